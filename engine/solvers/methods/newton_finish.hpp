// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The end of an iteration that has sorted contacts into open, sticking and sliding: steps of the generalised
// Newton method on all rows (contact_newton.hpp), damped where they do not come nearer. The residual may rise
// on the way, while contacts change their case; the best impulses found are kept, so that an attempt never
// leaves more than it found.
// Cost: n^3 / 3 per step and n^2 numbers of memory, n the number of rows.
#pragma once

#include <vector>

#include "engine/solvers/lcp/free_rows.hpp"
#include "engine/solvers/methods/contact_interior.hpp"
#include "engine/solvers/methods/contact_newton.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::engine {

template <class S>
class NewtonFinish {
  public:
    using Real = typename S::Real;
    /// The rows are others than those of the last attempt.
    void forget() {
        assembled_ = false;
        interiorStarts_ = 0;
    }
    /// Iterates from the current impulses, of natural map `residual` [m/s], towards `goal` in at most
    /// `steps`. Returns the natural map of the impulses it leaves.
    Real attempt(const SolverInput<S>& input, Real residual, Real goal, int steps = 30);
    /// The same from where the interior-point method ends, which starts nearer to the impulses there are with
    /// each call; there are kInteriorStarts of them.
    Real attemptFromInside(const SolverInput<S>& input, Real residual, Real goal);

  private:
    /// Impulses and velocities, to the bit: going back by impulses would leave rounding.
    struct Saved {
        std::vector<Real> impulses;
        std::vector<Velocity<S>> velocities;
        void save(const SolverInput<S>& input);
        void restore(const SolverInput<S>& input) const;
    };
    void assemble(const SolverInput<S>& input);
    Real take(const SolverInput<S>& input, const std::vector<double>& impulses);
    bool takeNewtonStep(double damping);
    bool runsAway() const;

    static constexpr int kInteriorStarts = 6;
    static constexpr Real kLost = Real(100);  ///< residual over the best from which there is no way back
    /// Steps in a row that come no nearer. Hardly an attempt that makes more of them ends well.
    static constexpr int kMostFruitless = 6;
    /// Residual over the best: the step has come to where the one before it was.
    static constexpr Real kStill = Real(1.1);
    static constexpr double kLeastDamping = 1e-10, kMostDamping = 1e-2;  ///< ContactNewton's sigma
    /// The least after a step that went astray, where joints take nearly all mobility from contacts.
    static constexpr double kJointDamping = 1e-4;
    /// Single precision: far above the rounding of rows.
    static constexpr double kJointShift = sizeof(Real) == sizeof(float) ? 2.4e-5 : FreeRows::kShift;
    AssembledProblem problem_;
    ContactNewton newton_;
    ContactInterior interior_;
    FreeRows joints_;
    std::vector<double> target_, reduced_;
    std::vector<Real> next_;
    Saved best_, before_;
    bool assembled_ = false;
    bool eliminated_ = false;  ///< joints_ has taken the free rows out
    int interiorStarts_ = 0;
};

/// Natural map [m/s] after the biases have been renewed for the velocities there are.
template <class S>
typename S::Real renewedResidual(const SolverInput<S>& input);

}  // namespace rigor::engine
