// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Direct solver: the whole step as one problem (assembled.hpp), solved by Dantzig's principal pivoting with
// bounds (box_lcp.hpp) on the friction pyramid |lambda_t| <= mu lambda_n, each tangent by itself
// [Baraff1994]. Rolling friction is such a pyramid over the two moments about the tangents, of half edge
// rho lambda_n; torsional friction, and rolling friction in 2D, is an interval and exact.
//
// The bounds of friction depend on the normals. Baraff lets them move while pivoting: the matrix is then no
// longer symmetric, its principal minors may vanish, and the method may not end. Here each round solves the
// problem with fixed bounds (Tresca friction), which is monotone and always has a solution, and sets the
// bounds from its normals: the fixed point of the rounds obeys Coulomb's law [Haslinger1983]. To get there in
// few rounds, the next bounds come from the same sets of free and bounded rows with lambda_t = +-mu lambda_n
// put into the equations (one more linear solve, a Newton step of the coupling): when the sets are right the
// second round is exact. After kPlainRounds without success the bounds are relaxed half way instead, which is
// slower but does not cycle as easily. Rounds also renew biases that depend on the velocities (curved
// joints).
//
// Redundant rows make W singular. W + sigma diag(W) is not, and with q - sigma diag(W) lambda_last for q the
// rounds are those of the proximal point method [Rockafellar1976]: they converge to a solution of the problem
// itself, the one near the impulses that the step began with. sigma = 1e-8: the square root of the precision
// halves the digits between regularisation and rounding; in single precision 16 epsilon, since rounded rows
// can make W indefinite by that much.
//
// Cost: O(n^3) in the first step, after that rounds * n^2 plus one factorisation while the sets last.
// Known limits: hundreds of rows, not thousands; up to sqrt(2) times Coulomb's friction diagonal to the
// tangents. Where pivoting gives up or the rounds do not converge (strong friction in wedges has problems
// without solution on the pyramid), gaveUp() says so: the nearest round's impulses stand, improved by projected
// Gauss-Seidel sweeps if it was the pivoting.
#include <algorithm>
#include <cmath>

#include "engine/solvers/lcp/box_lcp.hpp"
#include "engine/solvers/lcp/direct_rounds.hpp"
#include "engine/solvers/matrix_space.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {
namespace {

template <class S>
class Dantzig final : public DirectRounds<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<Solver<S>> clone() const override { return std::make_unique<Dantzig>(*this); }

  private:
    using DirectRounds<S>::gaveUp_;
    using DirectRounds<S>::problem_;
    using DirectRounds<S>::x_;

    /// Regularisation that is at least the change of an eigenvalue by rounding of the rows.
    static constexpr double kSigma = std::max(1e-8, 16.0 * std::numeric_limits<Real>::epsilon());
    static constexpr int kPlainRounds = 15;
    static constexpr int kFallbackSweeps = 200;

    void begin(const SolverInput<S>& input) override {
        const std::size_t n = problem_.n;
        shift_.resize(n);
        q_.resize(n);
        x_.assign(n, 0.0);
        // Room for any number of free rows: a later step may have more of them.
        free_.reserve(n);
        right_.reserve(n);
        lu_.reset(n);
        for (std::size_t i = 0; i < n; ++i) shift_[i] = kSigma * problem_.at(i, i);
        limits_.resize(problem_.contacts.size());
        sticks_.assign(n, 1);
        lcp_.forget();  // a step depends on the state of the world alone
        for (std::size_t c = 0; c < limits_.size(); ++c) {
            const AssembledContact& contact = problem_.contacts[c];
            limits_[c] =
                static_cast<double>(input.constraints.rows[contact.normal].impulse) + contact.applied;
        }
    }
    void improve(const SolverInput<S>&, int round) override {
        for (std::size_t i = 0; i < problem_.n; ++i) q_[i] = problem_.q[i] - shift_[i] * problem_.lambda[i];
        setBounds();
        const bool solved = lcp_.solve(problem_.n, problem_.W.data(), shift_.data(), q_.data(),
                                       problem_.lower.data(), problem_.upper.data(), x_.data());
        if (!solved || !std::all_of(x_.begin(), x_.end(), [](double x) { return std::isfinite(x); })) sweep();
        // Single precision can make W indefinite, and then even sweeps may diverge: better no change.
        if (!std::all_of(x_.begin(), x_.end(), [](double x) { return std::abs(x) < 1e30; }))
            x_.assign(problem_.lambda.begin(), problem_.lambda.end());
        nextLimits(round < kPlainRounds);
    }
    double coefficient(const AssembledContact& contact, std::size_t tangent) const {
        return sticks_[tangent] ? contact.muStatic : contact.mu;
    }
    /// Natural map of the friction pyramid for the current impulses, with the bounds of their own normal
    /// impulses.
    double residual() const override {
        double largest = 0;
        for (std::size_t i = 0; i < problem_.n; ++i) {
            if (problem_.kind[i] == RowKind::Tangent) continue;
            largest = std::max(largest, problem_.defect(i, problem_.lower[i], problem_.upper[i]));
        }
        for (const AssembledContact& contact : problem_.contacts)
            for (std::size_t t = contact.first; t < contact.first + contact.tangents; ++t) {
                const double limit =
                    coefficient(contact, t) * (problem_.lambda[contact.normal] + contact.applied);
                largest = std::max(largest, problem_.defect(t, -limit, limit));
            }
        return largest;
    }
    void setBounds() {
        for (std::size_t c = 0; c < limits_.size(); ++c) {
            const AssembledContact& contact = problem_.contacts[c];
            for (std::size_t t = contact.first; t < contact.first + contact.tangents; ++t) {
                problem_.upper[t] = coefficient(contact, t) * limits_[c];
                problem_.lower[t] = -problem_.upper[t];
            }
        }
    }

