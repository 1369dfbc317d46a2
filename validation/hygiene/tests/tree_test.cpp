// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The repository's own rules: licence lines, size of files, folders' READMEs, links and words that do not
// belong.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "validation/hygiene/tests/source_tree.hpp"

namespace rigor::hygiene {
namespace {

TEST(Tree, EverySourceFileStartsWithTheLicenceLines) {
    for (const auto& file :
         sourceFiles({".hpp", ".cpp", ".def", ".cmake", "CMakeLists.txt", ".js", ".css"})) {
        const std::string head = readFile(file).substr(0, 300);
        // REUSE-IgnoreStart
        EXPECT_NE(head.find("SPDX-License-Identifier: MIT"), std::string::npos) << file;
        EXPECT_NE(head.find("SPDX-FileCopyrightText: 2026 The Rigor authors"), std::string::npos) << file;
        // REUSE-IgnoreEnd
    }
}

TEST(Tree, FilesAreSmallRooms) {
    constexpr std::ptrdiff_t kMost = 700;
    for (const auto& file : sourceFiles({".hpp", ".cpp"})) {
        const std::string text = readFile(file);
        EXPECT_LE(std::count(text.begin(), text.end(), '\n'), kMost) << file;
    }
}

TEST(Tree, EveryFolderHasAReadme) {
    for (const char* folder : {"engine",
                               "adapters",
                               "scenarios",
                               "scenarios/exchange",
                               "validation",
                               "reports",
                               "reports/web",
                               "reports/handbook",
                               "cli",
                               "adapters/rigor",
                               "adapters/bullet",
                               "adapters/box2d",
                               "adapters/ode",
                               "adapters/fcl",
                               "adapters/mujoco",
                               "adapters/chipmunk",
                               "adapters/dart",
                               "adapters/simbody",
                               "adapters/siconos",
                               "adapters/guest",
                               "adapters/conformance",
                               "validation/references",
                               "validation/metrics",
                               "validation/results",
                               "validation/runner",
                               "validation/bench",
                               "validation/collide",
                               "validation/contact_problems",
                               "validation/studies",
                               "validation/symmetry",
                               "validation/chaos",
                               "validation/live",
                               "validation/fuzz",
                               "validation/same_bits"})
        EXPECT_TRUE(exists(std::string(folder) + "/README.md")) << folder;
}

/// The text without its fenced pieces of code, in which lambdas look like links.
std::string withoutCode(const std::string& text) {
    std::string rest;
    bool inCode = false;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const bool fence = line.starts_with("```");
        if (!fence && !inCode) rest += line + "\n";
        inCode = inCode != fence;
    }
    return rest;
}

/// Relative links and back-quoted paths of the documentation lead somewhere.
TEST(Tree, DocumentationNamesOnlyWhatExists) {
    const std::regex link(R"(\]\(([^)#:]+)\))");
    for (const auto& file : sourceFiles({".md"})) {
        const std::string text = withoutCode(readFile(file));
        const std::string folder =
            file.find('/') == std::string::npos ? "" : file.substr(0, file.rfind('/') + 1);
        for (auto it = std::sregex_iterator(text.begin(), text.end(), link); it != std::sregex_iterator();
             ++it)
            EXPECT_TRUE(exists(folder + (*it)[1].str())) << file << " links to " << (*it)[1].str();
    }
}

TEST(Tree, NoUnfinishedWordsAndNoMachinePaths) {
    const std::regex forbidden(R"((\bTODO\b|\bFIXME\b|\bXXX\b|/(home|work|root)/|/tmp/build))");
    for (const auto& file :
         sourceFiles({".hpp", ".cpp", ".md", ".json", ".cmake", "CMakeLists.txt", ".js", ".css", "rigor"})) {
        if (file.starts_with("validation/hygiene/")) continue;
        std::smatch match;
        const std::string text = readFile(file);
        EXPECT_FALSE(std::regex_search(text, match, forbidden)) << file << ": " << match.str();
    }
}

/// The version of CMakeLists.txt is that of the packages (cmake/RigorPackages.cmake), of the Python package and of what people
/// cite, and the newest version of the changelog, with one date.
TEST(Tree, OneVersion) {
    std::smatch version, newest;
    const std::string cmake = readFile("CMakeLists.txt"), changes = readFile("CHANGELOG.md");
    ASSERT_TRUE(std::regex_search(cmake, version, std::regex(R"(project\(rigor VERSION ([0-9.]+))")));
    ASSERT_TRUE(
        std::regex_search(changes, newest, std::regex(R"(\n## ([0-9.]+) \((\d{4}-\d{2}-\d{2})\)\n)")));
    EXPECT_EQ(newest[1].str(), version[1].str());
    const std::string citation = readFile("CITATION.cff"),
                      python = readFile("reports/python/rigor/__init__.py");
    EXPECT_NE(citation.find("\nversion: " + version[1].str() + "\n"), std::string::npos);
    EXPECT_NE(citation.find("\ndate-released: " + newest[2].str() + "\n"), std::string::npos);
    EXPECT_NE(python.find("\n__version__ = \"" + version[1].str() + "\"\n"), std::string::npos);
    EXPECT_NE(readFile("cmake/RigorPackages.cmake").find("CPACK_PACKAGE_VERSION ${PROJECT_VERSION}"),
              std::string::npos);
}

/// Standard-library random engines are portable, its distributions are not: scenario generators must not use
/// them.
TEST(Tree, GeneratorsArePortable) {
    const std::regex distribution(R"(std::(uniform_real|uniform_int|normal)_distribution)");
    for (const auto& file : sourceFiles({".cpp", ".hpp"})) {
        if (!file.starts_with("scenarios/generators/")) continue;
        EXPECT_FALSE(std::regex_search(readFile(file), distribution)) << file;
    }
}

}  // namespace
}  // namespace rigor::hygiene
