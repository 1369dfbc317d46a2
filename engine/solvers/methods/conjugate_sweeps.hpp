// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Nonsmooth nonlinear conjugate gradients over Gauss-Seidel sweeps [SilcowitzHansen2010]: what a sweep
// changes stands for the negative gradient, and impulses go on in the direction of the sweeps before,
//     r_k = sweep(lambda_k) - lambda_k,    beta = |r_k|^2 / |r_k-1|^2
//     lambda_k+1 = lambda_k + r_k + beta p_k-1,    p_k = r_k + beta p_k-1    (beta > 1: both without p_k-1, p_k = 0)
// Differences from the paper:
//     - a step is a sweep forwards and one backwards: the change of one alone grows in every second sweep of a
//       stack, so that each of these would begin anew;
//     - the norm is that of energies, |r|^2 = sum r_i^2 K_ii, which does not depend on the units of rows;
//     - independent parts have a beta each, so that what becomes of one does not depend on the others.
// Velocities are linear in the impulses and go on by the same factors. Impulses may leave their bounds and cones; the next
// sweep brings them back, and a sweep must be the last.
// Cost: that of reading the impulses three times, a small part of two sweeps. The first step of eleven boxes that
// stand on each other: 1e-6 m/s are left after 120 sweeps; plain sweeps leave 4e-5 m/s after 400.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/solvers/independent_parts.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::engine {

template <class S>
class ConjugateSweeps {
  public:
    using Real = typename S::Real;
    /// Begins anew for `parts` independent parts.
    void begin(const SolverInput<S>& input, std::size_t parts);
    /// To be called before the first sweep of a step, for each part that takes it. `blocks` are all blocks of
    /// the part, contacts alone.
    void remember(const SolverInput<S>& input, std::span<const std::uint32_t> blocks);
    /// To be called after the second sweep, with the same blocks.
    void advance(const SolverInput<S>& input, std::size_t part, std::span<const std::uint32_t> blocks);

  private:
    template <class Use>
    void forEachBody(const SolverInput<S>& input, std::span<const std::uint32_t> blocks, const Use& use);
    template <class Use>
    static void forEachRow(const SolverInput<S>& input, std::span<const std::uint32_t> blocks,
                           const Use& use);

    std::vector<Real> norm_;  ///< |r|^2 of each part in its last step; 0: it has no direction
    // --- by row and by body
    std::vector<Real> impulseBefore_, impulseAlong_;
    std::vector<Velocity<S>> velocityBefore_, velocityAlong_;
    std::vector<std::uint32_t> visited_;  ///< visit in which forEachBody has last used each body
    std::uint32_t visit_ = 0;
};

}  // namespace rigor::engine
