// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/plots/svg_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "reports/encoding/text.hpp"
#include "reports/model/trajectory_loader.hpp"
#include "reports/model/view_model.hpp"
#include "reports/plots/curves.hpp"
#include "validation/results/values.hpp"

namespace rigor::report {
namespace {

constexpr double kWidth = 760, kHeight = 420, kLeft = 78, kRight = 190, kTop = 40, kBottom = 50;

/// Okabe and Ito's palette: distinguishable with every common colour vision. The page uses the same, in the
/// same order.
constexpr std::array<const char*, kPaletteSize> kPalette{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                         "#E69F00", "#56B4E9", "#7A5C00"};

std::string coordinate(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.2f", value);
    return buffer;
}

struct Range {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;

    void add(double v) {
        if (std::isfinite(v)) {
            least = std::min(least, v);
            greatest = std::max(greatest, v);
        }
    }
    void finish(double pad) {
        if (!(least <= greatest)) {
            least = 0.0;
            greatest = 1.0;
        }
        if (least == greatest) {
            least -= pad;
            greatest += pad;
        }
    }
};

std::string label(double x, double y, const std::string& text, const char* anchor, const char* more = "") {
    return "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" text-anchor=\"" + anchor + "\"" +
           more + ">" + escapeMarkup(text) + "</text>\n";
}

std::string segment(double x1, double y1, double x2, double y2, const char* stroke) {
    return "<line x1=\"" + coordinate(x1) + "\" y1=\"" + coordinate(y1) + "\" x2=\"" + coordinate(x2) +
           "\" y2=\"" + coordinate(y2) + "\" stroke=\"" + stroke + "\"/>\n";
}

double logarithm(double v) {
    return v > 0.0 ? std::log10(v) : std::numeric_limits<double>::quiet_NaN();
}

struct Frame {
    Range x, y;
    bool logarithmic, logarithmicX;

