// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rule of includes between folders. The layers are a table; every #include "..." of the tree is checked
// against it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>

#include "validation/hygiene/tests/source_tree.hpp"

namespace rigor::hygiene {
namespace {

struct Rule {
    std::string folder;                ///< folder of the including file; the longest match counts
    std::vector<std::string> allowed;  ///< prefixes of the paths it may include, besides its own folder
};

const std::vector<Rule>& rules() {
    static const std::vector<Rule> table{
        {"engine/core", {}},
        {"engine/math", {"engine/core"}},
        {"engine/shapes", {"engine/core", "engine/math"}},
        {"engine/state", {"engine/core", "engine/math", "engine/shapes"}},
        {"engine/broadphase", {"engine/core", "engine/math"}},
        {"engine/narrowphase", {"engine/core", "engine/math", "engine/shapes"}},
        {"engine/constraints",
         {"engine/core", "engine/math", "engine/state", "engine/narrowphase/manifold.hpp"}},
        {"engine/solvers",
         {"engine/core", "engine/math", "engine/state", "engine/constraints/row.hpp",
          "engine/constraints/soft.hpp"}},
        {"engine/forces", {"engine/core", "engine/math", "engine/state"}},
        {"engine/integrators", {"engine/core", "engine/math", "engine/state", "engine/forces"}},
        {"engine/faults",
         {"engine/core", "engine/math", "engine/shapes", "engine/state", "engine/broadphase/broad_phase.hpp",
          "engine/narrowphase/manifold.hpp", "engine/constraints/row.hpp"}},
        {"engine/contacts",
         {"engine/core", "engine/math", "engine/shapes", "engine/state", "engine/broadphase",
          "engine/narrowphase", "engine/constraints/row.hpp", "engine/constraints/soft.hpp",
          "engine/solvers"}},
        {"engine/ccd",
         {"engine/core", "engine/math", "engine/shapes", "engine/state", "engine/broadphase/broad_phase.hpp",
          "engine/narrowphase", "engine/solvers", "engine/integrators", "engine/contacts"}},
        {"engine/sleeping", {"engine/core", "engine/state", "engine/contacts"}},
        {"engine/pipeline", {"engine/"}},
        {"engine/queries", {"engine/"}},
        {"engine/embedding", {"engine/"}},
        {"engine/benchmarks", {"engine/"}},
        {"engine/package", {"engine/"}},
        {"engine/python", {"engine/"}},
        {"engine", {"engine/"}},  // rule of engine/engine.hpp alone
        {"scenarios/model", {}},
        {"scenarios/json", {"scenarios/model/"}},
        {"scenarios/generators", {"scenarios/json/", "scenarios/model/"}},
        {"scenarios/loader",
         {"scenarios/generators/", "scenarios/json/", "scenarios/model/", "scenarios/schema/"}},
        {"scenarios/exchange", {"scenarios/"}},
        {"adapters/interface", {"scenarios/model/"}},
        {"adapters/conformance", {"adapters/interface/", "scenarios/"}},
        // Simbody's headers need one of the adapter's to compile.
        {"adapters/conformance/plain_programs/simbody",
         {"adapters/interface/", "scenarios/", "adapters/conformance/", "adapters/simbody/headers.hpp"}},
        {"adapters/rigor/python",
         {"adapters/interface/", "adapters/rigor/", "scenarios/json/", "scenarios/loader/",
          "scenarios/model/", "engine/"}},
        {"adapters/rigor", {"adapters/interface/", "scenarios/model/", "engine/"}},
        {"adapters", {"adapters/interface/", "scenarios/model/"}},
        {"validation/references",
         {"scenarios/model/", "validation/trajectory.hpp", "adapters/interface/types.hpp"}},
        {"validation/oracle", {"scenarios/model/"}},
        {"validation/statistics", {}},
        {"validation/results", {}},
        {"validation/fuzz", {"validation/", "adapters/interface/", "adapters/guest/frame.hpp", "scenarios/"}},
        // Live sessions pace all engines by the accumulator of the in-house engine's package.
        {"validation/live",
         {"validation/", "adapters/interface/", "scenarios/", "engine/embedding/frame_clock.hpp"}},
        {"validation", {"validation/", "adapters/interface/", "scenarios/"}},
        {"reports/encoding", {"validation/results/"}},
        {"reports/model", {"reports/encoding/", "validation/results/", "validation/statistics/"}},
        {"reports/tables",
         {"reports/encoding/", "reports/model/", "validation/results/", "validation/statistics/"}},
        {"reports/plots", {"reports/encoding/", "reports/model/", "validation/results/"}},
        {"reports/replay",
         {"reports/encoding/", "reports/model/", "validation/results/", "validation/statistics/"}},
        {"reports/summaries",
         {"reports/encoding/", "reports/model/", "reports/tables/", "validation/results/"}},
        {"reports",
         {"reports/", "validation/results/", "validation/statistics/", "reports/tests/browser_tool.cpp"}},
        // `rigor draw` draws the scenes of all engines with the lines of the in-house one.
        {"cli",
         {"cli/", "engine/", "adapters/interface/", "adapters/rigor/convert_shape.hpp", "scenarios/",
          "validation/", "reports/"}}};
    return table;
}

const Rule* ruleFor(const std::string& file) {
    const Rule* best = nullptr;
    for (const Rule& rule : rules())
        if (file.starts_with(rule.folder + "/") &&
            (best == nullptr || rule.folder.size() > best->folder.size()))
            best = &rule;
    return best;
}

/// Tests may also include what they compare with: their rule is that of their folder plus the tests' own
/// needs.
bool isTest(const std::string& file) {
    return file.find("/tests/") != std::string::npos || file.find("/benchmarks/") != std::string::npos;
}

/// The folder a file may always include from: its rule's, and for adapters that of the one engine.
std::string ownFolder(const Rule& rule, const std::string& file) {
    if (rule.folder != "adapters") return rule.folder + "/";
    return file.substr(0, file.find('/', rule.folder.size() + 1) + 1);
}

bool isAllowed(const Rule& rule, const std::string& file, const std::string& included) {
    if (included.starts_with(ownFolder(rule, file))) return true;
    const std::string top = file.substr(0, file.find('/') + 1);
    if (isTest(file) && included.starts_with(top)) return true;
    if (isTest(file) && file.starts_with("adapters/") &&
        (included.starts_with("validation/oracle/") || included == "scenarios/loader/collision_cases.hpp"))
        return true;
    if (isTest(file) && file.starts_with("validation/references/") &&
        (included == "scenarios/loader/loader.hpp" || included == "scenarios/loader/write.hpp"))
        return true;
    for (const auto& prefix : rule.allowed)
        if (included.starts_with(prefix)) return true;
    return false;
}

std::vector<std::string> includesOf(const std::string& text) {
    static const std::regex pattern(R"(^[ \t]*#[ \t]*include[ \t]+"([^"]+)\")", std::regex::multiline);
    std::vector<std::string> found;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), pattern); it != std::sregex_iterator();
         ++it)
        found.push_back((*it)[1]);
    return found;
}

TEST(IncludeRule, EveryIncludeRespectsTheLayers) {
    std::size_t checked = 0;
    for (const auto& file : sourceFiles({".hpp", ".cpp", ".def"})) {
        if (file.starts_with("cmake/")) continue;
        const Rule* rule = ruleFor(file);
        ASSERT_NE(rule, nullptr) << file << " is in no known folder";
        EXPECT_TRUE(rule->folder != "engine" || file == "engine/engine.hpp") << file << " has no rule";
        for (const auto& included : includesOf(readFile(file))) {
            ++checked;
            EXPECT_TRUE(isAllowed(*rule, file, included))
                << file << " may not include \"" << included << "\"";
        }
    }
    EXPECT_GT(checked, 100u);
}

/// The folders of the solvers build on each other in one order: what is common, then laws and the joints'
/// direct solver, then the methods. No method includes another one's folder.
TEST(IncludeRule, FoldersOfSolversIncludeTheCommonPartAndWhatTheyBuildOn) {
    const std::string root = "engine/solvers/";
    const std::map<std::string, std::vector<std::string>> buildsOn{{"", {}},
                                                                   {"laws", {}},
                                                                   {"joints", {}},
                                                                   {"corrections", {"joints"}},
                                                                   {"lcp", {}},
                                                                   {"methods", {"joints", "lcp"}},
                                                                   {"wide", {"joints"}}};
    const auto folderOf = [&](const std::string& path) {
        const std::size_t slash = path.find('/', root.size());
        return slash == std::string::npos ? "" : path.substr(root.size(), slash - root.size());
    };
    std::set<std::string> seen;
    for (const auto& file : sourceFiles({".hpp", ".cpp"})) {
        if (!file.starts_with(root) || isTest(file)) continue;
        const std::string folder = folderOf(file);
        seen.insert(folder);
        ASSERT_TRUE(buildsOn.contains(folder)) << file << " is in a folder that this test does not know";
        const std::vector<std::string>& allowed = buildsOn.at(folder);
        for (const auto& included : includesOf(readFile(file))) {
            if (!included.starts_with(root)) continue;
            const std::string other = folderOf(included);
            EXPECT_TRUE(other.empty() || other == folder ||
                        std::find(allowed.begin(), allowed.end(), other) != allowed.end())
                << file << " may not include \"" << included << "\"";
        }
    }
    EXPECT_EQ(seen.size(), buildsOn.size());
}

using FolderGraph = std::map<std::string, std::set<std::string>>;

std::string folderOf(const std::string& path) {
    return path.substr(0, path.rfind('/'));
}

/// Graph of the includes between folders. Tests and benchmarks are left out.
FolderGraph folderGraph() {
    FolderGraph graph;
    for (const auto& file : sourceFiles({".hpp", ".cpp", ".def"})) {
        if (file.starts_with("cmake/") || isTest(file)) continue;
        std::set<std::string>& used = graph[folderOf(file)];
        for (const auto& included : includesOf(readFile(file)))
            if (exists(included) && folderOf(included) != folderOf(file)) used.insert(folderOf(included));
    }
    return graph;
}

/// Continues `path`, whose last folder is looked at, until a folder comes again; empty where none does.
std::vector<std::string> cycleFrom(const FolderGraph& graph, std::vector<std::string>& path,
                                   std::set<std::string>& finished) {
    const std::string folder = path.back();
    const auto found = graph.find(folder);
    if (found == graph.end() || finished.contains(folder)) return {};
    for (const std::string& next : found->second) {
        const auto start = std::find(path.begin(), path.end(), next);
        if (start != path.end()) {
            std::vector<std::string> cycle(start, path.end());
            cycle.push_back(next);
            return cycle;
        }
        path.push_back(next);
        if (auto cycle = cycleFrom(graph, path, finished); !cycle.empty()) return cycle;
        path.pop_back();
    }
    finished.insert(folder);
    return {};
}

std::vector<std::string> findCycle(const FolderGraph& graph) {
    std::set<std::string> finished;
    for (const auto& [folder, used] : graph) {
        std::vector<std::string> path{folder};
        if (auto cycle = cycleFrom(graph, path, finished); !cycle.empty()) return cycle;
    }
    return {};
}

TEST(IncludeRule, FoldersDoNotIncludeEachOtherInACycle) {
    const FolderGraph graph = folderGraph();
    EXPECT_GT(graph.size(), 50u);
    EXPECT_THAT(findCycle(graph), testing::IsEmpty());
}

TEST(IncludeRule, TheFinderOfCyclesFindsThem) {
    EXPECT_THAT(findCycle({{"a", {"b", "d"}}, {"b", {"c"}}, {"c", {"d"}}, {"d", {}}}), testing::IsEmpty());
    EXPECT_THAT(findCycle({{"a", {"b", "d"}}, {"b", {"c"}}, {"c", {"d"}}, {"d", {"b"}}}),
                testing::ElementsAre("b", "c", "d", "b"));
}

TEST(IncludeRule, TheRuleItselfRefuses) {
    const auto refused = [](const std::string& file, const std::string& included) {
        return !isAllowed(*ruleFor(file), file, included);
    };
    EXPECT_TRUE(refused("engine/solvers/methods/pgs.cpp", "engine/shapes/shape.hpp"));
    EXPECT_TRUE(refused("engine/ccd/speculative.cpp", "engine/pipeline/world.hpp"));
    EXPECT_TRUE(refused("engine/pipeline/world.cpp", "scenarios/model/scenario.hpp"));
    EXPECT_TRUE(refused("adapters/bullet/world.cpp", "engine/math/space.hpp"));
    EXPECT_TRUE(refused("adapters/bullet/world.cpp", "adapters/ode/world.hpp"));
    EXPECT_TRUE(refused("validation/references/flight/free_flight.cpp", "engine/math/space.hpp"));
    EXPECT_TRUE(refused("reports/page/html.cpp", "validation/runner/runner.hpp"));
    EXPECT_TRUE(refused("scenarios/loader/loader.cpp", "adapters/interface/types.hpp"));
    EXPECT_TRUE(refused("scenarios/generators/pile.cpp", "scenarios/loader/loader.hpp"));
    EXPECT_FALSE(refused("adapters/rigor/world.cpp", "engine/math/space.hpp"));
}

/// Eigen has one door; engine libraries stay in their adapter's folder. The page's numbers are held to the
/// store as SQLite itself reads it.
TEST(IncludeRule, ThirdPartyHeadersStayInTheirRooms) {
    const std::vector<std::pair<std::regex, std::vector<std::string>>> rooms{
        {std::regex(R"(#include\s*<Eigen/)"),
         {"engine/math/", "engine/shapes/", "engine/narrowphase/", "adapters/fcl/", "adapters/dart/",
          "adapters/conformance/plain_programs/dart/", "validation/references/",
          "validation/contact_problems/"}},
        {std::regex(R"(#include\s*<(oneapi/)?tbb/)"), {"engine/core/"}},
        {std::regex(R"(#include\s*<(bullet/|bt[A-Z]|Bullet|LinearMath))"),
         {"adapters/bullet/", "adapters/conformance/plain_programs/bullet/"}},
        {std::regex(R"(#include\s*<ode/)"), {"adapters/ode/", "adapters/conformance/plain_programs/ode/"}},
        {std::regex(R"(#include\s*<box2d/)"),
         {"adapters/box2d/", "adapters/conformance/plain_programs/box2d/"}},
        {std::regex(R"(#include\s*<fcl/)"), {"adapters/fcl/"}},
        {std::regex(R"(#include\s*<mujoco/)"),
         {"adapters/mujoco/", "adapters/conformance/plain_programs/mujoco/", "scenarios/exchange/"}},
        {std::regex(R"(#include\s*<chipmunk/)"),
         {"adapters/chipmunk/", "adapters/conformance/plain_programs/chipmunk/"}},
        {std::regex(R"(#include\s*<dart/)"), {"adapters/dart/", "adapters/conformance/plain_programs/dart/"}},
        {std::regex(R"(#include\s*<(Simbody|SimTK))"), {"adapters/simbody/"}},
        {std::regex(R"(#include\s*<fclib)"), {"validation/contact_problems/tests/oracle/"}},
        {std::regex(R"(#include\s*<(SQLiteCpp/|sqlite3|hdf5))"),
         {"validation/results/", "reports/tests/browser_tool.cpp"}},
        {std::regex(R"(#include\s*<httplib)"), {"cli/view/"}},
        {std::regex(R"(#include\s*<valijson/)"), {"scenarios/loader/"}},
        {std::regex(R"(#include\s*<CLI/)"), {"cli/"}}};
    for (const auto& file : sourceFiles({".hpp", ".cpp"})) {
        const std::string text = readFile(file);
        for (const auto& [pattern, folders] : rooms) {
            if (!std::regex_search(text, pattern)) continue;
            bool home = file.starts_with("validation/hygiene/");
            for (const auto& folder : folders) home = home || file.starts_with(folder);
            EXPECT_TRUE(home) << file << " includes a library's header outside its room (expected in "
                              << folders.front() << ")";
        }
    }
}

}  // namespace
}  // namespace rigor::hygiene
