// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Physical pendulum: a rigid body on a hinge, any axis; gravity across the axis counts. With I about the axis
// and d the distance of the centre of mass from it, W^2 = m g d/I in the pendulum's equation (swing.hpp).
// Source: Whittaker, Analytical Dynamics, 1937, section 44. Stops: at the first limit of its angle (of a ball
// or cone-twist joint: of its swing) the body loses its speed, and stays where gravity pushes it on; where it
// swings back instead, the solution ends. Assumes: a hinge (2D: also a ball joint) to a fixed point, initial
// motion about its axis, nothing else; on a ball or cone-twist joint with a limit, motion about the
// horizontal across the arm, a principal axis. Quantities: period (mean over the passages through the lowest
// point), amplitude.
#include <algorithm>
#include <cmath>

#include "validation/references/joints/joint_parts.hpp"
#include "validation/references/joints/swing.hpp"

namespace rigor::validation {
namespace {

class PhysicalPendulum : public Reference {
  public:
    PhysicalPendulum(const Scenario& scenario, int index, int jointIndex)
        : duration_(scenario.duration),
          index_(index),
          body_(scenario.bodies[index]),
          hinge_(fixedJoint(scenario, jointIndex, index, true)) {
        const auto type = hinge_.joint->type;
        const bool swings = scenario.dimension == 3 && hinge_.joint->features().size() == 1 &&
                            (type == scenario::JointType::Ball || type == scenario::JointType::ConeTwist);
        require(type == scenario::JointType::Hinge || swings ||
                    (scenario.dimension == 2 && type == scenario::JointType::Ball),
                "joint '" + hinge_.joint->name + "' is not a hinge");
        if (swings) setSwingAxis(scenario);
        requireOnlyJoints(scenario, index, {hinge_.joint});
        requireTurnsAbout(scenario, index, hinge_.anchor);
        const Vec3 a = hinge_.axis, w = body_.angularVelocity;
        require(norm(w - dot(w, a) * a) <= 1e-9 * norm(w),
                bodyTitle(scenario, index) + " spins across the axis of its hinge");
        rate0_ = dot(w, a);
        const Vec3 arm = centerOfMass(body_) - hinge_.anchor, g = gravityOn(scenario, index);
        along_ = dot(arm, a) * a;
        across_ = arm - along_;
        const Vec3 pull = g - dot(g, a) * a;
        const double m = body_.massProperties.mass, d = norm(across_);
        const double moment = dot(a, worldInertia(body_) * a) + m * d * d;
        // Gravity along the axis, or through it: nothing drives the rotation.
        swing_ = Swing(0, 0.0, rate0_);
        if (negligible(norm(pull), norm(g)) || d == 0.0) return;
        down_ = unit(pull);
        angle0_ = angleOf(across_);
        swing_ = Swing(std::sqrt(m * norm(pull) * d / moment), angle0_, rate0_);
        findStop(swings, runEnd(scenario));
    }
    std::vector<int> bodies() const override { return {index_}; }
    double validUntil() const override { return stays_ ? 1e300 : stop_; }

    PartialState exact(int, double t) const override {
        auto [angle, rate] = swing_.at(std::min(t, stop_));
        if (t >= stop_) rate = 0;
        const auto turn = static_cast<double>(angle - angle0_);
        const Quat q = scenario::fromAxisAngle(hinge_.axis, turn);
        const Vec3 arm = along_ + rotate(q, across_), w = static_cast<double>(rate) * hinge_.axis;
        return stateOf(body_, hinge_.anchor + arm, scenario::normalized(q * body_.pose.orientation),
                       cross(w, arm), w);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        const auto m = swing_.parameter(), period = swing_.period();
        if (swing_.frequency() == 0 || m == 0 || m == 1 || stop_ < duration_) return result;
        if (swing_.firstPassage() + period <= duration_) {
            Quantity q{"period", "s", static_cast<double>(period), {}, 0.0, {}};
            q.measure = [this](const Trajectory& run) { return meanPeriod(run); };
            result.push_back(std::move(q));
        }
        if (m < 1 && period <= duration_) {
            Quantity q{"amplitude", "rad", static_cast<double>(swing_.amplitude()), {}, 0.0, {}};
            q.measure = [this](const Trajectory& run) { return largestAngle(run); };
            result.push_back(std::move(q));
        }
        return result;
    }

