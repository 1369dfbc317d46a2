// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/dart/solver.hpp"

#include <dart/constraint/ContactConstraint.hpp>
#include <dart/constraint/DynamicJointConstraint.hpp>
#include <dart/constraint/JointConstraint.hpp>

namespace rigor::dart_adapter {

dart::collision::CollisionGroupPtr PairwiseSolver::takeGroup() {
    auto group = mCollisionGroup;
    mCollisionGroup = mCollisionDetector->createCollisionGroupAsSharedPtr();
    return group;
}

void PairwiseSolver::setJoints(std::vector<dart::constraint::ConstraintBasePtr> joints) {
    joints_ = joints.size();
    mManualConstraints = std::move(joints);
}

std::vector<dart::constraint::ConstraintBasePtr>& PairwiseSolver::beginContacts() {
    mManualConstraints.resize(joints_);
    return mManualConstraints;
}

void Stabilisation::use() const {
    using dart::constraint::ContactConstraint;
    using dart::constraint::DynamicJointConstraint;
    using dart::constraint::JointConstraint;
    ContactConstraint::setErrorReductionParameter(contactErp);
    ContactConstraint::setMaxErrorReductionVelocity(contactMaxSpeed);
    ContactConstraint::setConstraintForceMixing(contactCfm);
    DynamicJointConstraint::setErrorReductionParameter(jointErp);
    DynamicJointConstraint::setMaxErrorReductionVelocity(jointMaxSpeed);
    DynamicJointConstraint::setConstraintForceMixing(jointCfm);
    JointConstraint::setErrorReductionParameter(jointErp);
    JointConstraint::setMaxErrorReductionVelocity(jointMaxSpeed);
    JointConstraint::setConstraintForceMixing(jointCfm);
}

}  // namespace rigor::dart_adapter
