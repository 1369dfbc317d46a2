// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/live/scene_now.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/metrics/joint_coordinates.hpp"

namespace rigor::validation {
namespace {

using adapter::BodyState;
using namespace scenario;

constexpr double kStill = 1e-6;  ///< [m] or [rad]: a coordinate this near to zero has not moved

Pose poseNow(std::span<const BodyState> states, int body) {
    if (body == kNone) return {};
    const BodyState& s = states[body];
    return {s.position, normalized(s.orientation)};
}

bool isBounded(const JointAxis& axis) {
    return axis.mode == AxisMode::Limited || axis.hasSpring();
}

/// Limits and target of a coordinate that stands at `by` and is counted from there.
void shift(JointAxis& axis, double by) {
    constexpr double kNever = 1e299;
    if (std::abs(axis.lower) < kNever) axis.lower -= by;
    if (std::abs(axis.upper) < kNever) axis.upper -= by;
    axis.target -= by;
}

/// A cone counts its angle from the axis, which is one world direction at the start: it can not be shifted.
bool isCone(const Joint& joint, std::size_t k) {
    return joint.type == JointType::Ball || (joint.type == JointType::ConeTwist && k == 1);
}

class Rewriter {
  public:
    Rewriter(const Scenario& from, const Moment& moment) : from_(from), moment_(moment) {
        out_.scenario = from;
    }

    SceneNow run() {
        Scenario& s = out_.scenario;
        for (std::size_t i = 0; i < s.bodies.size(); ++i) place(s.bodies[i], i);
        rewriteJoints();
        rewriteForces();
        rewriteEvents();
        if (s.reference)
            note("the reference '" + s.reference->name + "' is that of the scenario's own start");
        if (!s.accept.empty() || !s.knownDeviations.empty())
            note("bounds were set for the scenario's own start");
        s.reference.reset();
        s.accept.clear();
        s.knownDeviations.clear();
        s.metrics.clear();
        const double left = s.duration - now();
        if (left >= moment_.dt)
            s.duration = left;
        else if (moment_.steps > 0)
            note("the scenario's duration was over: it lasts as long again");
        s.timeSteps = {moment_.dt};
        return std::move(out_);
    }

  private:
    double now() const { return moment_.steps * moment_.dt; }
    void note(std::string text) { out_.notes.push_back(std::move(text)); }

    void place(Body& body, int index) {
        if (body.type == BodyType::Static) return;
        const BodyState& state = moment_.states[index];
        body.pose = poseNow(moment_.states, index);
        body.velocity = state.velocity;
        body.angularVelocity = state.angularVelocity;
    }

    void rewriteJoints() {
        std::vector<Joint> kept;
        for (std::size_t j = 0; j < from_.joints.size(); ++j) {
            if (j < moment_.holds.size() && !moment_.holds[j]) {
                note("joint " + from_.joints[j].name + " has broken and is left out");
                continue;
            }
            kept.push_back(from_.joints[j]);
            rewrite(kept.back(), j);
        }
        out_.scenario.joints = std::move(kept);
    }

    void rewrite(Joint& joint, std::size_t index) {
        const Pose a = poseNow(moment_.states, joint.bodyA), b = poseNow(moment_.states, joint.bodyB);
        const Vec3 onB = b * joint.anchorB;
        if (joint.type == JointType::Distance) {  // its length is no change since the start
            const bool rod = joint.axes[0].mode == AxisMode::Usual || joint.axes[0].mode == AxisMode::Locked;
            if (rod) joint.length = norm(onB - a * joint.anchorA);
            return;
        }
        for (std::size_t k = 0; const char* name = jointAxisName(joint.type, from_.dimension, k); ++k) {
            if (!isBounded(joint.axes[k])) continue;
            const double at = moment_.coordinates->value(index, k);
            if (isCone(joint, k) ? at > kStill : std::isnan(at))
                note("joint " + joint.name + ": " + name + " is counted from its present place");
            else if (!isCone(joint, k))
                shift(joint.axes[k], at);
        }
        // A's anchor of a sliding joint follows B's: along the axis only, except for the drift of the joint.
        joint.anchorA = inverse(a) * onB;
        // The loader makes B's axes of A's and the poses: the same directions as long as the joint holds.
        joint.axisB = rotateInverse(b.orientation, rotate(a.orientation, joint.axisA));
    }

    void rewriteForces() {
        std::vector<Force> kept;
        for (Force force : from_.forces) {
            if (auto* f = std::get_if<ConstantForce>(&force)) {
                if (f->end <= now()) continue;
                f->start = std::max(0.0, f->start - now());
                if (f->end < 1e299) f->end -= now();
            }
            kept.push_back(force);
        }
        out_.scenario.forces = std::move(kept);
    }

    /// The rule of applyForces: an event belongs to the first step that starts at or after it.
    void rewriteEvents() {
        std::vector<Event> kept;
        const double slack = 1e-9 * moment_.dt;
        for (Event event : from_.events) {
            if (moment_.steps > 0 && event.time <= now() - moment_.dt + slack) continue;
            event.time = std::max(0.0, event.time - now());
            kept.push_back(event);
        }
        out_.scenario.events = std::move(kept);
    }

    const Scenario& from_;
    const Moment& moment_;
    SceneNow out_;
};

}  // namespace

JointCoordinates::JointCoordinates(const Scenario& scenario)
    : scenario_(&scenario), values_(scenario.joints.size() * kMaxJointAxes, 0.0) {
    std::vector<BodyState> start;
    for (const Body& b : scenario.bodies) start.push_back({b.pose.position, b.pose.orientation, {}, {}});
    follow(start);
}

void JointCoordinates::follow(std::span<const BodyState> states) {
    for (std::size_t j = 0; j < scenario_->joints.size(); ++j) {
        const Joint& joint = scenario_->joints[j];
        const Pose a = poseNow(states, joint.bodyA), b = poseNow(states, joint.bodyB);
        for (std::size_t k = 0; k < kMaxJointAxes; ++k) {
            double& value = values_[j * kMaxJointAxes + k];
            const auto at = jointCoordinate(*scenario_, joint, k, a, b);
            value =
                at ? at->after(std::isnan(value) ? 0.0 : value) : std::numeric_limits<double>::quiet_NaN();
        }
    }
}

SceneNow sceneNow(const Scenario& scenario, const Moment& moment) {
    return Rewriter(scenario, moment).run();
}

}  // namespace rigor::validation
