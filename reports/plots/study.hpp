// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The tables of a study as pictures: what is drawn against what, decided once for the page and the SVG files.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/plots/svg_plot.hpp"

namespace rigor::report {

/// One row of a part in one of its columns.
struct StudyPoint {
    std::string label;                ///< of the bar, or of the line it belongs to
    std::optional<double> x;          ///< on the axis; none in a chart of bars
    std::optional<double> value;      ///< none where the run gave none
    std::optional<double> low, high;  ///< of its interval, where it has one
    std::string note;                 ///< who, or why there is no value
    std::string outcome;              ///< how the run ended
};

/// One column of a part, for one scenario where the part's axis is something else.
struct StudyChart {
    std::string part, scenario, metric, unit;
    std::string axis;  ///< "time step [s]", a parameter's key, "bodies"; empty: a bar for each row
    bool logarithmic = false, logarithmicX = false;
    std::vector<StudyPoint> points;  ///< of a line: together, by x
};

/// From `study.json`. Where a part with an axis has a column of time, its other columns are drawn over that,
/// too: error against cost. A part's axis is what takes the most numbers in its grid, three at least: a
/// parameter or an option, the number of bodies, the time step. Values over more than two decades are drawn
/// by their logarithms.
std::vector<StudyChart> studyCharts(const nlohmann::ordered_json& study);

/// The study with its charts, for the page.
std::string studyPageJson(const nlohmann::ordered_json& study);

/// `study-<part>-<metric>[-<scenario>]`
std::vector<NamedPlot> studyPlots(const nlohmann::ordered_json& study);

}  // namespace rigor::report
