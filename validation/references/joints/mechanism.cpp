// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Any mechanism: bodies on ball joints, hinges, sliders, rods and welds, with closed loops and superfluous
// joints, springs and dampers between points of the bodies, constant forces and torques, driven shafts.
// Equations of motion in mechanism_motion.hpp, integrated in extended precision; the solution is valid until
// runs of two tolerances diverge by 1e-8 of the size, and refused where the joints' equations are left by
// more.
// Source: Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, 1989, chapter 11; problems:
// IFToMM Library of Computational Benchmark Problems (Bricard's mechanism, governor); Mazzia and Magherini,
// Test Set for Initial Value Problem Solvers, 2008 (Andrews' squeezer); Schiehlen, Multibody Systems
// Handbook, 1990. Assumes: initial places and velocities that fit the joints; no limits, motors or breaking
// joints, no contacts; no singular position (there one motion branches into several).
#include <algorithm>
#include <cmath>

#include "validation/references/joints/joint_parts.hpp"
#include "validation/references/joints/mechanism_motion.hpp"

namespace rigor::validation {
namespace {

using namespace numerics;
using scenario::BodyType;
using scenario::JointType;
using scenario::kNone;
using Equation = MechanismMotion::Equation;

// gap relative to the size at which a part is lost
constexpr Real kJointsApart = 1e-8L;
constexpr std::size_t kMechanismOperations = 2'500'000'000;  // 2.5 s

class Mechanism : public Reference {
  public:
    Mechanism(const Scenario& scenario, std::vector<int> bodies)
        : scenario_(scenario), bodies_(std::move(bodies)), slot_(scenario.bodies.size(), -1) {
        motion_.planar = scenario.dimension == 2;
        for (const int body : bodies_) addMember(body);
        for (const auto& joint : scenario.joints) addJoint(joint);
        require(!motion_.equations.empty(), "no joint holds the bodies: they are not a mechanism");
        addForces();
        check();
        solve();
    }
    std::vector<int> bodies() const override { return bodies_; }
    double validUntil() const override { return validUntil_; }

    PartialState exact(int body, double t) const override {
        const OdeState y = solution_.at(t);
        const Real* s = &y[MechanismMotion::kStride * slotOf(body)];
        const auto d = [&](std::size_t i) { return static_cast<double>(s[i]); };
        const Quat q = scenario::normalized(Quat{d(3), d(4), d(5), d(6)});
        return stateOf(scenario_.bodies[body], {d(0), d(1), d(2)}, q, {d(7), d(8), d(9)},
                       rotate(q, {d(10), d(11), d(12)}));
    }

  private:
    const Body& body(int index) const { return scenario_.bodies[index]; }
    int slotOf(int index) const { return index == kNone ? -1 : slot_[index]; }
    bool isGiven(int index) const { return index == kNone || body(index).type == BodyType::Static; }

    void addMember(int index) {
        const Body& b = body(index);
        const bool driven = b.type != BodyType::Dynamic;
        if (!driven)
            requireUndisturbed(scenario_, index, {.joints = true, .springs = true, .constantForces = true});
        slot_[index] = motion_.members.size();
        MechanismMotion::Member m;
        m.driven = driven;
        m.mass = driven ? 1 : b.massProperties.mass;
        Mat3 inertia = b.massProperties.inertia;
        if (scenario_.dimension == 2) inertia = Mat3::diagonal(inertia(2, 2), inertia(2, 2), inertia(2, 2));
        m.inertia = driven ? real33(Mat3::diagonal(1, 1, 1)) : real33(inertia);
        if (!driven) m.gravity = real3(gravityOn(scenario_, index));
        motion_.members.push_back(m);
        const Quat q = scenario::normalized(b.pose.orientation);
        const Vec3 x = centerOfMass(b), v = b.velocity, w = rotateInverse(q, b.angularVelocity);
        for (const double value : {x.x, x.y, x.z, q.w, q.x, q.y, q.z, v.x, v.y, v.z, w.x, w.y, w.z})
            start_.push_back(value);
    }
    /// A body that drives others joins the mechanism when a joint names it.
    void include(int index) {
        if (isGiven(index) || slotOf(index) >= 0) return;
        require(body(index).type == BodyType::Kinematic,
                bodyTitle(scenario_, index) + " hangs on the mechanism but is not among its bodies");
        addMember(index);
    }

    MechanismMotion::Fixed point(int index, Vec3 local) const {
        if (isGiven(index)) return {-1, real3(index == kNone ? local : body(index).pose * local)};
        return {slotOf(index), real3(local - body(index).massProperties.centerOfMass)};
    }
    Real3 direction(int index, Vec3 world) const {
        return real3(isGiven(index)
                         ? world
                         : rotateInverse(scenario::normalized(body(index).pose.orientation), world));
    }

