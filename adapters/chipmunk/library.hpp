// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

namespace rigor::chipmunk {

/// To be called before the first space of the process: Debian's build writes two lines to the standard output then,
/// which belongs to the caller.
void useLibrary();

}  // namespace rigor::chipmunk
