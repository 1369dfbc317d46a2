// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A body hangs at rest on a joint to the fixed world until the load on it is more than the joint bears:
//   reaction = -(m g + F(t)), torque about the joint's anchor = (com - anchor) x (m g + F(t));
// from the first time one of them exceeds break_force or break_torque, x'' = g + F(t)/m.
// Source: Newton 1687, second and third law.
// Assumes: a fixed joint, or a ball joint or hinge at the centre of mass, or a distance joint that the load
// draws straight at the centre of mass; constant forces only, each during its interval; at rest at the start.
// Quantities: break_time, where the joint breaks after the start.
#include <algorithm>
#include <cmath>

#include "validation/references/joints/joint_parts.hpp"

namespace rigor::validation {
namespace {

using scenario::JointType;

class BreakingJoint : public Reference {
  public:
    BreakingJoint(const Scenario& scenario, int index, int jointIndex)
        : scenario_(scenario),
          index_(index),
          body_(scenario.bodies[index]),
          joint_(scenario.joints[jointIndex]) {
        requireUndisturbed(scenario, index, {.joints = true, .constantForces = true});
        for (const auto& other : scenario.joints)
            require(&other == &joint_ || (other.bodyA != index && other.bodyB != index),
                    "joint '" + other.name + "' also holds " + bodyTitle(scenario, index));
        const int other = joint_.bodyA == index ? joint_.bodyB : joint_.bodyA;
        require(
            other == scenario::kNone || scenario.bodies[other].type == scenario::BodyType::Static,
            "joint '" + joint_.name + "' does not hold " + bodyTitle(scenario, index) + " to a fixed point");
        require(body_.velocity == Vec3{} && body_.angularVelocity == Vec3{},
                bodyTitle(scenario, index) + " is not at rest at the start");
        for (const std::string& feature : joint_.features())
            require(feature == "break" || (feature == "limit" && joint_.type == JointType::Distance),
                    "joint '" + joint_.name + "' has a " + feature);
        collectLoads();
        arm_ = centerOfMass(body_) - anchorOf(scenario, joint_, index);
        line_ = anchorOf(scenario, joint_, other) - anchorOf(scenario, joint_, index);
        breakTime_ = 1e300;
        for (const Load& load : loads_) {
            if (breaks(load.force)) {
                breakTime_ = load.begin;
                break;
            }
            requireAtRest(load.force);
        }
    }
    std::vector<int> bodies() const override { return {index_}; }

    PartialState exact(int, double t) const override {
        Vec3 x = centerOfMass(body_), v;
        for (std::size_t i = 0; i < loads_.size(); ++i) {
            const double begin = std::max(loads_[i].begin, breakTime_);
            const double end = i + 1 < loads_.size() ? std::min(t, loads_[i + 1].begin) : t;
            if (!(end > begin)) continue;
            const double s = end - begin;
            const Vec3 a = loads_[i].force / body_.massProperties.mass;
            x += s * v + (0.5 * s * s) * a;
            v += s * a;
        }
        return stateOf(body_, x, body_.pose.orientation, v, {});
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        if (!(breakTime_ > 0.0 && breakTime_ < scenario_.duration)) return {};
        Quantity q{"break_time", "s", breakTime_, {}, 0.0, {}};
        const double freed = norm(loadAt(breakTime_)) / body_.massProperties.mass;
        q.measure = [this, freed](const Trajectory& run) -> std::optional<double> {
            // Free fall, extrapolated back from the last frame at which it has its speed.
            for (std::size_t k = 1; k < run.frames(); ++k)
                if (const double v = norm(run.state(k, index_).velocity); v > 1e-3 * freed)
                    return run.times[k] - v / freed;
            return std::nullopt;
        };
        return {q};
    }

  private:
    /// The sum of gravity and forces from `begin` to the next.
    struct Load {
        double begin = 0.0;
        Vec3 force;
    };

    void collectLoads() {
        std::vector<double> times{0.0};
        for (const auto& force : scenario_.forces)
            if (const auto* f = std::get_if<scenario::ConstantForce>(&force); f && f->body == index_) {
                require(f->torque == Vec3{}, "a force turns " + bodyTitle(scenario_, index_));
                times.push_back(std::max(0.0, f->start));
                times.push_back(f->end);
            }
        std::sort(times.begin(), times.end());
        for (const double t : times)
            if (loads_.empty() || t > loads_.back().begin) loads_.push_back({t, loadAt(t)});
    }
    Vec3 loadAt(double t) const {
        Vec3 load = body_.massProperties.mass * gravityOn(scenario_, index_);
        for (const auto& force : scenario_.forces)
            if (const auto* f = std::get_if<scenario::ConstantForce>(&force);
                f && f->body == index_ && f->start <= t && t < f->end)
                load += f->force;
        return load;
    }
    bool breaks(Vec3 load) const {
        return norm(load) > joint_.breakForce || norm(cross(arm_, load)) > joint_.breakTorque;
    }
    void requireAtRest(Vec3 load) const {
        const std::string subject = "joint '" + joint_.name + "'";
        switch (joint_.type) {
            case JointType::Fixed:
                return;
            case JointType::Ball:
            case JointType::Hinge:
                return require(norm(cross(arm_, load)) <= 1e-9 * norm(load) * sizeOf(body_),
                               subject + " does not keep " + bodyTitle(scenario_, index_) + " from turning");
            case JointType::Distance:
                return require(dot(load, line_) <= 0.0 &&
                                   norm(cross(load, line_)) <= 1e-9 * norm(load) * norm(line_) &&
                                   norm(arm_) <= 1e-9 * norm(line_),
                               subject + " is not drawn straight by the load");
            case JointType::Slider:
            case JointType::ConeTwist:
            case JointType::SixDof:
            case JointType::Wheel:
                break;
        }
        violated(subject + " does not hold " + bodyTitle(scenario_, index_) + " at rest");
    }

    const Scenario& scenario_;
    int index_;
    const Body& body_;
    const scenario::Joint& joint_;
    Vec3 arm_, line_;
    std::vector<Load> loads_;
    double breakTime_ = 0.0;
};

}  // namespace

std::unique_ptr<Reference> makeBreakingJoint(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "joint"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<BreakingJoint>(scenario, body, parts.joint("joint", body));
}

}  // namespace rigor::validation
