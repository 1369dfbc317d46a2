// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/joint_trees.hpp"

#include <cmath>
#include <deque>
#include <numbers>
#include <numeric>

#include "adapters/interface/principal_axes.hpp"

namespace rigor::adapter {
namespace {

using scenario::Body;
using scenario::BodyType;
using scenario::Joint;
using scenario::JointType;

/// The engine's frame of a body and its moments there.
void setFrame(const Body& body, bool planar, Link& link) {
    link.frame.position = body.massProperties.centerOfMass;
    const Mat3& inertia = body.massProperties.inertia;
    link.moments = {inertia(0, 0), inertia(1, 1), inertia(2, 2)};
    if (body.type != BodyType::Dynamic || planar) return;
    const PrincipalAxes principal = principalAxes(inertia);
    link.frame.orientation = principal.axes;
    link.moments = principal.moments;
}

class Search {
  public:
    Search(const Scenario& scenario, bool planar) : scenario_(scenario), used_(scenario.joints.size()) {
        const int count = static_cast<int>(scenario.bodies.size());
        forest_.links.resize(scenario.bodies.size());
        seen_.resize(scenario.bodies.size());
        for (int i = 0; i < count; ++i) setFrame(scenario.bodies[i], planar, forest_.links[i]);
        chooseJoints();
        // The search begins at bodies that joints do not move, so that loops are closed as far away from it as possible.
        for (int i = 0; i < count; ++i) {
            forest_.links[i].fixed = scenario.bodies[i].type == BodyType::Static;
            if (!isDynamic(i)) visit(i);
        }
        queue_.push_back(kNone);
        run();
        for (int i = 0; i < count; ++i) {
            if (seen_[i]) continue;
            visit(i);
            run();
        }
        for (std::size_t j = 0; j < scenario.joints.size(); ++j)
            if (!used_[j] && isLink(scenario.joints[j]) &&
                (isDynamic(scenario.joints[j].bodyA) || isDynamic(scenario.joints[j].bodyB)))
                forest_.loops.push_back(static_cast<int>(j));
    }
    Forest take() { return std::move(forest_); }

  private:
    bool isDynamic(int body) const {
        return body != kNone && scenario_.bodies[body].type == BodyType::Dynamic;
    }
    static bool isLink(const Joint& joint) { return joint.type != JointType::Distance; }

    /// Marks the joints of the trees (Kruskal): those that can not close a loop first, the others by their order. What
    /// does not move by joints counts as one body.
    void chooseJoints() {
        const std::size_t ground = scenario_.bodies.size();
        std::vector<std::size_t> group(ground + 1);
        std::iota(group.begin(), group.end(), std::size_t{0});
        const auto groupOf = [&](int body) {
            auto at = isDynamic(body) ? static_cast<std::size_t>(body) : ground;
            while (group[at] != at) at = group[at] = group[group[at]];
            return at;
        };
        inTree_.assign(scenario_.joints.size(), false);
        for (const bool late : {false, true})
            for (std::size_t j = 0; j < scenario_.joints.size(); ++j) {
                const Joint& joint = scenario_.joints[j];
                if (!isLink(joint) || canBreak(joint) || canCloseLoop(joint) != late) continue;
                const std::size_t a = groupOf(joint.bodyA), b = groupOf(joint.bodyB);
                if (a == b) continue;
                group[a] = b;
                inTree_[j] = true;
            }
    }

    void visit(int body) {
        seen_[body] = true;
        Link& link = forest_.links[body];
        const Pose pose = scenario_.bodies[body].pose * link.frame;
        link.rest = pose;
        if (link.parent != kNone) {
            const Pose parent = scenario_.bodies[link.parent].pose * forest_.links[link.parent].frame;
            link.rest = inverse(parent) * pose;
            forest_.links[link.parent].children.push_back(body);
        }
        forest_.order.push_back(body);
        queue_.push_back(body);
    }
    void run() {
        while (!queue_.empty()) {
            const int at = queue_.front();
            queue_.pop_front();
            for (std::size_t j = 0; j < scenario_.joints.size(); ++j) {
                const Joint& joint = scenario_.joints[j];
                if (used_[j] || !inTree_[j] || (joint.bodyA != at && joint.bodyB != at)) continue;
                const int other = joint.bodyA == at ? joint.bodyB : joint.bodyA;
                if (!isDynamic(other) || seen_[other]) continue;
                used_[j] = true;
                Link& link = forest_.links[other];
                link.parent = at;
                link.joint = static_cast<int>(j);
                link.reversed = other == joint.bodyA;
                visit(other);
            }
        }
    }

