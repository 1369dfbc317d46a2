// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Mechanics under gravity has no length of its own: lengths times s, times times sqrt(s), masses times s^d
// (densities stay). Absolute tolerances of an engine (slop, margins, thresholds of sleep and of restitution)
// do have one. Source: Froude 1861; Barenblatt, Scaling, 2003, ch. 1.
#include <cmath>
#include <cstring>

#include "validation/symmetry/transforms.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr double kLength = 4.0, kTime = 2.0;  ///< powers of two: scaling is exact
constexpr double kSpeed = kLength / kTime;

struct Scale {
    double mass, force, torque, impulse;

    explicit Scale(int dimension) {
        mass = dimension == 3 ? kLength * kLength * kLength : kLength * kLength;
        force = mass * kLength / (kTime * kTime);
        torque = force * kLength;
        impulse = force * kTime;
    }

    static void points(std::vector<Vec3>& list) {
        for (Vec3& p : list) p = kLength * p;
    }
    void operator()(Sphere& g) const { g.radius *= kLength; }
    void operator()(Box& g) const { g.halfExtents = kLength * g.halfExtents; }
    void operator()(ConvexHull& g) const { points(g.vertices); }
    void operator()(HalfSpace& g) const { g.offset *= kLength; }
    void operator()(Segment& g) const {
        g.a = kLength * g.a;
        g.b = kLength * g.b;
    }
    void operator()(Chain& g) const { points(g.vertices); }
    void operator()(TriangleMesh& g) const { points(g.vertices); }
    void operator()(HeightField& g) const {
        g.spacingX *= kLength;
        g.spacingZ *= kLength;
        g.thickness *= kLength;
        for (double& h : g.heights) h *= kLength;
    }
    void operator()(Ellipsoid& g) const { g.halfAxes = kLength * g.halfAxes; }
    template <class Round>
    void operator()(Round& g) const {
        g.radius *= kLength;
        g.halfLength *= kLength;
    }

    void operator()(ConstantForce& f) const {
        f.force = force * f.force;
        f.torque = torque * f.torque;
        f.start *= kTime;
        if (f.end < 1e299) f.end *= kTime;
    }
    void operator()(SpringForce& f) const {
        f.anchorA = kLength * f.anchorA;
        f.anchorB = kLength * f.anchorB;
        f.stiffness *= force / kLength;
        f.damping *= force / kSpeed;
        f.restLength *= kLength;
    }
    void operator()(DragForce& f) const {
        f.coefficient *= force / kSpeed;
        f.quadratic *= force / (kSpeed * kSpeed);
    }

    void body(Body& b) const {
        b.pose.position = kLength * b.pose.position;
        b.velocity = kSpeed * b.velocity;
        b.angularVelocity = b.angularVelocity / kTime;
        MassProperties& m = b.massProperties;
        m.mass *= mass;
        m.centerOfMass = kLength * m.centerOfMass;
        for (auto& row : m.inertia.m)
            for (double& value : row) value *= mass * kLength * kLength;
        for (Shape& s : b.shapes) {
            s.pose.position = kLength * s.pose.position;
            s.surfaceVelocity = {kSpeed * s.surfaceVelocity.linear, s.surfaceVelocity.angular / kTime};
            std::visit(*this, s.geometry);
        }
        // kept^t with t in the longer seconds
        b.linearVelocityKept = std::pow(b.linearVelocityKept, 1.0 / kTime);
        b.angularVelocityKept = std::pow(b.angularVelocityKept, 1.0 / kTime);
    }
    void axis(JointAxis& a, bool length) const {
        const double unit = length ? kLength : 1.0, load = length ? force : torque;
        if (a.lower > -1e299) a.lower *= unit;
        if (a.upper < 1e299) a.upper *= unit;
        a.motorSpeed *= unit / kTime;
        a.motorMaxForce *= load;
        a.target *= unit;
        a.frequency /= kTime;
        a.stiffness *= load / unit;
        a.damping *= load * kTime / unit;
    }
    void joint(Joint& j, int dimension) const {
        j.anchorA = kLength * j.anchorA;
        j.anchorB = kLength * j.anchorB;
        j.length *= kLength;
        for (std::size_t k = 0; k < kMaxJointAxes; ++k) {
            const char* name = jointAxisName(j.type, dimension, k);
            if (name == nullptr) break;
            const bool length = std::strlen(name) == 1 || std::strcmp(name, "travel") == 0 ||
                                std::strcmp(name, "length") == 0;
            axis(j.axes[k], length);
        }
        if (j.breakForce < 1e299) j.breakForce *= force;
        if (j.breakTorque < 1e299) j.breakTorque *= torque;
    }
};

Trajectory shrunk(const Trajectory& trajectory, const Scale& scale) {
    Trajectory t = mapped(
        trajectory,
        [](const BodyState& b, double) {
            return BodyState{b.position / kLength, b.orientation, b.velocity / kSpeed,
                             kTime * b.angularVelocity};
        },
        [&](ContactPoint c, double) {
            c.pointA = c.pointA / kLength;
            c.pointB = c.pointB / kLength;
            c.depth /= kLength;
            c.normalImpulse /= scale.impulse;
            c.frictionImpulse = c.frictionImpulse / scale.impulse;
            return c;
        });
    t.dt /= kTime;
    for (double& time : t.times) time /= kTime;
    return t;
}

}  // namespace

Transformed froude(const Scenario& scenario, const Trajectory*) {
    Scenario s = bare(scenario);
    const Scale scale(s.dimension);
    s.duration *= kTime;
    for (double& dt : s.timeSteps) dt *= kTime;
    const auto lengths = [](auto& surface) {
        surface.rollingFriction *= kLength;
        surface.torsionalFriction *= kLength;
    };
    for (Material& m : s.materials) lengths(m);
    for (MaterialPair& p : s.pairs) lengths(p);
    for (Body& b : s.bodies) scale.body(b);
    for (Joint& j : s.joints) scale.joint(j, s.dimension);
    for (Force& f : s.forces) std::visit(scale, f);
    for (Event& e : s.events) {
        e.time *= kTime;
        e.impulse = scale.impulse * e.impulse;
        e.angularImpulse = scale.impulse * kLength * e.angularImpulse;
    }
    return {s, kTime, [scale](const Trajectory& t) { return shrunk(t, scale); }};
}

}  // namespace rigor::validation
