// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "validation/results/trajectory_file.hpp"
#include "validation/trajectory.hpp"

namespace rigor::validation {

/// A stored trajectory as the run recorded it, the same bits. Contacts of frames whose contacts were not
/// stored (TrajectoryFile::contactStride) are missing. Those of an older file, of which the instant is not
/// known, stand at the frame that the file has them at, the one after their step.
Trajectory trajectoryOf(const results::TrajectoryFile& file);

}  // namespace rigor::validation
