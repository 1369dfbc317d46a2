// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/ccd/impact.hpp"

#include <cmath>
#include <limits>

#include "engine/contacts/contact.hpp"
#include "engine/contacts/moment_rows.hpp"

namespace rigor::engine {
namespace {

template <class S>
class UntilConverged final : public IterationMonitor<S> {
  public:
    using Real = typename S::Real;
    explicit UntilConverged(Real tolerance) : tolerance_(tolerance) {}
    void before(std::span<const Velocity<S>>) override {}
    bool after(std::span<const Velocity<S>>, Real change) override { return change <= tolerance_; }

  private:
    Real tolerance_;
};

template <class R, int N>
auto tangentsOf(const Eigen::Matrix<R, N, 1>& n) {
    using Vec = Eigen::Matrix<R, N, 1>;
    if constexpr (N == 2) {
        return std::array<Vec, 1>{Vec(-n.y(), n.x())};
    } else {
        const Vec axis = std::abs(n.x()) < R(0.7) ? Vec::Unit(0) : Vec::Unit(1);
        const Vec t = axis.cross(n).normalized();
        return std::array<Vec, 2>{t, Vec(n.cross(t))};
    }
}

}  // namespace

template <class S>
ImpactSolver<S>::ImpactSolver() : solver_(findAlgorithm(solverTable<S>(), "solver", "pgs").make()) {}

template <class S>
void ImpactSolver<S>::begin(const BodyArrays<S>& bodies, const ShapeRecord<S>& shapeA,
                            const ShapeRecord<S>& shapeB, const Manifold<S>& manifold,
                            const PreSolveAnswer<S>& law) {
    using Vec = typename S::Vec;
    const std::uint32_t a = shapeA.body, b = shapeB.body;
    const PairCoefficients<S>& coefficients = law.coefficients;
    const bool driven =
        shapeA.hasSurfaceVelocity || shapeB.hasSurfaceVelocity || !law.surfaceVelocity.isZero(0);
    const Velocity<S> surfaceA = surfaceNow(bodies, shapeA);
    Velocity<S> surfaceB = surfaceNow(bodies, shapeB);
    surfaceB.v += law.surfaceVelocity;
    const auto drive = [&](Row<S>& row) {
        if (driven) row.bias = rowVelocity<S>(row, surfaceA, surfaceB);
    };
    rows_.clear();
    restitution_ = coefficients.restitution;
    for (std::size_t i = 0; i < static_cast<std::size_t>(manifold.count); ++i) {
        // One point for both bodies: equal and opposite impulses make no couple.
        const Vec at = Real(0.5) * (manifold.points[i].pointA + manifold.points[i].pointB);
        const Vec rA = at - bodies.pose[a].p, rB = at - bodies.pose[b].p;
        Block<S> block;
        block.kind = BlockKind::Contact;
        block.first = static_cast<std::uint32_t>(rows_.rows.size());
        block.a = a;
        block.b = b;
        block.friction = coefficients.friction;
        block.invMassA = bodies.invMass[a];
        block.invMassB = bodies.invMass[b];
        const auto addRow = [&](const Vec& direction) {
            Row<S> row;
            row.lin = direction;
            row.angA = -cross(rA, direction);
            row.angB = cross(rB, direction);
            completeRow<S>(row, block, bodies.invInertia);
            row.invK = Real(1) / rowK<S>(row, block);
            rows_.rows.push_back(row);
        };
        addRow(manifold.normal);
        block.rows = 1;
        if (block.friction > 0) {
            for (const Vec& t : tangentsOf(manifold.normal)) {
                addRow(t);
                drive(rows_.rows.back());
                ++block.rows;
            }
            const Row<S>* t = rows_.rows.data() + block.first + 1;
            block.k11 = rowCoupling<S>(t[0], t[0], block);
            block.k12 = S::tangents > 1 ? rowCoupling<S>(t[0], t[S::tangents - 1], block) : Real(0);
            block.k22 =
                S::tangents > 1 ? rowCoupling<S>(t[S::tangents - 1], t[S::tangents - 1], block) : Real(1);
        }
        rows_.blocks.push_back(block);
        if (!coefficients.hasMoments()) continue;
        const std::size_t rows = rows_.rows.size(), blocks = rows_.blocks.size();
        rows_.rows.resize(rows + static_cast<std::size_t>(momentRows<S>(coefficients)));
        rows_.blocks.resize(blocks + static_cast<std::size_t>(momentBlocks<S>(coefficients)));
        makeMomentBlocks<S>(block, coefficients, manifold.normal, tangentsOf(manifold.normal),
                            bodies.invInertia, static_cast<std::uint32_t>(rows), rows_.blocks.data() + blocks,
                            rows_.rows.data() + rows);
        for (std::size_t k = rows; k < rows_.rows.size(); ++k) drive(rows_.rows[k]);
    }
}

template <class S>
typename S::Real ImpactSolver<S>::solve(BodyArrays<S>& bodies, FrictionLaw<S> friction, Real threshold,
                                        bool bounce) {
    Real fastest = 0;
    for (const Block<S>& block : rows_.blocks) {
        Row<S>& normal = rows_.rows[block.first];
        for (std::uint32_t r = 0; r < block.rows; ++r) rows_.rows[block.first + r].impulse = 0;
        if (block.kind != BlockKind::Contact) continue;
        const Real approach = rowVelocity<S>(normal, bodies.velocity[block.a], bodies.velocity[block.b]);
        normal.bias = bounce && approach < -threshold ? restitution_ * approach : Real(0);
        fastest = std::max(fastest, std::abs(approach));
    }
    // Rounding of the speeds involved.
    UntilConverged<S> monitor(Real(4) * std::numeric_limits<Real>::epsilon() * fastest);
    constexpr int kIterations = 100;  // four points of a box: 30 to double precision
    solver_->solve({rows_, bodies.velocity, friction, monitor, kIterations, Real(0), false});
    Real sum = 0;
    for (const Block<S>& block : rows_.blocks)
        if (block.kind == BlockKind::Contact) sum += rows_.rows[block.first].impulse;
    return sum;
}

template <class S>
typename S::Vec ImpactSolver<S>::frictionImpulse() const {
    typename S::Vec sum = S::Vec::Zero();
    for (const Block<S>& block : rows_.blocks) {
        if (block.kind != BlockKind::Contact) continue;
        for (std::uint32_t r = 1; r < block.rows; ++r) {
            const Row<S>& row = rows_.rows[block.first + r];
            sum += row.impulse * row.lin;
        }
    }
    return sum;
}

RIGOR_INSTANTIATE_CLASS(ImpactSolver)

}  // namespace rigor::engine
