// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Puts the page together: template, style, script and the data of the overview, all inline. The page is built
// by web/src/report from the data, through the document's own text nodes, so no name from a scenario is ever
// parsed as markup.
#include "reports/page/html.hpp"

#include <stdexcept>
#include <string>

#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"
#include "reports/page/page_data.hpp"
#include "reports/page/web_assets.hpp"

namespace rigor::report {
namespace {

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

/// A closing tag inside the page's own code or a library would end the element early.
std::string inlined(std::string_view name) {
    const auto code = webAsset(name);
    if (code.find("</script") != std::string_view::npos || code.find("</style") != std::string_view::npos)
        throw std::logic_error("report: " + std::string(name) + " cannot be inlined");
    return std::string(code);
}

void fill(std::string& page, const std::string& mark, const std::string& with) {
    const auto at = page.find(mark);
    if (at == std::string::npos) throw std::logic_error("report: template without " + mark);
    page.replace(at, mark.size(), with);
}

/// The template with a bundle and its data.
std::string pageOf(const std::string& title, const std::string& bundle, const std::string& data) {
    std::string page(webAsset("page.html"));
    fill(page, "<!--title-->", escapeMarkup(title));
    fill(page, "/*style*/", inlined(bundle + ".css"));
    fill(page, "<!--data-->", data);
    fill(page, "/*script*/", inlined(bundle + ".js"));
    return page;
}

}  // namespace

std::string htmlReport(const ViewModel& view, const std::string& study, CasesOfPage cases) {
    const auto& suite = view.run().suite;
    return pageOf("Rigor report" + (suite.empty() ? "" : ": " + suite), "report",
                  dataElement("run-data", overviewJson(view, cases)) +
                      (study.empty() ? "" : dataElement("study-data", study)));
}

std::string htmlHistory(const std::string& json) {
    return pageOf("Rigor history", "history", dataElement("history-data", json));
}

std::string htmlCollide(const std::string& json) {
    return pageOf("Rigor collide", "collide", dataElement("collide-data", json));
}

std::string htmlSolve(const std::string& json) {
    return pageOf("Rigor solve", "solve", dataElement("solve-data", json));
}

}  // namespace rigor::report
