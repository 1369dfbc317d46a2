// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario as DART's skeletons, with the tables that lead from one to the other.
#pragma once

#include <dart/dynamics/Skeleton.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "adapters/dart/convert.hpp"
#include "adapters/dart/coordinates.hpp"
#include "adapters/dart/loops.hpp"
#include "adapters/dart/surfaces.hpp"
#include "adapters/interface/joint_trees.hpp"
#include "adapters/interface/pair_table.hpp"

namespace rigor::dart_adapter {

using adapter::Forest;
using adapter::kNone;
using adapter::Link;

struct Model {
    explicit Model(const std::string& narrowPhase) : surfaces(narrowPhase) {}

    Forest forest;
    std::vector<dart::dynamics::SkeletonPtr> skeletons;
    std::vector<dart::dynamics::BodyNode*> bodies;  ///< nodes by scenario body
    std::vector<std::vector<dart::dynamics::ShapeNode*>>
        shapeNodes;  ///< the first of a shape's, by body and shape
    std::unordered_map<const dart::dynamics::ShapeFrame*, adapter::PairTable::ShapeRef> shapes;
    Surfaces surfaces;
    std::vector<std::vector<Coordinate>>
        coordinates;               ///< coordinates of the joint that a body hangs on, by body
    std::vector<LoopJoint> loops;  ///< joints beside the trees, made once the bodies are placed
    /// Joints that a motor drives, with the speed it strives for [u/s].
    std::vector<std::pair<dart::dynamics::Joint*, double>> motors;
};

/// `scenario` is three-dimensional and has springs by stiffness; `planar` if it was lifted. Throws Unsupported.
Model buildModel(const adapter::Scenario& scenario, bool planar, const std::string& narrowPhase);

/// Puts a body into a state, as coordinates of its joint; what its joint does not allow is lost. `states` are those of
/// all bodies; bodies that it hangs on have theirs already.
void placeBody(const Model& model, const adapter::Scenario& scenario, int body,
               std::span<const adapter::BodyState> states);

}  // namespace rigor::dart_adapter
