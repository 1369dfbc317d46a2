// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The example of README.md loads, and FORMAT.md, which explains the format, names every key the schemas know.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "scenarios/loader/loader.hpp"

namespace rigor::scenario {
namespace {

std::string read(const std::string& path) {
    std::ifstream in(std::string(RIGOR_SOURCE_DIR) + "/" + path);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string example() {
    const std::string page = read("scenarios/README.md"), open = "```json\n";
    const auto begin = page.find(open) + open.size();
    return page.substr(begin, page.find("```", begin) - begin);
}

TEST(Readme, ItsExampleLoads) {
    const Scenario s = loadScenarioText(example(), "README.md").scenario;
    EXPECT_EQ(s.name, "falling_ball");
    // Density 1000 by default: the mass of a ball of 0.1 m.
    EXPECT_NEAR(s.bodies[1].massProperties.mass, 4.0 / 3.0 * 3.14159265358979323846, 1e-12);
    EXPECT_EQ(s.accept.size(), 1u);
}

TEST(Readme, ItsExampleIsTheSmallest) {
    const auto json = nlohmann::json::parse(example());
    for (const auto& [key, value] : json.items()) {
        // parts that the example shows
        if (key == "materials" || key == "reference" || key == "accept") continue;
        auto less = json;
        less.erase(key);
        EXPECT_THROW((void)loadScenarioText(less.dump(), "less"), LoadError) << key;
    }
}

void collectKeys(const nlohmann::json& schema, std::set<std::string>& keys) {
    if (schema.is_object()) {
        if (const auto it = schema.find("properties"); it != schema.end())
            for (const auto& [key, value] : it->items()) keys.insert(key);
        for (const auto& [key, value] : schema.items()) collectKeys(value, keys);
    } else if (schema.is_array()) {
        for (const auto& value : schema) collectKeys(value, keys);
    }
}

TEST(Format, NamesEveryKeyOfTheSchemas) {
    const std::string page = read("scenarios/FORMAT.md");
    for (const char* file :
         {"scenarios/schema/scenario.schema.json", "scenarios/schema/suite.schema.json",
          "scenarios/schema/collision.schema.json", "scenarios/schema/study.schema.json"}) {
        std::set<std::string> keys;
        collectKeys(nlohmann::json::parse(read(file)), keys);
        EXPECT_GT(keys.size(), 5u);
        for (const std::string& key : keys)
            EXPECT_NE(page.find(key), std::string::npos) << file << ": " << key;
    }
}

}  // namespace
}  // namespace rigor::scenario
