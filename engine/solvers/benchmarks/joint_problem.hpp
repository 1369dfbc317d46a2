// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <cmath>

#include "engine/solvers/tests/row_problem.hpp"

namespace rigor::engine::benchmark_scene {

/// The rows of `links` bodies in a row of ball joints that hangs from the world, or of as many in a square
/// net of them.
template <class S>
test::RowProblem<S> jointProblem(int links, bool net) {
    test::RowProblem<S> problem;
    const int side = net ? static_cast<int>(std::sqrt(links)) : links;
    const typename S::Vec right = S::Vec::Unit(0) * typename S::Real(0.25);
    const typename S::Vec down = S::Vec::Unit(1) * typename S::Real(-0.25);
    const int count = net ? side * side : links;
    for (int i = 0; i < count; ++i) problem.addBody(1, 0.1, S::Vec::Unit(0));
    for (int i = 0; i < count; ++i) {
        const auto body = static_cast<std::uint32_t>(i + 1);
        if (i == 0) problem.addBall(0, body, S::Vec::Zero(), -right);
        if (i % side > 0) problem.addBall(body - 1, body, right, -right);
        if (net && i >= side) problem.addBall(body - static_cast<std::uint32_t>(side), body, down, -down);
    }
    return problem;
}

}  // namespace rigor::engine::benchmark_scene
