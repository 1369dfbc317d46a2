// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Combination of two materials' coefficients into that of the pair, if the pair has none of its own.
#pragma once

#include <span>

#include "engine/core/table.hpp"

namespace rigor::engine {

template <class R>
using CombineRule = R (*)(R a, R b);
template <class R>
std::span<const AlgorithmEntry<CombineRule<R>>> combineTable();

}  // namespace rigor::engine
