// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Numbers of eight things side by side (structure of arrays), as SIMD takes them: lanes-inl.hpp.
#pragma once

#include <cstddef>

namespace rigor::engine {

/// Things per block, whatever the instruction set: results do not depend on it.
inline constexpr std::size_t kLanes = 8;

/// One number of each thing of a block.
template <class R>
using Lanes = R[kLanes];

/// Attribute of lambdas in kernels: variables that they take by reference stay in registers.
#define RIGOR_INLINE_LAMBDA __attribute__((always_inline))

}  // namespace rigor::engine
