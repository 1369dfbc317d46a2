// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenarios as model files of other simulators. What a format can not hold is refused by name, or left out where
// `--without` names it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/exchange/common/report.hpp"
#include "scenarios/exchange/common/text.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::models {

/// Files that a model refers to, by their names in the model's own folder.
using FilesBeside = std::map<std::string, std::string>;

/// MJCF. Velocities become the keyframe "start", height fields files beside the model.
std::string mjcfText(const scenario::Scenario& scenario, Report& report, FilesBeside& beside);
/// URDF; bodies that nothing holds float from the link "world", hulls and meshes become files beside the model.
std::string urdfText(const scenario::Scenario& scenario, Report& report, FilesBeside& beside);
/// Name of a file beside the model without its ending: the scenario's and `part`, of letters that any system takes.
std::string besideName(const scenario::Scenario& scenario, const std::string& part);
/// MuJoCo's binary file of heights: rows and columns as integers, then (height - lowest) / range in single precision.
/// The model's rows lie along the scenario's x.
std::string heightBytes(const scenario::HeightField& field, double lowest, double range);

/// A joint as an edge of the tree of bodies, towards the child.
struct TreeJoint {
    int joint = scenario::kNone;   ///< index; kNone: the body is free
    int parent = scenario::kNone;  ///< body, or the world
    bool isReversed = false;       ///< the child is the joint's A
};
struct JointTree {
    std::vector<TreeJoint> above;  ///< one entry for every body
    std::vector<int> loops;        ///< joints that close a loop
    std::vector<int> order;        ///< bodies, parents first
};
/// A spanning tree over the joints that `mayBeEdge` names; others are loops.
JointTree treeOf(const scenario::Scenario& scenario, const std::vector<bool>& mayBeEdge);

/// Principal moments and axes of a symmetric tensor (Jacobi rotations): tensor = R diag R^T.
struct Principal {
    scenario::Vec3 moments;
    scenario::Quat axes;
};
Principal principalOf(const scenario::Mat3& tensor);

inline std::string digits(const scenario::Vec3& v) {
    return digits({v.x, v.y, v.z});
}
inline std::string digits(const scenario::Quat& q) {
    return digits({q.w, q.x, q.y, q.z});
}
std::string escaped(const std::string& text);  ///< text of an attribute in XML

/// Refuses what neither MJCF nor URDF has: forces, events, breaking joints, damping of bodies, moving surfaces.
void refuseCommon(const scenario::Scenario& scenario, Report& report);

}  // namespace rigor::models
