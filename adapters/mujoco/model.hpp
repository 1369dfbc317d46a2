// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario as a compiled mjModel, with the tables that lead from one to the other.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "adapters/interface/joint_trees.hpp"
#include "adapters/mujoco/library.hpp"
#include "adapters/mujoco/surface.hpp"

namespace rigor::mujoco {

using adapter::canBreak;
using adapter::canCloseLoop;
using adapter::Forest;
using adapter::kNone;
using adapter::Link;
using adapter::spanningForest;
using adapter::swingLimit;

/// Settings of a spec that the model depends on.
struct ModelSettings {
    std::string integrator, cone, solver, jacobian;
    int iterations = 100, noslipIterations = 0;
    double tolerance = 1e-8, impratio = 1.0;
    bool warmStart = true, safeReference = true, restitution = true;
    double bounceFrequency = 1.0;  ///< frequency of contacts with restitution [rad/s]
    Softness softness;             ///< softness of contacts and of stops of joints
    Softness rigid;                ///< softness of equalities and of bounds of distances
};

/// A motor of a joint coordinate: an actuator whose force the adapter sets at the start of each step.
struct Motor {
    int actuator = 0;       ///< index in the model
    double speed = 0.0;     ///< [u/s]
    double maxForce = 0.0;  ///< [N] or [N m]
};

struct Model {
    ModelOwner model;
    Forest forest;
    std::vector<int> bodies;                           ///< MuJoCo's bodies, by scenario body
    std::vector<adapter::PairTable::ShapeRef> shapes;  ///< scenario shapes by geom
    std::vector<std::vector<int>> geoms;               ///< geoms by scenario body and shape; -1: none
    std::vector<Motor> motors;
    std::map<int, std::vector<int>> equalities;  ///< equality constraints by the scenario joint they hold
    int equalityCount = 0;
    Surface common;         ///< surface of geoms that no explicit pair names
    int explicitPairs = 0;  ///< pairs of geoms whose surface is another
};

/// `scenario` is three-dimensional and has springs by stiffness; `planar` if it was lifted. Throws Unsupported.
Model buildModel(const adapter::Scenario& scenario, const adapter::PairTable& pairs, bool planar, double dt,
                 const ModelSettings& settings);

/// Distance of the two points of a hinge that is held by two `connect` [m].
inline constexpr double kConnectArm = 0.1;

/// The mass of kinematic bodies in MuJoCo, which moves them by its forces: so large that nothing else does [kg].
inline constexpr double kKinematicMass = 1e9;

}  // namespace rigor::mujoco
