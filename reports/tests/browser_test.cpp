// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page in a real browser: draws itself without an error, fetches nothing, shows the run's numbers,
// filters, opens a case, toggles an engine. Skipped where Chromium is not installed.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "reports/study.hpp"
#include "reports/tests/synthetic_run.hpp"
#include "reports/tests/synthetic_study.hpp"
#include "reports/text.hpp"

namespace rigor::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string findBrowser() {
    for (const char* name : {"/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"})
        if (access(name, X_OK) == 0) return name;
    return "";
}

class Folder {
  public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "rigor-browser-XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

std::string output(const std::string& command) {
    std::string text;
    FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return text;
    std::array<char, 65536> buffer{};
    for (std::size_t n; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        text.append(buffer.data(), n);
    pclose(pipe);
    return text;
}

std::string chromium(const fs::path& profile, const fs::path& page, const std::string& hash,
                     const std::string& action) {
    return "timeout 90 " + findBrowser() +
           " --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --hide-scrollbars"
           " --disable-background-networking --disable-component-update --disable-sync --user-data-dir='" +
           profile.string() + "' --virtual-time-budget=20000 --window-size=1400,1600 " + action +
           " 'file://" + page.string() + hash + "' 2>/dev/null";
}

/// Collects errors from the first line on, and writes what `actions` found into an element of its own.
std::string withProbe(std::string html, const std::string& actions) {
    const std::string early =
        "<script>window.faults=[];addEventListener('error',e=>faults.push('error: '+e.message));"
        "addEventListener('securitypolicyviolation',e=>faults.push('blocked: '+e.blockedURI));"
        "const say=console.error;console.error=(...a)=>{faults.push('console: '+a.join(' "
        "'));say(...a)};</script>";
    const std::string late =
        "<script>setTimeout(async()=>{const found={};const pause=()=>new Promise(r=>setTimeout(r,100));"
        "try{" +
        actions +
        "}catch(e){faults.push('probe: '+e)}"
        "found.faults=faults;found.requests=performance.getEntriesByType('resource').map(e=>e.name)"
        ".filter(n=>!n.startsWith('data:'));"
        "const out=document.createElement('pre');out.id='probe';"
        "out.textContent=btoa(unescape(encodeURIComponent(JSON.stringify(found))));document.body.append(out);"
        "},"
        "200);</script>";
    html.insert(html.find("<title>"), early);
    html.insert(html.rfind("</body>"), late);
    return html;
}

std::string fromBase64(const std::string& text) {
    const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    unsigned bits = 0;
    int held = 0;
    for (const char c : text) {
        const auto value = alphabet.find(c);
        if (value == std::string::npos) break;
        bits = (bits << 6) | static_cast<unsigned>(value), held += 6;
        if (held >= 8) held -= 8, out += static_cast<char>((bits >> held) & 0xFF);
    }
    return out;
}

class Browser : public ::testing::Test {
  protected:
    void SetUp() override {
        if (findBrowser().empty()) GTEST_SKIP() << "Chromium is not installed";
        html_ = htmlReport(ViewModel(run_), synthetic::makeLoader(run_));
    }
    json probe(const std::string& hash, const std::string& actions) {
        const fs::path page = folder_.path() / "index.html";
        writeFile(page, withProbe(html_, actions));
        const std::string dom = output(chromium(folder_.path() / "profile", page, hash, "--dump-dom"));
        const std::string open = "<pre id=\"probe\">";
        const auto start = dom.find(open);
        if (start == std::string::npos) throw std::runtime_error("the page never answered");
        return json::parse(fromBase64(dom.substr(start + open.size())));
    }
    static void expectClean(const json& found) {
        EXPECT_EQ(found["faults"], json::array());
        EXPECT_EQ(found["requests"], json::array());
    }

    results::Run run_ = synthetic::makeRun();
    std::string html_;
    Folder folder_;
};

TEST_F(Browser, OverviewShowsFiltersAndSorts) {
    const json found = probe("", R"js(
        found.rows = document.querySelectorAll('#scoreboard tbody tr').length;
        found.names = [...document.querySelectorAll('#scoreboard tbody th a')].map(a => a.textContent);
        found.hostile = window.hostile === 1;
        found.images = document.images.length;
        found.sections = [...document.querySelectorAll('section.panel')].map(s => s.id);
        found.classes = [...new Set([...document.querySelectorAll('#scoreboard a.cell')].map(a => a.className))];
        Rigor.filterScoreboard({dimension: '2'});
        found.planar = document.querySelectorAll('#scoreboard tbody tr').length;
        Rigor.filterScoreboard({dimension: '', verdict: 'crashed'});
        found.crashed = [...document.querySelectorAll('#scoreboard tbody tr')].every(r => r.querySelector('.v-crashed'));
        Rigor.filterScoreboard({verdict: ''});
        document.querySelector('#scoreboard thead th button').click();
        found.sorted = [...document.querySelectorAll('#scoreboard tbody th a')].map(a => a.textContent);
    )js");
    expectClean(found);
    EXPECT_EQ(found["rows"], run_.scenarios.size());
    std::vector<std::string> names;
    int planar = 0;
    for (const auto& s : run_.scenarios) names.push_back(s.name), planar += s.dimension == 2;
    EXPECT_EQ(found["names"].get<std::vector<std::string>>(), names);
    EXPECT_EQ(found["planar"], planar);
    EXPECT_EQ(found["crashed"], true);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(found["sorted"].get<std::vector<std::string>>(), names);
    EXPECT_EQ(found["hostile"], false);
    EXPECT_EQ(found["images"], 0);
    const auto sections = found["sections"].get<std::vector<std::string>>();
    for (const char* id :
         {"summary", "trust", "scoreboard", "timing", "in-run", "audit", "ledger", "engines", "method"})
        EXPECT_NE(std::find(sections.begin(), sections.end(), id), sections.end()) << id;
}

TEST_F(Browser, EveryScenarioPageOpensWithTheNumbersOfTheRun) {
    const json found = probe("", R"js(
        found.pages = [];
        for (const s of Rigor.run.scenarios) {
          location.hash = Rigor.scenarioLink(s.name).slice(1);
          for (let wait = 0; wait < 50 && !document.title.startsWith(s.name + ' '); ++wait) await pause();
          const cells = {};
          for (const row of document.querySelectorAll('#metrics tr[data-metric]'))
            if (row.dataset.subject === '') cells[row.dataset.metric] = [...row.querySelectorAll('td[data-value]')].map(d => d.dataset.value);
          found.pages.push({name: s.name, cells, pairs: document.querySelectorAll('#audit-pairs tbody tr').length,
            asked: [...document.querySelectorAll('#case-audit > .scroll tbody th')].map(t => t.textContent), canvases: document.querySelectorAll('#curves canvas').length,
            commands: [...document.querySelectorAll('#commands code')].map(c => c.textContent),
            outcomes: document.querySelector('#outcomes')?.textContent || ''});
        }
        Rigor.drawAllCharts();  // as for printing: no frames are shown here that would bring them into view
        const box = document.querySelector('#curves input[data-spec]');
        box.click();
        const charts = Rigor.liveCharts.map(c => ({connected: c.canvas.isConnected,
          hidden: c.data.datasets.filter(d => d.spec === box.dataset.spec).map(d => d.hidden)}));
        found.charts = charts;
        found.box = {checked: box.checked, connected: box.isConnected};
        found.hidden = charts.length > 0 && charts.every(c => c.connected && c.hidden.every(h => h));
        await pause();
        const pixels = (c) => { const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data; return d.some((v) => v !== 0); };
        found.drawn = [...document.querySelectorAll('#curves canvas')].slice(0, 1).every(pixels);
    )js");
    expectClean(found);
    EXPECT_EQ(found["hidden"], true) << found["box"] << found["charts"];
    EXPECT_EQ(found["drawn"], true);
    ASSERT_EQ(found["pages"].size(), run_.scenarios.size());
    std::size_t compared = 0;
    for (const auto& page : found["pages"]) {
        EXPECT_GT(page["canvases"], 2);
        EXPECT_GT(page["pairs"], 0);
        for (const auto& asked : page["asked"])
            EXPECT_EQ(asked.get<std::string>().find('|'), std::string::npos);
        for (const auto& c : run_.cases) {
            if (c.scenario != page["name"] || c.dt != 1.0 / 240.0) continue;
            const auto commands = page["commands"].get<std::vector<std::string>>();
            EXPECT_NE(std::find(commands.begin(), commands.end(), c.command), commands.end());
            EXPECT_NE(page["outcomes"].get<std::string>().find(c.reason), std::string::npos) << c.reason;
            for (const auto& m : c.metrics) {
                if (!m.subject.empty() || !std::isfinite(m.value)) continue;
                const auto& shown = page["cells"].at(m.name);
                EXPECT_TRUE(std::any_of(shown.begin(), shown.end(),
                                        [&](const json& v) {
                                            return std::strtod(v.get<std::string>().c_str(), nullptr) ==
                                                   m.value;
                                        }))
                    << page["name"] << " " << m.name << " " << fullNumber(m.value);
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 500u);
}

TEST_F(Browser, AScenarioRunAtManyStepsShowsItsOrders) {
    const auto& name = run_.scenarios[0].name;
    const auto& spec = run_.cases[0].spec;
    run_.orders = {
        {name, spec, "position_max", "m", 1.0625, 0.9, 1.2, 5, 1e-3, 1e-2, "left out: 1 at round-off"},
        {name, spec, "velocity_max", "m/s", {}, {}, {}, 0, 0.0, 0.0, "round-off"}};
    run_.fairness = {{"equal_time", name, "position_max", "m", "ode", "a", "ode", 0.01, 0.25, 1e-3, 2e-3},
                     {"equal_accuracy", name, "position_max", "m", "ode", "a", "ode", 0.01, 0.25, 1e-3, 0.5}};
    html_ = htmlReport(ViewModel(run_), synthetic::makeLoader(run_));
    const json found = probe("#/scenario/" + name, R"js(
        await pause();
        found.orders = [...document.querySelectorAll('#ladder #orders tbody td[data-value]')].map(d => d.dataset.value);
        found.text = document.querySelector('#ladder')?.textContent || '';
        found.modes = [...document.querySelectorAll('#fairness tbody')].map(b => b.dataset.mode);
        location.hash = Rigor.scenarioLink(Rigor.run.scenarios[1].name).slice(1);
        await pause();
        found.elsewhere = document.querySelectorAll('#ladder').length;
    )js");
    expectClean(found);
    EXPECT_EQ(found["orders"], json::array({"1.0625"}));
    EXPECT_NE(found["text"].get<std::string>().find("0.90 … 1.20"), std::string::npos) << found["text"];
    EXPECT_NE(found["text"].get<std::string>().find("1 at round-off"), std::string::npos);
    EXPECT_EQ(found["modes"], json::array({"equal_time", "equal_accuracy"}));
    EXPECT_EQ(found["elsewhere"], 0);
}

TEST_F(Browser, AStudyShowsItsFindingsChartsAndTables) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array(), bars = nlohmann::ordered_json::array();
    for (const char* variant : {"cold", "warm"})
        for (const double dt : {0.01, 0.005, 0.0025})
            rows.push_back(
                synthetic::studyRow(run_.scenarios[0].name, variant, dt, {}, {{"rest_sink", dt * dt}}));
    for (const char* solver : {"pgs", "nsgs"})
        bars.push_back(
            synthetic::studyRow("other", "rigor", 0.01, {{"solver", solver}}, {{"rest_sink", 0.25}}));
    const nlohmann::ordered_json study{
        {"name", "sweeps"},
        {"title", "What sweeps buy"},
        {"description", "Much."},
        {"symptoms", nlohmann::ordered_json::array()},
        {"findings",
         {{{"statement", "It sinks"},
           {"source", "Catto 2005"},
           {"variant", "cold"},
           {"where", {{"dt", "0.01"}}},
           {"metric", "rest_sink"},
           {"at_least", 0.5},
           {"at_most", nullptr},
           {"least", 1e-4},
           {"greatest", 1e-4},
           {"holds", false}}}},
        {"parts", {synthetic::studyPart("ladder", rows), synthetic::studyPart("solvers", bars)}}};
    html_ = htmlReport(ViewModel(run_), synthetic::makeLoader(run_), studyPageJson(study));
    const json found = probe("", R"js(
        await pause();
        found.kinds = [...document.querySelectorAll('#study .chart')].map(c => c.dataset.kind);
        found.drawn = Rigor.liveCharts.map(c => c.data.datasets.map(d => d.data.length));
        found.findings = document.querySelector('#study table').textContent;
        found.values = [...document.querySelectorAll('[data-part="ladder"] td[data-value]')].map(d => d.dataset.value);
        found.links = document.querySelectorAll('[data-part="ladder"] tbody a').length;
        found.dead = document.querySelectorAll('[data-part="solvers"] tbody a').length;
    )js");
    expectClean(found);
    EXPECT_EQ(found["kinds"], json::array({"lines", "bars"}));
    EXPECT_EQ(found["drawn"], json::parse("[[3, 3], [2]]"));
    EXPECT_NE(found["findings"].get<std::string>().find("does not hold"), std::string::npos);
    EXPECT_EQ(found["values"].size(), 6u);
    EXPECT_EQ(std::stod(found["values"][0].get<std::string>()), 0.01 * 0.01);
    EXPECT_EQ(found["links"], 6);
    EXPECT_EQ(found["dead"], 0) << "no page to go to";
}

TEST_F(Browser, ChartsOfAPageThatWasLeftAreNotDrawn) {
    const json found = probe("", R"js(
        const late = [];
        window.IntersectionObserver = class {
          constructor(callback) { late.push(() => callback([{isIntersecting: true}])); }
          observe() {}
          disconnect() {}
        };
        const open = async (name) => {
          location.hash = Rigor.scenarioLink(name).slice(1);
          for (let wait = 0; wait < 50 && !document.title.startsWith(name + ' '); ++wait) await pause();
        };
        await open(Rigor.run.scenarios[0].name);
        const left = late.splice(0);
        await open(Rigor.run.scenarios[1].name);
        late.forEach((seen) => seen());
        found.drawn = Rigor.liveCharts.length;
        left.forEach((seen) => seen());  // the browser may still deliver these
        found.left = left.length;
        found.after = Rigor.liveCharts.length;
    )js");
    expectClean(found);
    EXPECT_GT(found["left"], 0);
    EXPECT_GT(found["drawn"], 0);
    EXPECT_EQ(found["after"], found["drawn"]);
}

TEST_F(Browser, ScreenshotsAreWritten) {
    const fs::path page = folder_.path() / "index.html";
    writeFile(page, html_);
    const fs::path shots = fs::path(RIGOR_BINARY_DIR) / "screenshots";
    fs::create_directories(shots);
    for (const auto& [name, hash] : {std::pair{"overview", ""}, std::pair{"scenario", "#/scenario/bounce"}}) {
        const fs::path file = shots / (std::string(name) + ".png");
        fs::remove(file);
        output(chromium(folder_.path() / "profile", page, hash, "--screenshot='" + file.string() + "'"));
        ASSERT_TRUE(fs::exists(file));
        EXPECT_GT(fs::file_size(file), 50000u) << "an empty page compresses to less";
    }
}

}  // namespace
}  // namespace rigor::report
