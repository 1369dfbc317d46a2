// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenarios that were run at several time steps.
#pragma once

#include <string>
#include <vector>

#include "reports/model/view_model.hpp"

namespace rigor::report {

struct Refinement {
    std::string scenario, metric, unit;
};
/// Scenarios with orders, each with the first of its metrics that has some.
std::vector<Refinement> refinements(const ViewModel& view);

}  // namespace rigor::report
