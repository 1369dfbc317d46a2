// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page: its data are the run's, nothing is fetched, no name becomes markup.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "reports/encoding/data_files.hpp"
#include "reports/model/view_model.hpp"
#include "reports/page/html.hpp"
#include "reports/page/page_data.hpp"
#include "reports/plots/curves.hpp"
#include "reports/tests/synthetic_run.hpp"

namespace rigor::report {
namespace {

using nlohmann::json;

class Page : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        run_ = new results::Run(synthetic::makeRun());
        view_ = new ViewModel(*run_);
        html_ = new std::string(htmlReport(*view_));
    }
    static void TearDownTestSuite() {
        delete html_;
        delete view_;
        delete run_;
    }
    /// Content of the data element, as a browser would hand it to JSON.parse.
    static json data(const std::string& id) {
        const std::string open = "<script type=\"application/json\" id=\"" + id + "\">";
        const auto start = html_->find(open);
        if (start == std::string::npos) throw std::runtime_error("no element " + id);
        const auto end = html_->find("</script>", start);
        return json::parse(html_->substr(start + open.size(), end - start - open.size()));
    }
    static results::Run* run_;
    static ViewModel* view_;
    static std::string* html_;
};
results::Run* Page::run_ = nullptr;
ViewModel* Page::view_ = nullptr;
std::string* Page::html_ = nullptr;

/// Equal bits, through the page's spelling of numbers JSON lacks.
void expectNumber(const json& found, double wanted, const std::string& what) {
    if (std::isfinite(wanted)) {
        ASSERT_TRUE(found.is_number()) << what;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(found.get<double>()), std::bit_cast<std::uint64_t>(wanted))
            << what;
    } else {
        EXPECT_EQ(found, json(std::isnan(wanted) ? "nan" : wanted > 0 ? "inf" : "-inf")) << what;
    }
}
void expectOptional(const json& found, const std::optional<double>& wanted, const std::string& what) {
    if (wanted)
        expectNumber(found, *wanted, what);
    else
        EXPECT_TRUE(found.is_null()) << what;
}

void expectTiming(const json& found, const results::TimingRow& wanted, const std::string& what) {
    expectNumber(found["median"], wanted.median, what);
    expectOptional(found["low"], wanted.low, what);
    expectOptional(found["high"], wanted.high, what);
    EXPECT_EQ(found["bodies"], wanted.bodies) << what;
}

TEST_F(Page, HoldsEveryNumberOfTheRun) {
    std::size_t compared = 0;
    const auto load = synthetic::makeLoader(*run_);
    for (std::size_t s = 0; s < run_->scenarios.size(); ++s) {
        const json details = json::parse(scenarioJson(*view_, s, load));
        EXPECT_EQ(details["name"], run_->scenarios[s].name);
        for (const auto& row : run_->cases) {
            if (row.scenario != run_->scenarios[s].name) continue;
            const auto found = std::find_if(details["cases"].begin(), details["cases"].end(),
                                            [&](const json& c) { return c["id"] == row.id; });
            ASSERT_NE(found, details["cases"].end()) << row.id;
            const json& c = *found;
            expectNumber(c["dt"], row.dt, row.id);
            EXPECT_EQ(c["command"], row.command);
            EXPECT_EQ(c["reason"], row.reason);
            EXPECT_EQ(c["verdict"], results::verdictName(row.verdict));
            ASSERT_EQ(c["metrics"].size(), row.metrics.size());
            for (std::size_t i = 0; i < row.metrics.size(); ++i, ++compared) {
                expectNumber(c["metrics"][i]["value"], row.metrics[i].value, row.id);
                expectOptional(c["metrics"][i]["bound"], row.metrics[i].bound, row.id);
                expectOptional(c["metrics"][i]["boundMin"], row.metrics[i].boundMin, row.id);
                expectOptional(c["metrics"][i]["expectation"], row.metrics[i].expectation, row.id);
            }
            ASSERT_EQ(c["quantities"].size(), row.quantities.size());
            for (std::size_t i = 0; i < row.quantities.size(); ++i, ++compared) {
                expectNumber(c["quantities"][i]["exact"], row.quantities[i].exact, row.id);
                expectOptional(c["quantities"][i]["measured"], row.quantities[i].measured, row.id);
                expectOptional(c["quantities"][i]["schemeExact"], row.quantities[i].schemeExact, row.id);
            }
            for (std::size_t i = 0; i < row.audit.size(); ++i)
                expectOptional(c["audit"][i]["normalErrorMax"], row.audit[i].normalErrorMax, row.id);
            for (std::size_t i = 0; i < row.timings.size(); ++i)
                expectTiming(c["timings"][i], row.timings[i], row.id);
        }
    }
    EXPECT_GT(compared, 2000u);
}

