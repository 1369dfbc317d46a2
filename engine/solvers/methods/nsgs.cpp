// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Non-smooth Gauss-Seidel on Coulomb's exact cone [JeanMoreau1992], [Jean1999], iterated until the natural
// map of the whole problem (natural_map.hpp) is below a stated tolerance: the in-house reference for the
// contact law.
//
// With w = W r + b at one contact (r its impulse, b the velocity that all other impulses lead to, bias
// included), the law is  K* > (w + mu |w_t| n)  _|_  r < K = {|r_t| <= mu r_n}  after De Saxce's change of
// variable [DeSaxceFeng1998]. Each update solves this 3x3 problem exactly (contact_alone.hpp). Joints get
// -K^-1 (w) as a block, bounded rows are clamped; rolling and torsional friction has the disc that its contact's
// r_n bounds [AcaryBourrier2021].
//
// One iteration is a symmetric sweep (backwards, forwards) of all blocks, a fixed-point map g(r). Plain
// iteration converges linearly and slowly for stacks; it is accelerated by Anderson's method of depth
// kDepth [WalkerNi2011]: the next iterate is the combination of the last g that minimises the combined g(r) -
// r (in the norm of energy), projected into the cones and bounds, and kept only if its natural map is not
// worse than that of g(r) itself (the safeguard; else the history is dropped). Deviation from the sources:
// they iterate without acceleration, with one sweep per iteration.
//
// Every kFinishEvery iterations, when the sweeps have sorted contacts into open, sticking and sliding,
// Newton's method on all rows (newton_finish.hpp) tries to finish. Harsh piles (strong friction, a hundred
// times the mass on top) never get sorted that way: there an interior-point method on all rows
// (contact_interior.hpp) finds impulses near a solution, first from the middle of the cones, in later
// attempts from nearer and nearer to the sweeps' own; Newton steps finish again. The best impulses are kept
// throughout.
//
// The velocities come from incremental updates: rounding of a few thousand updates stays below 1e-13 m/s.
// Cost: iterations * (2 sweeps + 2 passes + kDepth^2 ... rows); hundreds of iterations for tall stacks. A
// step of Newton's or the interior-point method costs 2/3 n^3. velocity_iterations, 0 for 1000, is the most;
// below kFinishEvery there are sweeps alone. Known limits: no proof of convergence; where friction has
// several solutions the one found depends on the order of the rows, and some problems have none. If the
// iterations end first, gaveUp() says so and the best impulses are kept. Measured on heaps of 30 boxes and
// spheres (pipeline/tests/reference_test.cpp).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/solvers/impulses.hpp"
#include "engine/solvers/joints/joint_inverses.hpp"
#include "engine/solvers/matrix_space.hpp"
#include "engine/solvers/methods/contact_alone.hpp"
#include "engine/solvers/methods/newton_finish.hpp"
#include "engine/solvers/sequential_impulses.hpp"
#include "engine/solvers/solver.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {

SolverTraits makeNsgsTraits() {
    return {.iterations = 1000, .friction = FrictionShape::Cone, .stops = StopRule::Residual};
}

namespace {

template <class R>
using Vec3 = Eigen::Matrix<R, 3, 1>;
template <class R>
using Mat3 = Eigen::Matrix<R, 3, 3>;

template <class S>
class Nsgs final : public Solver<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<Solver<S>> clone() const override { return std::make_unique<Nsgs>(*this); }
    bool gaveUp() const override { return gaveUp_; }
    SolverStyle<S> style() const override { return styleOf<S>(makeNsgsTraits()); }

    void solve(const SolverInput<S>& input) override {
        prepare(input);
        applyWarmStart<S>(input);
        Real best = std::numeric_limits<Real>::infinity();
        int stalled = 0;
        gaveUp_ = true;
        for (int k = 0; k < input.iterations; ++k) {
            input.monitor.before(input.velocities);
            readImpulses(input.constraints, start_);
            const Real backwards = sweep(input, true);
            const Real change = std::max(backwards, sweep(input, false));
            Real residual = renewedResidual(input);
            if (residual > input.residualTolerance) residual = accelerate(input, residual);
            if (k % kFinishEvery == kFinishEvery - 1 && residual > goal(input))
                residual = finish(input, residual);
            input.monitor.after(input.velocities, change);
            if (residual <= goal(input)) {
                gaveUp_ = false;
                return;
            }
            stalled = residual < Real(0.5) * best ? 0 : stalled + 1;
            best = std::min(best, residual);
            if (stalled > kMaxStalled) return;
        }
    }

  private:
    static constexpr int kDepth = 10;        ///< length of Anderson's history
    static constexpr int kFinishEvery = 25;  ///< iterations between attempts to finish
    static constexpr int kMaxStalled = 400;  ///< iterations without halving the residual

