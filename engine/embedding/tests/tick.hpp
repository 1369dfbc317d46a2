// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The step of these tests.
#pragma once

namespace rigor::engine::test {

inline constexpr double kTick = 1.0 / 60;  ///< [s]

}  // namespace rigor::engine::test
