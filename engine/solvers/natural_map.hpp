// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One residual for all solvers: how far impulses and velocities are from the laws that the rows state,
// whatever the solver made of them. With w = J v + bias + softness lambda and P the projection onto what
// impulses are allowed, each block's law is a fixed point (the natural map of its variational inequality
// [FacchineiPang2003, section 1.5]) and the residual its defect as a velocity:
//     joint     |w|
//     bounded   |lambda - clamp(lambda - rho w, lower, upper)| / rho
//     moment    |r - P_D(r - rho w)| / rho,   D = {|r| <= rho_r r_n}  (rolling; torsional)
//     contact   |r - P_K(r - rho (w + mu |w_t| n))| / rho,   K = {|r_t| <= mu r_n}
// The contact law is Signorini's and Coulomb's together, by De Saxce's change of variable [DeSaxceFeng1998];
// zero if and only if both hold exactly. rho = 1/K of the normal (of the row), which makes the measure the
// velocity error of a contact alone. A contact with static friction mu_s > mu also satisfies its law
// where it sticks with |r_t| <= mu_s r_n.
//
// Pyramids are measured against the cone like everything else: what remains is their model error.
#pragma once

#include <span>

#include "engine/constraints/row.hpp"

namespace rigor::engine {

/// Residual of one block [m/s or rad/s].
template <class S>
typename S::Real blockResidual(const ConstraintRows<S>& constraints, const Block<S>& block,
                               std::span<const Velocity<S>> velocities);
/// The largest residual of all blocks [m/s or rad/s]. Cost: one pass over the rows.
template <class S>
typename S::Real naturalMapResidual(const ConstraintRows<S>& constraints,
                                    std::span<const Velocity<S>> velocities);

/// Closest point of the cone |r_t| <= mu r_n; r = (n, t1, t2).
template <class R>
Eigen::Matrix<R, 3, 1> projectOnCone(const Eigen::Matrix<R, 3, 1>& r, R mu);

/// Resolution of the velocities of a block's rows, see below [m/s or rad/s].
template <class S>
typename S::Real blockResolution(const ConstraintRows<S>& constraints, const Block<S>& block,
                                 std::span<const Velocity<S>> velocities);
/// Resolution of the rows' velocities in this precision: rounding of velocities and impulses of the size of
/// the current ones [m/s or rad/s].
template <class S>
typename S::Real velocityResolution(const ConstraintRows<S>& constraints,
                                    std::span<const Velocity<S>> velocities);

}  // namespace rigor::engine
