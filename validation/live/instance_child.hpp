// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The child's side of an instance: `rigor __instance FILE_NUMBER`.
#pragma once

#include <filesystem>

namespace rigor::validation {

/// Responds to each packet of the socket with that number by one packet, until it is closed. Returns the exit
/// code.
int instanceChild(const std::filesystem::path& fileNumber);

}  // namespace rigor::validation
