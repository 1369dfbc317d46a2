// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The constraints of a step as position correction sees them, after the bodies have moved.
#pragma once

#include <vector>

#include "engine/pipeline/contact_set.hpp"
#include "engine/pipeline/joint_set.hpp"
#include "engine/solvers/position_correction.hpp"

namespace rigor::engine {

/// Arrays that outlive the step so that it does not allocate.
template <class S>
struct PositionScratch {
    std::vector<Velocity<S>>
        motion;  ///< since the contacts were found: translation [m], rotation vector [rad]
    std::vector<typename S::Ang> turn;    ///< rotation not yet in the pose [rad]
    std::vector<std::uint32_t> turned;    ///< bodies with a turn
    std::vector<std::uint32_t> contacts;  ///< blocks of contacts to be corrected
    std::vector<std::uint32_t> places;    ///< their places among all contact blocks
};

/// Contacts are evaluated to first order in the motion since they were found:
///     C = s + n . (dB + aB x rB - dA - aA x rA)
/// exact for translation and for rolling spheres. Joints are evaluated exactly. Contacts that separate faster
/// than `separating` [m/s] are left to do so.
template <class S>
class StepPositions final : public PositionProblem<S> {
  public:
    using Real = typename S::Real;

    /// `used` are the velocities that moved the bodies over h.
    StepPositions(BodyArrays<S>& bodies, const JointSet<S>& joints, const ContactSet<S>& contacts,
                  const ConstraintRows<S>& rows, std::span<const Velocity<S>> used, Real h, Real separating,
                  PositionScratch<S>& scratch);

    std::size_t jointCount() const override { return joints_.records().size(); }
    void evaluateJoint(std::size_t index, Block<S>& block, std::span<Row<S>> rows, BlockVector<S>& error,
                       BlockMatrix<S>& inverseK) const override;
    std::size_t contactCount() const override { return scratch_.contacts.size(); }
    const Block<S>& contactBlock(std::size_t i) const override { return rows_.blocks[scratch_.contacts[i]]; }
    const Row<S>& contactRow(std::size_t i) const override { return rows_.rows[contactBlock(i).first]; }
    Real separation(std::size_t i) const override {
        const Block<S>& block = contactBlock(i);
        return contacts_.separations()[scratch_.places[i]] +
               rowVelocity<S>(contactRow(i), scratch_.motion[block.a], scratch_.motion[block.b]);
    }
    void move(const Block<S>& block, const Row<S>& row, Real lambda) override;
    void applyRotations() override;

  private:
    void moveBody(std::uint32_t body, const typename S::Vec& d, const typename S::Ang& turn);

    BodyArrays<S>& bodies_;
    const JointSet<S>& joints_;
    const ContactSet<S>& contacts_;
    const ConstraintRows<S>& rows_;
    PositionScratch<S>& scratch_;
};

}  // namespace rigor::engine
