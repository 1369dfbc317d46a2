// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Hooke's (Cardan's, universal) joint: a shaft driven at the constant rate W about e turns a cross about the
// yoke axis c = Rot(e, W t) c0, which turns a second shaft about f through the yoke axis d = Rot(f, b) d0.
// The yokes stay square: c.d = 0, hence
//   b = atan2(-c.d0, c.(f x d0)) (the branch that starts at 0), b' = -W (e x c).d/(c.(f x d)),
// for shafts at the angle beta: tan(out) = tan(in) cos(beta) with both angles from where the input yoke is
// across the plane of the shafts; ratio b'/W between cos(beta) and 1/cos(beta).
// The cross has the axes c, d and turns at W e + p c = b' f + q d.
// Source: Uicker, Pennock, Shigley, Theory of Machines and Mechanisms, 2017, section 9.9; Haug 1989.
// Assumes: a kinematic input shaft, hinges input-cross, cross-output, output-world whose axes meet in one
// point on the shaft's axis, yoke axes across their shafts and each other, velocities that fit. Masses and
// gravity play no part. Quantities: ratio_max, ratio_min of the output speed to the input's.
#include <algorithm>
#include <cmath>

#include "validation/references/joints/joint_parts.hpp"

namespace rigor::validation {
namespace {

using scenario::BodyType;

class HookeJoint : public Reference {
  public:
    HookeJoint(const Scenario& scenario, int input, int spider, int output)
        : scenario_(scenario), cross_(spider), output_(output) {
        require(scenario.dimension == 3, "Hooke's joint needs three dimensions");
        const Body& shaft = body(input);
        require(shaft.type == BodyType::Kinematic && shaft.velocity == Vec3{},
                bodyTitle(scenario, input) + " is not a kinematic shaft in place");
        rate_ = norm(shaft.angularVelocity);
        require(rate_ > 0.0, bodyTitle(scenario, input) + " does not turn");
        e_ = unit(shaft.angularVelocity);
        const auto &first = hingeOf(input, spider), &second = hingeOf(spider, output),
                   &bearing = hingeOf(output, scenario::kNone);
        requireOnlyJoints(scenario, spider, {&first, &second});
        requireOnlyJoints(scenario, output, {&second, &bearing});
        c_ = axisOf(scenario, first);
        d_ = axisOf(scenario, second);
        f_ = axisOf(scenario, bearing);
        center_ = anchorOf(scenario, first, spider);
        const double size = sizeOf(body(spider)) + sizeOf(body(output));
        for (const Vec3 p : {anchorOf(scenario, second, spider), onLine(centerOfMass(shaft), e_),
                             onLine(anchorOf(scenario, bearing, output), f_)})
            require(norm(p - center_) <= 1e-9 * size, "the axes of the joint do not meet in one point");
        require(std::abs(dot(c_, e_)) < 1e-9 && std::abs(dot(d_, f_)) < 1e-9 && std::abs(dot(c_, d_)) < 1e-9,
                "the yoke axes are not across their shafts and each other");
        require(std::abs(dot(e_, f_)) > 0.05, "the shafts are at a right angle: the joint locks");
        for (const int index : {spider, output}) checkStart(index);
    }
    std::vector<int> bodies() const override { return {cross_, output_}; }

    PartialState exact(int index, double t) const override {
        const Body& one = body(index);
        const Motion m = motionAt(t);
        Quat turn;
        Vec3 w;
        if (index == output_) {
            turn = scenario::fromAxisAngle(f_, m.angle);
            w = m.rate * f_;
        } else {
            // (c, d, c x d) at the start to the same now: first with the input, then about c.
            const Quat carried = scenario::fromAxisAngle(e_, rate_ * t);
            const Vec3 d = rotate(carried, d_);
            const double swing = std::atan2(dot(m.c, cross(d, m.d)), dot(d, m.d));
            turn = scenario::fromAxisAngle(m.c, swing) * carried;
            w = rate_ * e_ + m.swingRate * m.c;
        }
        const Vec3 arm = rotate(turn, centerOfMass(one) - center_);
        return stateOf(one, center_ + arm, scenario::normalized(turn * one.pose.orientation), cross(w, arm),
                       w);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        double low = 1e300, high = -1e300;
        for (int k = 0; k <= 4000; ++k) {
            const double ratio = motionAt(scenario_.duration * k / 4000).rate / rate_;
            low = std::min(low, ratio);
            high = std::max(high, ratio);
        }
        std::vector<Quantity> result;
        for (const bool most : {true, false}) {
            Quantity q{most ? "ratio_max" : "ratio_min", "1", most ? high : low, {}, 0.0, {}};
            q.measure = [this, most](const Trajectory& run) -> std::optional<double> {
                double found = most ? -1e300 : 1e300;
                for (std::size_t k = 0; k < run.frames(); ++k) {
                    const double ratio = dot(f_, run.state(k, output_).angularVelocity) / rate_;
                    found = most ? std::max(found, ratio) : std::min(found, ratio);
                }
                return found;
            };
            result.push_back(std::move(q));
        }
        return result;
    }

