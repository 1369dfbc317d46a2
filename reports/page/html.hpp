// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page of a report.
#pragma once

#include <string>

#include "reports/model/view_model.hpp"
#include "reports/page/page_data.hpp"

namespace rigor::report {

/// The page with the overview's data in it. `study`: studyPageJson() of a study's run, else empty.
std::string htmlReport(const ViewModel& view, const std::string& study = "",
                       CasesOfPage cases = CasesOfPage::Inside);

/// The page of several runs after each other, with its data in it.
std::string htmlHistory(const std::string& json);

/// The page of `rigor collide`, of its record (collide.json).
std::string htmlCollide(const std::string& json);

/// The page of `rigor solve`, of its record.
std::string htmlSolve(const std::string& json);

}  // namespace rigor::report