TEST_F(Page, OverviewHoldsFormulasAndStepTimings) {
    const json overview = data("run-data");
    std::size_t timed = 0, phases = 0;
    for (std::size_t s = 0; s < run_->scenarios.size(); ++s) {
        const json& scenario = overview["scenarios"][s];
        EXPECT_EQ(scenario["referenceFormula"], run_->scenarios[s].referenceFormula);
        EXPECT_EQ(scenario["referenceTex"], run_->scenarios[s].referenceTex);
        for (const auto& brief : scenario["cases"]) {
            const auto row = std::find_if(run_->cases.begin(), run_->cases.end(),
                                          [&](const auto& c) { return brief["id"] == c.id; });
            ASSERT_NE(row, run_->cases.end());
            if (row->timings.empty()) {
                EXPECT_TRUE(brief["step"].is_null());
                continue;
            }
            ++timed;
            expectTiming(brief["step"], row->timings[0], row->id);
            for (std::size_t i = 2; i < row->timings.size(); ++i, ++phases)
                expectNumber(brief["step"]["phases"][row->timings[i].phase], row->timings[i].median, row->id);
            EXPECT_FALSE(brief["step"]["phases"].contains("build"));
        }
    }
    EXPECT_GT(timed, 100u);
    EXPECT_GT(phases, 100u);
}

TEST_F(Page, OverviewShowsEveryVerdict) {
    const json overview = data("run-data");
    std::map<std::string, int> shown;
    std::size_t cases = 0;
    for (const auto& s : overview["scenarios"])
        for (const auto& c : s["cases"]) {
            ++shown[c["shown"].get<std::string>()];
            ++cases;
        }
    EXPECT_EQ(cases, run_->cases.size());
    EXPECT_EQ(shown.size(), 8u) << "the synthetic run has every verdict";
    for (const auto& [key, count] : shown) EXPECT_EQ(overview["symbols"][key]["count"], count) << key;
}

TEST_F(Page, FetchesNothing) {
    const std::regex reference(R"((src|href|action|data-src)\s*=\s*["']?\s*(https?:|//))", std::regex::icase);
    EXPECT_FALSE(std::regex_search(*html_, reference));
    EXPECT_EQ(html_->find("@import"), std::string::npos);
    EXPECT_EQ(html_->find("url(http"), std::string::npos);
    EXPECT_EQ(html_->find("sourceMappingURL"), std::string::npos);
    EXPECT_EQ(html_->find("<link rel=\"stylesheet"), std::string::npos);
    const std::string policy =
        "default-src 'none'; script-src 'self' 'nonce-rigor'; style-src 'unsafe-inline'; img-src data: "
        "blob:; "
        "font-src data:; connect-src 'self'; base-uri 'none'; form-action 'none'";
    EXPECT_NE(html_->find(policy), std::string::npos) << "and the browser gets it";
}

TEST_F(Page, HostileNamesStayText) {
    const std::string beforeCode =
        html_->substr(0, html_->find("<script nonce="));  // the rest is the page's own code
    EXPECT_EQ(beforeCode.find("<img"), std::string::npos);
    EXPECT_EQ(beforeCode.find("<b>x</b>"), std::string::npos);
    const json overview = data("run-data");
    EXPECT_EQ(overview["scenarios"].back()["name"], synthetic::kHostileName);
    const auto count = [&](const std::string& what) {
        std::size_t n = 0;
        for (auto at = html_->find(what); at != std::string::npos; at = html_->find(what, at + 1)) ++n;
        return n;
    };
    EXPECT_EQ(count("<script"), count("</script>"));
}

TEST_F(Page, SaysWhoseEngineTakesPart) {
    EXPECT_NE(html_->find("authors of one of the engines"), std::string::npos);
}

TEST(PageSize, SixtyScenariosStayUnderThirtyMegabytes) {
    const auto run = synthetic::makeRun(60);
    const ViewModel view(run);
    const auto load = synthetic::makeLoader(run);
    std::size_t bytes = htmlReport(view).size();
    for (std::size_t s = 0; s < run.scenarios.size(); ++s)
        bytes += dataFile("scenario-" + std::to_string(s), scenarioJson(view, s, load)).size();
    EXPECT_LT(bytes, 30u << 20);
}

TEST(PageWithoutTrajectories, IsComplete) {
    const auto run = synthetic::makeRun(3);
    const ViewModel view(run);
    const json parsed = json::parse(scenarioJson(view, 0, [](const auto&) { return std::nullopt; }));
    for (const auto& c : parsed["cases"]) EXPECT_TRUE(c["curves"].is_null());
}

TEST(Curves, OfSomeFramesHaveThoseAlone) {
    const auto run = synthetic::makeRun(1);
    const ViewModel view(run);
    const auto whole = synthetic::makeLoader(run);
    const json parsed = json::parse(scenarioJson(view, 0, [&](const auto& row) {
        auto file = whole(row);
        if (!file) return file;
        results::SeriesChannel series{"normal_error", "", {"rad", 1, {}}};
        series.channel.values.assign(file->times.size(), std::nan(""));
        for (const std::size_t i : {3u, 40u, 99u}) series.channel.values[i] = 0.5;
        file->series.push_back(series);
        return file;
    }));
    std::size_t seen = 0;
    for (const auto& c : parsed["cases"])
        if (!c["curves"].is_null())
            for (const auto& s : c["curves"]["series"])
                if (s["name"] == "normal_error") {
                    ++seen;
                    EXPECT_EQ(s["y"].get<std::string>().size(), base64(std::string(3 * 4, '0')).size());
                    EXPECT_EQ(s["t"].get<std::string>().size(), s["y"].get<std::string>().size());
                }
    EXPECT_GT(seen, 0u);
}

/// Every preset that an engine has is there with its values; runs from before an engine had its own have the two
/// that all have.
TEST(Engines, HaveTheValuesOfEveryPreset) {
    auto run = synthetic::makeRun(1);
    run.engines[0].capabilities =
        R"({"capabilities": {"dynamics": true}, "presets": ["default", "matched", "fast"], "options":
            [{"key": "k", "values": [], "min": 0, "max": null,
              "presets": {"default": "1", "matched": "2", "fast": "3"}}]})";
    run.engines[1].capabilities =
        R"({"capabilities": {}, "options": [{"key": "k", "default": "a", "matched": "b"}]})";
    run.engines[2].capabilities = "no JSON";
    const json page = json::parse(overviewJson(ViewModel(run)));
    const json& ours = page["engines"][0]["described"];
    EXPECT_EQ(ours["presets"], (json{"default", "matched", "fast"}));
    EXPECT_EQ(ours["options"][0]["presets"]["fast"], "3");
    const json& older = page["engines"][1]["described"];
    EXPECT_EQ(older["presets"], (json{"default", "matched"}));
    EXPECT_EQ(older["options"][0]["presets"], (json{{"default", "a"}, {"matched", "b"}}));
    EXPECT_TRUE(page["engines"][2]["described"].is_null());
}

