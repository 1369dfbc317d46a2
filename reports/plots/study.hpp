// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The tables of a study as pictures: what is drawn against what, decided once for the page and the files of plots.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/plots/line_plot.hpp"

namespace rigor::report {

/// One row of a part in one of its columns.
struct StudyPoint {
    std::string label;                ///< label of the bar, or of its line
    std::optional<double> x;          ///< place on the axis; none in a chart of bars
    std::optional<double> value;      ///< value; none if the run gave none
    std::optional<double> low, high;  ///< bounds of its interval, if it has one
    std::string note;                 ///< subject, or the reason why there is no value
    std::string outcome;              ///< end of the run
};

/// One column of a part, for one scenario where the part's axis is something else.
struct StudyChart {
    std::string part, scenario, metric, unit;
    std::string axis;  ///< "time step [s]", a parameter's key, "bodies"; empty: a bar for each row
    bool logarithmic = false, logarithmicX = false;
    std::vector<StudyPoint> points;  ///< points; those of a line are together, by x
};

/// Charts of `study.json`. If a part with an axis has a column of time, its other columns are also drawn over
/// that: error against cost. The axis of a part is the quantity with the most values in its grid, at least
/// three: a parameter or an option, the number of bodies, the time step. Values over more than two decades
/// are drawn by their logarithms.
std::vector<StudyChart> studyCharts(const nlohmann::ordered_json& study);

/// The study with its charts, for the page.
std::string studyPageJson(const nlohmann::ordered_json& study);

/// `study-<part>-<metric>[-<scenario>]`
std::vector<NamedPlot> studyPlots(const nlohmann::ordered_json& study);

}  // namespace rigor::report
