// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Short names of specs: what they leave out, that they stay short, and that no two are the same.
#include "validation/results/spec_labels.hpp"

#include <gtest/gtest.h>

#include <set>

namespace rigor::results {
namespace {

using Specs = std::vector<std::string>;

std::vector<std::string> labelsOf(const Specs& specs) {
    const auto labels = specLabels(specs);
    std::vector<std::string> list;
    for (const auto& spec : specs) list.push_back(labels.at(spec));
    return list;
}

TEST(SpecLabels, ThePresetOfAllGoesWithoutSaying) {
    EXPECT_EQ(labelsOf({"bullet:preset=matched", "rigor:preset=matched", "box2d"}),
              (Specs{"bullet", "rigor", "box2d"}));
    EXPECT_EQ(labelsOf({"bullet:preset=default", "rigor:preset=matched"}),
              (Specs{"bullet default", "rigor matched"}));
    EXPECT_EQ(labelsOf({"box2d", "box2d:preset=matched", "rigor:preset=matched"}),
              (Specs{"box2d", "box2d matched", "rigor"}));
}

TEST(SpecLabels, TellWhatSpecsOfAnEngineDifferIn) {
    EXPECT_EQ(labelsOf({"rigor:precision=f32,solver=wide,substeps=4",
                        "rigor:precision=f32,solver=wide,substeps=5"}),
              (Specs{"rigor substeps=4", "rigor substeps=5"}));
    EXPECT_EQ(labelsOf({"rigor:broad_phase=octree,precision=f32", "rigor:broad_phase=octree,precision=f64",
                        "fcl:broad_phase=sap"}),
              (Specs{"rigor f32", "rigor f64", "fcl sap"}));
    EXPECT_EQ(labelsOf({"rigor:sleeping=off"}), (Specs{"rigor sleeping=off"}));
}

TEST(SpecLabels, WordsThatWouldNotTellApartGetTheirKeys) {
    EXPECT_EQ(labelsOf({"a:one=x", "a:two=x"}), (Specs{"a one=x", "a two=x"}));
}

TEST(SpecLabels, LongOnesAreNumbered) {
    const std::string fast =
        "rigor:box_margin=0.05,broad_phase=wide_tree,contact_frequency=45,precision=f32,";
    EXPECT_EQ(labelsOf({"rigor:preset=matched", fast + "preset=matched,substeps=5", fast + "preset=matched"}),
              (Specs{"rigor", "rigor[1]", "rigor[2]"}));
    EXPECT_EQ(labelsOf({fast + "substeps=5"}), (Specs{"rigor[1]"}));
}

TEST(SpecLabels, AreUniqueAndShortWhateverTheSpecs) {
    // All sets of options with values that are words, numbers, and the same for several keys.
    const Specs options{"a=x", "b=x", "c=off", "d=7", "e=a_word_that_is_long_by_itself", "x"};
    Specs specs;
    for (const char* engine : {"one", "two"})
        for (unsigned set = 0; set < 1u << options.size(); ++set) {
            std::string spec = engine;
            for (std::size_t i = 0; i < options.size(); ++i)
                if ((set >> i & 1u) != 0) spec += (spec == engine ? ":" : ",") + options[i];
            specs.push_back(spec);
        }
    const auto labels = specLabels(specs);
    ASSERT_EQ(labels.size(), specs.size());
    std::set<std::string> seen;
    for (const auto& [spec, label] : labels) {
        EXPECT_LE(label.size(), 36u) << spec;
        EXPECT_TRUE(seen.insert(label).second) << spec << ": " << label;
    }
}

}  // namespace
}  // namespace rigor::results
