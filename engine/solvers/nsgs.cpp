// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Non-smooth Gauss-Seidel on Coulomb's exact cone [JeanMoreau1992], [Jean1999], iterated until the natural
// map of the whole problem (natural_map.hpp) is below a stated tolerance: the in-house reference for the
// contact law.
//
// With w = W r + b at one contact (r its impulse, b the velocity that all other impulses lead to, bias
// included), the law is  K* > (w + mu |w_t| n)  _|_  r < K = {|r_t| <= mu r_n}  after De Saxce's change of
// variable [DeSaxceFeng1998]. Each visit solves this 3x3 problem exactly (contact_alone.hpp). Joints get
// -K^-1 (w) as a block, bounded rows are clamped.
//
// One iteration is a symmetric sweep (forwards, backwards) of all blocks, a fixed-point map g(r). Plain
// iteration converges linearly and slowly for stacks; it is accelerated by Anderson's method of depth
// kDepth [WalkerNi2011]: the next iterate is the combination of the last g that minimises the combined g(r) -
// r (in the norm of energy), projected into the cones and bounds, and kept only if its natural map is not
// worse than that of g(r) itself (the safeguard; else the history is dropped). Deviation from the sources:
// they iterate without acceleration, with one sweep per iteration.
//
// Every kFinishEvery iterations, when the sweeps have sorted contacts into open, sticking and sliding,
// generalised Newton steps on all rows (contact_newton.hpp) try to finish, damped where they do not come
// nearer. Harsh piles (strong friction, a hundred times the mass on top) never get sorted that way: there an
// interior-point method on all rows (contact_interior.hpp) finds impulses near a solution, first from the
// middle of the cones, in later attempts from nearer and nearer to the sweeps' own; Newton steps finish
// again. The best impulses are kept throughout.
//
// The velocities come from incremental updates: rounding of a few thousand updates stays below 1e-13
// m/s. Cost: iterations * (2 sweeps + 2 passes + kDepth^2 ... rows); hundreds of iterations for tall stacks.
// A step of Newton's or the interior-point method costs 2/3 n^3. velocity_iterations, 0 for kIterations, is
// the most; below kFinishEvery there are sweeps alone. Known limits: no proof of convergence; where friction
// has several solutions the one found depends on the order of the rows, and some problems have none. If the
// iterations end first, gaveUp() says so and the best impulses stand. Measured on heaps of 30 boxes and balls
// (pipeline/tests/reference_test.cpp).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/solvers/assembled.hpp"
#include "engine/solvers/contact_alone.hpp"
#include "engine/solvers/contact_interior.hpp"
#include "engine/solvers/contact_newton.hpp"
#include "engine/solvers/natural_map.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::engine {

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
    SolverStyle<S> style() const override {
        SolverStyle<S> style;
        style.iterations = kIterations;
        return style;
    }

    void solve(const SolverInput<S>& input) override {
        prepare(input);
        applyWarmStart<S>(input);
        Real best = std::numeric_limits<Real>::infinity();
        int stalled = 0;
        gaveUp_ = true;
        for (int k = 0; k < input.iterations; ++k) {
            input.monitor.before(input.velocities);
            readImpulses(input.constraints, start_);
            const Real change = std::max(sweep(input, false), sweep(input, true));
            Real residual = measure(input);
            if (residual > input.residualTolerance) residual = accelerate(input, residual);
            if (k % kFinishEvery == kFinishEvery - 1 && residual > goal(input)) {
                residual = finish(input, residual);
                if (residual > goal(input)) residual = fromInside(input, residual);
            }
            input.monitor.after(input.velocities, change);
            if (residual <= goal(input)) {
                gaveUp_ = false;
                return;
            }
            stalled = residual < Real(0.5) * best ? 0 : stalled + 1;
            best = std::min(best, residual);
            if (stalled > kPatience) return;
        }
    }

  private:
    static constexpr int kIterations = 1000;   ///< where the world does not say
    static constexpr int kDepth = 10;          ///< of Anderson's history
    static constexpr int kFinishEvery = 25;    ///< iterations between attempts to finish
    static constexpr int kNewtonSteps = 30;    ///< at most, of one attempt
    static constexpr int kInteriorStarts = 6;  ///< different ones, of the interior-point method
    static constexpr Real kLost = Real(100);   ///< residual over the best from which there is no way back
    static constexpr int kPatience = 400;      ///< iterations without halving the residual
    static constexpr double kLeastDamping = 1e-10, kMostDamping = 1e-2;  ///< ContactNewton's sigma

    void prepare(const SolverInput<S>& input) {
        const ConstraintRows<S>& all = input.constraints;
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
        start_.resize(n), mapped_.resize(n), saved_.resize(n);
        for (auto& column : stepHistory_) column.resize(n);
        for (auto& column : mapHistory_) column.resize(n);
        kept_ = 0, next_ = 0, havePrevious_ = false;
        previousStep_.resize(n), previousMap_.resize(n);
        assembled_ = false;
        interiorStarts_ = 0;
        // What the impulses have to stop or to bring about.
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
        } else {
            Vec3<Real> r = Vec3<Real>::Zero(), w = Vec3<Real>::Zero();
            for (int i = 0; i < block.rows; ++i) r[i] = rows[i].impulse, w[i] = step[i];
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
    static Real measure(const SolverInput<S>& input) {
        input.monitor.before(input.velocities);
        return naturalMapResidual<S>(input.constraints, input.velocities);
    }
    /// What the precision can tell of velocities and impulses of this size.
    Real resolution(const SolverInput<S>& input) const {
        Real largest = 0;
        for (const Block<S>& block : input.constraints.blocks) {
            const Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
            for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
                const Row<S>& row = input.constraints.rows[i];
                const Real moving = std::abs(row.lin.dot(a.v)) + std::abs(row.lin.dot(b.v)) +
                                    std::abs(dotAng(row.angA, a.w)) + std::abs(dotAng(row.angB, b.w));
                const Real pushed = row.invK > 0 ? std::abs(row.impulse) / row.invK : Real(0);
                largest = std::max(largest, moving + pushed);
            }
        }
        // Impulses without bound, as contradictory rows have, are no excuse.
        constexpr Real eps = std::numeric_limits<Real>::epsilon();
        return std::min(Real(32) * eps * largest, std::sqrt(eps) * fastest_);
    }

    Real goal(const SolverInput<S>& input) const {
        return std::max(input.residualTolerance, resolution(input));
    }

    // --- Newton's finish ---------------------------------------------------------------------------------
    /// Newton steps from the impulses there are. The residual may rise on the way, while contacts change
    /// their case; the best impulses met are kept. Returns their residual.
    Real finish(const SolverInput<S>& input, Real residual) {
        if (!assembled_) problem_.assemble<S>(input.constraints, input.velocities.size());
        assembled_ = true;
        readImpulses(input.constraints, mapped_);
        Real best = residual;
        double damping = kLeastDamping;
        int astray = 0;
        for (int step = 0; step < kNewtonSteps && best > goal(input); ++step) {
            problem_.readVelocities<S>(input.constraints, input.velocities);
            Real reached = std::numeric_limits<Real>::infinity();
            if (newton_.step(problem_, damping, target_) && !runsAway()) reached = take(input, target_);
            if (reached < best) {
                best = reached, mapped_ = start_, astray = 0;
                damping = std::max(kLeastDamping, 1e-2 * damping);
            } else if (!(reached < kLost * best) || ++astray > 2) {
                setImpulses(input, mapped_);
                measure(input);
                damping *= 100, astray = 0;
                if (damping > kMostDamping) break;
            }
        }
        setImpulses(input, mapped_);
        // Anderson's history is of another path.
        kept_ = 0, next_ = 0, havePrevious_ = false;
        return measure(input);
    }
    /// The interior-point method, and Newton steps from where it ends. The impulses there are stay if they
    /// are better. Returns the residual.
    Real fromInside(const SolverInput<S>& input, Real residual) {
        if (interiorStarts_ == kInteriorStarts || !ContactInterior::fits(problem_)) return residual;
        const double shift = std::pow(10.0, -interiorStarts_++);
        readImpulses(input.constraints, saved_);
        problem_.readVelocities<S>(input.constraints, input.velocities);
        if (!interior_.solve(problem_, shift, target_)) return residual;
        const Real reached = finish(input, take(input, target_));
        if (reached < residual) return reached;
        setImpulses(input, saved_);
        return measure(input);
    }
    /// Sets impulses, brought back into cones and bounds; returns their residual.
    Real take(const SolverInput<S>& input, const std::vector<double>& impulses) {
        for (std::size_t i = 0; i < start_.size(); ++i) start_[i] = static_cast<Real>(impulses[i]);
        project(input.constraints, start_);
        setImpulses(input, start_);
        return measure(input);
    }
    /// Impulses far beyond those there are: a singular system, whose rounding the velocities would keep.
    bool runsAway() const {
        double now = 0, then = 0;
        for (std::size_t i = 0; i < problem_.n; ++i) {
            const double K = problem_.at(i, i);
            now = std::max(now, K * std::abs(problem_.lambda[i]) + std::abs(problem_.q[i]));
            then = std::max(then, K * std::abs(target_[i]));
        }
        return !(then < 1e3 * now);
    }

    // --- Anderson's acceleration -------------------------------------------------------------------------
    static void readImpulses(const ConstraintRows<S>& all, std::vector<Real>& out) {
        for (std::size_t i = 0; i < all.rows.size(); ++i) out[i] = all.rows[i].impulse;
    }
    /// Sets impulses, and velocities with them.
    static void setImpulses(const SolverInput<S>& input, const std::vector<Real>& impulses) {
        for (const Block<S>& block : input.constraints.blocks)
            for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
                Row<S>& row = input.constraints.rows[i];
                applyRowImpulse<S>(row, block, impulses[i] - row.impulse, input.velocities[block.a],
                                   input.velocities[block.b]);
                row.impulse = impulses[i];
            }
    }
    static void project(const ConstraintRows<S>& all, std::vector<Real>& impulses) {
        for (const Block<S>& block : all.blocks) {
            Real* r = impulses.data() + block.first;
            if (block.kind == BlockKind::Bounded) {
                r[0] = std::clamp(r[0], all.rows[block.first].lower, all.rows[block.first].upper);
            } else if (block.kind == BlockKind::Contact) {
                Vec3<Real> whole = Vec3<Real>::Zero();
                for (int i = 0; i < block.rows; ++i) whole[i] = r[i];
                const Real mu = std::max(block.friction, block.staticFriction);
                if (block.rows > 1) whole[0] += block.appliedNormal;
                whole = block.rows > 1 ? projectOnCone<Real>(whole, mu)
                                       : Vec3<Real>(std::max(Real(0), whole[0]), Real(0), Real(0));
                if (block.rows > 1) whole[0] = std::max(Real(0), whole[0] - block.appliedNormal);
                for (int i = 0; i < block.rows; ++i) r[i] = whole[i];
            }
        }
    }

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
        previousStep_ = start_, previousMap_ = mapped_;
        havePrevious_ = true;
        if (kept_ == 0) return residual;
        extrapolate(all);
        project(all, start_);
        setImpulses(input, start_);
        const Real extrapolated = measure(input);
        if (extrapolated <= residual) return extrapolated;
        setImpulses(input, mapped_);
        kept_ = 0, next_ = 0, havePrevious_ = false;
        return measure(input);
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
                const double f = weight * static_cast<double>(stepHistory_[static_cast<std::size_t>(p)][i]);
                y[p] += f * static_cast<double>(start_[i]);
                for (int q = 0; q <= p; ++q)
                    A(p, q) += f * static_cast<double>(stepHistory_[static_cast<std::size_t>(q)][i]);
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
            for (int p = 0; p < m; ++p)
                value -= gamma[p] * static_cast<double>(mapHistory_[static_cast<std::size_t>(p)][i]);
            start_[i] = static_cast<Real>(value);
        }
    }

    static constexpr double kShift = 1e-12;  ///< of a Gram matrix with unit diagonal

    bool gaveUp_ = false;
    std::vector<Mat3<Real>> local_;  ///< W by block; of contacts
    std::vector<Real> start_, mapped_, saved_, previousStep_, previousMap_;
    std::array<std::vector<Real>, kDepth> stepHistory_, mapHistory_;
    AssembledProblem problem_;
    ContactNewton newton_;
    ContactInterior interior_;
    int interiorStarts_ = 0;  ///< of this solve, so far
    std::vector<double> target_;
    bool assembled_ = false;
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

}  // namespace rigor::engine
