// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// DART's constraint solver with contacts from outside: DART 6.12 combines coefficients of friction by their minimum and
// of restitution by their product, so the adapter finds the contacts of a step in DART's own way, gives the two shapes of
// each the coefficients of their pair, and hands the solver the constraints.
#pragma once

#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::dart_adapter {

class PairwiseSolver final : public dart::constraint::BoxedLcpConstraintSolver {
  public:
    using BoxedLcpConstraintSolver::BoxedLcpConstraintSolver;

    /// The group of all shapes that can collide, which the solver itself no longer looks at.
    dart::collision::CollisionGroupPtr takeGroup();

    /// Sets the constraints of joints, beside those that belong to the joints of trees.
    void setJoints(std::vector<dart::constraint::ConstraintBasePtr> joints);

    /// Constraints of the coming step's contacts, beside those of joints.
    std::vector<dart::constraint::ConstraintBasePtr>& beginContacts();

    std::size_t groups() const { return mConstrainedGroups.size(); }

  private:
    std::size_t joints_ = 0;  ///< constraints of joints, which stay
};

/// Error reduction and compliance, which DART keeps in static variables of its kinds of constraints.
struct Stabilisation {
    double contactErp = 0.01, contactMaxSpeed = 1e-3, contactCfm = 1e-5;
    double jointErp = 0.01, jointMaxSpeed = 10.0, jointCfm = 1e-9;
    void use() const;
};

}  // namespace rigor::dart_adapter
