// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Mechanisms of one degree of freedom in a plane: the four-bar linkage and the slider-crank. Everything
// follows from the crank's angle phi (0 at the start). P: crank's pin, C: pin between the coupler (rod) and
// the rocker (slider), Q: the rocker's pivot, u: the slider's rail:
//   P = O + R(phi) (P0 - O), |C - P| = l;
//   four-bar: |C - Q| = r, by the intersection of two circles; slider-crank: C = C0 + s u;
// first and second derivatives by phi from the differentiated closure, 2 x 2 linear systems:
//   P' + a' k x (C - P) = b' k x (C - Q)  or  = s' u.
// The motion: M phi'' + M' phi'^2/2 = Q + T, M = sum m |x'|^2 + I t'^2, Q = sum m g . x', with the torque T
// of the crank's motor: +-max until phi' is its speed, then what holds it there (M'/2 w^2 - Q at most max);
// integrated to 1e-12 (ode.hpp).
// Source: Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, 1989, chapters 3 and 6; Uicker,
// Pennock, Shigley, Theory of Machines and Mechanisms, 2017.
// Assumes: hinges of one axis (four, or three and a slider across it); initial velocities that fit the
// joints; gravity without a part along the axis does not matter; no dead point on the way; nothing else.
#include <algorithm>
#include <cmath>
#include <complex>

#include "validation/references/joints/joint_parts.hpp"
#include "validation/references/numerics/ode.hpp"

namespace rigor::validation {
namespace {

using numerics::OdeState;
using numerics::Real;
using scenario::JointType;
using PlanePoint = std::complex<Real>;  ///< a point of the plane of motion

constexpr PlanePoint kTurn{0, 1};  // k x p
Real planeDot(PlanePoint a, PlanePoint b) {
    return a.real() * b.real() + a.imag() * b.imag();
}
Real crossOf(PlanePoint a, PlanePoint b) {
    return a.real() * b.imag() - a.imag() * b.real();
}
/// x a + y b = c.
std::pair<Real, Real> solve2(PlanePoint a, PlanePoint b, PlanePoint c) {
    const Real det = crossOf(a, b);
    return {crossOf(c, b) / det, crossOf(a, c) / det};
}

/// A link at one angle of the crank: its centre of mass and the first and second derivative of that.
struct Motion {
    PlanePoint com[3];
    Real turn = 0, bend = 0;  ///< first and second derivative of the turn
};
struct Kinematics {
    Motion links[3];  ///< crank, coupler or rod, rocker or slider
};

class PlanarLinkage : public Reference {
  public:
    PlanarLinkage(const Scenario& scenario, const int (&links)[3], bool slider)
        : scenario_(scenario), slider_(slider), links_{links[0], links[1], links[2]} {
        findJoints();
        setPlane();
        const auto at = [&](const scenario::Joint& joint, int body) {
            return flat(anchorOf(scenario, joint, body));
        };
        O_ = at(*joints_[0], links_[0]);
        P_ = at(*joints_[1], links_[0]);
        C_ = at(*joints_[2], links_[1]);
        if (slider_) {
            const Vec3 rail = worldOf(*joints_[3], joints_[3]->axisA);
            require(std::abs(dot(rail, normal_)) <= 1e-9,
                    "joint '" + joints_[3]->name + "' leaves the plane");
            rail_ = flat(rail);
        } else {
            Q_ = at(*joints_[3], links_[2]);
        }
        for (int i = 0; i < 3; ++i) {
            com_[i] = flat(centerOfMass(bodyOf(i)));
            const double z = dot(worldInertia(bodyOf(i)) * normal_, normal_);
            moment_[i] = z;
        }
        branch_ =
            slider_ ? (planeDot(C_ - P_, rail_) >= 0 ? 1 : -1) : (crossOf(Q_ - P_, C_ - P_) >= 0 ? 1 : -1);
        require(std::abs(det(C_, P_)) > 1e-9L * std::norm(C_ - P_), "the linkage starts at a dead point");
        start();
        drive();
    }
    std::vector<int> bodies() const override { return {links_[0], links_[1], links_[2]}; }

