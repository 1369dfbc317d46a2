// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The data of the page.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/model/trajectory_loader.hpp"
#include "reports/model/view_model.hpp"

namespace rigor::report {

/// Place of the cases of the overview, of the audit and of the parity ledger: in the page, or, for a large run, in files
/// beside it that it loads when they are looked at.
enum class CasesOfPage { Inside, Beside };

/// The data behind the page's overview, which is in the page, and behind the page of one scenario, which
/// stands beside it in data/scenario-<index>.js, as JSON.
std::string overviewJson(const ViewModel& view, CasesOfPage cases = CasesOfPage::Inside);
/// The first scenario of each file of CasesOfPage::Beside; a file has some hundred cases.
std::vector<std::size_t> caseFiles(const ViewModel& view);
/// Content of data/cases-<file>.js: for each scenario of the file an array of its cases, as they would stand in the page.
std::string casesJson(const ViewModel& view, std::size_t file);
/// Content of data/lists.js of CasesOfPage::Beside: the audit and the parity ledger over all scenarios.
std::string listsJson(const ViewModel& view);
/// `files`: names of the files of its table and its plot, from the folder of the page.
std::string scenarioJson(const ViewModel& view, std::size_t scenario, const TrajectoryLoader& load,
                         const std::vector<std::string>& files = {});

}  // namespace rigor::report
