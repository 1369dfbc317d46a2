// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One body on one joint to the fixed world that moves along the joint's free coordinates, each for itself:
//   J q'' = Q - k (q - target) - c q' + F,  J: mass or moment about the axis, Q: what gravity does along it;
//   spring given by frequency f and damping ratio zeta: k = J (2 pi f)^2, c = 4 pi zeta f J;
//   motor: F = +-max towards its speed w until q' = w; then whatever holds w, where |Q| <= max;
//   stop: q' = 0 where q reaches it (no restitution); the body stays where it is pushed on against it.
// Closed forms between the events: parabola, damped oscillation, straight line. The times of events: roots
// of the parabola, else bisection.
// Source: Landau and Lifshitz, Mechanics, 1976, section 25; Goldstein, Poole, Safko 2002, chapter 1; Haug,
// Computer Aided Kinematics and Dynamics of Mechanical Systems, 1989.
// Assumes: hinge, slider, wheel, six_dof (of the turns at most one), the twist of a cone_twist, or a distance
// joint along whose line everything moves; a joint that does not break; no motion across the free
// coordinates; no torque of gravity that changes with the angle; a motor and a spring not on one coordinate.
#include <algorithm>
#include <cmath>

#include "validation/references/joints/joint_parts.hpp"
#include "validation/references/numerics/real.hpp"

namespace rigor::validation {
namespace {

using scenario::AxisMode;
using scenario::JointAxis;
using scenario::JointType;

/// A free coordinate, its data and its solution.
struct Coordinate {
    bool turn = false;     ///< true: a rotation about `direction` through the anchor; false: a translation
                           ///< along it
    Vec3 direction;        ///< world, unit; q grows with the body's motion along it
    double inertia = 0.0;  ///< J [kg] or [kg m^2]
    double load = 0.0;     ///< Q [N] or [N m]
    double k = 0.0, c = 0.0, target = 0.0;
    double lower = -1e300, upper = 1e300;
    double motorSpeed = 0.0, motorForce = 0.0;
    double q0 = 0.0, v0 = 0.0;

