// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Counts what a test program allocates: linking counting_new.cpp replaces the global operators new and
// delete.
#pragma once

namespace rigor::engine::test {

/// Calls of operator new since the program started.
long allocationCount();

}  // namespace rigor::engine::test