    void prepare(const SolverInput<S>& input) {
        const ConstraintRows<S>& all = input.constraints;
        if constexpr (!OnMatrix<S>) invertJoints<S>(input.constraints);
        local_.resize(all.blocks.size());
        for (std::size_t k = 0; k < all.blocks.size(); ++k) {
            const Block<S>& block = all.blocks[k];
            if (block.kind != BlockKind::Contact) continue;
            local_[k].setIdentity();
            const Row<S>* rows = all.rows.data() + block.first;
            for (int i = 0; i < block.rows; ++i)
                for (int j = 0; j < block.rows; ++j)
                    local_[k](i, j) =
                        rowCoupling<S>(rows[i], rows[j], block) + (i == j ? rows[i].softness : Real(0));
        }
        const std::size_t n = all.rows.size();
        for (auto& column : stepHistory_) column.resize(n);
        for (auto& column : mapHistory_) column.resize(n);
        kept_ = 0;
        next_ = 0;
        havePrevious_ = false;
        previousStep_.resize(n);
        previousMap_.resize(n);
        finish_.forget();
        // Largest velocity that the impulses have to stop or to bring about.
        fastest_ = 0;
        for (const Block<S>& block : all.blocks)
            for (std::uint32_t i = block.first; i < block.first + block.rows; ++i)
                fastest_ = std::max(fastest_, std::abs(rowVelocity<S>(all.rows[i], input.velocities[block.a],
                                                                      input.velocities[block.b])) +
                                                  std::abs(all.rows[i].bias));
    }

