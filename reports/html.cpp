// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Puts the page together: template, style, scripts and data, all inline. What is shown is built by web/*.js
// from the data, through the document's own text nodes, so no name from a scenario is ever parsed as markup.
#include <array>
#include <stdexcept>
#include <string>

#include "reports/text.hpp"
#include "reports/web_assets.hpp"
#include "reports/writers.hpp"

namespace rigor::report {
namespace {

/// In the order in which they must run.
constexpr std::array<const char*, 10> kScripts{"core.js",     "scoreboard.js",  "overview.js", "tables.js",
                                               "charts.js",   "case_tables.js", "ladders.js",  "study.js",
                                               "scenario.js", "main.js"};

/// Nothing inside a script element may look like markup to the parser.
std::string inScript(std::string_view json) {
    std::string out;
    out.reserve(json.size());
    for (const char c : json) {
        if (c == '<')
            out += "\\u003c";
        else if (c == '>')
            out += "\\u003e";
        else
            out += c;
    }
    return out;
}

std::string dataElement(const std::string& id, const std::string& json) {
    return "<script type=\"application/json\" id=\"" + id + "\">" + inScript(json) + "</script>\n";
}

/// A closing tag inside our own code or the library would end the element early.
void requireInlinable(std::string_view name, std::string_view code) {
    if (code.find("</script") != std::string_view::npos || code.find("</style") != std::string_view::npos)
        throw std::logic_error("report: " + std::string(name) + " cannot be inlined");
}

std::string inlined(std::string_view name) {
    const auto code = webAsset(name);
    requireInlinable(name, code);
    return std::string(code);
}

void fill(std::string& page, const std::string& mark, const std::string& with) {
    const auto at = page.find(mark);
    if (at == std::string::npos) throw std::logic_error("report: template without " + mark);
    page.replace(at, mark.size(), with);
}

}  // namespace

std::string htmlReport(const ViewModel& view, const TrajectoryLoader& load, const std::string& study) {
    std::string page(webAsset("page.html"));
    const auto& suite = view.run().suite;
    fill(page, "<!--title-->", "Rigor report" + (suite.empty() ? "" : ": " + escapeMarkup(suite)));
    fill(page, "/*style*/", inlined("report.css"));

    std::string data = dataElement("run-data", overviewJson(view));
    if (!study.empty()) data += dataElement("study-data", study);
    for (std::size_t i = 0; i < view.run().scenarios.size(); ++i)
        data += dataElement("scenario-data-" + std::to_string(i), scenarioJson(view, i, load));
    std::string scripts =
        "<script>" + inlined("chart.min.js") + "</script>\n<script>" + inlined("report.js") + "</script>\n";
    for (const char* name : kScripts) scripts += "<script>\n" + inlined(name) + "</script>\n";
    const auto at = page.find("<!--content-->");
    if (at == std::string::npos) throw std::logic_error("report: template without content mark");
    page.replace(at, 14, data + scripts);
    return page;
}

}  // namespace rigor::report
