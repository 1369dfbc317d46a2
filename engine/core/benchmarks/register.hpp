// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Functions that every benchmark program defines: main.cpp beside this is the rest of it.
#pragma once

namespace rigor::engine {

/// Registers all benchmarks of the program, by name.
void registerBenchmarks();

}  // namespace rigor::engine
