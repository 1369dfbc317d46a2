// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Parallelogram linkages: cranks of one length l on fixed pivots, side by side, and bars that join their
// pins; one window or N. All cranks turn by the same angle th and the bars only shift, so the whole is one
// pendulum: J = sum of cranks (I + m c^2) + sum of bars m l^2, W^2 = |sum m g x arm|/J, th'' = -W^2 sin(th)
// with th from where the weighted arms hang (swing.hpp). Flat, with all pins on one line, the joints would
// let the cranks turn against each other as well; the velocities they come with go on into the parallelogram.
// More windows only add superfluous joints: the motion stays exact.
// Source: Gonzalez, Dopico, Lugris, Cuadrado, Multibody Syst. Dyn. 16 (2006) 179 (N-four-bar problem of the
// IFToMM Library of Computational Benchmark Problems); Haug 1989, ch. 3.
// Assumes: hinges of one axis, every crank's pins at the same arm from its pivot, velocities that fit,
// gravity alone. Quantities: period, where it swings or turns over within the duration.
#include <algorithm>
#include <cmath>

#include "validation/references/joints/joint_parts.hpp"
#include "validation/references/joints/swing.hpp"

namespace rigor::validation {
namespace {

using scenario::kNone;

class ParallelBars : public Reference {
  public:
    ParallelBars(const Scenario& scenario, const std::vector<int>& bodies)
        : scenario_(scenario), bodies_(bodies) {
        for (const int body : bodies_) requireUndisturbed(scenario, body, {.joints = true});
        findCranks();
        checkPins();
        const int crank = bodies_[cranks_.front().slot];
        rate_ = dot(scenario.bodies[crank].angularVelocity, axis_);
        Vec3 weighted;  // sum of m |g| times the arm that turns with the angle
        double moment = 0.0;
        const Vec3 g = gravityOn(scenario, crank), pull = g - dot(g, axis_) * axis_;
        for (const int body : bodies_) addInertia(body, g, weighted, moment);
        const Vec3 down = unit(pull);
        const double start = std::atan2(dot(axis_, cross(down, weighted)), dot(down, weighted));
        start_ = start;
        swing_ = Swing(std::sqrt(norm(pull) * norm(weighted) / moment), start, rate_);
    }
    std::vector<int> bodies() const override { return bodies_; }

    PartialState exact(int index, double t) const override {
        const Body& body = scenario_.bodies[index];
        const auto state = swing_.at(t);
        const Vec3 w = static_cast<double>(state.rate) * axis_;
        const Quat turn = scenario::fromAxisAngle(axis_, static_cast<double>(state.angle) - start_);
        const Crank* crank = crankOf(index);
        if (crank) {
            const Vec3 arm = rotate(turn, centerOfMass(body) - crank->pivot);
            return stateOf(body, crank->pivot + arm, scenario::normalized(turn * body.pose.orientation),
                           cross(w, arm), w);
        }
        const Vec3 arm = rotate(turn, arm_);
        return stateOf(body, centerOfMass(body) + arm - arm_, body.pose.orientation, cross(w, arm), {});
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        const auto period = static_cast<double>(swing_.period());
        if (swing_.parameter() <= 0 || period <= 0.0 || swing_.firstPassage() + period > scenario_.duration)
            return {};
        Quantity q{"period", "s", period, {}, 0.0, {}};
        q.measure = [this](const Trajectory& run) { return measuredPeriod(run); };
        return {q};
    }

  private:
    struct Crank {
        std::size_t slot = 0;
        Vec3 pivot;
    };
    const Crank* crankOf(int index) const {
        for (const Crank& crank : cranks_)
            if (bodies_[crank.slot] == index) return &crank;
        return nullptr;
    }
    bool isFixed(int body) const {
        return body == kNone || scenario_.bodies[body].type == scenario::BodyType::Static;
    }

    void findCranks() {
        for (const auto& joint : scenario_.joints) {
            require(joint.type == scenario::JointType::Hinge, "joint '" + joint.name + "' is not a hinge");
            requirePassive(joint);
            const Vec3 axis = axisOf(scenario_, joint);
            if (axis_ == Vec3{}) axis_ = axis;
            require(norm(cross(axis, axis_)) <= 1e-9, "the axes of the hinges are not parallel");
            const bool a = isFixed(joint.bodyA), b = isFixed(joint.bodyB);
            if (a == b) continue;
            const int body = a ? joint.bodyB : joint.bodyA;
            const auto found = std::find(bodies_.begin(), bodies_.end(), body);
            require(found != bodies_.end(), "joint '" + joint.name + "' holds a body that is not named");
            require(crankOf(body) == nullptr, bodyTitle(scenario_, body) + " has two pivots");
            cranks_.push_back({static_cast<std::size_t>(found - bodies_.begin()),
                               anchorOf(scenario_, joint, a ? joint.bodyA : joint.bodyB)});
        }
        require(!cranks_.empty(), "no hinge holds a body to the world");
    }

