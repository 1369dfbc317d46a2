// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Exit codes by which a child reports to its parent what a result file could not.
#pragma once

namespace rigor::validation {

inline constexpr int kExitOutOfMemory = 86;  ///< operator new found no memory

}  // namespace rigor::validation