    PartialState exact(int body, double t) const override {
        const auto [phi, rate] = crank(t);
        const int i = body == links_[0] ? 0 : body == links_[1] ? 1 : 2;
        Real turns[3] = {};
        const Motion m = kinematics(phi, turns).links[i];
        const Body& b = bodyOf(i);
        const auto world = [&](PlanePoint p) {
            return static_cast<double>(p.real()) * e1_ + static_cast<double>(p.imag()) * e2_;
        };
        const Vec3 com = centerOfMass(b) + world(m.com[0] - com_[i]);
        const Quat turn = scenario::fromAxisAngle(normal_, static_cast<double>(turns[i]));
        return stateOf(b, com, scenario::normalized(turn * b.pose.orientation), world(rate * m.com[1]),
                       static_cast<double>(rate * m.turn) * normal_);
    }

  private:
    const Body& bodyOf(int i) const { return scenario_.bodies[links_[i]]; }
    PlanePoint flat(Vec3 p) const { return {dot(p, e1_), dot(p, e2_)}; }
    bool isFixed(int body) const {
        return body == scenario::kNone || scenario_.bodies[body].type == scenario::BodyType::Static;
    }
    Vec3 worldOf(const scenario::Joint& joint, Vec3 local) const {
        if (joint.bodyA == scenario::kNone) return unit(local);
        return unit(rotate(scenario_.bodies[joint.bodyA].pose.orientation, local));
    }

    /// joints_: ground and crank, crank and coupler, coupler and rocker, rocker and ground; no others.
    void findJoints() {
        const int ground = scenario::kNone, ends[4][2] = {{ground, links_[0]},
                                                          {links_[0], links_[1]},
                                                          {links_[1], links_[2]},
                                                          {links_[2], ground}};
        for (int k = 0; k < 4; ++k) {
            for (const auto& joint : scenario_.joints) {
                const int a = isFixed(joint.bodyA) ? ground : joint.bodyA;
                const int b = isFixed(joint.bodyB) ? ground : joint.bodyB;
                if (!((a == ends[k][0] && b == ends[k][1]) || (a == ends[k][1] && b == ends[k][0]))) continue;
                require(joints_[k] == nullptr, "joint '" + joint.name + "' doubles another");
                joints_[k] = &joint;
            }
            require(joints_[k] != nullptr,
                    "the linkage is not closed: crank, coupler and rocker need four joints");
            const bool rail = slider_ && k == 3;
            require(joints_[k]->type == (rail ? JointType::Slider : JointType::Hinge),
                    "joint '" + joints_[k]->name + "' is not a " + (rail ? "slider" : "hinge"));
            for (const std::string& feature : joints_[k]->features())
                require(k == 0 && feature == "motor", "joint '" + joints_[k]->name + "' has a " + feature);
        }
        for (const int body : links_) {
            requireUndisturbed(scenario_, body, {.joints = true});
            for (const auto& joint : scenario_.joints)
                require((joint.bodyA != body && joint.bodyB != body) || &joint == joints_[0] ||
                            &joint == joints_[1] || &joint == joints_[2] || &joint == joints_[3],
                        "joint '" + joint.name + "' does not belong to the linkage");
        }
    }

    void setPlane() {
        normal_ = axisOf(scenario_, *joints_[0]);
        // The motor's angle grows with B's turn against A.
        sense_ = joints_[0]->bodyB == links_[0] ? 1.0 : -1.0;
        for (int k = 1; k < (slider_ ? 3 : 4); ++k)
            require(norm(cross(axisOf(scenario_, *joints_[k]), normal_)) <= 1e-9,
                    "the axes of the hinges are not parallel");
        e1_ = perpendicular(normal_);
        e2_ = cross(normal_, e1_);
    }

    /// Determinant of the closure's linear systems.
    Real det(PlanePoint C, PlanePoint P) const {
        return slider_ ? crossOf(kTurn * (C - P), -rail_) : crossOf(kTurn * (C - P), -kTurn * (C - Q_));
    }

