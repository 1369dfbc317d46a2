// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The reader of MJCF files: rewrites what is newer than the library, judges every element, lets a library compile
// the model, and maps the compiled model.
#include <algorithm>
#include <charconv>

#include "scenarios/exchange/mjcf/mjcf.hpp"

namespace rigor::models::mjcf {
namespace {

/// Judges every element. Returns whether something is newer than libmujoco, and MuJoCo 3 is there to read it.
bool checkWords(XmlFile& file, Report& report, const NewerLibrary& newer) {
    bool needsNewer = false;
    applyRules(file, rules(), report, [&](const std::string& element, const std::string& attribute) {
        const bool mapped = (element == "body" && attribute == "gravcomp") ||
                            (element == "freejoint" && attribute == "align");
        if (mapped || libraryKnows(element, attribute)) return std::string();
        const std::string older = "newer than " + libraryName() + " reads";
        if (!NewerLibrary::maps(element, attribute)) return older;
        needsNewer = true;
        return newer.isInstalled() ? "" : older + "; MuJoCo 3 of npm does: " + newer.install();
    });
    for (const char* section : {"actuator", "sensor"})
        if (auto* e = file.root()->FirstChildElement(section); e && e->NoChildren())
            file.root()->DeleteChild(e);
    return needsNewer;
}

/// The number of the keyframe that --keyframe names, -1 without one.
int keyframeOf(XmlFile& file, const ReadOptions& options, Report& report) {
    std::vector<std::string> names;
    for (auto* section = file.root()->FirstChildElement("keyframe"); section;
         section = section->NextSiblingElement("keyframe"))
        for (auto* key = section->FirstChildElement("key"); key; key = key->NextSiblingElement("key"))
            names.emplace_back(key->Attribute("name") ? key->Attribute("name") : "");
    const Place place{file.shownName(), 0};
    const int count = static_cast<int>(names.size());
    if (options.keyframe.empty()) {
        if (count > 0)
            report.changed("<keyframe>", place,
                           "the start is the model's own pose at rest; --keyframe NAME or NUMBER starts from "
                           "one of the file's " +
                               std::to_string(count));
        return -1;
    }
    const auto named = std::find(names.begin(), names.end(), options.keyframe);
    if (named != names.end()) return static_cast<int>(named - names.begin());
    int key = -1;
    const char* end = options.keyframe.data() + options.keyframe.size();
    if (std::from_chars(options.keyframe.data(), end, key).ptr != end) key = -1;
    if (key < 0 || key >= count)
        throw Refusal(place, "--keyframe: found '" + options.keyframe +
                                 "', expected the name or number of one of " + std::to_string(count));
    return key;
}

/// The model of libmujoco, or of MuJoCo 3 where the file is newer or libmujoco does not compile it and MuJoCo 3 does.
CompiledModel compiledBy(const NewerLibrary& newer, bool needsNewer, XmlFile& file, int keyframe) {
    if (needsNewer) return newer.compile(file, keyframe);
    try {
        return compile(file, keyframe);
    } catch (const Refusal& older) {
        if (!newer.isInstalled()) throw;
        try {
            return newer.compile(file, keyframe);
        } catch (const Refusal&) {
            throw older;
        }
    }
}

Answer read(const ReadOptions& options) {
    Report report(options.without);
    XmlFile file(options.file);
    const AssetFolders assets(options.file, options.assets);
    lower(file, assets, report);
    const NewerLibrary newer;
    const bool needsNewer = checkWords(file, report, newer);
    if (report.isRefused()) return {"", report};
    const Places places = collectPlaces(file);
    const int keyframe = keyframeOf(file, options, report);
    const CompiledModel model = compiledBy(newer, needsNewer, file, keyframe);
    if (!model.isFinite())
        throw Refusal({file.shownName(), 0}, "a value is not a number, not finite or beyond 1e15");
    SceneBuilder builder(options, report, "MJCF", model.library);
    Conversion c{options, report, builder, model, places, {}};
    builder.scene.gravity = c.isOff("gravity") ? scenario::Vec3{} : c.point(model.gravity, 0);
    builder.setTimeStep(model.timestep);
    addBodies(c);
    addGeoms(c);
    addJoints(c);
    addConstraints(c);
    addContactRules(c);
    return builder.finish();
}

}  // namespace
}  // namespace rigor::models::mjcf

int main(int argc, char** argv) {
    return rigor::models::runReader(argc, argv, rigor::models::mjcf::read);
}
