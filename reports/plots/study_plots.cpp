// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Charts of a study as drawings: lines over an axis, or a bar for each row.
#include <algorithm>
#include <cmath>
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

Drawing drawBars(const StudyChart& chart) {
    constexpr double kLongest = kBarWidth - 110;
    Drawing out{kBarPage, kBarTop + kBarHeight * static_cast<double>(chart.points.size()) + 34, {}};
    const BarScale scale(chart);
    out.add(DrawnText{.x = 16, .y = 24, .text = titleOf(chart), .size = 15, .bold = true});
    double y = kBarTop;
    for (const auto& p : chart.points) {
        const double length = p.value && std::isfinite(*p.value) ? kLongest * scale.length(*p.value) : 0.0;
        out.add(DrawnText{kBarLeft - 8, y + 15, p.label, Anchor::End});
        out.add(DrawnRectangle{kBarLeft, y + 3, length, kBarHeight - 6, paletteColour(0)});
        const double end = p.low && p.high ? kLongest * scale.length(*p.high) : length;
        if (p.low && p.high)
            out.add(DrawnLine{kBarLeft + kLongest * scale.length(*p.low),
                              y + 11,
                              kBarLeft + end,
                              y + 11,
                              {kTextColour, 1.5, {}}});
        out.add(DrawnText{kBarLeft + std::max(length, end) + 6, y + 15, valueText(p)});
        y += kBarHeight;
    }
    out.add(DrawnLine{kBarLeft, kBarTop, kBarLeft, y, {"#5b6470"}});
    out.add(DrawnText{kBarLeft, y + 20, withUnit(chart) + (chart.logarithmic ? ", logarithmic" : "")});
    return out;
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
            {name, chart.axis.empty() ? drawBars(chart) : drawPlot(linesOf(chart)), chartCsv(chart)});
    }
    return plots;
}

}  // namespace rigor::report
