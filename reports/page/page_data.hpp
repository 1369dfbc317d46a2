// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The data of the page.
#pragma once

#include <cstddef>
#include <string>

#include "reports/model/trajectory_loader.hpp"
#include "reports/model/view_model.hpp"

namespace rigor::report {

/// The data behind the page's overview, which is in the page, and behind the page of one scenario, which
/// stands beside it in data/scenario-<index>.js, as JSON.
std::string overviewJson(const ViewModel& view);
std::string scenarioJson(const ViewModel& view, std::size_t scenario, const TrajectoryLoader& load);

}  // namespace rigor::report
