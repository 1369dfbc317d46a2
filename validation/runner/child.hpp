// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Exit codes by which a child reports to its parent what a result file could not.
#pragma once

namespace rigor::validation {

inline constexpr int kExitOutOfMemory = 86;  ///< operator new found no memory
/// The environment failed (results::EnvironmentError): the line that begins with kEnvironmentMark says how.
inline constexpr int kExitEnvironment = 87;
inline constexpr const char* kEnvironmentMark = "rigor-environment: ";

}  // namespace rigor::validation
