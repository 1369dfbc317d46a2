// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The constraints of a step as input of position correction, after the bodies have moved.
#pragma once

#include <vector>

#include "engine/pipeline/joint_set.hpp"
#include "engine/solvers/position_correction.hpp"

namespace rigor::engine {

/// Arrays that outlive the step so that it does not allocate.
template <class S>
struct PositionScratch {
    /// Motion of each body since the rows were made: translation [m], rotation vector [rad].
    std::vector<Velocity<S>> motion;
    std::vector<typename S::Ang> turn;    ///< rotation not yet in the pose [rad]
    std::vector<std::uint32_t> turned;    ///< bodies with a turn
    std::vector<std::uint32_t> contacts;  ///< blocks of contacts to be corrected
    JointRows<S> made;
};

/// Contacts are evaluated to first order in the motion since their rows were made:
///     C = s + n . (dB + aB x rB - dA - aA x rA)
/// exact for translation and for rolling spheres. Joints are evaluated exactly. Contacts that separate faster
/// than `separating` [m/s] are left to do so.
template <class S>
class StepPositions final : public PositionProblem<S> {
  public:
    using Real = typename S::Real;

    /// `used` are the velocities that moved the bodies over h.
    StepPositions(BodyArrays<S>& bodies, const JointSet<S>& joints, const ConstraintRows<S>& rows,
                  std::span<const Velocity<S>> used, Real h, Real separating, PositionScratch<S>& scratch);

    /// Coordinates that a motor drives, and has the force for, are held where they are.
    void holdMotors() { holdsMotors_ = true; }

    std::size_t jointCount() const override { return joints_.records().size(); }
    void evaluateJoint(std::size_t index, JointPositions<S>& out) const override;
    std::size_t contactCount() const override { return scratch_.contacts.size(); }
    const Block<S>& contactBlock(std::size_t i) const override { return rows_.blocks[scratch_.contacts[i]]; }
    const Row<S>& contactRow(std::size_t i) const override { return rows_.rows[contactBlock(i).first]; }
    Real moved(const Block<S>& block, const Row<S>& row) const override {
        return rowVelocity<S>(row, scratch_.motion[block.a], scratch_.motion[block.b]);
    }
    Real separation(std::size_t i) const override {
        return contactRow(i).error + moved(contactBlock(i), contactRow(i));
    }
    void move(const Block<S>& block, const Row<S>& row, Real lambda) override;
    void moveBody(std::uint32_t body, const typename S::Vec& by, const typename S::Ang& turn) override;
    void applyRotations() override;
    Real velocity(const Block<S>& block, const Row<S>& row) const override {
        return rowVelocity<S>(row, bodies_.velocity[block.a], bodies_.velocity[block.b]);
    }
    void push(const JointPositions<S>& joint, const Real* impulses, Real factor) override;
    /// Joints of other bodies than the flagged ones are left out.
    void takeOnly(std::span<const std::uint8_t> bodies) { only_ = bodies; }

  private:
    BodyArrays<S>& bodies_;
    const JointSet<S>& joints_;
    const ConstraintRows<S>& rows_;
    PositionScratch<S>& scratch_;
    Real h_;  ///< size of the step [s]
    bool holdsMotors_ = false;
    std::span<const std::uint8_t> only_;
};

}  // namespace rigor::engine