    /// Turns of the three links since the start go to `turns`; NaN where the linkage does not close.
    Kinematics kinematics(Real phi, Real (&turns)[3]) const {
        const PlanePoint spin = std::polar(Real(1), phi), arm = spin * (P_ - O_), P = O_ + arm;
        const PlanePoint P1 = kTurn * arm, P2 = -arm;
        const Real l = std::abs(C_ - P_);
        PlanePoint C;
        if (slider_) {
            // |C0 + s u - P| = l
            const PlanePoint d = C_ - P;
            const Real b = planeDot(d, rail_), c = std::norm(d) - l * l;
            C = C_ + (-b + static_cast<Real>(branch_) * std::sqrt(b * b - c)) * rail_;
        } else {
            const PlanePoint d = Q_ - P;
            const Real r = std::abs(C_ - Q_), D = std::abs(d), x = (D * D + l * l - r * r) / (2 * D);
            C = P + (d / D) * PlanePoint{x, static_cast<Real>(branch_) * std::sqrt(l * l - x * x)};
        }
        // P' + a k x (C - P) = b k x (C - Q) or b u; then once more.
        const PlanePoint bar = kTurn * (C - P), out = slider_ ? rail_ : kTurn * (C - Q_);
        const auto [a1, b1] = solve2(bar, -out, -P1);
        const PlanePoint C1 = b1 * out, bend = slider_ ? PlanePoint{} : -b1 * b1 * (C - Q_);
        const auto [a2, b2] = solve2(bar, -out, bend - P2 + a1 * a1 * (C - P));
        const PlanePoint C2 = b2 * out + bend;

        Kinematics k;
        turns[0] = phi;
        turns[1] = std::arg((C - P) / (C_ - P_));
        turns[2] = slider_ ? 0 : std::arg((C - Q_) / (C_ - Q_));
        const Real rate[3] = {1, a1, slider_ ? 0 : b1}, bent[3] = {0, a2, slider_ ? 0 : b2};
        const PlanePoint pin[3] = {O_, P, C}, pin0[3] = {O_, P_, C_}, pin1[3] = {{}, P1, C1},
                         pin2[3] = {{}, P2, C2};
        for (int i = 0; i < 3; ++i) {
            const PlanePoint r = std::polar(Real(1), turns[i]) * (com_[i] - pin0[i]);
            Motion& m = k.links[i];
            m.com[0] = pin[i] + r;
            m.com[1] = pin1[i] + rate[i] * kTurn * r;
            m.com[2] = pin2[i] + bent[i] * kTurn * r - rate[i] * rate[i] * r;
            m.turn = rate[i];
            m.bend = bent[i];
        }
        return k;
    }

    /// M, M'/2 and Q at phi.
    struct Inertia {
        Real M = 0, half = 0, load = 0;
    };
    Inertia inertia(Real phi) const {
        Real turns[3] = {};
        const Kinematics k = kinematics(phi, turns);
        Inertia sum;
        for (int i = 0; i < 3; ++i) {
            const Motion& m = k.links[i];
            const Real mass = bodyOf(i).massProperties.mass;
            const PlanePoint g = flat(gravityOn(scenario_, links_[i]));
            sum.M += mass * std::norm(m.com[1]) + moment_[i] * m.turn * m.turn;
            sum.half += mass * planeDot(m.com[1], m.com[2]) + moment_[i] * m.turn * m.bend;
            sum.load += mass * planeDot(g, m.com[1]);
        }
        return sum;
    }

    /// The crank's rate at the start; the other bodies' velocities must fit it.
    void start() {
        rate0_ = dot(bodyOf(0).angularVelocity, normal_);
        double fast = std::abs(rate0_) * static_cast<double>(std::abs(P_ - O_)), off = 0.0;
        for (int i = 0; i < 3; ++i) {
            const PartialState fits = initial(i);
            fast = std::max({fast, norm(bodyOf(i).velocity), norm(*fits.velocity)});
            off = std::max({off, norm(bodyOf(i).velocity - *fits.velocity),
                            norm(bodyOf(i).angularVelocity - *fits.angularVelocity) *
                                static_cast<double>(std::abs(C_ - P_))});
        }
        require(off <= 1e-6 * fast, "the initial velocities do not fit the joints of the linkage");
    }
    PartialState initial(int i) const {
        Real turns[3] = {};
        const Motion m = kinematics(0, turns).links[i];
        const PlanePoint v = static_cast<Real>(rate0_) * m.com[1];
        PartialState state;
        state.velocity = static_cast<double>(v.real()) * e1_ + static_cast<double>(v.imag()) * e2_;
        state.angularVelocity = (rate0_ * static_cast<double>(m.turn)) * normal_;
        return state;
    }

