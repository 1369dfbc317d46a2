// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A small SVG line plot: axes with round ticks, grid, legend, linear or logarithmic values.
#pragma once

#include <string>
#include <vector>

#include "reports/writers.hpp"

namespace rigor::report {

struct PlotLine {
    std::string label, colour;
    bool dashed = false;
    std::vector<double> x, y;  ///< same length; a non-finite y is a gap
};

struct Plot {
    std::string title, xLabel, yLabel;
    bool logarithmic = false;  ///< values <= 0 are gaps then
    std::vector<PlotLine> lines;
};

std::string svgPlot(const Plot& plot);

/// Round tick values covering [least, greatest]: steps of 1, 2 or 5 times a power of ten.
std::vector<double> niceTicks(double least, double greatest, int about);

struct NamedPlot {
    std::string fileName, svg;
};
/// One plot per scenario: its position error over time at the finest time step, or the first series there is.
std::vector<NamedPlot> scenarioPlots(const ViewModel& view, const TrajectoryLoader& load);

}  // namespace rigor::report
