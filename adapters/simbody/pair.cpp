// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rates. With x the axis in A, b that in B, n = x x b / |x x b|, phi the angle between them, w = w_B - w_A and e = n x x:
//     twist    its rate is (x + b) . w / (1 + x . b)
//     swing    phi' = n . w
//     part of the swing along t, s = phi n:  (s . t)' = (t + (phi cot(phi) - 1)(t . e) e - phi (t . e) x) . w
#include "adapters/simbody/pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigor::simbody {

using scenario::AxisMode;
using scenario::Joint;
using scenario::JointAxis;
using scenario::JointType;
using SimTK::SpatialVec;

namespace {

SimTK::Vec3 anyNormalOf(const SimTK::Vec3& axis) {
    return SimTK::Vec3(SimTK::UnitVec3(axis).perp());
}

}  // namespace

/// The axes of both bodies in the common frame.
struct PairCoordinate::Turned {
    SimTK::Vec3 x, y, z, b, across, n;
    double sine, cosine, angle;

    Turned(const PairCoordinate& of, const Poses& at)
        : x(at.a.R() * of.x_),
          y(at.a.R() * of.y_),
          z(at.a.R() * of.z_),
          b(at.b.R() * of.axisB_),
          across(x % b),
          n(y),
          sine(across.norm()),
          cosine(SimTK::dot(x, b)),
          angle(std::atan2(sine, cosine)) {
        if (sine > std::numeric_limits<double>::min()) n = across / sine;
    }
};

PairCoordinate::PairCoordinate(PairKind kind, const Sides& sides, const Vec3& axis)
    : PairCoordinate(kind, sides, axis, fromSimbody(anyNormalOf(toSimbody(axis)))) {}

PairCoordinate::PairCoordinate(PairKind kind, const Sides& sides, const Vec3& axis, const Vec3& normal)
    : kind_(kind),
      a_(sides.a.body),
      b_(sides.b.body),
      anchorA_(toSimbody(sides.a.pose * sides.joint.anchorA)),
      anchorB_(toSimbody(sides.b.pose * sides.joint.anchorB)),
      x_(toSimbody(rotate(sides.a.pose.orientation, axis))),
      y_(toSimbody(rotate(sides.a.pose.orientation, normal))),
      z_(x_ % y_),
      axisB_(toSimbody(rotate(sides.b.pose.orientation, rotateInverse(sides.relative, axis)))),
      sideB_(toSimbody(rotate(sides.b.pose.orientation, rotateInverse(sides.relative, normal)))) {}

double PairCoordinate::value(const Poses& at) const {
    const SimTK::Vec3 span = at.b * anchorB_ - at.a * anchorA_;
    if (kind_ == PairKind::Length) return span.norm();
    const Turned t(*this, at);
    if (kind_ == PairKind::Travel) return SimTK::dot(t.x, span);
    if (kind_ == PairKind::Swing) return t.angle;
    if (kind_ == PairKind::Turn) {
        const SimTK::Vec3 side = at.b.R() * sideB_;
        const SimTK::Vec3 back =
            t.cosine * side - t.sine * (t.n % side) + (1.0 - t.cosine) * SimTK::dot(t.n, side) * t.n;
        return std::atan2(SimTK::dot(back, t.z), SimTK::dot(back, t.y));
    }
    return t.angle * SimTK::dot(t.n, kind_ == PairKind::SwingY ? t.y : t.z);
}

/// Direction of the relative angular velocity that changes an angle.
SimTK::Vec3 PairCoordinate::direction(const Turned& t) const {
    constexpr double kSmallest = 1e-12;
    if (kind_ == PairKind::Turn) return (t.x + t.b) / std::max(1.0 + t.cosine, kSmallest);
    if (kind_ == PairKind::Swing) return t.sine > 0.0 ? t.n : SimTK::Vec3(0);
    const SimTK::Vec3& along = kind_ == PairKind::SwingY ? t.y : t.z;
    if (t.sine < kSmallest) return along;
    const SimTK::Vec3 e = t.n % t.x;
    const double part = SimTK::dot(along, e);
    return along + (t.angle * t.cosine / t.sine - 1.0) * part * e - t.angle * part * t.x;
}