    struct Phase {
        double begin = 0.0, q = 0.0, v = 0.0;
        double load = 0.0;   ///< Q and the motor's force
        bool spring = true;  ///< false: at constant speed v (a motor that holds it, or rest at a stop)
    };
    std::vector<Phase> phases;
};

/// q and q' of J q'' = load - k (q - target) - c q', `t` after q0, v0.
std::pair<double, double> freeMotion(const Coordinate& x, double load, double q0, double v0, double t) {
    if (x.k == 0.0 && x.c == 0.0) {
        const double a = load / x.inertia;
        return {q0 + v0 * t + 0.5 * a * t * t, v0 + a * t};
    }
    const double gamma = x.c / (2.0 * x.inertia);
    if (x.k == 0.0) {
        const double end = load / x.c, decay = std::exp(-2.0 * gamma * t);
        return {q0 + end * t - (v0 - end) * std::expm1(-2.0 * gamma * t) / (2.0 * gamma),
                end + (v0 - end) * decay};
    }
    const double w2 = x.k / x.inertia, s2 = w2 - gamma * gamma, rest = x.target + load / x.k, y0 = q0 - rest;
    double co = 1.0, si = t;  // e^(gamma t) times the two fundamental solutions
    if (s2 > 1e-12 * w2) {
        co = std::cos(std::sqrt(s2) * t);
        si = std::sin(std::sqrt(s2) * t) / std::sqrt(s2);
    } else if (s2 < -1e-12 * w2) {
        const double w = std::sqrt(-s2), up = std::exp((w - gamma) * t), down = std::exp(-(w + gamma) * t);
        const double c = 0.5 * (up + down), s = 0.5 * (up - down) / w;
        return {rest + y0 * (c + gamma * s) + v0 * s, v0 * (c - gamma * s) - w2 * y0 * s};
    }
    const double decay = std::exp(-gamma * t);
    return {rest + decay * (y0 * (co + gamma * si) + v0 * si),
            decay * (v0 * (co - gamma * si) - w2 * y0 * si)};
}

std::pair<double, double> inPhase(const Coordinate& x, const Coordinate::Phase& phase, double t) {
    const double s = t - phase.begin;
    if (!phase.spring) return {phase.q + phase.v * s, phase.v};
    return freeMotion(x, phase.load, phase.q, phase.v, s);
}

/// The first time in (begin, end] at which f, not negative at the start, becomes negative; `end` if it does
/// not. Looks at 4000 points and bisects: finer than any oscillation that a run of 1000 steps can show.
template <class F>
double firstNegative(F f, double begin, double end) {
    const int points = 4000;
    double before = begin;
    for (int i = 1; i <= points; ++i) {
        const double t = begin + (end - begin) * i / points;
        if (f(t) < 0.0) {
            double low = before, high = t;
            for (int k = 0; k < 200 && low < high; ++k) {
                const double middle = 0.5 * (low + high);
                if (middle <= low || middle >= high) break;
                (f(middle) < 0.0 ? high : low) = middle;
            }
            return high;
        }
        before = t;
    }
    return end;
}

/// Fills x.phases until `end`.
void solve(Coordinate& x, double end) {
    double t = 0.0, q = x.q0, v = x.v0;
    // A stop that is hit ever more softly and never again rests in the end; more phases mean neither.
    for (int count = 0; count < 64; ++count) {
        if (q <= x.lower) {
            q = x.lower;
            v = std::max(v, 0.0);
        }
        if (q >= x.upper) {
            q = x.upper;
            v = std::min(v, 0.0);
        }
        const double ahead = x.motorForce == 0.0 ? 0.0 : x.motorSpeed - v;
        const double pull = x.load - x.k * (q - x.target);
        bool atSpeed =
            x.motorForce > 0.0 && std::abs(ahead) <= 1e-14 * std::max(std::abs(x.motorSpeed), std::abs(v));
        double force = 0.0;
        if (x.motorForce > 0.0) {
            force = ahead > 0.0 ? x.motorForce : -x.motorForce;
            if (atSpeed) force = std::clamp(-x.load, -x.motorForce, x.motorForce);
        }
        const bool held = (q <= x.lower && v <= 0.0 && pull + force <= 0.0) ||
                          (q >= x.upper && v >= 0.0 && pull + force >= 0.0);
        const bool steady = held || (atSpeed && std::abs(x.load) <= x.motorForce);
        Coordinate::Phase phase{t, q, held ? 0.0 : v, x.load + force, !steady};
        x.phases.push_back(phase);
        if (held) return;
        // The phase ends at a stop, or when the motor has its speed. A stop that is being left does not end
        // it.
        const auto inside = [&](double s) {
            const auto [a, b] = inPhase(x, phase, s);
            double room = std::min(a - x.lower, x.upper - a);
            if (x.motorForce > 0.0 && !atSpeed)
                room = std::min(room, ahead > 0.0 ? x.motorSpeed - b : b - x.motorSpeed);
            return room;
        };
        const double last = x.motorForce > 0.0 && !atSpeed && phase.load * ahead > 0.0
                                ? std::min(end, t + ahead * x.inertia / phase.load)
                                : end;
        const double next = firstNegative(inside, t, last);
        if (next >= end) return;
        const double fast = std::max(std::abs(phase.v), std::abs(x.motorSpeed));
        std::tie(q, v) = inPhase(x, phase, next);
        if (x.motorForce > 0.0 && !atSpeed && std::abs(v - x.motorSpeed) <= 1e-9 * fast) v = x.motorSpeed;
        // Tolerance relative to its start and its largest possible travel.
        const double far = std::abs(phase.q) + std::abs(q) + std::max(fast, std::abs(v)) * (next - t);
        if (std::abs(q - x.lower) <= 1e-9 * far) q = x.lower;
        if (std::abs(q - x.upper) <= 1e-9 * far) q = x.upper;
        if (next <= t && count > 2) break;
        t = next;
    }
    violated("the body does not come to rest at the stop of its joint");
}

class JointCoordinate : public Reference {
  public:
    JointCoordinate(const Scenario& scenario, int index, int jointIndex)
        : scenario_(scenario),
          index_(index),
          body_(scenario.bodies[index]),
          joint_(scenario.joints[jointIndex]) {
        requireOnlyJoints(scenario, index, {&joint_});
        const int other = joint_.bodyA == index ? joint_.bodyB : joint_.bodyA;
        require(
            other == scenario::kNone || scenario.bodies[other].type == scenario::BodyType::Static,
            "joint '" + joint_.name + "' does not hold " + bodyTitle(scenario, index) + " to a fixed point");
        require(joint_.breakForce > 1e299 && joint_.breakTorque > 1e299,
                "joint '" + joint_.name + "' may break");
        anchor_ = anchorOf(scenario, joint_, index);
        fixed_ = anchorOf(scenario, joint_, other);
        com_ = centerOfMass(body_);
        sign_ = joint_.bodyB == index ? 1.0 : -1.0;
        collect();
        requireMotionAlong();
        for (Coordinate& x : coordinates_) solve(x, runEnd(scenario));
    }
    std::vector<int> bodies() const override { return {index_}; }