    const Scenario& scenario_;
    std::vector<bool> used_, seen_, inTree_;
    std::deque<int> queue_;
    Forest forest_;
};

}  // namespace

bool canCloseLoop(const Joint& joint) {
    const scenario::JointAxis& axis = joint.axes[0];
    const bool plain = !axis.hasSpring() && !axis.hasMotor() && axis.mode != scenario::AxisMode::Limited;
    const bool turns = joint.type == JointType::Ball || joint.type == JointType::Hinge;
    if (turns && axis.mode == scenario::AxisMode::Locked) return false;
    return joint.type == JointType::Fixed || (turns && plain);
}

bool canBreak(const Joint& joint) {
    return joint.breakForce < 1e299 || joint.breakTorque < 1e299;
}

double swingLimit(const Joint& joint) {
    const bool cone = joint.type == JointType::ConeTwist;
    const scenario::JointAxis& swing = joint.axes[cone ? 1 : 0];
    const bool bounded = (cone || joint.type == JointType::Ball) && swing.mode == scenario::AxisMode::Limited;
    return bounded ? swing.upper : 1e300;
}

Forest spanningForest(const Scenario& scenario, bool planar) {
    return Search(scenario, planar).take();
}

LinkMotion motionOf(const Forest& forest, const Scenario& scenario, int body,
                    std::span<const BodyState> states) {
    const Link& link = forest.links[body];
    const BodyState& state = states[body];
    LinkMotion m;
    m.anchor = anchorIn(link, scenario.joints[link.joint]);
    m.pose = Pose{state.position, state.orientation} * link.frame;
    // Velocity of the parent's point that is at the child's anchor.
    Vec3 parentTurn, parentSpeed;
    if (link.parent != kNone) {
        const BodyState& of = states[link.parent];
        m.parent = Pose{of.position, of.orientation} * forest.links[link.parent].frame;
        parentTurn = of.angularVelocity;
        parentSpeed = of.velocity + cross(parentTurn, m.pose * m.anchor - m.parent.position);
    }
    m.speed =
        state.velocity + cross(state.angularVelocity, m.pose * m.anchor - m.pose.position) - parentSpeed;
    m.turn = rotateInverse(m.pose.orientation, state.angularVelocity - parentTurn);
    m.relative = inverse(m.parent) * m.pose;
    m.turned = conjugate(link.rest.orientation) * m.relative.orientation;
    if (m.turned.w < 0.0) m.turned = {-m.turned.w, -m.turned.x, -m.turned.y, -m.turned.z};
    return m;
}

/// The place s of the anchor in the axes of a reversed link changes by d/dt s = R^T v - w x s: v is the velocity of the
/// anchor against the parent, w the link's angular velocity against it, in the link's axes.
Travel travelOf(const Link& link, const LinkMotion& motion, const Vec3& axis) {
    if (!link.reversed) {
        const Vec3 along = rotate(link.rest.orientation, axis);
        const Vec3 moved = motion.relative * motion.anchor - link.rest * motion.anchor;
        return {dot(moved, along), dot(rotateInverse(motion.parent.orientation, motion.speed), along)};
    }
    const Vec3 moved = motion.anchor - inverse(motion.relative) * (link.rest * motion.anchor);
    const Vec3 speed = rotateInverse(motion.pose.orientation, motion.speed) - cross(motion.turn, moved);
    return {dot(moved, axis), dot(speed, axis)};
}

double nearestTurn(double angle, double now) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    return angle + kTurn * std::round((now - angle) / kTurn);
}

double turnAbout(const LinkMotion& motion, const Vec3& axis) {
    const Quat& q = motion.turned;
    return 2.0 * std::atan2(dot(Vec3{q.x, q.y, q.z}, axis), q.w);
}

Damping dampingOf(const Body& body, const Link& link, const BodyState& state, double dt) {
    const Quat axes = state.orientation * link.frame.orientation;
    const Vec3 turn = rotateInverse(axes, state.angularVelocity), &m = link.moments;
    const Vec3 momentum = rotate(axes, Vec3{m.x * turn.x, m.y * turn.y, m.z * turn.z});
    const double linear = (std::pow(body.linearVelocityKept, dt) - 1.0) / dt;
    const double angular = (std::pow(body.angularVelocityKept, dt) - 1.0) / dt;
    return {linear * body.massProperties.mass * state.velocity, angular * momentum};
}

Vec3 anchorIn(const Link& link, const Joint& joint) {
    return inverse(link.frame) * (link.reversed ? joint.anchorA : joint.anchorB);
}

Vec3 axisIn(const Link& link, const Joint& joint) {
    const Vec3 axis = rotateInverse(link.frame.orientation, link.reversed ? joint.axisA : joint.axisB);
    return link.reversed ? -axis : axis;
}

std::array<Vec3, 3> sixDofAxesIn(const Link& link, const Scenario& scenario, const Joint& joint) {
    const auto turnOf = [&](int body) {
        return body == kNone ? Quat{} : scenario.bodies[body].pose.orientation;
    };
    const Quat own = turnOf(link.reversed ? joint.bodyA : joint.bodyB) * link.frame.orientation;
    const Vec3 x = rotate(turnOf(joint.bodyA), joint.axisA), y = rotate(turnOf(joint.bodyA), joint.normalA);
    const double sign = link.reversed ? -1.0 : 1.0;
    return {sign * rotateInverse(own, x), sign * rotateInverse(own, y),
            sign * rotateInverse(own, cross(x, y))};
}

Vec3 spinIn(const Link& link, const Scenario& scenario, const Joint& joint) {
    if (!link.reversed) return rotateInverse(link.frame.orientation, joint.spinAxisB);
    const auto turnOf = [&](int body) {
        return body == kNone ? Quat{} : scenario.bodies[body].pose.orientation;
    };
    const Vec3 world = rotate(turnOf(joint.bodyB), joint.spinAxisB);
    return -rotateInverse(turnOf(joint.bodyA) * link.frame.orientation, world);
}

}  // namespace rigor::adapter
