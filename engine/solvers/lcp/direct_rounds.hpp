// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Common part of the direct solvers (dantzig.cpp, lemke.cpp): rounds, each of which makes impulses of the
// whole problem (assembled.hpp) from those of the round before, until the problem's own conditions hold.
//
// They hold when the residual, a velocity, is at most the larger of WorldDef::residualTolerance and rounding:
// 32 epsilon of the velocities that the terms of w = W lambda + q are made of. Terms may cancel by any
// factor, but no more than sqrt(epsilon) of the fastest row is forgiven: impulses without bound, as
// contradictory rows have, are no excuse.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/solvers/impulses.hpp"
#include "engine/solvers/lcp/assembled.hpp"

namespace rigor::engine {

template <class S>
class DirectRounds : public Solver<S> {
  public:
    using Real = typename S::Real;

    bool gaveUp() const final { return gaveUp_; }

    void solve(const SolverInput<S>& input) final {
        applyWarmStart<S>(input);
        gaveUp_ = false;
        if (input.constraints.rows.empty()) return;
        problem_.assemble<S>(input.constraints, input.velocities.size());
        begin(input);
        bool converged = false;
        double least = std::numeric_limits<double>::infinity();
        for (int round = 0;; ++round) {
            input.monitor.before(input.velocities);
            problem_.readVelocities<S>(input.constraints, input.velocities);
            problem_.findOffsets();
            const double left = round > 0 ? residual() : least;
            converged = left <= tolerance(input);
            if (left < least) {
                least = left;
                best_ = x_;
            }
            if (converged || round == input.iterations || isHopeless()) break;
            improve(input, round);
            const double change = setImpulses(input, x_);
            input.monitor.after(input.velocities, static_cast<Real>(change));
        }
        gaveUp_ = gaveUp_ || !converged;
        if (!converged && std::isfinite(least)) setImpulses(input, best_);
    }

  protected:
    bool gaveUp_ = false;
    AssembledProblem problem_;
    std::vector<double> x_;  ///< impulses of the round

  private:
    /// problem_ is new; sizes x_.
    virtual void begin(const SolverInput<S>& input) = 0;
    /// Distance of problem_.lambda from a solution [m/s or rad/s].
    virtual double residual() const = 0;
    /// x_ from problem_.
    virtual void improve(const SolverInput<S>& input, int round) = 0;
    /// Another round would do the same again.
    virtual bool isHopeless() const { return false; }

    double tolerance(const SolverInput<S>& input) const {
        double largest = 0, fastest = 0;
        for (std::size_t i = 0; i < problem_.n; ++i) {
            fastest = std::max(fastest, std::abs(problem_.q[i]));
            largest = std::max(largest, problem_.at(i, i) * std::abs(x_[i]));
        }
        constexpr auto eps = static_cast<double>(std::numeric_limits<Real>::epsilon());
        return std::max(static_cast<double>(input.residualTolerance),
                        std::min(32 * eps * (largest + fastest), std::sqrt(eps) * fastest));
    }

    std::vector<double> best_;  ///< impulses of the round that came nearest
};

}  // namespace rigor::engine