    double value(double v) const { return logarithmic ? logarithm(v) : v; }
    double place(double v) const { return logarithmicX ? logarithm(v) : v; }
    double px(double transformed) const {
        return kLeft + (transformed - x.least) / (x.greatest - x.least) * (kWidth - kLeft - kRight);
    }
    double py(double transformed) const {
        return kHeight - kBottom -
               (transformed - y.least) / (y.greatest - y.least) * (kHeight - kTop - kBottom);
    }
};

Frame frameOf(const Plot& plot) {
    Frame frame{{}, {}, plot.logarithmic, plot.logarithmicX};
    for (const auto& line : plot.lines)
        for (std::size_t i = 0; i < line.x.size(); ++i) {
            const double v = frame.value(line.y[i]), at = frame.place(line.x[i]);
            if (!std::isfinite(v) || !std::isfinite(at)) continue;
            frame.x.add(at);
            frame.y.add(v);
        }
    frame.x.finish(0.5);
    if (plot.logarithmic && std::isfinite(frame.y.least)) {
        frame.y.least = std::floor(frame.y.least);
        frame.y.greatest = std::ceil(frame.y.greatest);
    }
    frame.y.finish(frame.y.least == 0.0 ? 1.0 : 0.05 * std::abs(frame.y.least));
    return frame;
}

/// Places and their texts; 1, 2 and 5 times powers of ten on a logarithmic axis of less than two decades,
/// powers of ten on a longer one.
std::vector<std::pair<double, std::string>> ticksOfX(const Frame& frame) {
    std::vector<std::pair<double, std::string>> ticks;
    if (!frame.logarithmicX) {
        for (const double t : niceTicks(frame.x.least, frame.x.greatest, 6))
            ticks.emplace_back(t, shortNumber(t));
        return ticks;
    }
    const bool isShort = frame.x.greatest - frame.x.least < 2.0;
    for (double e = std::floor(frame.x.least); e <= frame.x.greatest; ++e)
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double at = e + std::log10(factor);
            if ((factor == 1.0 || isShort) && at >= frame.x.least - 1e-9 && at <= frame.x.greatest + 1e-9)
                ticks.emplace_back(at, shortNumber(std::pow(10.0, at)));
        }
    return ticks;
}

std::string axes(const Plot& plot, const Frame& frame) {
    std::string out;
    const double right = kWidth - kRight, bottom = kHeight - kBottom;
    for (const auto& [t, text] : ticksOfX(frame)) {
        out += segment(frame.px(t), kTop, frame.px(t), bottom, "#e3e6ea");
        out += label(frame.px(t), bottom + 18, text, "middle");
    }
    if (plot.logarithmic) {
        const int step = std::max(1, static_cast<int>(std::ceil((frame.y.greatest - frame.y.least) / 8)));
        for (int e = static_cast<int>(frame.y.least); e <= static_cast<int>(frame.y.greatest); e += step) {
            out += segment(kLeft, frame.py(e), right, frame.py(e), "#e3e6ea");
            out += label(kLeft - 8, frame.py(e) + 4, "1e" + std::to_string(e), "end");
        }
    } else {
        for (const double t : niceTicks(frame.y.least, frame.y.greatest, 6)) {
            out += segment(kLeft, frame.py(t), right, frame.py(t), "#e3e6ea");
            out += label(kLeft - 8, frame.py(t) + 4, shortNumber(t), "end");
        }
    }
    out += segment(kLeft, bottom, right, bottom, "#5b6470") + segment(kLeft, kTop, kLeft, bottom, "#5b6470");
    out += label((kLeft + right) / 2, kHeight - 12, plot.xLabel, "middle");
    const std::string middle = coordinate((kTop + bottom) / 2);
    const std::string turn = " transform=\"rotate(-90 18 " + middle + ")\"";
    out += label(18, (kTop + bottom) / 2, plot.yLabel, "middle", turn.c_str());
    return out + label(kLeft, 24, plot.title, "start", " font-size=\"15\" font-weight=\"600\"");
}

std::string dashAttribute(const PlotLine& line) {
    std::string lengths;
    for (const double length : line.dash) lengths += (lengths.empty() ? "" : " ") + coordinate(length);
    return lengths.empty() ? "" : " stroke-dasharray=\"" + lengths + "\"";
}

std::string curve(const PlotLine& line, const Frame& frame, bool marked) {
    std::string path, dots;
    bool pen = false;
    for (std::size_t i = 0; i < line.x.size(); ++i) {
        const double v = frame.value(line.y[i]), at = frame.place(line.x[i]);
        if (!std::isfinite(v) || !std::isfinite(at)) {
            pen = false;
            continue;
        }
        const std::string x = coordinate(frame.px(at)), y = coordinate(frame.py(v));
        path += std::string(pen ? "L" : "M") + x + " " + y;
        if (marked)
            dots += "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"3\" fill=\"" + escapeMarkup(line.colour) +
                    "\"/>\n";
        pen = true;
    }
    if (path.empty()) return "";
    return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + escapeMarkup(line.colour) +
           "\" stroke-width=\"1.6\" stroke-linejoin=\"round\"" + dashAttribute(line) + "/>\n" + dots;
}

std::string legend(const Plot& plot) {
    std::string out;
    double y = kTop + 8;
    for (const auto& line : plot.lines) {
        out += "<line x1=\"" + coordinate(kWidth - kRight + 14) + "\" y1=\"" + coordinate(y) + "\" x2=\"" +
               coordinate(kWidth - kRight + 38) + "\" y2=\"" + coordinate(y) + "\" stroke=\"" +
               escapeMarkup(line.colour) + "\" stroke-width=\"2\"" + dashAttribute(line) + "/>\n";
        out += label(kWidth - kRight + 44, y + 4, line.label, "start");
        y += 18;
    }
    return out;
}

/// The series of a file that a plot shows: of this name, where one is given, and that of the whole scene before that of
/// a body; of this subject, where one is given. Null when there is none.
const results::SeriesChannel* findSeries(const results::TrajectoryFile& file, const std::string& name,
                                         const std::optional<std::string>& subject) {
    const results::SeriesChannel* found = nullptr;
    for (const auto& s : file.series) {
        const bool isWanted = (s.name == name || name.empty()) && (!subject || s.subject == *subject);
        if (!isWanted || s.channel.values.size() != file.times.size()) continue;
        if (s.subject.empty() || subject) return &s;
        if (!found) found = &s;
    }
    return found;
}

/// "position error of block".
std::string seriesTitle(const std::string& name, const std::string& subject) {
    std::string text = name;
    std::replace(text.begin(), text.end(), '_', ' ');
    return subject.empty() ? text : text + " of " + subject;
}

}  // namespace

