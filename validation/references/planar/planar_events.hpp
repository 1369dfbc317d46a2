// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Events of planar_motion.hpp: zeros of functions of time that are positive while a mode of the motion holds.
#pragma once

#include <functional>
#include <optional>

#include "validation/references/numerics/real.hpp"

namespace rigor::validation {

/// A function of time that is positive while a mode holds, and what of it is zero.
struct Watched {
    std::function<numerics::Real(numerics::Real)> value;
    numerics::Real small = 0;
};

/// The first time in [begin, end] at which the function becomes negative, from 64 samples; between samples
/// that are positive their least value shows whether it dips below zero.
std::optional<numerics::Real> firstZero(const Watched& watched, numerics::Real begin, numerics::Real end);

}  // namespace rigor::validation
