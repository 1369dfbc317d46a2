// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Direct solver: contacts with polyhedral friction as one linear complementarity problem
// [StewartTrinkle1996], [AnitescuPotra1997], solved by Lemke's method (lemke_lcp.hpp). Each contact has,
// besides its normal impulse lambda_n, one impulse beta_k >= 0 for each of D directions d_k spread evenly
// over the tangent plane, and the slack s (the speed of slip):
//     0 <= lambda_n  _|_  w_n >= 0
//     0 <= beta_k    _|_  d_k . w_t + s >= 0                    maximal dissipation among the directions
//     0 <= s         _|_  mu lambda_n - sum_k beta_k >= 0       the pyramid
// D = 4 is the pyramid over the two tangents (inscribed in Coulomb's cone: at most his friction, between the
// directions as little as 1/sqrt 2 of it), D = 2 the line of the slip that there would be without impulses,
// larger even D approach the cone. In 2D D is 2 and exact. Rolling friction has the same form with D moments
// about directions of the tangent plane, slack rho lambda_n - sum_k beta_k and the relative angular velocity
// in place of the slip; torsional friction has two, about the normal, and is exact.
//
// Rows without bounds (joints, springs) are eliminated first, lambda_F = -W_FF^-1 (q_F + W_FC lambda_C), by
// Cholesky on W_FF + sigma diag(W_FF); rounds of the proximal point method, as in dantzig.cpp, remove sigma
// again and renew biases that depend on the velocities. The other rows get the same, larger, where pivoting
// fails without it, as it may where W is indefinite by rounding. A row with bounds becomes x = lambda - lower
// >= 0 (or upper - lambda), and with both the multiplier y: w + y _|_ x, 0 <= y _|_ upper - lower - x >= 0.
// Static friction has no linear complementarity form: contacts start with it, and those that slip
// (s > 0) are solved again with that of sliding.
//
// Cost: O(N^3), N = (D + 2) per contact, in every step: pivoting knows no warm start.
// Known limits: a hundred contacts, not more. Where the method ends in a ray or rounding ruins its solution,
// gaveUp() says so, and the last impulses are improved by projected Gauss-Seidel sweeps over normals,
// bounds and (as a box) friction; what came nearest stands (direct_rounds.hpp).
#include <algorithm>
#include <cmath>

#include "engine/math/portable.hpp"
#include "engine/math/rotation.hpp"
#include "engine/solvers/lcp/direct_rounds.hpp"
#include "engine/solvers/lcp/lemke_lcp.hpp"
#include "engine/solvers/matrix_space.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {
namespace {

/// A variable z of the complementarity problem: up to two rows' impulses are made of it.
struct Variable {
    enum class Kind : std::uint8_t { Impulse, UpperMultiplier, Slip } kind = Kind::Impulse;
    std::size_t row[2] = {0, 0};
    double coefficient[2] = {0, 0};  ///< lambda_row += coefficient z
    std::size_t of = 0;              ///< UpperMultiplier: its variable; Slip: its AssembledContact
    double scale = 1;                ///< scale of the impulse
};

template <class S>
class Lemke final : public DirectRounds<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<Solver<S>> clone() const override { return std::make_unique<Lemke>(*this); }

  private:
    using DirectRounds<S>::gaveUp_;
    using DirectRounds<S>::problem_;
    using DirectRounds<S>::x_;

    static constexpr double kSigma = 1e-8;  ///< regularisation of joints; the square root of the precision
    static constexpr double kSoft = 1e-6;   ///< regularisation of the other rows if pivoting needs it
    enum class Softened : std::uint8_t { No, JustNow, Yes };
    static constexpr int kFallbackSweeps = 200;

    bool pivot(const SolverInput<S>& input) {
        makeVariables(input);
        makeMatrix();
        z_.resize(variables_.size());
        return lcp_.solve(variables_.size(), M_.data(), constant_.data(), z_.data()) ==
               LemkeLcp::Outcome::Solved;
    }
    /// Makes the matrix of the complementarity problem definite; the rounds undo it. False if it is already.
    bool soften() {
        if (softened_ != Softened::No) return false;
        softened_ = Softened::JustNow;
        for (std::size_t i = 0; i < problem_.n; ++i)
            if (problem_.kind[i] != RowKind::Free) {
                shift_[i] = kSoft * problem_.at(i, i);
                R_[i * problem_.n + i] += shift_[i];
            }
        return true;
    }

