// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// No code compares an algorithm's name to know what it does, that is what its traits are for; and no code
// outside of the in-house engine and its adapter spells its name, to treat it otherwise than the others.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "validation/hygiene/tests/source_tree.hpp"

namespace rigor::hygiene {
namespace {

using Names = std::set<std::string>;

/// Names of every table of the engine.
Names algorithmNames() {
    Names names;
    static const std::regex line(R"(\nALGORITHM\((\w+),)");
    for (const std::string& file : sourceFiles({".def"})) {
        if (!file.starts_with("engine/")) continue;
        const std::string text = readFile(file);
        for (std::sregex_iterator i(text.begin(), text.end(), line), end; i != end; ++i)
            if ((*i)[1] != "name") names.insert((*i)[1]);
    }
    return names;
}

std::string withoutComments(const std::string& text) {
    static const std::regex comment("//[^\n]*");
    return std::regex_replace(text, comment, "");
}

/// Names that `text` is asked to be compared with.
Names compared(const std::string& text) {
    static const std::regex equal(R"re([=!]=\s*"(\w+)"|"(\w+)"\s*[=!]=)re");
    Names names;
    const std::string code = withoutComments(text);
    for (std::sregex_iterator i(code.begin(), code.end(), equal), end; i != end; ++i)
        names.insert((*i)[1].matched ? (*i)[1] : (*i)[2]);
    return names;
}

bool isTestFile(const std::string& file) {
    return file.find("/tests/") != std::string::npos;
}

/// Benchmarks of what takes too long for all of their sizes.
const std::set<std::pair<std::string, std::string>> kMayCompare{
    {"engine/benchmarks/counted_parts.cpp", "mpr"},
    {"engine/broadphase/benchmarks/broad_phase_benchmark.cpp", "brute_force"}};

/// Words that mean other things outside of the engine: shapes, forces, settings.
const Names kOtherWords{"none", "off", "min", "max", "cone", "soft", "block", "spring", "drag", "constant"};

TEST(Names, OfAlgorithmsAreComparedNowhere) {
    const Names names = algorithmNames();
    ASSERT_TRUE(names.contains("nsgs") && names.contains("rk4") &&
                names.contains("conservative_advancement"));
    for (const std::string& file : sourceFiles({".cpp", ".hpp"})) {
        const bool own = file.starts_with("engine/") || file.starts_with("adapters/rigor/");
        const bool other = file.starts_with("cli/") || file.starts_with("validation/");
        if ((!own && !other) || isTestFile(file)) continue;
        for (const std::string& name : compared(readFile(file))) {
            if (!names.contains(name) || (other && kOtherWords.contains(name))) continue;
            EXPECT_TRUE(kMayCompare.contains({file, name})) << file << " compares with \"" << name << '"';
        }
    }
}

TEST(Names, TheRuleFindsComparisons) {
    EXPECT_EQ(compared("if (name == \"nsgs\" || \"rk4\" != other) // == \"pgs\"\n x = \"sat\";"),
              (Names{"nsgs", "rk4"}));
}

/// Removes names with other meanings than engines: the program, the scenario format, folders of an
/// installation.
std::string withoutOtherMeanings(std::string code) {
    static const std::regex other(
        R"re(\{"rigor", ?1\}|\{"rigor", RIGOR_VERSION\}|require\("rigor"\)|isObject\(\{"rigor"|app\.name\("rigor"\)|/ "rigor" /|"rigor: )re");
    return std::regex_replace(code, other, "");
}

TEST(Names, OfTheInHouseEngineIsSpeltOnce) {
    const std::string once = "validation/results/judgement.hpp";
    // List of the known deviations of every engine.
    const std::string deviations = "adapters/conformance/deviations.cpp";
    static const std::regex spelt(R"re("rigor[":])re");
    for (const std::string& file : sourceFiles({".cpp", ".hpp"})) {
        if (file.starts_with("engine/") || file.starts_with("adapters/rigor/") || isTestFile(file)) continue;
        if (file == deviations) continue;
        const std::string code = withoutOtherMeanings(withoutComments(readFile(file)));
        const auto times = std::distance(std::sregex_iterator(code.begin(), code.end(), spelt), {});
        EXPECT_EQ(times, file == once ? 1 : 0) << file << ": use kInHouseEngine (" << once << ")";
    }
}

}  // namespace
}  // namespace rigor::hygiene
