// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Function by which writers load the trajectory of a case.
#pragma once

#include <functional>
#include <optional>

#include "validation/results/trajectory_file.hpp"
#include "validation/results/types.hpp"

namespace rigor::report {

/// Trajectory of a case without its contacts; empty when there is none or it can not be read.
using TrajectoryLoader = std::function<std::optional<results::TrajectoryFile>(const results::CaseRow& row)>;

}  // namespace rigor::report