std::string colourOf(const ViewModel& view, const SpecColumn& column) {
    std::vector<std::string> engines;  // engines that took part, in the order of the columns
    for (const SpecColumn& c : view.columns())
        if (std::find(engines.begin(), engines.end(), c.engine) == engines.end()) engines.push_back(c.engine);
    return paletteColour(std::find(engines.begin(), engines.end(), column.engine) - engines.begin());
}

const char* paletteColour(std::size_t index) {
    return kPalette[index % kPaletteSize];
}

std::vector<double> niceTicks(double least, double greatest, int about) {
    if (!(greatest > least) || about < 1) return {least};
    const double raw = (greatest - least) / about;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    const double share = raw / power;
    const double step = power * (share <= 1.0 ? 1.0 : share <= 2.0 ? 2.0 : share <= 5.0 ? 5.0 : 10.0);
    std::vector<double> ticks;
    const double slack = 1e-9 * step;
    for (double k = std::ceil((least - slack) / step); k * step <= greatest + slack && ticks.size() < 100;
         ++k)
        ticks.push_back(k == 0.0 ? 0.0 : k * step);
    return ticks;
}

std::string svgPlot(const Plot& plot) {
    const Frame frame = frameOf(plot);
    std::string out =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 420\" width=\"760\" height=\"420\" "
        "font-family=\"system-ui, sans-serif\" font-size=\"12\" fill=\"#22272e\">\n"
        "<rect width=\"760\" height=\"420\" fill=\"#ffffff\"/>\n";
    out += axes(plot, frame);
    for (const auto& line : plot.lines) out += curve(line, frame, plot.marked);
    return out + legend(plot) + "</svg>\n";
}

std::string plotCsv(const Plot& plot) {
    std::string out = "line," + csvField(plot.xLabel) + "," + csvField(plot.yLabel) + ",non_finite\n";
    for (const auto& line : plot.lines)
        for (std::size_t i = 0; i < line.x.size(); ++i)
            out += csvField(line.label) + "," + results::finiteText(line.x[i]) + "," +
                   results::finiteText(line.y[i]) + "," +
                   results::nonFiniteNote({{"x", line.x[i]}, {"y", line.y[i]}}) + "\n";
    return out;
}

NamedPlot namedPlot(const std::string& name, const Plot& plot) {
    return {name, svgPlot(plot), plotCsv(plot)};
}

std::optional<NamedPlot> scenarioPlot(const ViewModel& view, std::size_t index,
                                      const TrajectoryLoader& load) {
    const auto& scenario = view.run().scenarios[index];
    std::string name = "position_error";
    std::optional<std::string> subject;  // subject of the first line, and of all
    Plot plot;
    const std::size_t points = curvePoints(view.run().cases.size(), kPlotPoints, kFewestPlotPoints);
    for (std::size_t c = 0; c < view.columns().size(); ++c) {
        const auto& cases = view.cell(index, c).cases;
        if (cases.empty()) continue;
        const auto file = load(*cases.front());
        if (!file || file->times.empty()) continue;
        const auto* series = findSeries(*file, name, subject);
        if (!series && plot.lines.empty() && (series = findSeries(*file, "", subject))) name = series->name;
        if (!series) continue;
        subject = series->subject;
        const auto& column = view.columns()[c];
        PlotLine line{column.label, colourOf(view, column), column.dash, {}, {}};
        for (const std::size_t i : outlineIndices(series->channel.values, points)) {
            line.x.push_back(file->times[i]);
            line.y.push_back(series->channel.values[i]);
        }
        plot.lines.push_back(line);
        plot.yLabel = seriesTitle(name, *subject) +
                      (series->channel.unit.empty() ? "" : " [" + series->channel.unit + "]");
    }
    if (plot.lines.empty()) return std::nullopt;
    plot.title = scenario.title.empty() ? scenario.name : scenario.title;
    plot.xLabel = "t [s]";
    plot.logarithmic = name.find("error") != std::string::npos;
    return namedPlot(fileNamePart(scenario.name) + "-" + fileNamePart(name), plot);
}

}  // namespace rigor::report
