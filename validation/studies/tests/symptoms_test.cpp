// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The library's symptoms, run for real: every fault is visible, every cure works, and one setting is all that
// is switched between them.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "scenarios/loader/study.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

json runSymptoms() {
    const auto folder = std::filesystem::path(testing::TempDir()) / "symptoms-run";
    std::filesystem::remove_all(folder);
    const std::string command =
        std::string(RIGOR_BINARY_DIR) + "/bin/rigor study symptoms -q -j 2 --json --out " + folder.string();
    FILE* pipe = popen(command.c_str(), "r");
    std::string out;
    char buffer[4096];
    while (const std::size_t n = fread(buffer, 1, sizeof buffer, pipe)) out.append(buffer, n);
    pclose(pipe);
    return json::parse(out, nullptr, false);
}

TEST(Symptoms, EveryFaultIsVisibleAndEveryCureWorks) {
    const json out = runSymptoms();
    ASSERT_FALSE(out.is_discarded());
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

/// What the issue of a beginner's engine is known for: each has a part.
TEST(Symptoms, TheClassicOnesAreThere) {
    const auto study = scenario::loadStudy(scenario::findStudy("symptoms"));
    std::set<std::string> kinds;
    for (const auto& part : study.parts) kinds.insert(part.name.substr(0, part.name.find('_')));
    for (const char* kind : {"jitter", "sinking", "sticking", "flying", "collapse", "slowdown", "tunnelling"})
        EXPECT_TRUE(kinds.contains(kind)) << kind;
}

}  // namespace
}  // namespace rigor::validation