    void addJoint(const scenario::Joint& joint) {
        const auto ours = [&](int b) { return b != kNone && slotOf(b) >= 0; };
        if (!ours(joint.bodyA) && !ours(joint.bodyB)) return;
        include(joint.bodyA);
        include(joint.bodyB);
        requirePassive(joint);
        Equation e;
        e.joint = &joint - scenario_.joints.data();
        e.a = point(joint.bodyA, joint.anchorA);
        e.b = point(joint.bodyB, joint.anchorB);
        const Vec3 axis = axisOf(scenario_, joint), t = perpendicular(axis), u = cross(axis, t);
        const auto add = [&](Equation::Kind kind, Real3 along) {
            e.kind = kind;
            e.axis = along;
            motion_.equations.push_back(e);
        };
        const auto square = [&](Vec3 inA, Vec3 inB) {
            Equation d{Equation::Kind::Direction, e.a, e.b, direction(joint.bodyA, inA), 0, e.joint};
            d.b.local = direction(joint.bodyB, inB);
            motion_.equations.push_back(d);
        };
        switch (joint.type) {
            case JointType::Distance:
                e.length = joint.length;
                add(Equation::Kind::Distance, {});
                return;
            case JointType::Slider:
                for (const Vec3 side : acrossRail(joint))
                    add(Equation::Kind::Offset, direction(joint.bodyA, side));
                break;
            case JointType::Ball:
            case JointType::Hinge:
            case JointType::Fixed:
                add(Equation::Kind::Point, {1, 0, 0});
                add(Equation::Kind::Point, {0, 1, 0});
                if (!motion_.planar) add(Equation::Kind::Point, {0, 0, 1});
                break;
            default:
                violated("joint '" + joint.name + "' is of a kind that this reference does not know");
        }
        if (joint.type == JointType::Ball) return;
        if (!motion_.planar) {
            square(t, axis);
            square(u, axis);
        }
        if (joint.type == JointType::Slider || joint.type == JointType::Fixed) square(t, u);
    }
    /// World directions across a slider's rail: two, in 2D one.
    std::vector<Vec3> acrossRail(const scenario::Joint& joint) const {
        const Quat turn =
            joint.bodyA == kNone ? Quat{} : scenario::normalized(body(joint.bodyA).pose.orientation);
        const Vec3 rail = unit(rotate(turn, joint.axisA)), t = perpendicular(rail);
        if (motion_.planar) return {cross(Vec3{0, 0, 1}, rail)};
        return {t, cross(rail, t)};
    }

    void addForces() {
        for (const auto& force : scenario_.forces) {
            if (const auto* spring = std::get_if<scenario::SpringForce>(&force)) {
                if (slotOf(spring->bodyA) < 0 && slotOf(spring->bodyB) < 0) continue;
                motion_.springs.push_back({point(spring->bodyA, spring->anchorA),
                                           point(spring->bodyB, spring->anchorB), spring->stiffness,
                                           spring->damping, spring->restLength});
            }
            const auto* constant = std::get_if<scenario::ConstantForce>(&force);
            if (!constant || slotOf(constant->body) < 0) continue;
            motion_.loads.push_back({slotOf(constant->body), real3(constant->force), real3(constant->torque),
                                     constant->start, std::min(constant->end, 1e299)});
            for (const double t : {constant->start, constant->end})
                if (t > 0.0 && t < end()) breaks_.push_back(t);
        }
        std::sort(breaks_.begin(), breaks_.end());
        breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
    }

    double end() const { return runEnd(scenario_); }

    void check() {
        for (const int b : bodies_) size_ = std::max(size_, static_cast<Real>(sizeOf(body(b))));
        for (const auto& e : motion_.equations) {
            size_ = std::max(size_, norm(e.a.local));
            if (e.kind != Equation::Kind::Direction) size_ = std::max(size_, norm(e.b.local));
        }
        motion_.prepare(start_, 20 / static_cast<Real>(end()));
        require(motion_.gap(start_, size_) <= 1e-9L * size_, "the joints do not close at the start");
        for (std::size_t i = 0; i < start_.size(); i += MechanismMotion::kStride)
            fastest_ = std::max({fastest_, norm(Real3{start_[i + 7], start_[i + 8], start_[i + 9]}),
                                 size_ * norm(Real3{start_[i + 10], start_[i + 11], start_[i + 12]})});
        require(motion_.gapRate(start_, size_) <= 1e-6L * fastest_,
                "the initial velocities do not fit the joints");
        const bool driven = std::any_of(motion_.members.begin(), motion_.members.end(),
                                        [](const MechanismMotion::Member& m) { return m.driven; });
        require(driven || motion_.freedom() > 0, "the joints leave nothing that could move");
    }

    void solve() {
        const auto rhs = [this](Real t, const OdeState& y, OdeState& d) { motion_.derivative(t, y, d); };
        const Real fast =
            fastest_ + std::sqrt(norm(real3(scenario_.gravity)) * size_) + size_ / static_cast<Real>(end());
        OdeState beside(start_.size(), 1);
        for (std::size_t i = 0; i < beside.size(); i += MechanismMotion::kStride)
            for (std::size_t k = 0; k < 3; ++k) {
                beside[i + k] = size_;
                beside[i + 7 + k] = fast;
                beside[i + 10 + k] = fast / size_;
            }
        OdeLimits limits;
        limits.neighbour = 1e-10L;
        limits.evaluations = kMechanismOperations / motion_.operations();
        limits.agrees = [&](const OdeState& y, const OdeState& neighbour) {
            for (std::size_t i = 0; i < y.size(); ++i)
                if (i % MechanismMotion::kStride < 7 &&
                    !(std::abs(y[i] - neighbour[i]) < kJointsApart * beside[i]))
                    return false;
            return motion_.gap(y, size_) < kJointsApart * size_;
        };
        solution_ = DenseSolution(rhs, 0, start_, end(), 1e-13L, breaks_, beside, limits);
        if (!solution_.isWhole()) validUntil_ = static_cast<double>(solution_.end());
    }

    const Scenario& scenario_;
    std::vector<int> bodies_, slot_;
    MechanismMotion motion_;
    OdeState start_;
    std::vector<Real> breaks_;
    Real size_ = 0, fastest_ = 0;  ///< [m], [m/s]
    DenseSolution solution_;
    double validUntil_ = 1e300;
};

}  // namespace

std::unique_ptr<Reference> makeMechanism(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies"});
    return std::make_unique<Mechanism>(scenario, parts.dynamicBodies("bodies"));
}

}  // namespace rigor::validation
