// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The report formats as pure functions from a run to text. writeReports() is the shell around them.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "reports/view_model.hpp"
#include "validation/results/trajectory_file.hpp"

namespace rigor::report {

/// Trajectory of a case without its contacts; empty when there is none or it can not be read.
using TrajectoryLoader = std::function<std::optional<results::TrajectoryFile>(const results::CaseRow& row)>;

/// The run without the derived scenarios of a study (tag "derived": a transformed or perturbed scene) and
/// their cases. Pages, plots and the summary show this; the numbers of derived runs stay in results.csv and
/// in the columns of the study.
results::Run withoutDerivedRuns(results::Run run);
/// One row per case x metric and per case x quantity; columns in README.md.
std::string csvReport(const results::Run& run);
/// Fits a pull-request comment.
std::string markdownSummary(const ViewModel& view);
/// JUnit XML: one testcase per case.
std::string junitReport(const results::Run& run);
/// Observed orders, and the four ways to compare; a header alone where nothing was run at three time steps.
std::string ordersCsv(const results::Run& run);
std::string fairnessCsv(const results::Run& run);
/// The orders of each scenario's main metric as a section of the summary; empty without any.
std::string ordersMarkdown(const ViewModel& view);
/// Cases whose result depends on the order of insertion; empty where none was run in several.
std::string insertionOrdersMarkdown(const ViewModel& view);
/// What a step costs each engine, by median and by mean, first step apart; empty where nothing was timed.
std::string costMarkdown(const ViewModel& view);
/// The page with the overview's data in it. `study`: studyPageJson() of a study's run, else empty.
std::string htmlReport(const ViewModel& view, const std::string& study = "");
/// The data behind the page's overview, which is in the page, and behind the page of one scenario, which
/// stands beside it in data/scenario-<index>.js, as JSON.
std::string overviewJson(const ViewModel& view);
std::string scenarioJson(const ViewModel& view, std::size_t scenario, const TrajectoryLoader& load);

}  // namespace rigor::report
