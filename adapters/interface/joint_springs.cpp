// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The projection is Gram-Schmidt in the product of M^-1; rows that are held already by others are dropped.
#include "adapters/interface/joint_springs.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "adapters/interface/inverse.hpp"

namespace rigor::adapter {
namespace {

using scenario::AxisMode;
using scenario::Body;
using scenario::Joint;
using scenario::JointType;

/// Jacobian row of a coordinate: u = lin.(vB - vA) + angA.wA + angB.wB, world frame.
struct Row {
    Vec3 lin, angA, angB;
};
Row combined(const Row& row, double scale, const Row& other) {
    return {row.lin + scale * other.lin, row.angA + scale * other.angA, row.angB + scale * other.angB};
}

/// One side of a joint: centre of mass, inverse mass and inertia in the world.
struct Side {
    Pose pose;
    Vec3 center;
    double inverseMass = 0.0;
    Mat3 inverseInertia;
};
Side sideOf(const Scenario& scenario, int index) {
    Side side;
    if (index == scenario::kNone) return side;
    const Body& body = scenario.bodies[index];
    side.pose = body.pose;
    side.center = body.pose * body.massProperties.centerOfMass;
    if (body.type != scenario::BodyType::Dynamic) return side;
    side.inverseMass = 1.0 / body.massProperties.mass;
    if (scenario.dimension == 2) {
        side.inverseInertia = Mat3::diagonal(0.0, 0.0, 1.0 / body.massProperties.inertia(2, 2));
        return side;
    }
    const Mat3 axes = toMatrix(body.pose.orientation);
    side.inverseInertia = axes * inverseOf(body.massProperties.inertia) * transpose(axes);
    return side;
}

Vec3 anyNormalOf(const Vec3& n) {
    const Vec3 other = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 side = other - dot(other, n) * n;
    return side / norm(side);
}

/// Rows of a joint's coordinates at the initial poses, and of what it locks.
class Rows {
  public:
    Rows(const Scenario& scenario, const Joint& joint)
        : joint_(joint),
          isFlat_(scenario.dimension == 2),
          a_(sideOf(scenario, joint.bodyA)),
          b_(sideOf(scenario, joint.bodyB)) {
        anchorA_ = a_.pose * joint.anchorA;
        anchorB_ = b_.pose * joint.anchorB;
        axis_ = rotate(a_.pose.orientation, joint.axisA);
        const bool hasNormal = joint.type == JointType::SixDof && !isFlat_;
        normal_ = hasNormal ? rotate(a_.pose.orientation, joint.normalA) : anyNormalOf(axis_);
        if (isFlat_) normal_ = {-axis_.y, axis_.x, 0.0};
        third_ = cross(axis_, normal_);
    }

    const Side& a() const { return a_; }
    const Side& b() const { return b_; }

    Row coordinate(std::size_t k) const {
        switch (joint_.type) {
            case JointType::Distance: {
                const Vec3 d = anchorB_ - anchorA_;
                const Vec3 u = norm(d) > 0.0 ? d / norm(d) : Vec3{1, 0, 0};
                return {u, -cross(anchorA_ - a_.center, u), cross(anchorB_ - b_.center, u)};
            }
            case JointType::Slider:
                return travel(axis_);
            case JointType::Wheel:
                return k == 0 ? travel(axis_) : turn(spin());
            case JointType::SixDof:
                return sixDof(k);
            case JointType::Ball:
                return turn(normal_);
            case JointType::ConeTwist:
                return turn(k == 0 ? axis_ : normal_);
            case JointType::Hinge:
            case JointType::Fixed:
                break;
        }
        return turn(isFlat_ ? Vec3{0, 0, 1} : axis_);
    }

