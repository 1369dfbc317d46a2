// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Parts of a scenario, read from their JSON; one file each. Errors become Problems of the context.
#pragma once

#include <optional>
#include <vector>

#include "scenarios/json/node.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::scenario {

/// Shapes; `usual` has what a shape has that names no material, no layers, ...
std::vector<Shape> readShapes(const Node& list, const Scenario& scenario, const Shape& usual);
/// One shape in the world, without a material; for collision queries.
Shape readPosedShape(const Node& node);
/// "orientation", "axis_angle_deg", "angle", "angle_deg" of an object; identity without any.
Quat readOrientation(const Node& object);
/// The layers that a file names.
void readLayers(const Node& list, Scenario& scenario);
/// `filter` with what the keys "layers", "collides_with" and "group" of an object change.
ContactFilter readFilter(const Node& node, const Scenario& scenario, ContactFilter filter);
Body readBody(const Node& node, const Scenario& scenario);
void readJoints(const Node& list, Scenario& scenario);
void readForces(const Node& list, Scenario& scenario);
void readEvents(const Node& list, Scenario& scenario);
void readAcceptance(const Node& root, Scenario& scenario);
BenchPlan readBench(const Node& node);
std::optional<ReferenceSpec> readReference(const Node& node);
/// Index of the body that a text node names; kNone for "world" where `mayBeWorld`; reported otherwise.
int readBodyName(const Node& node, const Scenario& scenario, bool mayBeWorld);
int readMaterialName(const Node& node, const Scenario& scenario);

}  // namespace rigor::scenario
