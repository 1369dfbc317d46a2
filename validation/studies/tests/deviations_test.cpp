// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Known deviations whose evidence is an experiment: the experiment is in this repository and gives today what
// the reason says. It is a part of the study `deviations`, or a plain program that the reason names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "scenarios/loader/study.hpp"
#include "validation/studies/tests/run_study.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

json libraryFile(const std::filesystem::path& path) {
    std::ifstream in(path);
    return json::parse(in);
}
json deviationsStudy() {
    return libraryFile(scenario::findStudy("deviations"));
}
bool has(const json& list, const std::string& what) {
    return std::find(list.begin(), list.end(), what) != list.end();
}

/// A part about this scenario and metric with a variant of this engine.
bool isolatedBy(const json& part, const std::string& scenario, const json& deviation) {
    const std::string engine = deviation.at("engine");
    const bool variant =
        std::any_of(part.at("variants").begin(), part.at("variants").end(),
                    [&](const json& v) { return v.at("engine").get<std::string>().starts_with(engine); });
    return variant && has(part.at("scenarios"), scenario) && has(part.at("metrics"), deviation.at("metric"));
}

/// "(plain_programs/bullet/touch.cpp" in a reason names a file of the conformance kit, "(guest/engines/plain/jolt.mjs" one of the
/// guests.
bool namesAPlainProgram(const std::string& reason) {
    struct Place {
        const char *folder, *begins, *ends;
    };
    for (const Place& place : {Place{"adapters/conformance", "plain_programs/", ".cpp"},
                               Place{"adapters", "guest/engines/plain/", ".mjs"}}) {
        const std::size_t start = reason.find(place.begins), end = reason.find(place.ends, start);
        if (start == std::string::npos || end == std::string::npos) continue;
        const std::string name = reason.substr(start, end + std::strlen(place.ends) - start);
        return std::filesystem::exists(std::filesystem::path(RIGOR_SOURCE_DIR) / place.folder / name);
    }
    return false;
}

TEST(Deviations, EveryExperimentIsInTheRepository) {
    const json study = deviationsStudy();
    int experiments = 0;
    for (const char* folder : {"2d", "3d"})
        for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(RIGOR_SOURCE_DIR) /
                                                                     "scenarios/library" / folder)) {
            const json scenario = libraryFile(entry.path());
            for (const json& deviation : scenario.value("known_deviations", json::array())) {
                if (deviation.at("evidence") != "experiment") continue;
                ++experiments;
                const bool isolated = std::any_of(
                    study.at("parts").begin(), study.at("parts").end(),
                    [&](const json& part) { return isolatedBy(part, scenario.at("name"), deviation); });
                EXPECT_TRUE(isolated || namesAPlainProgram(deviation.at("reason")))
                    << scenario.at("name") << ", " << deviation.dump();
            }
        }
    EXPECT_GT(experiments, 100);
}

TEST(Deviations, EachIsShownAndGoesByOneSetting) {
    int code = -1;
    const json out = runStudy("deviations", code);
    ASSERT_FALSE(out.is_discarded());
    EXPECT_EQ(code, 0);
    ASSERT_GT(out.at("symptoms").size(), 40u);
    for (const json& s : out.at("symptoms")) {
        const std::string name = s.at("name");
        EXPECT_TRUE(s.at("shown")) << name << ": " << s.at("fault_value") << " < " << s.at("fault_at_least");
        EXPECT_TRUE(s.at("cured")) << name << ": " << s.at("cure_value") << " > " << s.at("cure_at_most");
        EXPECT_EQ(s.at("switched").size(), 1u) << name << ": " << s.at("switched");
    }
    for (const json& f : out.at("findings")) EXPECT_TRUE(f.at("holds")) << f;
}

}  // namespace
}  // namespace rigor::validation
