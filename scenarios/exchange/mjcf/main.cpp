// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The reader of MJCF files: rewrites what is newer than the library, judges every element, lets the library compile
// the model, and maps the compiled model.
#include <unistd.h>

#include <charconv>
#include <cstdio>

#include "scenarios/exchange/mjcf/mjcf.hpp"

namespace rigor::models::mjcf {
namespace {

/// The library's errors end the process: the caller reads the message.
void onError(const char* message) {
    std::fprintf(stderr, "libmujoco: %s\n", message);
    std::fflush(stderr);
    _exit(4);
}
void onWarning(const char* message) {
    std::fprintf(stderr, "libmujoco: %s\n", message);
}

void checkWords(XmlFile& file, Report& report) {
    applyRules(
        file, rules(), report,
        [](const std::string& element, const std::string& attribute) {
            const bool mapped = (element == "body" && attribute == "gravcomp") ||
                                (element == "freejoint" && attribute == "align");
            return mapped || libraryKnows(element, attribute);
        },
        libraryName());
    for (const char* section : {"actuator", "sensor"})
        if (auto* e = file.root()->FirstChildElement(section); e && e->NoChildren())
            file.root()->DeleteChild(e);
}

/// Sets the start: the model's own, or that of a keyframe.
void setStart(mjModel& m, mjData& d, const ReadOptions& options, Report& report, const Place& place) {
    mj_resetData(&m, &d);
    if (options.keyframe.empty()) {
        if (m.nkey > 0)
            report.changed(
                "<keyframe>", place,
                "the start is the model's own pose at rest; --keyframe NAME or NUMBER starts from one of the "
                "file's " +
                    std::to_string(m.nkey));
    } else {
        int key = mj_name2id(&m, mjOBJ_KEY, options.keyframe.c_str());
        const char* end = options.keyframe.data() + options.keyframe.size();
        if (key < 0 && std::from_chars(options.keyframe.data(), end, key).ptr != end) key = -1;
        if (key < 0 || key >= m.nkey)
            throw Refusal(place, "--keyframe: found '" + options.keyframe +
                                     "', expected the name or number of one of " + std::to_string(m.nkey));
        mj_resetDataKeyframe(&m, &d, key);
    }
    const int flags = m.opt.disableflags;
    m.opt.disableflags |= mjDSBL_CONTACT;
    mj_forward(&m, &d);
    m.opt.disableflags = flags;
}

Answer read(const ReadOptions& options) {
    mju_user_error = onError;
    mju_user_warning = onWarning;
    Report report(options.without);
    XmlFile file(options.file);
    const AssetFolders assets(options.file, options.assets);
    lower(file, assets, report);
    checkWords(file, report);
    if (report.isRefused()) return {"", report};
    const Places places = collectPlaces(file);
    const Model model = compile(file, file.shownName());
    const Data data(mj_makeData(model.get()));
    setStart(*model, *data, options, report, {file.shownName(), 0});
    SceneBuilder builder(options, report, "MJCF", libraryName());
    Conversion c{options, report, builder, *model, *data, places, {}};
    builder.scene.gravity = c.isOff(mjDSBL_GRAVITY) ? scenario::Vec3{} : c.point(model->opt.gravity, 0);
    builder.setTimeStep(model->opt.timestep);
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