  private:
    /// A cone limits motion about the horizontal across the arm as a stop of a hinge there.
    void setSwingAxis(const Scenario& scenario) {
        const Vec3 arm = centerOfMass(body_) - hinge_.anchor, cone = hinge_.axis;
        const Vec3 a = unit(cross(arm, gravityOn(scenario, index_)));
        require(a != Vec3{}, bodyTitle(scenario, index_) + " hangs straight down from its joint");
        hinge_.axis = a;
        const Mat3 I = worldInertia(body_);
        require(norm(cross(I * a, a)) <= 1e-9 * norm(I * a) && std::abs(dot(cone, a)) <= 1e-9,
                bodyTitle(scenario, index_) + " does not swing in a plane that its joint's axis is in");
    }

    void findStop(bool swings, double end) {
        const auto& joint = *hinge_.joint;
        const auto& axis = joint.axes[joint.type == scenario::JointType::ConeTwist ? 1 : 0];
        if (axis.mode != scenario::AxisMode::Limited) return;
        // The joint's angle grows with B's turn against A; a cone has the same angle on both sides.
        const bool isB = joint.bodyB == index_;
        const double upper = isB || swings ? axis.upper : -axis.lower;
        const double lower = swings ? -axis.upper : isB ? axis.lower : -axis.upper;
        const auto beyond = [&](double t) {
            const auto q = static_cast<double>(swing_.at(t).angle - angle0_);
            return std::max(q - upper, lower - q);
        };
        require(beyond(0.0) <= 1e-12, "joint '" + joint.name + "' starts beyond its limits");
        const int points = 20000;  // the fastest swing of a run of 1000 steps moves little between them
        for (int i = 1; i <= points && stop_ > 1e299; ++i) {
            if (beyond(end * i / points) <= 0.0) continue;
            double low = end * (i - 1) / points, high = end * i / points;
            for (int k = 0; k < 80; ++k) {
                const double middle = 0.5 * (low + high);
                (beyond(middle) > 0.0 ? high : low) = middle;
            }
            stop_ = high;
        }
        if (stop_ > 1e299) return;
        const auto [angle, rate] = swing_.at(stop_);
        stays_ = -std::sin(angle) * rate >= 0;
    }

    double angleOf(Vec3 arm) const {
        return std::atan2(dot(hinge_.axis, cross(down_, arm)), dot(down_, arm));
    }

    double angleIn(const Trajectory& run, std::size_t k) const {
        const Vec3 arm = centerOfMass(body_, run.state(k, index_)) - hinge_.anchor;
        return angleOf(arm - dot(arm, hinge_.axis) * hinge_.axis);
    }
    double rateIn(const Trajectory& run, std::size_t k) const {
        return dot(run.state(k, index_).angularVelocity, hinge_.axis);
    }

    std::optional<double> meanPeriod(const Trajectory& run) const {
        const double sign = swing_.parameter() > 1 && rate0_ < 0 ? -1.0 : 1.0;
        std::optional<double> first, last;
        int count = 0;
        for (std::size_t k = 0; k + 1 < run.frames(); ++k) {
            const double a = sign * angleIn(run, k), b = sign * angleIn(run, k + 1);
            if (!(a < 0.0 && b >= 0.0 && b - a < 3.0)) continue;
            const auto time = upwardCrossing(
                run, k, [&](std::size_t i) { return sign * angleIn(run, i); },
                [&](std::size_t i) { return sign * rateIn(run, i); });
            if (!time) return std::nullopt;
            if (!first) first = time;
            last = time;
            ++count;
        }
        if (count < 2) return std::nullopt;
        return (*last - *first) / (count - 1);
    }

    /// Largest turning point: near the top of an arc cos(th_max) = cos(th) - th'^2/(2 W^2).
    std::optional<double> largestAngle(const Trajectory& run) const {
        std::optional<double> largest;
        const auto W2 = static_cast<double>(swing_.frequency() * swing_.frequency());
        for (std::size_t k = 0; k < run.frames(); ++k) {
            const double angle = std::abs(angleIn(run, k)), rate = rateIn(run, k);
            if (!(rate * rate < 0.1 * W2 * std::sin(angle))) continue;
            const double top = std::acos(std::max(-1.0, std::cos(angle) - 0.5 * rate * rate / W2));
            if (!largest || top > *largest) largest = top;
        }
        return largest;
    }

    double duration_;
    int index_;
    const Body& body_;
    FixedJoint hinge_;
    Vec3 along_, across_, down_;
    double angle0_ = 0.0, rate0_ = 0.0;
    double stop_ = 1e300;  ///< time when it reaches a limit [s]
    bool stays_ = true;    ///< true if gravity holds it there
    Swing swing_;
};

}  // namespace

std::unique_ptr<Reference> makePhysicalPendulum(const Scenario& scenario,
                                                const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "joint"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<PhysicalPendulum>(scenario, body, parts.joint("joint", body));
}

}  // namespace rigor::validation
