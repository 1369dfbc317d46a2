// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// State that ODE has once per process: its initialisation, its error handlers and its random numbers.
#pragma once

#include <cstdint>
#include <mutex>

namespace rigor::ode {

/// Initialises ODE once per process and its thread data once per calling thread, and replaces the handlers
/// that would print and abort: errors and failed assertions arrive as std::runtime_error. Call before
/// anything else of ODE.
void useLibrary();

/// Messages ("LCP internal error" and the like) that ODE has uttered in this thread so far.
std::int64_t messageCount();

/// QuickStep draws its row order from one generator per process; a thread that steps with it holds this.
std::mutex& randomMutex();

}  // namespace rigor::ode
