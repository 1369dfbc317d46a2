// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The step of these tests, and what calls are refused for.
#pragma once

#include <string>

#include "engine/core/error.hpp"

namespace rigor::engine::test {

inline constexpr double kTick = 1.0 / 60;  ///< [s]

/// Id of the EngineError that a call throws, or "none".
template <class Call>
std::string refusal(Call call) {
    try {
        call();
    } catch (const EngineError& e) {
        return e.id();
    }
    return "none";
}

}  // namespace rigor::engine::test
