// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The joints of a tree as text of MJCF: the coordinates by which a body moves against the one it hangs on.
#pragma once

#include <string>

#include "adapters/mujoco/model.hpp"

namespace rigor::mujoco {

/// Attribute of an element, with a blank before it.
std::string attribute(const char* name, const std::string& value);
std::string softnessText(const Softness& softness, const char* solref = "solref",
                         const char* solimp = "solimp");

/// Writes coordinates, and the actuators of their motors.
class CoordinateWriter {
  public:
    CoordinateWriter(const adapter::Scenario& scenario, bool planar, const ModelSettings& settings,
                     Model& model)
        : scenario_(scenario), planar_(planar), settings_(settings), model_(model) {}

    /// The elements of a body that hangs on a joint. Throws Unsupported.
    std::string text(const Link& link);
    /// The actuator of a coordinate's motor, if it has one; `transmission`: attributes that say what it moves.
    void addMotor(int joint, const std::string& transmission, const scenario::JointAxis& use);
    const std::string& actuators() const { return actuators_; }

  private:
    std::string one(const char* what, const char* type, const scenario::Vec3& axis,
                    const scenario::JointAxis& use);
    std::string ballOrCone(const Link& link);
    std::string wheel(const Link& link);
    std::string sixDof(const Link& link);
    const scenario::Joint& joint() const { return scenario_.joints[index_]; }

    const adapter::Scenario& scenario_;
    bool planar_;
    const ModelSettings& settings_;
    Model& model_;
    int index_ = kNone;  ///< the joint that is written
    std::string at_;     ///< its anchor as an attribute
    std::string actuators_;
};

}  // namespace rigor::mujoco