    /// Projected Gauss-Seidel from the current impulses, used if pivoting gave up.
    void sweep() {
        gaveUp_ = true;
        x_.assign(problem_.lambda.begin(), problem_.lambda.end());
        for (int k = 0; k < kFallbackSweeps; ++k)
            for (std::size_t i = 0; i < problem_.n; ++i) {
                if (!(problem_.at(i, i) > 0)) continue;  // no body can follow it
                x_[i] = problem_.relaxed(i, x_, problem_.lower[i], problem_.upper[i]);
            }
    }

    /// Bounds for the next round.
    void nextLimits(bool early) {
        bool slides = false;
        for (std::size_t c = 0; c < limits_.size(); ++c) {
            const AssembledContact& contact = problem_.contacts[c];
            for (std::size_t t = contact.first; t < contact.first + contact.tangents; ++t) {
                const bool inside = std::abs(x_[t]) < problem_.upper[t];
                sticks_[t] = inside || problem_.upper[t] == 0;
                slides = slides || !inside;
            }
        }
        const bool coupled = early && slides && lcp_.states().size() == problem_.n && solveCoupled();
        for (std::size_t c = 0; c < limits_.size(); ++c) {
            const AssembledContact& contact = problem_.contacts[c];
            const double now = x_[contact.normal] + contact.applied;
            if (coupled)
                limits_[c] = std::max(0.0, next_[c]) + contact.applied;
            else
                limits_[c] = early ? now : 0.5 * (limits_[c] + now);
        }
    }

    /// Sets next_ to the normal impulses if all rows keep their states and bounded friction is mu times its
    /// normal. The unknowns are the free rows.
    bool solveCoupled() {
        const std::vector<BoxState>& state = lcp_.states();
        const std::size_t n = problem_.n;
        place_.assign(n, n);
        free_.clear();
        for (std::size_t i = 0; i < n; ++i)
            if (state[i] == BoxState::Free) {
                place_[i] = free_.size();
                free_.push_back(i);
            }
        const std::size_t f = free_.size();
        double* M = lu_.reset(f);
        right_.assign(f, 0.0);
        for (std::size_t a = 0; a < f; ++a) {
            const std::size_t i = free_[a];
            for (std::size_t b = 0; b < f; ++b) M[a * f + b] = problem_.at(i, free_[b]);
            M[a * f + a] += shift_[i];
            right_[a] = -q_[i];
            for (std::size_t j = 0; j < n; ++j)
                if (state[j] != BoxState::Free && problem_.kind[j] != RowKind::Tangent)
                    right_[a] -= problem_.at(i, j) * x_[j];
        }
        for (const AssembledContact& contact : problem_.contacts)
            for (std::size_t t = contact.first; t < contact.first + contact.tangents; ++t) {
                if (state[t] == BoxState::Free) continue;
                const double mu = state[t] == BoxState::Upper ? contact.mu : -contact.mu;
                const std::size_t normal = place_[contact.normal];
                for (std::size_t a = 0; a < f; ++a) {
                    const double W = problem_.at(free_[a], t);
                    if (normal < n) M[a * f + normal] += mu * W;
                    right_[a] -= mu * W * contact.applied;
                }
            }
        if (!lu_.factor()) return false;
        lu_.solve(right_.data());
        next_.assign(limits_.size(), 0.0);
        for (std::size_t c = 0; c < limits_.size(); ++c) {
            const std::size_t normal = place_[problem_.contacts[c].normal];
            if (normal < n) next_[c] = right_[normal];
            if (!std::isfinite(next_[c])) return false;
        }
        return true;
    }

    BoxLcp lcp_;
    DenseLu lu_;
    std::vector<double> shift_, q_, limits_, next_, right_;
    std::vector<std::uint8_t> sticks_;  ///< flag of each row: 1 for tangents inside their bounds
    std::vector<std::size_t> place_, free_;
};

}  // namespace

SolverTraits makeDantzigTraits() {
    return {.friction = FrictionShape::Box, .direct = true, .stops = StopRule::Residual};
}

template <class S>
std::unique_ptr<Solver<S>> makeDantzig() {
    return std::make_unique<Dantzig<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeDantzig, Solver);
RIGOR_INSTANTIATE_ON_MATRIX(makeDantzig);

}  // namespace rigor::engine
