// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The impulses of all rows as one vector [N s or N m s], in the order of the rows: for solvers that go back
// to an earlier iterate or jump to one.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/math/portable.hpp"
#include "engine/solvers/natural_map.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::engine {

template <class S>
void readImpulses(const ConstraintRows<S>& all, std::vector<typename S::Real>& out) {
    out.resize(all.rows.size());
    for (std::size_t i = 0; i < all.rows.size(); ++i) out[i] = all.rows[i].impulse;
}

/// Sets impulses, and velocities with them; those of rows that no body can follow stay. Returns the largest
/// change of a row's velocity that its own impulse makes [m/s or rad/s].
template <class S, class Value>
double setImpulses(const SolverInput<S>& input, const std::vector<Value>& impulses) {
    using Real = typename S::Real;
    double change = 0;
    for (const Block<S>& block : input.constraints.blocks)
        for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
            Row<S>& row = input.constraints.rows[i];
            if (!(row.invK > 0)) continue;
            const Real next = static_cast<Real>(impulses[i]), step = next - row.impulse;
            applyRowImpulse<S>(row, block, step, input.velocities[block.a], input.velocities[block.b]);
            row.impulse = next;
            change = std::max(change, std::abs(static_cast<double>(step)) / static_cast<double>(row.invK));
        }
    return change;
}

/// Projects impulses to the nearest ones that the rows allow: bounds, and Coulomb's cone (of static
/// friction), and the bounds of moments.
template <class S>
void projectImpulses(const ConstraintRows<S>& all, std::vector<typename S::Real>& impulses) {
    using Real = typename S::Real;
    using Vec3 = Eigen::Matrix<Real, 3, 1>;
    for (const Block<S>& block : all.blocks) {
        Real* r = impulses.data() + block.first;
        if (block.kind == BlockKind::Bounded) {
            r[0] = std::clamp(r[0], all.rows[block.first].lower, all.rows[block.first].upper);
        } else if (block.kind == BlockKind::Moment) {
            // The normal, of a block before, has been projected.
            const Real bound = block.friction * (impulses[block.normal] + block.appliedNormal);
            const Real length = portable::hypot(r[0], block.rows > 1 ? r[1] : Real(0));
            for (int i = 0; length > bound && i < block.rows; ++i) r[i] *= bound / length;
        } else if (block.kind == BlockKind::Contact) {
            Vec3 whole = Vec3::Zero();
            for (int i = 0; i < block.rows; ++i) whole[i] = r[i];
            const Real mu = std::max(block.friction, block.staticFriction);
            if (block.rows > 1) whole[0] += block.appliedNormal;
            whole = block.rows > 1 ? projectOnCone<Real>(whole, mu)
                                   : Vec3(std::max(Real(0), whole[0]), Real(0), Real(0));
            if (block.rows > 1) whole[0] = std::max(Real(0), whole[0] - block.appliedNormal);
            for (int i = 0; i < block.rows; ++i) r[i] = whole[i];
        }
    }
}

}  // namespace rigor::engine
