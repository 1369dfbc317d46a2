// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/dart/coordinates.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "adapters/interface/planar_joints.hpp"

namespace rigor::dart_adapter {
namespace {

using scenario::AxisMode;
using scenario::Joint;
using scenario::JointAxis;
using scenario::JointType;

bool isPlain(const JointAxis& axis) {
    return axis.mode == AxisMode::Free && !axis.hasSpring() && !axis.hasMotor();
}

/// The turns of a six_dof are open, and nothing acts on any of them.
bool turnsFreely(const Joint& joint) {
    return std::all_of(joint.axes.begin() + 3, joint.axes.end(), isPlain);
}

void addOpen(std::vector<Coordinate>& all, CoordinateKind kind, const Vec3& axis, const JointAxis& use) {
    if (use.mode != AxisMode::Locked) all.push_back({kind, axis, &use});
}

/// Travels along A's axes, then B's swings, then its twist, which is about the axis that the swings have moved.
std::vector<Coordinate> sixDof(const adapter::Link& link, const adapter::Scenario& scenario,
                               const Joint& joint) {
    const auto axes = adapter::sixDofAxesIn(link, scenario, joint);
    std::vector<Coordinate> all;
    for (std::size_t k = 0; k < 3; ++k)
        if (!adapter::isHeld(joint.axes[k])) all.push_back({CoordinateKind::Travel, axes[k], &joint.axes[k]});
    if (turnsFreely(joint)) {
        all.push_back({CoordinateKind::Ball, {}, nullptr});
        return all;
    }
    for (const std::size_t k : {1, 2, 0})
        if (!adapter::isHeld(joint.axes[3 + k]))
            all.push_back({CoordinateKind::Turn, axes[k], &joint.axes[3 + k]});
    return all;
}

/// Product of the turns, and where their axes are once all have turned, in the axes of what they turn.
Eigen::Matrix3Xd axesAfter(const std::vector<Vec3>& axes, const std::vector<double>& angles) {
    Eigen::Matrix3Xd out(3, static_cast<Eigen::Index>(axes.size()));
    Eigen::Matrix3d after = Eigen::Matrix3d::Identity();
    for (std::size_t k = axes.size(); k-- > 0;) {
        out.col(static_cast<Eigen::Index>(k)) = after.transpose() * toDart(axes[k]);
        after = Eigen::AngleAxisd(angles[k], toDart(axes[k])).toRotationMatrix() * after;
    }
    return out;
}

}  // namespace

std::vector<Coordinate> coordinatesOf(const adapter::Link& link, const adapter::Scenario& scenario,
                                      bool planar) {
    const Joint& joint = scenario.joints[link.joint];
    const Vec3 axis = axisIn(link, joint);
    std::vector<Coordinate> all;
    switch (joint.type) {
        case JointType::Fixed:
            break;
        case JointType::Ball:
            if (planar)
                addOpen(all, CoordinateKind::Turn, {0.0, 0.0, 1.0}, joint.axes[0]);
            else if (joint.axes[0].mode != AxisMode::Locked)
                all.push_back({CoordinateKind::Ball, {}, nullptr});
            break;
        case JointType::Hinge:
            addOpen(all, CoordinateKind::Turn, planar ? Vec3{0.0, 0.0, 1.0} : axis, joint.axes[0]);
            break;
        case JointType::Slider:
            addOpen(all, CoordinateKind::Travel, axis, joint.axes[0]);
            break;
        case JointType::Wheel:
            addOpen(all, CoordinateKind::Travel, axis, joint.axes[0]);
            addOpen(all, CoordinateKind::Turn, spinIn(link, scenario, joint), joint.axes[1]);
            break;
        case JointType::SixDof:
            all = sixDof(link, scenario, joint);
            break;
        default:
            throw adapter::notInAdapter("dart", std::string("joint '") + jointName(joint.type) + "'",
                                        "joint '" + joint.name + "'");
    }
    // Seen from B, the last of A's coordinates comes first.
    if (link.reversed) std::reverse(all.begin(), all.end());
    return all;
}

bool hasEulerAngles(const Joint& joint) {
    return joint.type == JointType::SixDof && !adapter::isHeld(joint.axes[4]) &&
           !adapter::isHeld(joint.axes[5]) && !turnsFreely(joint);
}

/// R = R_u(alpha) R_v(beta) R_w(gamma) in the frame (u, v, w), w turned round where the frame is left-handed:
///     R = [ cb cg,  -cb sg,  sb;  ..., ..., -sa cb;  ..., ..., ca cb ],  with gamma = 0:  R_11 = ca, R_21 = sa
Angles anglesOf(const std::vector<Vec3>& axes, const Quat& turned, const Vec3& turn) {
    Angles out;
    if (axes.size() == 1) {
        out.angles = {2.0 * std::atan2(dot(Vec3{turned.x, turned.y, turned.z}, axes[0]), turned.w)};
    } else {
        const Vec3 w = cross(axes[0], axes[1]);
        Eigen::Matrix3d frame;
        frame << toDart(axes[0]), toDart(axes[1]), toDart(w);
        const Eigen::Matrix3d R = frame.transpose() * toDart(Pose{{}, turned}).linear() * frame;
        const bool both = axes.size() == 2;
        const double beta = both ? std::atan2(R(0, 2), R(0, 0)) : std::asin(std::clamp(R(0, 2), -1.0, 1.0));
        out.angles = {both ? std::atan2(R(2, 1), R(1, 1)) : std::atan2(-R(1, 2), R(2, 2)), beta};
        if (!both) out.angles.push_back(std::copysign(1.0, dot(w, axes[2])) * std::atan2(-R(0, 1), R(0, 0)));
    }
    const Eigen::VectorXd rates = axesAfter(axes, out.angles).colPivHouseholderQr().solve(toDart(turn));
    out.rates.assign(rates.data(), rates.data() + rates.size());
    return out;
}

}  // namespace rigor::dart_adapter