    // --- one sweep ---------------------------------------------------------------------------------------
    Real sweep(const SolverInput<S>& input, bool backwards) const {
        Real change = 0;
        const std::size_t n = input.constraints.blocks.size();
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t k = backwards ? n - 1 - i : i;
            change = std::max(change, solveBlock(input, k));
        }
        return change;
    }

    /// Returns the largest change of a row's velocity that its own impulse makes.
    Real solveBlock(const SolverInput<S>& input, std::size_t k) const {
        const Block<S>& block = input.constraints.blocks[k];
        Row<S>* rows = input.constraints.rows.data() + block.first;
        Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
        BlockVector<S> step(block.rows);
        for (int i = 0; i < block.rows; ++i)
            step[i] = rowVelocity<S>(rows[i], a, b) + rows[i].bias + rows[i].softness * rows[i].impulse;
        if (block.kind == BlockKind::Joint) {
            step = (-(input.constraints.matrices[block.matrix] * step)).eval();
        } else if (block.kind == BlockKind::Bounded) {
            const Real old = rows[0].impulse;
            step[0] = std::clamp(old - rows[0].invK * step[0], rows[0].lower, rows[0].upper) - old;
        } else if (block.kind == BlockKind::Moment) {
            return solveMoment<S>(input, block, a, b);
        } else {
            Vec3<Real> r = Vec3<Real>::Zero(), w = Vec3<Real>::Zero();
            for (int i = 0; i < block.rows; ++i) {
                r[i] = rows[i].impulse;
                w[i] = step[i];
            }
            const Vec3<Real> free = w - local_[k] * r;
            const Vec3<Real> next =
                block.rows > 1 ? solveContactAlone<Real>(local_[k], free, block.friction,
                                                         std::max(block.friction, block.staticFriction),
                                                         block.appliedNormal)
                               : solveContactAlone<Real>(local_[k], free, Real(0), Real(0), Real(0));
            for (int i = 0; i < block.rows; ++i) step[i] = next[i] - r[i];
        }
        Real change = 0;
        for (int i = 0; i < block.rows; ++i) {
            rows[i].impulse += step[i];
            applyRowImpulse<S>(rows[i], block, step[i], a, b);
            if (rows[i].invK > 0) change = std::max(change, std::abs(step[i]) / rows[i].invK);
        }
        return change;
    }

    // --- residual ----------------------------------------------------------------------------------------
    Real goal(const SolverInput<S>& input) const {
        // Impulses without bound, as contradictory rows have, are no excuse.
        const Real resolved = std::min(velocityResolution<S>(input.constraints, input.velocities),
                                       std::sqrt(std::numeric_limits<Real>::epsilon()) * fastest_);
        return std::max(input.residualTolerance, resolved);
    }

    /// Newton's method, and the interior-point method where that does not get there. Returns the residual.
    Real finish(const SolverInput<S>& input, Real residual) {
        const Real enough = goal(input);
        Real reached = finish_.attempt(input, residual, enough);
        if (reached > enough) reached = finish_.attemptFromInside(input, reached, enough);
        // Anderson's history is of another path.
        kept_ = 0;
        next_ = 0;
        havePrevious_ = false;
        return reached;
    }

    // --- Anderson's acceleration -------------------------------------------------------------------------
    /// Takes the iterate g(start_), whose residual is given, to the better of itself and the extrapolation.
    /// Returns the residual of what it left.
    Real accelerate(const SolverInput<S>& input, Real residual) {
        ConstraintRows<S>& all = input.constraints;
        const std::size_t n = all.rows.size();
        readImpulses(all, mapped_);
        for (std::size_t i = 0; i < n; ++i) start_[i] = mapped_[i] - start_[i];  // the step f = g(r) - r
        if (havePrevious_) {
            for (std::size_t i = 0; i < n; ++i) {
                stepHistory_[next_][i] = start_[i] - previousStep_[i];
                mapHistory_[next_][i] = mapped_[i] - previousMap_[i];
            }
            next_ = (next_ + 1) % kDepth;
            kept_ = std::min<std::size_t>(kept_ + 1, kDepth);
        }
        previousStep_ = start_;
        previousMap_ = mapped_;
        havePrevious_ = true;
        if (kept_ == 0) return residual;
        extrapolate(all);
        projectImpulses(all, start_);
        setImpulses(input, start_);
        const Real extrapolated = renewedResidual(input);
        if (extrapolated <= residual) return extrapolated;
        setImpulses(input, mapped_);
        kept_ = 0;
        next_ = 0;
        havePrevious_ = false;
        return renewedResidual(input);
    }

    /// start_ = g - sum gamma_j dg_j, with gamma minimising |f - sum gamma_j df_j| in the norm weighted by K
    /// (velocity times impulse). The normal equations are shifted by rounding.
    void extrapolate(const ConstraintRows<S>& all) {
        using Gram = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kDepth, kDepth>;
        using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kDepth, 1>;
        const int m = static_cast<int>(kept_);
        Gram A = Gram::Zero(m, m);
        Column y = Column::Zero(m);
        for (std::size_t i = 0; i < all.rows.size(); ++i) {
            const double weight = all.rows[i].invK > 0 ? 1.0 / static_cast<double>(all.rows[i].invK) : 0.0;
            for (int p = 0; p < m; ++p) {
                const double f = weight * static_cast<double>(stepHistory_[p][i]);
                y[p] += f * static_cast<double>(start_[i]);
                for (int q = 0; q <= p; ++q) A(p, q) += f * static_cast<double>(stepHistory_[q][i]);
            }
        }
        // Scaled to unit diagonal, so that the shift means the same for old and new columns.
        Column scale(m);
        for (int p = 0; p < m; ++p) scale[p] = A(p, p) > 0 ? 1.0 / std::sqrt(A(p, p)) : 0.0;
        for (int p = 0; p < m; ++p)
            for (int q = 0; q <= p; ++q) A(p, q) *= scale[p] * scale[q];
        Column gamma = y.cwiseProduct(scale);
        for (int p = 0; p < m; ++p) {  // Cholesky, in place
            A(p, p) += kShift;
            for (int q = 0; q <= p; ++q) {
                double sum = A(p, q);
                for (int r = 0; r < q; ++r) sum -= A(p, r) * A(q, r);
                A(p, q) = q < p ? sum / A(q, q) : std::sqrt(std::max(sum, kShift));
            }
        }
        for (int p = 0; p < m; ++p) {
            for (int q = 0; q < p; ++q) gamma[p] -= A(p, q) * gamma[q];
            gamma[p] /= A(p, p);
        }
        for (int p = m - 1; p >= 0; --p) {
            for (int q = p + 1; q < m; ++q) gamma[p] -= A(q, p) * gamma[q];
            gamma[p] /= A(p, p);
        }
        gamma = gamma.cwiseProduct(scale).eval();
        for (std::size_t i = 0; i < all.rows.size(); ++i) {
            double value = static_cast<double>(mapped_[i]);
            for (int p = 0; p < m; ++p) value -= gamma[p] * static_cast<double>(mapHistory_[p][i]);
            start_[i] = static_cast<Real>(value);
        }
    }

    static constexpr double kShift = 1e-12;  ///< shift of a Gram matrix with unit diagonal

    bool gaveUp_ = false;
    std::vector<Mat3<Real>> local_;  ///< W by block; of contacts
    std::vector<Real> start_, mapped_, previousStep_, previousMap_;
    std::array<std::vector<Real>, kDepth> stepHistory_, mapHistory_;
    NewtonFinish<S> finish_;
    Real fastest_ = 0;
    std::size_t kept_ = 0, next_ = 0;
    bool havePrevious_ = false;
};

}  // namespace

template <class S>
std::unique_ptr<Solver<S>> makeNsgs() {
    return std::make_unique<Nsgs<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeNsgs, Solver);
RIGOR_INSTANTIATE_ON_MATRIX(makeNsgs);

}  // namespace rigor::engine
