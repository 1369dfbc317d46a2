// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/mujoco/coordinates.hpp"

#include <algorithm>
#include <array>

#include "adapters/mujoco/geoms.hpp"
#include "adapters/mujoco/mjcf.hpp"

namespace rigor::mujoco {
namespace {

using scenario::AxisMode;
using scenario::Joint;
using scenario::JointAxis;
using scenario::JointType;

bool isPlain(const JointAxis& axis) {
    return !axis.hasSpring() && !axis.hasMotor() && axis.mode != AxisMode::Limited;
}

[[noreturn]] void refuse(const Joint& joint, const std::string& what) {
    throw adapter::notInLibrary("mujoco", what, kWholeRotation, "joint '" + joint.name + "'");
}

}  // namespace

std::string attribute(const char* name, const std::string& value) {
    return std::string(" ") + name + "=\"" + value + "\"";
}

std::string softnessText(const Softness& s, const char* solref, const char* solimp) {
    std::string ref, imp;
    for (const double x : s.solref) ref += exact(x) + " ";
    for (const double x : s.solimp) imp += exact(x) + " ";
    return attribute(solref, ref) + attribute(solimp, imp);
}

std::string CoordinateWriter::text(const Link& link) {
    index_ = link.joint;
    at_ = attribute("pos", exact(anchorIn(link, joint())));
    switch (joint().type) {
        case JointType::Ball:
        case JointType::ConeTwist:
            return ballOrCone(link);
        case JointType::Hinge:
            return one("", "hinge", axisIn(link, joint()), joint().axes[0]);
        case JointType::Slider:
            return one("", "slide", axisIn(link, joint()), joint().axes[0]);
        case JointType::Wheel:
            return wheel(link);
        case JointType::SixDof:
            return sixDof(link);
        default:
            return "";
    }
}

std::string CoordinateWriter::one(const char* what, const char* type, const scenario::Vec3& axis,
                                  const JointAxis& use) {
    if (use.mode == AxisMode::Locked) return "";
    const std::string name = jointTag(index_, what);
    std::string out =
        "<joint" + attribute("name", name) + attribute("type", type) + attribute("axis", exact(axis)) + at_;
    if (use.mode == AxisMode::Limited)
        out += " limited=\"true\"" +
               attribute("range", exact(std::max(use.lower, -1e6)) + " " + exact(std::min(use.upper, 1e6))) +
               softnessText(settings_.softness, "solreflimit", "solimplimit");
    if (use.hasSpring())
        out += attribute("stiffness", exact(use.stiffness)) + attribute("damping", exact(use.damping)) +
               attribute("springref", exact(use.target));
    out += "/>";
    addMotor(index_, attribute("joint", name), use);
    return out;
}

void CoordinateWriter::addMotor(int joint, const std::string& transmission, const JointAxis& use) {
    if (!use.hasMotor()) return;
    const int actuator = static_cast<int>(model_.motors.size());
    model_.motors.push_back({actuator, use.motorSpeed, use.motorMaxForce});
    actuators_ += "<motor" + attribute("name", "a" + std::to_string(actuator) + "_" + jointTag(joint)) +
                  transmission + "/>";
}

/// A ball, whose swing is bounded by a tendon (mjcf.cpp). Where it may not swing, a twist is a hinge.
std::string CoordinateWriter::ballOrCone(const Link& link) {
    if (planar_) return one("", "hinge", {0, 0, 1}, joint().axes[0]);
    const bool cone = joint().type == JointType::ConeTwist;
    const JointAxis &swing = joint().axes[cone ? 1 : 0], &twist = joint().axes[0];
    if (swing.mode == AxisMode::Locked)
        return cone ? one("", "hinge", axisIn(link, joint()), twist)
                    : one("", "hinge", axisIn(link, joint()), {});
    if (swing.hasSpring() || swing.hasMotor()) refuse(joint(), "a spring or motor of a swing");
    if (cone && (twist.mode == AxisMode::Locked || twist.mode == AxisMode::Limited || twist.hasSpring()))
        refuse(joint(), "a cone_twist whose twist is not free while it swings");
    // The gear of a ball is the axis in its body about which it is turned.
    if (cone)
        addMotor(
            index_,
            attribute("joint", jointTag(index_)) + attribute("gear", exact(axisIn(link, joint())) + " 0 0 0"),
            twist);
    return "<joint" + attribute("name", jointTag(index_)) + " type=\"ball\"" + at_ + "/>";
}

/// The first joint of a body turns or moves the axes of the next.
std::string CoordinateWriter::wheel(const Link& link) {
    const std::string turn = one("_spin", "hinge", spinIn(link, scenario_, joint()), joint().axes[1]);
    const std::string travel = one("", "slide", axisIn(link, joint()), joint().axes[0]);
    return link.reversed ? turn + travel : travel + turn;
}

/// Travels along A's axes, and angles where one is open, or all three and free.
std::string CoordinateWriter::sixDof(const Link& link) {
    const std::array<scenario::Vec3, 3> axes = sixDofAxesIn(link, scenario_, joint());
    const auto& use = joint().axes;
    const auto open = [](const JointAxis& axis) {
        return axis.mode != AxisMode::Locked && axis.mode != AxisMode::Usual;
    };
    std::string travels, turns;
    const char* names[] = {"_x", "_y", "_z"};
    for (int k = 0; k < 3; ++k)
        if (open(use[k])) travels += one(names[k], "slide", axes[k], use[k]);
    const auto angles = std::count_if(use.begin() + 3, use.end(), open);
    if (angles > 1) {
        if (angles == 2 || !std::all_of(use.begin() + 3, use.end(), isPlain))
            refuse(joint(), "a six_dof with several angles that are not all free");
        turns = "<joint" + attribute("name", jointTag(index_)) + " type=\"ball\"" + at_ + "/>";
    }
    for (int k = 0; k < 3; ++k)
        if (angles == 1 && open(use[3 + k])) turns += one("_turn", "hinge", axes[k], use[3 + k]);
    return link.reversed ? turns + travels : travels + turns;
}

}  // namespace rigor::mujoco