    void drive() {
        const scenario::JointAxis& axis = joints_[0]->axes[0];
        const double end = runEnd(scenario_);
        const Real w = sense_ * axis.motorSpeed, most = axis.motorMaxForce;
        steadyFrom_ = 1e300;
        if (axis.hasMotor())
            steadyFrom_ = std::abs(static_cast<double>(w) - rate0_) <=
                                  1e-12 * std::max(std::abs(static_cast<double>(w)), std::abs(rate0_))
                              ? 0.0
                              : 1e300;
        if (steadyFrom_ > 0.0) {
            const Real torque = !axis.hasMotor() ? 0 : (w > rate0_ ? most : -most);
            const auto f = [this, torque](Real, const OdeState& y, OdeState& dydt) {
                const Inertia I = inertia(y[0]);
                dydt[0] = y[1];
                dydt[1] = (I.load + torque - I.half * y[1] * y[1]) / I.M;
            };
            speedUp(f, w, axis.hasMotor(), end);
        }
        if (steadyFrom_ >= end) return;
        steadySpeed_ = w;
        steadyAngle_ = steadyFrom_ > 0.0 ? solution_.at(steadyFrom_)[0] : 0;
        // Everything repeats after a turn.
        const Real turned = std::clamp(w * (end - steadyFrom_), -2 * numerics::kPi, 2 * numerics::kPi);
        for (int i = 0; i <= 4000; ++i) {
            const Real phi = steadyAngle_ + turned * i / 4000;
            const Inertia I = inertia(phi);
            require(std::isfinite(I.M), "the linkage does not close at every angle of its crank");
            require(std::abs(I.half * w * w - I.load) <= most,
                    "the motor of joint '" + joints_[0]->name + "' is too weak to hold its speed");
        }
    }
    /// Integrates until the crank has the speed w, or to the end.
    void speedUp(const numerics::OdeRhs& f, Real w, bool motor, double end) {
        const Real goal = motor ? w - static_cast<Real>(rate0_) : 0;
        double part = end;
        if (motor) {
            const Inertia I = inertia(0);
            const double guess =
                static_cast<double>(std::abs(goal) * I.M / joints_[0]->axes[0].motorMaxForce);
            part = std::min(end, 2.0 * guess);
        }
        for (;; part = std::min(end, 4.0 * part)) {
            const OdeState y{0, static_cast<Real>(rate0_)};
            const Real turns = 1 / static_cast<Real>(part) + std::max(std::abs(y[1]), std::abs(w));
            try {
                solution_ = numerics::DenseSolution(f, 0, y, part, 1e-14L, {}, {1, turns},
                                                    numerics::OdeLimits::ofEvaluations(2'000'000));
            } catch (const std::runtime_error&) {
                violated("the linkage runs into a dead point");
            }
            require(std::isfinite(solution_.at(part)[0]), "the linkage runs into a dead point");
            if (motor) {
                const auto slower =
                    solution_.lastTimeOf([&](const OdeState& at) { return (at[1] - w) * goal < 0; }, part);
                if (slower && *slower < part) {
                    steadyFrom_ = static_cast<double>(*slower);
                    return;
                }
            }
            if (part >= end) return;
        }
    }
    std::pair<Real, Real> crank(double t) const {
        if (t >= steadyFrom_) return {steadyAngle_ + steadySpeed_ * (t - steadyFrom_), steadySpeed_};
        const OdeState y = solution_.at(t);
        return {y[0], y[1]};
    }

    const Scenario& scenario_;
    bool slider_;
    int links_[3];
    const scenario::Joint* joints_[4] = {};
    Vec3 normal_, e1_, e2_;
    double sense_ = 1.0, rate0_ = 0.0, steadyFrom_ = 0.0;
    PlanePoint O_, P_, C_, Q_, rail_, com_[3];
    Real moment_[3] = {}, steadyAngle_ = 0, steadySpeed_ = 0;
    int branch_ = 1;
    numerics::DenseSolution solution_;
};

std::unique_ptr<Reference> make(const Scenario& scenario, const scenario::ReferenceSpec& spec,
                                const char* second, const char* third, bool slider) {
    const Parts parts(scenario, spec, {"crank", second, third});
    const int links[3] = {parts.dynamicBody("crank"), parts.dynamicBody(second), parts.dynamicBody(third)};
    return std::make_unique<PlanarLinkage>(scenario, links, slider);
}

}  // namespace

std::unique_ptr<Reference> makeFourBar(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    return make(scenario, spec, "coupler", "rocker", false);
}
std::unique_ptr<Reference> makeSliderCrank(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    return make(scenario, spec, "rod", "slider", true);
}

}  // namespace rigor::validation