    std::vector<Row> held() const {
        std::vector<Row> rows;
        const auto hold = [&](std::initializer_list<Row> more) { rows.insert(rows.end(), more); };
        switch (joint_.type) {
            case JointType::Distance:
                break;
            case JointType::Ball:
            case JointType::ConeTwist:
                hold({travel(axis_), travel(normal_), travel(third_)});
                break;
            case JointType::Hinge:
                hold({travel({1, 0, 0}), travel({0, 1, 0}), travel({0, 0, 1})});
                if (!isFlat_) hold({turn(normal_), turn(third_)});
                break;
            case JointType::Fixed:
                hold({travel(axis_), travel(normal_), travel(third_), turn(axis_), turn(normal_),
                      turn(third_)});
                break;
            case JointType::Slider:
                hold({travel(normal_), travel(third_), turn(axis_), turn(normal_), turn(third_)});
                break;
            case JointType::Wheel: {
                const Vec3 n = anyNormalOf(spin());
                hold({travel(normal_), travel(third_)});
                if (!isFlat_) hold({turn(n), turn(cross(spin(), n))});
                break;
            }
            case JointType::SixDof:
                for (std::size_t k = 0; k < (isFlat_ ? 3u : 6u); ++k)
                    if (isLocked(joint_.axes[k])) rows.push_back(sixDof(k));
                break;
        }
        return rows;
    }

  private:
    static bool isLocked(const scenario::JointAxis& axis) {
        const bool locked = axis.mode == AxisMode::Locked || axis.mode == AxisMode::Usual;
        return locked && !axis.hasMotor() && !axis.hasSpring();
    }
    Row travel(const Vec3& t) const {
        return {t, -cross(anchorB_ - a_.center, t), cross(anchorB_ - b_.center, t)};
    }
    static Row turn(const Vec3& n) { return {{}, -n, n}; }
    Vec3 spin() const { return isFlat_ ? Vec3{0, 0, 1} : rotate(b_.pose.orientation, joint_.spinAxisB); }
    Row sixDof(std::size_t k) const {
        const Vec3 directions[] = {axis_, normal_, third_};
        if (isFlat_) return k < 2 ? travel(directions[k]) : turn({0, 0, 1});
        return k < 3 ? travel(directions[k]) : turn(directions[k - 3]);
    }

    const Joint& joint_;
    bool isFlat_;
    Side a_, b_;
    Vec3 anchorA_, anchorB_;      ///< world
    Vec3 axis_, normal_, third_;  ///< unit axes of the joint, world frame
};

}  // namespace

double effectiveMass(const Scenario& scenario, const Joint& joint, std::size_t k) {
    const Rows rows(scenario, joint);
    const auto product = [&](const Row& p, const Row& q) {
        return (rows.a().inverseMass + rows.b().inverseMass) * dot(p.lin, q.lin) +
               dot(p.angA, rows.a().inverseInertia * q.angA) + dot(p.angB, rows.b().inverseInertia * q.angB);
    };
    std::vector<Row> basis;  // orthogonal in the product
    const auto reduced = [&](Row row) {
        for (int pass = 0; pass < 2; ++pass)
            for (const Row& known : basis)
                row = combined(row, -product(row, known) / product(known, known), known);
        return row;
    };
    for (const Row& row : rows.held()) {
        const Row rest = reduced(row);
        if (product(rest, rest) > 1e-12 * product(row, row)) basis.push_back(rest);
    }
    const Row coordinate = rows.coordinate(k);
    const Row rest = reduced(coordinate);
    const double mobility = product(rest, rest);
    return mobility > 1e-12 * product(coordinate, coordinate) ? 1.0 / mobility : 0.0;
}

Scenario withStiffness(Scenario scenario) {
    for (Joint& joint : scenario.joints)
        for (std::size_t k = 0; k < joint.axes.size(); ++k) {
            scenario::JointAxis& axis = joint.axes[k];
            if (axis.frequency <= 0.0) continue;
            const double mass = effectiveMass(scenario, joint, k);
            const double omega = 2.0 * std::numbers::pi * axis.frequency;
            axis.stiffness = mass * omega * omega;
            axis.damping = 2.0 * axis.dampingRatio * mass * omega;
        }
    for (Joint& joint : scenario.joints)
        for (scenario::JointAxis& axis : joint.axes) {
            axis.frequency = 0.0;
            axis.dampingRatio = 0.0;
        }
    return scenario;
}

}  // namespace rigor::adapter