    /// Every other joint is a pin between a crank and a bar at the same arm from the crank's pivot.
    void checkPins() {
        std::vector<int> held(scenario_.bodies.size(), 0);
        for (const auto& joint : scenario_.joints) {
            if (isFixed(joint.bodyA) || isFixed(joint.bodyB)) continue;
            const Crank *a = crankOf(joint.bodyA), *b = crankOf(joint.bodyB);
            require((a == nullptr) != (b == nullptr),
                    "joint '" + joint.name + "' does not join a crank and a bar");
            const Crank& crank = a ? *a : *b;
            const int body = bodies_[crank.slot], bar = a ? joint.bodyB : joint.bodyA;
            Vec3 arm = anchorOf(scenario_, joint, body) - crank.pivot;
            arm = arm - dot(arm, axis_) * axis_;
            if (arm_ == Vec3{}) arm_ = arm;
            require(norm(arm - arm_) <= 1e-9 * norm(arm_), "the cranks are not parallel and of one length");
            ++held[bar];
        }
        for (const int body : bodies_)
            require(crankOf(body) != nullptr || held[body] >= 2,
                    bodyTitle(scenario_, body) + " does not hang on two cranks");
    }

    void addInertia(int index, Vec3 g, Vec3& weighted, double& moment) {
        const Body& body = scenario_.bodies[index];
        const std::string subject = bodyTitle(scenario_, index);
        require(negligible(norm(gravityOn(scenario_, index) - g), norm(g)),
                "gravity acts differently on the bodies");
        const Crank* crank = crankOf(index);
        Vec3 arm = crank ? centerOfMass(body) - crank->pivot : arm_;
        arm = arm - dot(arm, axis_) * axis_;
        const double mass = body.massProperties.mass;
        const double own = scenario_.dimension == 2 ? body.massProperties.inertia(2, 2)
                                                    : dot(axis_, worldInertia(body) * axis_);
        moment += mass * dot(arm, arm) + (crank ? own : 0.0);
        weighted += mass * arm;
        const Vec3 v = rate_ * cross(axis_, arm);
        // A velocity at rest may be rounding, small beside the speed of a fall over the arm.
        const double falling = std::sqrt(norm(gravityOn(scenario_, index)) * norm(arm_));
        const double turning = 1e-6 * std::abs(rate_) + 1e-12 * falling / norm(arm_);
        require(norm(body.velocity - v) <= 1e-6 * std::max(norm(v), norm(body.velocity)) + 1e-12 * falling &&
                    norm(body.angularVelocity - (crank ? rate_ : 0.0) * axis_) <= turning,
                "the velocity of " + subject + " does not fit the parallelogram");
    }

    /// Time between the first two passages of the first crank through the lowest point, the same way.
    std::optional<double> measuredPeriod(const Trajectory& run) const {
        const int body = bodies_[cranks_.front().slot];
        const Quat first = scenario_.bodies[body].pose.orientation;
        const double sign = swing_.parameter() > 1 && rate_ < 0.0 ? -1.0 : 1.0;
        const auto tilt = [&](std::size_t k) {
            const Quat turn = run.state(k, body).orientation * scenario::conjugate(first);
            const double angle = 2.0 * std::atan2(dot({turn.x, turn.y, turn.z}, axis_), turn.w);
            return sign * std::remainder(angle + start_, 2.0 * static_cast<double>(numerics::kPi));
        };
        const auto slope = [&](std::size_t k) {
            return sign * dot(run.state(k, body).angularVelocity, axis_);
        };
        std::optional<double> before;
        for (std::size_t k = 0; k + 1 < run.frames(); ++k) {
            const double a = tilt(k), b = tilt(k + 1);
            if (!(a < 0.0 && b >= 0.0 && b - a < 3.0)) continue;
            const auto time = upwardCrossing(run, k, tilt, slope);
            if (!time) return std::nullopt;
            if (before) return *time - *before;
            before = time;
        }
        return std::nullopt;
    }

    const Scenario& scenario_;
    std::vector<int> bodies_;
    std::vector<Crank> cranks_;
    Vec3 axis_, arm_;  ///< arm_: from a pivot to its pin at the start
    double rate_ = 0.0, start_ = 0.0;
    Swing swing_;
};

}  // namespace

std::unique_ptr<Reference> makeParallelBars(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies"});
    return std::make_unique<ParallelBars>(scenario, parts.dynamicBodies("bodies"));
}

}  // namespace rigor::validation
