// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The clock of an engine's times.
#pragma once

#include <string>

#include "validation/results/types.hpp"

namespace rigor::results {

/// "guest, wasm" and the like where an engine's times are not those of native code in its process; "" otherwise, and in
/// runs that did not store it. Times of different clocks are not compared.
std::string clockOf(const EngineRow& engine);

}  // namespace rigor::results
