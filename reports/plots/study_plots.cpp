// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Charts of a study as SVG: lines over an axis, or a bar for each row.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "reports/encoding/json.hpp"
#include "reports/plots/study.hpp"
#include "validation/results/values.hpp"

namespace rigor::report {
namespace {

std::string titleOf(const StudyChart& chart) {
    return chart.part + (chart.scenario.empty() ? "" : ", " + chart.scenario) + ": " + chart.metric;
}

std::string withUnit(const StudyChart& chart) {
    return chart.metric + (chart.unit.empty() || chart.unit == "1" ? "" : " [" + chart.unit + "]");
}

Plot linesOf(const StudyChart& chart) {
    Plot plot;
    plot.title = titleOf(chart);
    plot.xLabel = chart.axis;
    plot.yLabel = withUnit(chart);
    plot.logarithmic = chart.logarithmic;
    plot.logarithmicX = chart.logarithmicX;
    plot.marked = true;
    for (const auto& p : chart.points) {
        if (plot.lines.empty() || plot.lines.back().label != p.label) {
            const std::size_t n = plot.lines.size();
            const auto dash = n < kPaletteSize ? std::vector<double>{} : std::vector<double>{6, 4};
            plot.lines.push_back({p.label, paletteColour(n), dash, {}, {}});
        }
        plot.lines.back().x.push_back(*p.x);
        plot.lines.back().y.push_back(p.value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    return plot;
}

constexpr double kBarLeft = 250, kBarWidth = 400, kBarHeight = 22, kBarTop = 46, kBarPage = 760;

std::string at(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

std::string words(double x, double y, const std::string& text, const char* anchor, const char* more = "") {
    return "<text x=\"" + at(x) + "\" y=\"" + at(y) + "\" text-anchor=\"" + anchor + "\"" + more + ">" +
           escapeMarkup(text) + "</text>\n";
}

/// Share of the longest bar; by logarithms from the decade below the least.
class BarScale {
  public:
    explicit BarScale(const StudyChart& chart) : logarithmic_(chart.logarithmic) {
        for (const auto& p : chart.points) {
            if (!p.value || !std::isfinite(*p.value)) continue;
            const double size = std::abs(*p.value);
            greatest_ = std::max({greatest_, size, std::abs(p.high.value_or(0.0))});
            if (size > 0.0) least_ = std::min(least_, size);
        }
        if (logarithmic_) floor_ = std::floor(std::log10(least_)) - 0.2;
    }
    double length(double value) const {
        const double size = std::abs(value);
        if (!(size > 0.0) || !(greatest_ > 0.0)) return 0.0;
        if (!logarithmic_) return size / greatest_;
        return (std::log10(size) - floor_) / (std::log10(greatest_) - floor_);
    }

  private:
    bool logarithmic_;
    double least_ = std::numeric_limits<double>::infinity(), greatest_ = 0.0, floor_ = 0.0;
};

std::string valueText(const StudyPoint& p) {
    if (p.outcome != "completed") return p.outcome;
    if (!p.value) return "no value";
    return shortNumber(*p.value) + (p.note.empty() ? "" : " (" + p.note + ")");
}

std::string svgBars(const StudyChart& chart) {
    const double height = kBarTop + kBarHeight * chart.points.size() + 34;
    const BarScale scale(chart);
    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 " + at(height) +
                      "\" width=\"760\" height=\"" + at(height) +
                      "\" font-family=\"system-ui, sans-serif\" font-size=\"12\" fill=\"#22272e\">\n"
                      "<rect width=\"760\" height=\"" +
                      at(height) + "\" fill=\"#ffffff\"/>\n";
    out += words(16, 24, titleOf(chart), "start", " font-size=\"15\" font-weight=\"600\"");
    double y = kBarTop;
    for (const auto& p : chart.points) {
        const double length =
            p.value && std::isfinite(*p.value) ? (kBarWidth - 110) * scale.length(*p.value) : 0.0;
        out += words(kBarLeft - 8, y + 15, p.label, "end");
        out += "<rect x=\"" + at(kBarLeft) + "\" y=\"" + at(y + 3) + "\" width=\"" + at(length) +
               "\" height=\"" + at(kBarHeight - 6) + "\" fill=\"" + paletteColour(0) + "\"/>\n";
        const double end = p.low && p.high ? (kBarWidth - 110) * scale.length(*p.high) : length;
        if (p.low && p.high)
            out += "<line x1=\"" + at(kBarLeft + (kBarWidth - 110) * scale.length(*p.low)) + "\" y1=\"" +
                   at(y + 11) + "\" x2=\"" + at(kBarLeft + end) + "\" y2=\"" + at(y + 11) +
                   "\" stroke=\"#22272e\" stroke-width=\"1.5\"/>\n";
        out += words(kBarLeft + std::max(length, end) + 6, y + 15, valueText(p), "start");
        y += kBarHeight;
    }
    out += "<line x1=\"" + at(kBarLeft) + "\" y1=\"" + at(kBarTop) + "\" x2=\"" + at(kBarLeft) + "\" y2=\"" +
           at(y) + "\" stroke=\"#5b6470\"/>\n";
    return out +
           words(kBarLeft, y + 20, withUnit(chart) + (chart.logarithmic ? ", logarithmic" : ""), "start") +
           "</svg>\n";
}

/// A row for each point or bar.
std::string chartCsv(const StudyChart& chart) {
    const auto field = [](const std::optional<double>& v) { return results::finiteText(v); };
    std::string out = "label," + (chart.axis.empty() ? "" : csvField(chart.axis) + ",") +
                      csvField(withUnit(chart)) + ",low,high,outcome,note,non_finite\n";
    for (const auto& p : chart.points)
        out += csvField(p.label) + "," + (chart.axis.empty() ? "" : field(p.x) + ",") + field(p.value) + "," +
               field(p.low) + "," + field(p.high) + "," + csvField(p.outcome) + "," + csvField(p.note) + "," +
               results::nonFiniteNote({{"x", p.x}, {"value", p.value}, {"low", p.low}, {"high", p.high}}) +
               "\n";
    return out;
}

}  // namespace

std::vector<NamedPlot> studyPlots(const Json& study) {
    std::vector<NamedPlot> plots;
    for (const auto& chart : studyCharts(study)) {
        const std::string name = "study-" + fileNamePart(chart.part) + "-" + fileNamePart(chart.metric) +
                                 (chart.scenario.empty() ? "" : "-" + fileNamePart(chart.scenario));
        plots.push_back(
            {name, chart.axis.empty() ? svgBars(chart) : svgPlot(linesOf(chart)), chartCsv(chart)});
    }
    return plots;
}

}  // namespace rigor::report