    bool isHopeless() const override { return gaveUp_; }
    void improve(const SolverInput<S>& input, int) override {
        if (!pivot(input) && !soften()) gaveUp_ = true;
        if (softened_ == Softened::JustNow) {
            softened_ = Softened::Yes;
            if (!pivot(input)) gaveUp_ = true;
        }
        readImpulses();
        if (gaveUp_) sweep();
    }

    void begin(const SolverInput<S>&) override {
        const std::size_t n = problem_.n;
        x_.resize(n);
        q_.resize(n);
        shift_.assign(n, 0.0);
        reduced_.resize(n);
        free_.reset(n);
        for (std::size_t i = 0; i < n; ++i)
            if (problem_.kind[i] == RowKind::Free) {
                shift_[i] = kSigma * problem_.at(i, i);
                free_.append(problem_.W.data(), n, shift_.data(), i);
            }
        makeSchur();
        slips_.assign(problem_.contacts.size(), 0);
        softened_ = Softened::No;
        // The rounding of J and M^-1 in single precision gives W negative eigenvalues of that size.
        if (sizeof(Real) < sizeof(double)) {
            soften();
            softened_ = Softened::Yes;
        }
    }
    /// Schur complement of the free rows: R = W_CC - W_CF A_FF^-1 W_FC. response_ holds A_FF^-1 W_FC.
    void makeSchur() {
        const std::size_t n = problem_.n, f = free_.size();
        R_ = problem_.W;
        response_.resize(f * n);
        column_.resize(std::max<std::size_t>(f, 1));
        if (f == 0) return;
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t k = 0; k < f; ++k) column_[k] = problem_.at(free_.member(k), j);
            free_.solve(column_.data());
            for (std::size_t k = 0; k < f; ++k) response_[k * n + j] = column_[k];
        }
        for (std::size_t i = 0; i < n; ++i) {
            if (problem_.kind[i] == RowKind::Free) continue;
            for (std::size_t k = 0; k < f; ++k) {
                const double W = problem_.at(i, free_.member(k));
                if (W == 0) continue;
                for (std::size_t j = 0; j < n; ++j) R_[i * n + j] -= W * response_[k * n + j];
            }
        }
    }

    // --- the complementarity problem ---------------------------------------------------------------------
    void makeVariables(const SolverInput<S>& input) {
        const std::size_t n = problem_.n;
        variables_.clear();
        offset_.assign(n, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            if (problem_.kind[i] != RowKind::Bounded) continue;
            const bool below = std::isfinite(problem_.lower[i]);
            offset_[i] = below ? problem_.lower[i] : problem_.upper[i];
            const double scale = 1 / std::sqrt(problem_.at(i, i));
            Variable x;
            x.row[0] = i;
            x.coefficient[0] = below ? scale : -scale;
            x.scale = scale;
            variables_.push_back(x);
            if (!below || !std::isfinite(problem_.upper[i])) continue;
            Variable y;
            y.kind = Variable::Kind::UpperMultiplier;
            y.of = variables_.size() - 1;
            y.scale = scale;
            variables_.push_back(y);
        }
        reduceConstant();
        normalOf_.resize(n);
        directionsOf_.resize(problem_.contacts.size());
        for (std::size_t c = 0; c < problem_.contacts.size(); ++c) addContact(input, c);
    }
    /// reduced_ = q of the problem without free rows, at the offsets.
    void reduceConstant() {
        const std::size_t n = problem_.n, f = free_.size();
        for (std::size_t k = 0; k < f; ++k) {
            const std::size_t i = free_.member(k);
            column_[k] = q_[i] = problem_.q[i] - shift_[i] * problem_.lambda[i];
        }
        if (f > 0) free_.solve(column_.data());
        for (std::size_t i = 0; i < n; ++i) {
            reduced_[i] = problem_.q[i] - shift_[i] * problem_.lambda[i];
            for (std::size_t k = 0; k < f; ++k) reduced_[i] -= problem_.at(i, free_.member(k)) * column_[k];
            for (std::size_t j = 0; j < n; ++j)
                if (offset_[j] != 0) reduced_[i] += R_[i * n + j] * offset_[j];
        }
    }
    /// Row whose mobility is the unit of the impulses of a contact's friction: the normal; of moments the first of them.
    static std::size_t unitRow(const AssembledContact& contact) {
        return contact.moment ? contact.first : contact.normal;
    }
    void addContact(const SolverInput<S>& input, std::size_t c) {
        const AssembledContact& contact = problem_.contacts[c];
        const std::size_t first = contact.first;
        const double scale = 1 / std::sqrt(problem_.at(unitRow(contact), unitRow(contact)));
        if (!contact.moment) {
            Variable v;
            v.scale = scale;
            v.row[0] = contact.normal;
            v.coefficient[0] = scale;
            normalOf_[contact.normal] = variables_.size();
            variables_.push_back(v);
        }
        directionsOf_[c] = variables_.size();
        if (contact.tangents == 0) return;
        const int directions = contact.tangents == 1 ? 2 : input.pyramidDirections;
        double start = 0;
        if (contact.tangents == 2 && directions == 2)
            start = portable::atan2(problem_.q[first + 1], problem_.q[first]);
        for (int k = 0; k < directions; ++k) {
            const Rot2<double> direction = expMap(start + 6.283185307179586 * k / directions);
            Variable beta;
            beta.scale = scale;
            beta.row[0] = first;
            beta.coefficient[0] = scale * direction.c;
            if (contact.tangents == 2) {
                beta.row[1] = first + 1;
                beta.coefficient[1] = scale * direction.s;
            }
            variables_.push_back(beta);
        }
        Variable slip;
        slip.kind = Variable::Kind::Slip;
        slip.of = c;
        slip.scale = scale;
        variables_.push_back(slip);
    }
    void makeMatrix() {
        const std::size_t N = variables_.size(), n = problem_.n;
        M_.assign(N * N, 0.0);
        constant_.assign(N, 0.0);
        for (std::size_t a = 0; a < N; ++a) {
            const Variable& x = variables_[a];
            if (x.kind == Variable::Kind::UpperMultiplier) {
                const std::size_t row = variables_[x.of].row[0];
                M_[a * N + x.of] = -1;
                M_[x.of * N + a] = 1;
                constant_[a] = (problem_.upper[row] - problem_.lower[row]) / x.scale;
            } else if (x.kind == Variable::Kind::Slip) {
                const AssembledContact& contact = problem_.contacts[x.of];
                const double mu = slips_[x.of] ? contact.mu : contact.muStatic;
                const std::size_t normal = normalOf_[contact.normal];
                M_[a * N + normal] = contact.moment ? mu * variables_[normal].scale / x.scale : mu;
                constant_[a] = mu * contact.applied / x.scale;
                for (std::size_t b = directionsOf_[x.of]; b < a; ++b) {
                    M_[a * N + b] = -1;
                    M_[b * N + a] = 1;
                }
            } else {
                for (int p = 0; p < 2; ++p) {
                    if (x.coefficient[p] == 0) continue;
                    constant_[a] += x.coefficient[p] * reduced_[x.row[p]];
                    for (std::size_t b = 0; b < N; ++b) {
                        const Variable& y = variables_[b];
                        if (y.kind != Variable::Kind::Impulse) continue;
                        for (int r = 0; r < 2; ++r)
                            M_[a * N + b] +=
                                x.coefficient[p] * y.coefficient[r] * R_[x.row[p] * n + y.row[r]];
                    }
                }
            }
        }
    }
    void readImpulses() {
        const std::size_t n = problem_.n, f = free_.size();
        for (std::size_t i = 0; i < n; ++i) x_[i] = offset_[i];
        for (std::size_t a = 0; a < variables_.size(); ++a) {
            const Variable& v = variables_[a];
            for (int p = 0; p < 2; ++p)
                if (v.coefficient[p] != 0) x_[v.row[p]] += v.coefficient[p] * z_[a];
            // Once it slips it slides.
            if (v.kind == Variable::Kind::Slip && z_[a] > 0) slips_[v.of] = 1;
        }
        for (std::size_t k = 0; k < f; ++k) {
            double lambda = -column_[k];
            for (std::size_t j = 0; j < n; ++j)
                if (problem_.kind[j] != RowKind::Free) lambda -= response_[k * n + j] * x_[j];
            x_[free_.member(k)] = lambda;
        }
    }

    // --- how good it is ----------------------------------------------------------------------------------
    /// Natural map of the linear complementarity problem at the impulses there are: w = |min(w, z)| of
    /// all rows but friction, whose slack and directions are checked through the impulses they make.
    double residual() const override {
        double largest = 0;
        for (std::size_t i = 0; i < problem_.n; ++i) {
            if (problem_.kind[i] == RowKind::Tangent) continue;
            largest = std::max(largest, problem_.defect(i, problem_.lower[i], problem_.upper[i]));
        }
        for (std::size_t c = 0; c < problem_.contacts.size(); ++c)
            if (problem_.contacts[c].tangents > 0) largest = std::max(largest, frictionResidual(c));
        return largest;
    }
    /// Residual of the friction pyramid. With s the least value that makes all d_k . w_t + s >= 0: beta_k
    /// (d_k . w_t + s) and s times the slack of the pyramid, as velocities.
    double frictionResidual(std::size_t c) const {
        const AssembledContact& contact = problem_.contacts[c];
        const std::size_t first = directionsOf_[c];
        double w[2] = {problem_.velocity(contact.first, problem_.lambda), 0};
        if (contact.tangents == 2) w[1] = problem_.velocity(contact.first + 1, problem_.lambda);
        double slip = 0, sum = 0, largest = 0;
        const auto along = [&](std::size_t a) {
            const Variable& v = variables_[a];
            return (v.coefficient[0] * w[0] + v.coefficient[1] * w[1]) / v.scale;
        };
        std::size_t end = first;
        for (; variables_[end].kind == Variable::Kind::Impulse; ++end) {
            slip = std::max(slip, -along(end));
            sum += variables_[end].scale * z_[end];
        }
        const double K = problem_.at(unitRow(contact), unitRow(contact));
        const double pressed = problem_.lambda[contact.normal] + contact.applied;
        for (std::size_t a = first; a < end; ++a)
            largest = std::max(largest, std::min(along(a) + slip, K * variables_[a].scale * z_[a]));
        const double mu = slips_[c] ? contact.mu : contact.muStatic;
        const double slack = mu * pressed - sum;
        largest = std::max(largest, slack < 0 ? -K * slack : std::min(slip, K * slack));
        // Slips, yet it was solved with the coefficient of sticking.
        if (!slips_[c] && contact.muStatic > contact.mu && slack <= 0) largest = std::max(largest, slip);
        return largest;
    }
    /// Projected Gauss-Seidel from the last iterate, used if pivoting gave up.
    void sweep() {
        for (int k = 0; k < kFallbackSweeps; ++k) {
            for (std::size_t i = 0; i < problem_.n; ++i)
                if (problem_.kind[i] != RowKind::Tangent)
                    x_[i] = problem_.relaxed(i, x_, problem_.lower[i], problem_.upper[i]);
            for (const AssembledContact& contact : problem_.contacts)
                for (std::size_t t = contact.first; t < contact.first + contact.tangents; ++t) {
                    const double limit = contact.mu * (x_[contact.normal] + contact.applied);
                    x_[t] = problem_.relaxed(t, x_, -limit, limit);
                }
        }
    }

    Softened softened_ = Softened::No;
    LemkeLcp lcp_;
    GrowingCholesky free_;  ///< W of the rows without bounds
    std::vector<double> shift_, q_, R_, response_, column_, reduced_, offset_, M_, constant_, z_;
    std::vector<Variable> variables_;
    std::vector<std::size_t> normalOf_;      ///< variable of each normal row
    std::vector<std::size_t> directionsOf_;  ///< first of the directions of each AssembledContact
    std::vector<std::uint8_t> slips_;
};

}  // namespace

SolverTraits makeLemkeTraits() {
    return {.friction = FrictionShape::Polygon, .direct = true, .stops = StopRule::Residual};
}

template <class S>
std::unique_ptr<Solver<S>> makeLemke() {
    return std::make_unique<Lemke<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeLemke, Solver);
RIGOR_INSTANTIATE_ON_MATRIX(makeLemke);

}  // namespace rigor::engine
