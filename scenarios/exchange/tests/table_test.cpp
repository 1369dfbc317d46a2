// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The table of models in MODELS.md is what the program says of them. With RIGOR_UPDATE_TABLE=1 this test writes it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "scenarios/exchange/tests/library_says.hpp"
#include "scenarios/exchange/tests/tool.hpp"

namespace rigor::models::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Attempt {
    bool isImported = false;
    std::string reasons;             ///< refusals with file and line
    std::set<std::string> features;  ///< words that `--without` could leave out
    bool isFinal = false;            ///< something is refused that can not be left out
    bool hasCorners = false;         ///< a hull has more corners than a scenario's, and nothing else is final
};

Attempt attempt(const std::string& format, const fs::path& file, const std::set<std::string>& without,
                const fs::path& out, bool fewerCorners = false) {
    std::string words = fewerCorners ? " --hull-corners 64" : "";
    bool isFirst = true;
    for (const std::string& word : without) {
        words += (isFirst ? " --without " : ",") + word;
        isFirst = false;
    }
    const Outcome outcome =
        rigor("import " + format + " '" + file.string() + "' --json --out '" + out.string() + "'" + words);
    Attempt result;
    const json report = json::parse(outcome.out, nullptr, false);
    if (!report.is_object()) {
        result.reasons = "no report: " + outcome.err;
        result.isFinal = true;
        return result;
    }
    result.isImported = outcome.code == 0;
    for (const json& remark : report.at("remarks")) {
        if (remark.at("kind") != "refused") continue;
        const int line = remark.at("line").get<int>();
        result.reasons += (result.reasons.empty() ? "" : "; ") +
                          (line > 0 ? "line " + std::to_string(line) + ", " : std::string()) + "`" +
                          remark.at("element").get<std::string>() +
                          "`: " + remark.at("text").get<std::string>();
        const std::string feature = remark.at("feature").get<std::string>();
        if (remark.at("text").get<std::string>().find("--hull-corners 64") != std::string::npos)
            result.hasCorners = true;
        else if (feature.empty())
            result.isFinal = true;
        else
            result.features.insert(feature);
    }
    return result;
}

std::string contents(const fs::path& file) {
    const auto s = scenario::loadScenario(file).scenario;
    const auto count = [](std::size_t n, const char* one, const char* more) {
        return std::to_string(n) + " " + (n == 1 ? one : more);
    };
    return count(s.bodies.size(), "body", "bodies") + ", " + count(s.joints.size(), "joint", "joints");
}

std::string rowOf(const std::string& format, const std::string& name, const fs::path& file,
                  const fs::path& out) {
    Attempt result = attempt(format, file, {}, out);
    const std::string first = result.isImported ? contents(out) : "refused: " + result.reasons;
    std::set<std::string> without;
    bool fewerCorners = false;
    while (!result.isImported && !result.isFinal) {
        without.insert(result.features.begin(), result.features.end());
        fewerCorners = fewerCorners || result.hasCorners;
        result = attempt(format, file, without, out, fewerCorners);
    }
    std::string second;
    for (const std::string& word : without) second += (second.empty() ? "without " : ", ") + word;
    if (fewerCorners) second += " and with --hull-corners 64";
    if (!second.empty()) second += ": " + (result.isImported ? contents(out) : "refused: " + result.reasons);
    return "| `" + name + "` | " + format + " | " + first + " | " + second + " |\n";
}

std::string table() {
    const fs::path folder = modelsFolder(), out = freshFolder("table") / "scenario.json";
    std::ifstream manifest(folder / "MANIFEST.csv");
    std::string text = "| model | format | as it stands | with what it names left out |\n|---|---|---|---|\n",
                line;
    std::getline(manifest, line);
    while (std::getline(manifest, line)) {
        const std::string name = line.substr(0, line.find(','));
        std::string format = line.substr(name.size() + 1, line.find(',', name.size() + 1) - name.size() - 1);
        std::transform(format.begin(), format.end(), format.begin(),
                       [](unsigned char c) { return std::tolower(c); });
        fs::path file = folder / name;
        text += rowOf(format, name, file, out);
    }
    return text;
}

/// Rows in both tables of the models that are not newer than the library, where MuJoCo 3 of npm is not installed.
void leaveOutNewer(std::string& page, std::string& made) {
    std::istringstream pageLines(page), madeLines(made);
    std::string pageLeft, madeLeft, expected, found;
    while (std::getline(pageLines, expected) && std::getline(madeLines, found)) {
        if (found.find("MuJoCo 3 of npm does") != std::string::npos) continue;
        pageLeft += expected + "\n";
        madeLeft += found + "\n";
    }
    page = pageLeft;
    made = madeLeft;
}

TEST(ModelTable, IsWhatTheProgramSays) {
    if (modelsFolder().empty()) GTEST_SKIP() << "RIGOR_DATA is not set";
    const fs::path page = fs::path(RIGOR_SOURCE_DIR) / "scenarios/exchange/MODELS.md";
    std::ifstream in(page);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string begin = "<!-- table -->\n", end = "<!-- end of the table -->";
    const auto from = text.find(begin) + begin.size(), to = text.find(end);
    ASSERT_NE(to, std::string::npos);
    std::string made = table();
    EXPECT_EQ(std::count(made.begin(), made.end(), '\n'), 54);
    if (std::getenv("RIGOR_UPDATE_TABLE")) {
        std::ofstream(page) << text.substr(0, from) << made << text.substr(to);
        return;
    }
    std::string onPage = text.substr(from, to - from);
    if (mujoco3Package().empty()) leaveOutNewer(onPage, made);
    EXPECT_EQ(onPage, made) << "RIGOR_UPDATE_TABLE=1 writes the table";
}

}  // namespace
}  // namespace rigor::models::testing
