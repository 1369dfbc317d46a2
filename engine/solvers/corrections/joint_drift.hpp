// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of bodies that have moved for a while without forces, by RATTLE (position_correction.hpp).
#pragma once

#include <vector>

#include "engine/solvers/corrections/joint_newton.hpp"
#include "engine/solvers/position_correction.hpp"

namespace rigor::engine {

template <class S>
class JointDrift {
  public:
    using Real = typename S::Real;

    /// `newton` finds and factors the joints where the bodies move from. False: there are none, or no factors.
    bool begin(const PositionProblem<S>& problem, JointNewton<S>& newton);
    /// The bodies have moved over 1 / `perTime` times the fraction of the impulses that velocities get.
    void end(PositionProblem<S>& problem, JointNewton<S>& newton, Real perTime, bool whole,
             const PositionIterations& iterations);

  private:
    void findImpulses(PositionProblem<S>& problem, JointNewton<S>& newton);
    void project(PositionProblem<S>& problem, JointNewton<S>& newton, Real perTime, bool whole);

    std::vector<JointPositions<S>> ends_;  ///< joints where bodies have moved to
    JointPositions<S> moved_;
    std::vector<Real> mu_, kept_;  ///< kMaxJointRows numbers for each held joint
};

}  // namespace rigor::engine
