// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/capability_fields.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <type_traits>

namespace rigor::adapter {
namespace {

using nlohmann::json;

/// Changes a field to what no default is.
void change(bool& field) {
    field = !field;
}
void change(std::vector<int>& field) {
    field.push_back(7);
}
void change(std::vector<std::string>& field) {
    field.emplace_back("word");
}
void change(std::map<std::string, std::string>& field) {
    field["what"] = "where";
}

TEST(CapabilityFields, EachHasAKeyOfItsOwnThatIsWrittenAndRead) {
    std::set<std::string> names;
    Capabilities all;
    forEachCapability(all, [&](const char* name, auto& field) {
        EXPECT_TRUE(names.insert(name).second) << name << " is there twice";
        const json before = capabilitiesToJson<json>(all);
        change(field);
        const json after = capabilitiesToJson<json>(all);
        for (const auto& [key, value] : after.items())
            EXPECT_EQ(value != before.at(key), key == name) << key << " when " << name << " changes";
        EXPECT_EQ(capabilitiesToJson<json>(capabilitiesFromJson(after)), after) << name;
    });
    EXPECT_EQ(capabilitiesToJson<json>(all).size(), names.size());
}

}  // namespace
}  // namespace rigor::adapter
