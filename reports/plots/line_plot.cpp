// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/plots/line_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "reports/encoding/text.hpp"
#include "reports/model/trajectory_loader.hpp"
#include "reports/model/view_model.hpp"
#include "reports/plots/curves.hpp"
#include "validation/results/values.hpp"

namespace rigor::report {
namespace {

constexpr double kWidth = 760, kHeight = 420, kLeft = 78, kLeastRight = 190, kBottom = 50;
constexpr double kTop = 40, kTopWithSubtitle = 54;
constexpr double kLegendLine = 18,
                 kLegendText = 44;  ///< heights of its lines; offset of its texts from the axes
constexpr double kCharacter = 6.8;  ///< typical width of a character of size 12

constexpr const char *kGrid = "#e3e6ea", *kAxis = "#5b6470";

/// Okabe and Ito's palette: distinguishable with every common colour vision. The page uses the same, in the
/// same order.
constexpr std::array<const char*, kPaletteSize> kPalette{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                         "#E69F00", "#56B4E9", "#7A5C00"};

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

double logarithm(double v) {
    return v > 0.0 ? std::log10(v) : std::numeric_limits<double>::quiet_NaN();
}

/// Axes and their place in a drawing, which grows with its legend.
struct Frame {
    Range x, y;
    bool logarithmic, logarithmicX;
    double width = kWidth, height = kHeight, top = kTop, right = kWidth - kLeastRight;

    double bottom() const { return height - kBottom; }

    double value(double v) const { return logarithmic ? logarithm(v) : v; }
    double place(double v) const { return logarithmicX ? logarithm(v) : v; }
    double px(double transformed) const {
        return kLeft + (transformed - x.least) / (x.greatest - x.least) * (right - kLeft);
    }
    double py(double transformed) const {
        return bottom() - (transformed - y.least) / (y.greatest - y.least) * (bottom() - top);
    }
};

void makeRoom(const Plot& plot, Frame& frame) {
    if (!plot.subtitle.empty()) frame.top = kTopWithSubtitle;
    std::size_t longest = 0;
    for (const auto& line : plot.lines) longest = std::max(longest, displayWidth(line.label));
    frame.width = frame.right + std::max(kLeastRight, kLegendText + kCharacter * longest + 8);
    frame.height = std::max(kHeight, frame.top + kLegendLine * (plot.lines.size() + 1));
}

Frame frameOf(const Plot& plot) {
    Frame frame{{}, {}, plot.logarithmic, plot.logarithmicX};
    makeRoom(plot, frame);
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

/// The same of the values; powers of ten on a logarithmic axis.
std::vector<std::pair<double, std::string>> ticksOfY(const Frame& frame) {
    std::vector<std::pair<double, std::string>> ticks;
    if (!frame.logarithmic) {
        for (const double t : niceTicks(frame.y.least, frame.y.greatest, 6))
            ticks.emplace_back(t, shortNumber(t));
        return ticks;
    }
    const int step = std::max(1, static_cast<int>(std::ceil((frame.y.greatest - frame.y.least) / 8)));
    for (int e = static_cast<int>(frame.y.least); e <= static_cast<int>(frame.y.greatest); e += step)
        ticks.emplace_back(e, "1e" + std::to_string(e));
    return ticks;
}

void addAxes(const Plot& plot, const Frame& frame, Drawing& out) {
    const double right = frame.right, bottom = frame.bottom();
    for (const auto& [t, text] : ticksOfX(frame)) {
        out.add(DrawnLine{frame.px(t), frame.top, frame.px(t), bottom, {kGrid}});
        out.add(DrawnText{frame.px(t), bottom + 18, text, Anchor::Middle});
    }
    for (const auto& [t, text] : ticksOfY(frame)) {
        out.add(DrawnLine{kLeft, frame.py(t), right, frame.py(t), {kGrid}});
        out.add(DrawnText{kLeft - 8, frame.py(t) + 4, text, Anchor::End});
    }
    out.add(DrawnLine{kLeft, bottom, right, bottom, {kAxis}});
    out.add(DrawnLine{kLeft, frame.top, kLeft, bottom, {kAxis}});
    out.add(DrawnText{(kLeft + right) / 2, frame.height - 12, plot.xLabel, Anchor::Middle});
    out.add(DrawnText{.x = 18,
                      .y = (frame.top + bottom) / 2,
                      .text = plot.yLabel,
                      .anchor = Anchor::Middle,
                      .upward = true});
    out.add(DrawnText{.x = kLeft, .y = 24, .text = plot.title, .size = 15, .bold = true});
    if (!plot.subtitle.empty()) out.add(DrawnText{kLeft, 42, plot.subtitle});
}

void addCurve(const PlotLine& line, const Frame& frame, bool marked, Drawing& out) {
    DrawnPath path{{}, {line.colour, 1.6, line.dash}};
    bool pen = false;
    for (std::size_t i = 0; i < line.x.size(); ++i) {
        const double v = frame.value(line.y[i]), at = frame.place(line.x[i]);
        const bool seen = std::isfinite(v) && std::isfinite(at);
        if (seen && !pen) path.pieces.emplace_back();
        if (seen) path.pieces.back().push_back({frame.px(at), frame.py(v)});
        pen = seen;
    }
    if (path.pieces.empty()) return;
    out.add(path);
    if (!marked) return;
    for (const auto& piece : path.pieces)
        for (const auto& [x, y] : piece) out.add(DrawnCircle{x, y, 3, line.colour});
}

void addLegend(const Plot& plot, const Frame& frame, Drawing& out) {
    double y = frame.top + 8;
    for (const auto& line : plot.lines) {
        out.add(DrawnLine{frame.right + 14, y, frame.right + 38, y, {line.colour, 2, line.dash}});
        out.add(DrawnText{frame.right + kLegendText, y + 4, line.label});
        y += kLegendLine;
    }
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

/// ", time step 1/240 s" where the lines have one; else each label gets its own.
std::string nameTimeSteps(const std::vector<double>& steps, std::vector<PlotLine>& lines) {
    const bool areEqual =
        std::adjacent_find(steps.begin(), steps.end(), std::not_equal_to<>()) == steps.end();
    if (areEqual) return ", time step " + timeStepLabel(steps.front());
    for (std::size_t i = 0; i < lines.size(); ++i) lines[i].label += ", " + timeStepLabel(steps[i]);
    return ", each at its finest time step";
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

Drawing drawPlot(const Plot& plot) {
    const Frame frame = frameOf(plot);
    Drawing out{frame.width, frame.height, {}};
    addAxes(plot, frame, out);
    for (const auto& line : plot.lines) addCurve(line, frame, plot.marked, out);
    addLegend(plot, frame, out);
    return out;
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
    return {name, drawPlot(plot), plotCsv(plot)};
}

std::optional<NamedPlot> scenarioPlot(const ViewModel& view, std::size_t index,
                                      const TrajectoryLoader& load) {
    const auto& scenario = view.run().scenarios[index];
    std::string name = "position_error";
    std::optional<std::string> subject;  // subject of the first line, and of all
    Plot plot;
    std::vector<double> steps;  // time step of each line
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
        steps.push_back(cases.front()->dt);
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
    plot.subtitle = seriesTitle(name, *subject) + nameTimeSteps(steps, plot.lines);
    plot.xLabel = "t [s]";
    plot.logarithmic = name.find("error") != std::string::npos;
    return namedPlot(fileNamePart(scenario.name) + "-" + fileNamePart(name), plot);
}

}  // namespace rigor::report
