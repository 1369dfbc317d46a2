// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario as one multibody system of Simbody, with the tables that lead from one to the other.
#pragma once

#include <memory>
#include <vector>

#include "adapters/interface/joint_trees.hpp"
#include "adapters/simbody/convert.hpp"
#include "adapters/simbody/loops.hpp"

namespace rigor::simbody {

using adapter::Forest;
using adapter::kNone;
using adapter::Link;

/// Part of a joint of a tree: a pin, a slider or a ball of Simbody's. Between two parts there is a body without mass.
struct Coordinate {
    enum class Kind { Turn, Travel, Ball };
    Kind kind = Kind::Turn;
    Vec3 axis;  ///< in the axes of the body that hangs on the joint; nothing for a ball
    SimTK::MobilizedBody mobilizer;
};

struct Model {
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter{system};
    SimTK::GeneralForceSubsystem forces{system};
    SimTK::Force::Gravity gravity;
    SimTK::Force::DiscreteForces discrete;  ///< forces of a step, and those of motors
    Forest forest;
    std::vector<SimTK::MobilizedBody> bodies;  ///< bodies by scenario body; the ground for static ones
    std::vector<std::vector<Coordinate>> coordinates;  ///< parts of joints in trees, by scenario body
    std::vector<LoopJoint> loops;                      ///< joints beside the trees
    std::vector<Motor> motors;
    std::vector<const PairSpring*> turns;  ///< springs that count full turns
};

/// `scenario` is three-dimensional and has springs by stiffness; `planar` if it was lifted. Throws Unsupported.
std::unique_ptr<Model> buildModel(const adapter::Scenario& scenario, bool planar);

/// Puts a body into a state, as coordinates of its joint; what its joint does not allow is lost. `states` are those of
/// all bodies.
void placeBody(const Model& model, const adapter::Scenario& scenario, int body,
               std::span<const adapter::BodyState> states, SimTK::State& to);

}  // namespace rigor::simbody
