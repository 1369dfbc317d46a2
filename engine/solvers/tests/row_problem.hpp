// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Problems for solvers, made row by row without a world.
#pragma once

#include <random>

#include "engine/contacts/contact_rows.hpp"
#include "engine/solvers/natural_map.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::engine::test {

template <class S>
class QuietMonitor final : public IterationMonitor<S> {
  public:
    void before(std::span<const Velocity<S>>) override {}
    bool after(std::span<const Velocity<S>>, typename S::Real) override {
        ++iterations;
        return false;
    }
    typename S::Real tolerance() const override { return tolerated; }
    int iterations = 0;
    typename S::Real tolerated = 0;  ///< the tolerance; it ends nothing by itself
};

/// Bodies (0 is the world) and rows between them.
template <class S>
struct RowProblem {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    std::vector<Real> invMass{0};
    std::vector<typename S::Inertia> invInertia{zeroInertia<S>()};
    std::vector<Velocity<S>> velocities{Velocity<S>{}};
    ConstraintRows<S> rows;
    bool gaveUp = false;
    int iterations = 0;

    std::uint32_t addBody(double mass, double inertia, const Vec& v,
                          const typename S::Ang& w = zeroAng<S>()) {
        invMass.push_back(static_cast<Real>(1 / mass));
        if constexpr (S::dim == 2)
            invInertia.push_back(static_cast<Real>(1 / inertia));
        else
            invInertia.push_back(S::Inertia::Identity() * static_cast<Real>(1 / inertia));
        velocities.push_back({v, w});
        return static_cast<std::uint32_t>(invMass.size() - 1);
    }
    Block<S>& addContact(std::uint32_t a, std::uint32_t b, const Vec& n, const Vec& rA, const Vec& rB,
                         double mu, double bias = 0, double muStatic = 0) {
        Block<S> block = begin(BlockKind::Contact, a, b);
        block.friction = static_cast<Real>(mu);
        block.staticFriction = static_cast<Real>(muStatic);
        push(block, n, rA, rB, bias);
        if (mu > 0 || muStatic > 0)
            for (const Vec& t : tangentBasis<S>(n)) push(block, t, rA, rB, 0);
        const Row<S>* t = rows.rows.data() + block.first + 1;
        if (block.rows > 1) {
            block.k11 = rowCoupling<S>(t[0], t[0], block);
            block.k12 = S::tangents > 1 ? rowCoupling<S>(t[0], t[S::tangents - 1], block) : Real(0);
            block.k22 =
                S::tangents > 1 ? rowCoupling<S>(t[S::tangents - 1], t[S::tangents - 1], block) : Real(1);
        }
        rows.blocks.push_back(block);
        return rows.blocks.back();
    }
    void addBall(std::uint32_t a, std::uint32_t b, const Vec& rA, const Vec& rB, double bias = 0) {
        Block<S> block = begin(BlockKind::Joint, a, b);
        for (int i = 0; i < S::dim; ++i) push(block, Vec::Unit(i), rA, rB, bias);
        rows.blocks.push_back(block);
        rows.matrices.emplace_back();  // room for a solver to invert it in
    }
    void addBounded(std::uint32_t a, std::uint32_t b, const Vec& direction, const Vec& rA, const Vec& rB,
                    double lower, double upper, double bias, double softness) {
        Block<S> block = begin(BlockKind::Bounded, a, b);
        push(block, direction, rA, rB, bias);
        Row<S>& row = rows.rows.back();
        row.lower = static_cast<Real>(lower);
        row.upper = static_cast<Real>(upper);
        row.softness = static_cast<Real>(softness);
        row.invK = Real(1) / rowK<S>(row, block);
        rows.blocks.push_back(block);
    }
    void solve(Solver<S>& solver, int most, const char* friction = "cone", int directions = 4) {
        QuietMonitor<S> monitor;
        solver.solve({rows, velocities, findAlgorithm(frictionTable<S>(), "friction", friction).make, monitor,
                      most, Real(0.01), false, Real(1e-10), directions});
        gaveUp = solver.gaveUp();
        iterations = monitor.iterations;
    }
    Real residual() const { return naturalMapResidual<S>(rows, std::span<const Velocity<S>>(velocities)); }
    bool finite() const {
        for (const Row<S>& row : rows.rows)
            if (!std::isfinite(row.impulse)) return false;
        for (const Velocity<S>& v : velocities)
            if (!v.v.allFinite() || !std::isfinite(dotAng(v.w, v.w))) return false;
        return true;
    }

  private:
    Block<S> begin(BlockKind kind, std::uint32_t a, std::uint32_t b) {
        Block<S> block;
        block.kind = kind;
        block.a = a;
        block.b = b;
        block.first = static_cast<std::uint32_t>(rows.rows.size());
        block.invMassA = invMass[a];
        block.invMassB = invMass[b];
        return block;
    }
    void push(Block<S>& block, const Vec& direction, const Vec& rA, const Vec& rB, double bias) {
        Row<S> row;
        row.lin = direction;
        row.angA = -cross(rA, direction);
        row.angB = cross(rB, direction);
        row.bias = static_cast<Real>(bias);
        completeRow<S>(row, block, invInertia);
        const Real K = rowK<S>(row, block);
        row.invK = K > 0 ? Real(1) / K : Real(0);
        rows.rows.push_back(row);
        ++block.rows;
    }
};

template <class S>
typename S::Vec randomVec(std::mt19937& random) {
    std::normal_distribution<double> g;
    typename S::Vec v;
    for (int i = 0; i < S::dim; ++i) v[i] = static_cast<typename S::Real>(g(random));
    return v;
}

/// A few bodies with contacts, and with joints, limits, motors and springs if `joints`.
template <class S>
RowProblem<S> randomRowProblem(unsigned seed, int bodies, int contacts, double mu, bool joints) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(0, 1);
    RowProblem<S> p;
    for (int i = 0; i < bodies; ++i) {
        typename S::Ang w = zeroAng<S>();
        if constexpr (S::dim == 2)
            w = static_cast<typename S::Real>(2 * u(random) - 1);
        else
            w = randomVec<S>(random);
        p.addBody(0.5 + u(random), 0.1 + 0.2 * u(random), randomVec<S>(random), w);
    }
    const auto body = [&](int from) {
        return static_cast<std::uint32_t>(from + static_cast<int>(u(random) * (bodies + 1 - from) * 0.9999));
    };
    const auto arm = [&] { return typename S::Vec(typename S::Real(0.4) * randomVec<S>(random)); };
    if (joints) {
        const auto j = static_cast<std::uint32_t>(bodies);
        p.addBall(j - 1, j, arm(), arm());
        const double infinity = std::numeric_limits<double>::infinity();
        p.addBounded(0, j, randomVec<S>(random).normalized(), arm(), arm(), 0, infinity, 0.2, 0);  // limit
        p.addBounded(0, 1, randomVec<S>(random).normalized(), arm(), arm(), -0.3, 0.2, -1, 0);     // motor
        p.addBounded(1, j, randomVec<S>(random).normalized(), arm(), arm(), -infinity, infinity, 0.5,
                     0.7);  // spring
        p.addBounded(0, j, randomVec<S>(random).normalized(), arm(), arm(), -infinity, 0, 0.1,
                     0);  // upper stop
    }
    for (int i = 0; i < contacts; ++i) {
        const std::uint32_t b = body(1), a = body(0);
        p.addContact(a == b ? 0 : a, b, randomVec<S>(random).normalized(), arm(), arm(), mu,
                     i % 3 == 0 ? 0.2 * u(random) : 0);
    }
    return p;
}

}  // namespace rigor::engine::test
