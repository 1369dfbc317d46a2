// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Newton's method (newton_finish.hpp) on one independent part of a problem that is swept (block.cpp): which parts are
// worth an attempt, and the attempt. The blocks of a part are put in an order in which its matrix is narrow
// (elimination_order.hpp).
// Cost: up to kSteps factorisations of the rows of the part, of which EliminationOrder::cost() is a bound.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/solvers/elimination_order.hpp"
#include "engine/solvers/independent_parts.hpp"
#include "engine/solvers/methods/newton_finish.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::engine {

/// Numbers of the rows of a part.
struct PartRows {
    std::size_t all = 0;
    std::size_t besideEqualities = 0;  ///< all but the equality rows of joints
    bool ofJoints = false;             ///< some are of joints, limits or motors

    /// Joints and what presses beside their equality rows: contacts, limits, motors.
    bool mixesJoints() const { return ofJoints && besideEqualities > 0; }
};
template <class S>
PartRows partRows(const std::vector<Block<S>>& all, std::span<const std::uint32_t> blocks);

template <class S>
class PartFinish {
  public:
    using Real = typename S::Real;
    static constexpr std::size_t kMostRows = 512;
    static constexpr std::size_t kFewRows = 48;  ///< an attempt on so few costs less than some sweeps

    /// Natural map of a part [m/s], and where it is small enough.
    struct Residual {
        Real found = 0, goal = 0;
    };
    static Residual residualOf(const SolverInput<S>& input, std::span<const std::uint32_t> blocks);

    /// Newton's method takes the smallest parts, and small ones with joints, whatever is left of them. Other small parts it
    /// takes once sweeps have nearly sorted their contacts into open, sticking and sliding ones; larger parts if they
    /// are sorted, their matrix is narrow, and sweeps did not solve them (`unsolved`). Puts `blocks` in order.
    bool isWorthwhile(const SolverInput<S>& input, std::vector<std::uint32_t>& blocks, const Residual& left,
                      bool unsolved);
    /// Solves the part of `blocks`, in order. Returns the residual reached.
    Real solve(const SolverInput<S>& input, std::span<const std::uint32_t> blocks, const Residual& left);
    void putInOrder(const SolverInput<S>& input, std::vector<std::uint32_t>& blocks) {
        order_.apply<S>(input.constraints.blocks, input.velocities.size(), blocks);
    }

  private:
    static constexpr int kSteps = 12;
    static constexpr std::size_t kSmallRows = 128;  ///< n^3 / 3 is then less than a millisecond
    static constexpr double kMostCost = 2e6;        ///< multiplications of a step: about a millisecond
    static constexpr Real kSorted = Real(1e4);      ///< multiple of the tolerance: contacts are sorted
    /// The same of small parts. From further away hardly one attempt in twenty succeeds.
    static constexpr Real kNearlySorted = Real(1e5);

    PartProblem<S> problem_;
    EliminationOrder order_;
    NewtonFinish<S> newton_;
};

}  // namespace rigor::engine