    PartialState exact(int, double t) const override {
        Vec3 arm = com_ - anchor_, moved, velocity, spin;
        Quat turn;
        for (const Coordinate& x : coordinates_) {
            const auto [q, v] = at(x, t);
            if (x.turn) {
                turn = scenario::fromAxisAngle(x.direction, q - x.q0);
                arm = rotate(turn, arm);
                spin = v * x.direction;
                velocity += cross(spin, arm);
            } else {
                moved += (q - x.q0) * x.direction;
                velocity += v * x.direction;
            }
        }
        return stateOf(body_, anchor_ + moved + arm, scenario::normalized(turn * body_.pose.orientation),
                       velocity, spin);
    }

  private:
    static std::pair<double, double> at(const Coordinate& x, double t) {
        std::size_t i = 0;
        while (i + 1 < x.phases.size() && x.phases[i + 1].begin <= t) ++i;
        return inPhase(x, x.phases[i], t);
    }

    void collect() {
        const Vec3 axis = axisOf3d();
        const auto& axes = joint_.axes;
        const auto along = [&](const JointAxis& a, Vec3 d) { add(false, sign_ * d, a, 0.0); };
        const auto about = [&](const JointAxis& a, Vec3 d) { add(true, sign_ * d, a, 0.0); };
        const bool flat = scenario_.dimension == 2;
        const auto isFree = [](const JointAxis& a) {
            return a.mode == AxisMode::Free || (a.mode == AxisMode::Limited && a.lower < a.upper);
        };
        switch (joint_.type) {
            case JointType::Hinge:
                return about(axes[0], axisOf(scenario_, joint_));
            case JointType::Slider:
                return along(axes[0], axis);
            case JointType::Wheel:
                along(axes[0], axis);
                return about(axes[1], flat ? Vec3{0, 0, 1} : unit(inWorld(joint_.bodyB, joint_.spinAxisB)));
            case JointType::ConeTwist:
                return about(axes[0], axis);
            case JointType::Distance: {
                require(isFree(axes[0]), "joint '" + joint_.name + "' is a rod");
                require(norm(anchor_ - com_) <= 1e-9 * sizeOf(body_),
                        "joint '" + joint_.name + "' does not hold " + bodyTitle(scenario_, index_) +
                            " at its centre of mass");
                const double length = norm(anchor_ - fixed_);
                require(length > 0.0, "joint '" + joint_.name + "' has no direction at the start");
                return add(false, unit(anchor_ - fixed_), axes[0], length);
            }
            case JointType::SixDof: {
                const Vec3 x = axis,
                           y = flat ? Vec3{-axis.y, axis.x, 0} : inWorld(joint_.bodyA, joint_.normalA);
                const Vec3 z = flat ? Vec3{0, 0, 1} : cross(x, y);
                const Vec3 directions[6] = {x, y, z, x, y, z};
                for (std::size_t i = 0; scenario::jointAxisName(joint_.type, scenario_.dimension, i); ++i) {
                    if (!isFree(axes[i])) continue;
                    if (flat ? i == 2 : i >= 3)
                        about(axes[i], flat ? z : directions[i]);
                    else
                        along(axes[i], directions[i]);
                }
                const auto turns = std::count_if(coordinates_.begin(), coordinates_.end(),
                                                 [](const Coordinate& c) { return c.turn; });
                return require(turns <= 1, "joint '" + joint_.name + "' leaves several turns free");
            }
            case JointType::Ball:
            case JointType::Fixed:
                break;
        }
        violated("joint '" + joint_.name + "' has no coordinates of its own");
    }

    Vec3 inWorld(int body, Vec3 local) const {
        if (body == scenario::kNone) return local;
        return rotate(scenario_.bodies[body].pose.orientation, local);
    }
    /// Axis as in the file, also in 2D where axisOf() is +z.
    Vec3 axisOf3d() const { return unit(inWorld(joint_.bodyA, joint_.axisA)); }