PairCoordinate::Motions PairCoordinate::gradient(const Poses& at) const {
    const SimTK::Vec3 end = at.b * anchorB_;
    // A force acts on A at A's anchor where it acts between the anchors, else where B's anchor is.
    const auto pull = [&](const SimTK::Vec3& along, const SimTK::Vec3& onA) {
        return Motions{SpatialVec(-(onA - at.a.p()) % along, -along),
                       SpatialVec((end - at.b.p()) % along, along)};
    };
    const SimTK::Vec3 zero(0);
    if (kind_ == PairKind::Length) {
        const SimTK::Vec3 begin = at.a * anchorA_, span = end - begin;
        const double length = span.norm();
        return pull(length > 0.0 ? SimTK::Vec3(span / length) : zero, begin);
    }
    if (kind_ == PairKind::Travel) return pull(at.a.R() * x_, end);
    const SimTK::Vec3 about = direction(Turned(*this, at));
    return {SpatialVec(-about, zero), SpatialVec(about, zero)};
}

/// A difference of the gradients at two near poses of the motion that has these velocities.
double PairCoordinate::bias(const Poses& at, const Motions& motions) const {
    const double fastest =
        std::max({1.0, motions.a[0].norm(), motions.b[0].norm(), motions.a[1].norm(), motions.b[1].norm()});
    const double time = 1e-5 / fastest;
    const auto rateAfter = [&](double t) {
        const auto moved = [t](const SimTK::Transform& pose, const SpatialVec& motion) {
            const double angle = t * motion[0].norm();
            SimTK::Rotation turn;
            if (angle != 0.0) turn = SimTK::Rotation(angle, SimTK::UnitVec3((t / angle) * motion[0]));
            return SimTK::Transform(turn * pose.R(), pose.p() + t * motion[1]);
        };
        return product(gradient({moved(at.a, motions.a), moved(at.b, motions.b)}), motions);
    };
    return (rateAfter(time) - rateAfter(-time)) / (2.0 * time);
}

bool isOpen(const JointAxis& axis) {
    return axis.mode != AxisMode::Locked && axis.mode != AxisMode::Usual;
}

int openAngles(const Joint& joint) {
    return static_cast<int>(std::count_if(joint.axes.begin() + 3, joint.axes.end(), isOpen));
}

namespace {

void addSixDof(const Sides& sides, bool inTree, std::vector<Driven>& all) {
    const Joint& joint = sides.joint;
    const Vec3 axes[] = {joint.axisA, joint.normalA, cross(joint.axisA, joint.normalA)};
    const bool several = openAngles(joint) > 1;
    for (std::size_t k = 0; k < 6; ++k) {
        const JointAxis& use = joint.axes[k];
        if (!isOpen(use) || (inTree && (k < 3 || !several))) continue;
        if (k < 3)
            all.push_back({{PairKind::Travel, sides, axes[k]}, use});
        else if (k == 3 || !several)
            all.push_back({{PairKind::Turn, sides, axes[k - 3]}, use});
        else
            all.push_back(
                {{k == 4 ? PairKind::SwingY : PairKind::SwingZ, sides, joint.axisA, joint.normalA}, use});
    }
}

}  // namespace

std::vector<Driven> drivenCoordinates(const Sides& sides, bool inTree) {
    const Joint& joint = sides.joint;
    const auto& use = joint.axes;
    const auto isFree = [&](std::size_t k) { return use[k].mode != AxisMode::Locked; };
    const Vec3 spin = rotate(sides.relative, joint.spinAxisB);
    std::vector<Driven> all;
    const auto add = [&](std::size_t k, PairKind kind, const Vec3& axis) {
        if (isFree(k)) all.push_back({{kind, sides, axis}, use[k]});
    };
    switch (joint.type) {
        case JointType::Fixed:
            break;
        case JointType::Distance:
            if (isOpen(use[0])) add(0, PairKind::Length, {1, 0, 0});
            break;
        case JointType::Ball:
            add(0, PairKind::Swing, joint.axisA);
            break;
        case JointType::ConeTwist:
            // A tree has a pin where the swing is locked.
            if (isFree(1) || !inTree) add(0, PairKind::Turn, joint.axisA);
            add(1, PairKind::Swing, joint.axisA);
            break;
        case JointType::SixDof:
            addSixDof(sides, inTree, all);
            break;
        case JointType::Hinge:
            if (!inTree) add(0, PairKind::Turn, sides.planar ? Vec3{0, 0, 1} : joint.axisA);
            break;
        case JointType::Slider:
        case JointType::Wheel:
            if (inTree) break;
            add(0, PairKind::Travel, joint.axisA);
            if (joint.type == JointType::Wheel) add(1, PairKind::Turn, spin);
            break;
    }
    std::erase_if(all, [](const Driven& d) { return !d.use.hasSpring() && !d.use.hasMotor(); });
    return all;
}

}  // namespace rigor::simbody