TEST(PageOfNothing, IsAPage) {
    const results::Run run;
    const ViewModel view(run);
    EXPECT_NE(htmlReport(view).find("run-data"), std::string::npos);
}

TEST(Curves, OutlineKeepsASpikeOfOneSample) {
    std::vector<double> values(10000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(0.001 * i);
    values[7321] = 9.0;
    values[1234] = -9.0;
    values[5000] = std::nan("");
    const auto kept = outlineIndices(values, 200);
    EXPECT_LE(kept.size(), 200u);
    EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
    EXPECT_EQ(std::adjacent_find(kept.begin(), kept.end()), kept.end());
    EXPECT_EQ(kept.front(), 0u);
    EXPECT_EQ(kept.back(), values.size() - 1);
    for (const std::size_t i : {std::size_t{7321}, std::size_t{1234}})
        EXPECT_NE(std::find(kept.begin(), kept.end(), i), kept.end()) << i;
    EXPECT_EQ(outlineIndices(std::span(values).first(150), 200).size(), 150u);
}

/// The base64 of RFC 4648 and little-endian singles, decoded here by other means.
TEST(Curves, PackedSinglesDecode) {
    const std::vector<double> values{0.0, 1.0, -2.5, 1e-20, 3.14159274, std::nan("")};
    for (std::size_t n = 0; n <= values.size(); ++n) {
        const std::string text = packSingles(std::span(values).first(n));
        ASSERT_EQ(text.size() % 4, 0u);
        std::string bits;
        const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        for (const char c : text)
            if (c != '=')
                for (int b = 5; b >= 0; --b) bits += ((alphabet.find(c) >> b) & 1) ? '1' : '0';
        for (std::size_t i = 0; i < n; ++i) {
            std::uint32_t word = 0;
            for (std::size_t byte = 0; byte < 4; ++byte)
                word |= static_cast<std::uint32_t>(std::stoul(bits.substr(32 * i + 8 * byte, 8), nullptr, 2))
                        << (8 * byte);
            const float wanted = static_cast<float>(values[i]);
            EXPECT_EQ(word, std::bit_cast<std::uint32_t>(wanted));
        }
    }
}

}  // namespace
}  // namespace rigor::report
