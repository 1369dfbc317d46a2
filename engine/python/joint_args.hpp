// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A joint as Python gives it, for a world of any dimension and precision.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/python/numbers.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine::python {

using AxisArgs = JointAxis<double>;

struct JointArgs {
    std::string type;
    MaybeNumbers anchorA, anchorB, axisA, axisB, spinAxisB, normalA;
    double length = 0;
    bool collideConnected = false;
    std::vector<AxisArgs> axes;
    double breakForce = std::numeric_limits<double>::infinity();
    double breakTorque = std::numeric_limits<double>::infinity();
};

template <class R>
JointAxis<R> toJointAxis(const AxisArgs& args);

/// The definition without its bodies. Throws EngineError "joint_type", "joint_axes", "array".
template <class S>
JointDef<S> toJointDef(const JointArgs& args);

void bindJoints(py::module_& module);

}  // namespace rigor::engine::python
