// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "validation/results/trajectory_file.hpp"
#include "validation/trajectory.hpp"

namespace rigor::validation {

/// A stored trajectory as the run recorded it, the same bits. Contacts of frames whose contacts were not
/// stored (TrajectoryFile::contactStride) are missing. Contacts of an older file, whose instant is not known,
/// stay at the frame of the file, the one after their step.
Trajectory trajectoryOf(const results::TrajectoryFile& file);

}  // namespace rigor::validation
