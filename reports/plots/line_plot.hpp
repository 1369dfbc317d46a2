// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A small line plot: axes with round ticks, grid, legend beside it, linear or logarithmic values.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reports/model/trajectory_loader.hpp"
#include "reports/model/view_model.hpp"
#include "reports/plots/drawing.hpp"

namespace rigor::report {

struct PlotLine {
    std::string label, colour;
    std::vector<double> dash;  ///< empty: solid
    std::vector<double> x, y;  ///< points of the line, of the same length; a non-finite y is a gap
};

struct Plot {
    std::string title, xLabel, yLabel;
    std::string subtitle;       ///< second line of the title; may be empty
    bool logarithmic = false;   ///< values <= 0 are gaps then
    bool logarithmicX = false;  ///< x <= 0 is a gap then
    bool marked = false;        ///< a dot at every point
    std::vector<PlotLine> lines;
};

Drawing drawPlot(const Plot& plot);

/// Round tick values covering [least, greatest]: steps of 1, 2 or 5 times a power of ten.
std::vector<double> niceTicks(double least, double greatest, int about);

/// The data of a plot as CSV, digits that read back as the same doubles: a row for each point of each line.
/// Points that a logarithmic axis can not show are there too.
std::string plotCsv(const Plot& plot);

struct NamedPlot {
    std::string name;  ///< name of its files, without an ending
    Drawing drawing;
    std::string csv;
};
/// The picture and its data.
NamedPlot namedPlot(const std::string& name, const Plot& plot);
/// Colours that every common colour vision distinguishes; they repeat after kPaletteSize.
inline constexpr std::size_t kPaletteSize = 7;
const char* paletteColour(std::size_t index);
/// The colour of a column's engine: the same in every plot.
std::string colourOf(const ViewModel& view, const SpecColumn& column);
/// Error over time step and error over cost of every scenario that was run at three time steps or more.
std::vector<NamedPlot> refinementPlots(const ViewModel& view);
/// Position error of a scenario over time at the finest time step, or the first series there is; empty without one.
std::optional<NamedPlot> scenarioPlot(const ViewModel& view, std::size_t scenario,
                                      const TrajectoryLoader& load);

}  // namespace rigor::report