    void add(bool turn, Vec3 direction, const JointAxis& axis, double q0) {
        Coordinate x;
        x.turn = turn;
        x.direction = direction;
        x.q0 = q0;
        const Vec3 g = gravityOn(scenario_, index_), arm = com_ - anchor_;
        const double m = body_.massProperties.mass;
        if (turn) {
            const Vec3 across = arm - dot(arm, direction) * direction;
            const Vec3 pull = g - dot(g, direction) * direction;
            require(negligible(norm(across) * norm(pull), norm(arm) * norm(g)) || norm(across) == 0.0,
                    "gravity turns " + bodyTitle(scenario_, index_) + " about its joint");
            x.inertia = dot(direction, worldInertia(body_) * direction) + m * dot(across, across);
            x.v0 = dot(body_.angularVelocity, direction);
        } else {
            x.inertia = m;
            x.load = m * dot(g, direction);
            x.v0 = dot(body_.velocity, direction);
        }
        require(!(axis.hasMotor() && axis.hasSpring()),
                "joint '" + joint_.name + "' has a motor and a spring on one coordinate");
        if (axis.hasMotor()) {
            x.motorSpeed = axis.motorSpeed;
            x.motorForce = axis.motorMaxForce;
        }
        if (axis.hasSpring()) {
            const double w = 2.0 * static_cast<double>(numerics::kPi) * axis.frequency;
            x.k = axis.frequency > 0.0 ? x.inertia * w * w : axis.stiffness;
            x.c = axis.frequency > 0.0 ? 2.0 * axis.dampingRatio * w * x.inertia : axis.damping;
            x.target = axis.target;
        }
        if (axis.mode == AxisMode::Limited) {
            x.lower = axis.lower;
            x.upper = axis.upper;
            require(x.q0 >= x.lower && x.q0 <= x.upper,
                    "joint '" + joint_.name + "' starts beyond its limits");
        }
        coordinates_.push_back(x);
    }

    /// Nothing may start or pull across the coordinates where that would move the body.
    void requireMotionAlong() const {
        Vec3 v = body_.velocity, w = body_.angularVelocity;
        bool turns = false, travels = false;
        for (const Coordinate& x : coordinates_) (x.turn ? turns : travels) = true;
        const Vec3 arm = com_ - anchor_;
        for (const Coordinate& x : coordinates_) {
            if (!x.turn) {
                v -= x.v0 * x.direction;
                continue;
            }
            require(!travels || norm(cross(arm, x.direction)) <= 1e-9 * (norm(arm) + sizeOf(body_)),
                    "the centre of mass of " + bodyTitle(scenario_, index_) +
                        " is beside the axis it turns about");
            w -= x.v0 * x.direction;
            v -= cross(x.v0 * x.direction, arm);
        }
        const double fast = norm(body_.velocity) + norm(body_.angularVelocity) * (norm(arm) + sizeOf(body_));
        require(norm(v) <= 1e-9 * fast && norm(w) * sizeOf(body_) <= 1e-9 * fast,
                bodyTitle(scenario_, index_) + " moves across the free coordinates of its joint");
        const bool swings = joint_.type == JointType::ConeTwist;
        const Vec3 g = gravityOn(scenario_, index_);
        if (swings) {
            const Mat3 I = worldInertia(body_);
            const Vec3 d = coordinates_[0].direction;
            require(norm(cross(arm, g)) <= 1e-9 * norm(arm) * norm(g) &&
                        norm(cross(arm, d)) <= 1e-9 * norm(arm) &&
                        norm(cross(I * d, d)) <= 1e-9 * norm(I * d),
                    bodyTitle(scenario_, index_) + " swings on its joint");
        }
        if (joint_.type == JointType::Distance)
            require(negligible(norm(cross(g, coordinates_[0].direction)), norm(g)),
                    "gravity pulls " + bodyTitle(scenario_, index_) + " aside");
    }

    const Scenario& scenario_;
    int index_;
    const Body& body_;
    const scenario::Joint& joint_;
    Vec3 anchor_, fixed_, com_;
    double sign_ = 1.0;
    std::vector<Coordinate> coordinates_;
};

}  // namespace

std::unique_ptr<Reference> makeJointCoordinate(const Scenario& scenario,
                                               const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "joint"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<JointCoordinate>(scenario, body, parts.joint("joint", body));
}

}  // namespace rigor::validation
