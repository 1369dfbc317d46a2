// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The library's symptoms, run for real: every fault is visible, every cure works, and one setting is all that
// is switched between them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "scenarios/loader/study.hpp"
#include "validation/studies/tests/run_study.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

TEST(Symptoms, EveryFaultIsVisibleAndEveryCureWorks) {
    int code = -1;
    const json out = runStudy("symptoms", code);
    ASSERT_FALSE(out.is_discarded());
    EXPECT_EQ(code, 0);
    const auto study = scenario::loadStudy(scenario::findStudy("symptoms"));
    ASSERT_EQ(out.at("symptoms").size(), study.parts.size()) << "every part of it states a symptom";
    for (const json& s : out.at("symptoms")) {
        const std::string name = s.at("name");
        EXPECT_TRUE(s.at("shown")) << name << ": " << s.at("fault_value") << " < " << s.at("fault_at_least");
        EXPECT_TRUE(s.at("cured")) << name << ": " << s.at("cure_value") << " > " << s.at("cure_at_most");
        EXPECT_EQ(s.at("switched").size(), 1u) << name << ": " << s.at("switched");
    }
    EXPECT_TRUE(out.at("green"));
}

/// Known symptoms of a first engine: each has its part.
TEST(Symptoms, TheClassicOnesAreThere) {
    const auto study = scenario::loadStudy(scenario::findStudy("symptoms"));
    std::set<std::string> names;
    for (const auto& part : study.parts) names.insert(part.name);
    for (const char* name :
         {"jitter_iterations", "jitter_restitution", "jitter_normals", "sinking_no_correction",
          "sinking_no_resting_contact", "sticking", "flying_division", "flying_normal", "flying_floor",
          "flying_quaternion", "collapse_single_point", "collapse_iterations", "collapse_restitution",
          "slowdown_brute_force", "slowdown_no_rejection", "tunnelling"})
        EXPECT_TRUE(names.contains(name)) << name;
}

/// The verdicts are of the runs: where a fault is off, its symptom is not there and the study is red.
TEST(Symptoms, AFaultThatIsSwitchedOffIsNotShown) {
    const auto file = scenario::findStudy("symptoms");
    std::ifstream in(file);
    json study = json::parse(in);
    json parts = json::array();
    for (json& part : study["parts"]) {
        if (part["name"] != "flying_floor" && part["name"] != "sticking") continue;
        part["scenarios"][0] = (file.parent_path() / part["scenarios"][0].get<std::string>()).string();
        part["variants"][0]["engine"] = "rigor:fault=none";
        part["variants"][1]["engine"] = "rigor:fault=none,precision=f64";
        parts.push_back(part);
    }
    ASSERT_EQ(parts.size(), 2u);
    study["parts"] = parts;
    const auto own = std::filesystem::path(testing::TempDir()) / "faultless.json";
    std::ofstream(own) << study;
    int code = 0;
    const json out = runStudy(own.string(), code);
    ASSERT_FALSE(out.is_discarded());
    EXPECT_EQ(code, 1);
    EXPECT_FALSE(out.at("green"));
    for (const json& s : out.at("symptoms")) {
        EXPECT_FALSE(s.at("shown")) << s.at("name");
        EXPECT_TRUE(s.at("cured")) << s.at("name");
    }
}

}  // namespace
}  // namespace rigor::validation
