// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The child's side of a lane: `rigor __lane FILE_NUMBER`.
#pragma once

#include <filesystem>

namespace rigor::validation {

/// Answers the packets of the socket with that number, each with one, until it is closed. Returns the exit
/// code.
int laneChild(const std::filesystem::path& fileNumber);

}  // namespace rigor::validation
