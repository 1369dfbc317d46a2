// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The findings of the studies on symmetries, chaos and surfaces hold; of the second, which takes minutes, some
// parts.
#include <filesystem>
#include <fstream>
#include <set>

#include "scenarios/loader/study.hpp"
#include "validation/studies/tests/run_study.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

/// Some parts of a shipped study as a file of its own.
std::string partsOf(const std::string& study, const std::set<std::string>& names) {
    const auto file = scenario::findStudy(study);
    std::ifstream in(file);
    json all = json::parse(in);
    json parts = json::array();
    for (json& part : all["parts"]) {
        if (!names.contains(part.at("name"))) continue;
        for (json& name : part["scenarios"])
            if (name.get<std::string>().ends_with(".json"))
                name = (file.parent_path() / name.get<std::string>()).string();
        parts.push_back(part);
    }
    all["parts"] = parts;
    const auto copy = newFolder() / (study + "_parts.json");
    std::ofstream(copy) << all.dump();
    return copy.string();
}

void expectFindings(const std::string& study, std::size_t least) {
    int code = -1;
    const json out = runStudy(study, code);
    ASSERT_FALSE(out.is_discarded()) << study;
    EXPECT_EQ(code, 0) << study;
    EXPECT_GE(out.at("findings").size(), least);
    for (const json& f : out.at("findings"))
        EXPECT_TRUE(f.at("holds")) << f.at("statement") << " (" << f.at("variant") << ", " << f.at("metric")
                                   << "): " << f.at("least") << " .. " << f.at("greatest");
}

TEST(ShippedStudies, SymmetriesHold) {
    expectFindings(partsOf("symmetries", {"smooth", "impact", "friction", "stack", "heap_2d"}), 50);
}

TEST(ShippedStudies, ChaosHolds) {
    expectFindings(partsOf("chaos", {"heap_parts_2d", "heap_2d"}), 10);
}

TEST(ShippedStudies, SurfacesHold) {
    expectFindings("surfaces", 10);
}

}  // namespace
}  // namespace rigor::validation