  private:
    struct Motion {
        double angle = 0.0, rate = 0.0, swingRate = 0.0;
        Vec3 c, d;
    };
    const Body& body(int index) const { return scenario_.bodies[index]; }
    /// The point of the line nearest to the centre of the joint.
    Vec3 onLine(Vec3 p, Vec3 direction) const { return p + dot(direction, center_ - p) * direction; }

    const scenario::Joint& hingeOf(int a, int b) const {
        for (const auto& joint : scenario_.joints) {
            const auto fixed = [&](int i) {
                return b == scenario::kNone && (i == scenario::kNone || body(i).type == BodyType::Static);
            };
            const bool here = (joint.bodyA == a && (joint.bodyB == b || fixed(joint.bodyB))) ||
                              (joint.bodyB == a && (joint.bodyA == b || fixed(joint.bodyA)));
            if (!here || joint.type != scenario::JointType::Hinge) continue;
            requirePassive(joint);
            return joint;
        }
        violated("no hinge joins " + bodyTitle(scenario_, a) + " to " +
                 (b == scenario::kNone ? std::string("the world") : bodyTitle(scenario_, b)));
    }

    Motion motionAt(double t) const {
        Motion m;
        m.c = rotate(scenario::fromAxisAngle(e_, rate_ * t), c_);
        // Two signs of (sin, cos) solve c.d = 0; the motion keeps the sign of the start.
        const double sign = dot(c_, cross(f_, d_)) < 0.0 ? -1.0 : 1.0;
        const double turns = std::round(rate_ * t / kTurn) * (dot(e_, f_) < 0.0 ? -1.0 : 1.0);
        m.angle = std::atan2(-sign * dot(m.c, d_), sign * dot(m.c, cross(f_, d_)));
        m.angle += kTurn * std::round((turns * kTurn - m.angle + remainderOf(t)) / kTurn);
        m.d = rotate(scenario::fromAxisAngle(f_, m.angle), d_);
        m.rate = -rate_ * dot(cross(e_, m.c), m.d) / dot(m.c, cross(f_, m.d));
        // W e + p c = b' f + q d, seen along c.
        m.swingRate = m.rate * dot(f_, m.c);
        return m;
    }
    double remainderOf(double t) const {
        const double in = rate_ * t;
        return (in - std::round(in / kTurn) * kTurn) * (dot(e_, f_) < 0.0 ? -1.0 : 1.0);
    }

    void checkStart(int index) const {
        const PartialState start = exact(index, 0.0);
        const Body& one = body(index);
        require(norm(one.angularVelocity - *start.angularVelocity) <= 1e-6 * rate_,
                "the spin of " + bodyTitle(scenario_, index) + " does not fit the joint, " +
                    shown(*start.angularVelocity, 3));
        require(norm(one.velocity - *start.velocity) <= 1e-6 * rate_ * sizeOf(one),
                "the velocity of " + bodyTitle(scenario_, index) + " does not fit the joint, " +
                    shown(*start.velocity, 3));
    }

    static constexpr double kTurn = 6.28318530717958647692;
    const Scenario& scenario_;
    int cross_, output_;
    Vec3 e_, f_, c_, d_, center_;  ///< shaft axes; yoke axes at the start
    double rate_ = 0.0;
};

}  // namespace

std::unique_ptr<Reference> makeHookeJoint(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"input", "cross", "output"});
    const int input = parts.anyBody("input");
    const int spider = parts.dynamicBody("cross", {input});
    return std::make_unique<HookeJoint>(scenario, input, spider, parts.dynamicBody("output", {spider}));
}

}  // namespace rigor::validation
