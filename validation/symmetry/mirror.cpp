// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Left and right are alike: polar vectors are reflected, axial ones (angular velocity, torque, axis of a
// hinge) reflected and turned round. Body frames are mirrored as well, R' = M R M, so that shapes, anchors
// and inertia are reflected within them.
#include "validation/symmetry/transforms.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

/// M: z -> -z in 3D, x -> -x in 2D.
struct Mirror {
    bool solid;
    Vec3 polar(const Vec3& v) const { return solid ? Vec3{v.x, v.y, -v.z} : Vec3{-v.x, v.y, v.z}; }
    Vec3 axial(const Vec3& v) const { return -polar(v); }
    Quat turn(const Quat& q) const {
        const Vec3 v = axial({q.x, q.y, q.z});
        return {q.w, v.x, v.y, v.z};
    }
    Pose pose(const Pose& p) const { return {polar(p.position), turn(p.orientation)}; }
    Mat3 tensor(const Mat3& m) const {
        Mat3 r;
        const Vec3 e[3] = {polar({1, 0, 0}), polar({0, 1, 0}), polar({0, 0, 1})};
        const auto sign = [&](int i) { return e[i].x + e[i].y + e[i].z; };
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) r(i, j) = sign(i) * sign(j) * m(i, j);
        return r;
    }

    void points(std::vector<Vec3>& list) const {
        for (Vec3& p : list) p = polar(p);
    }
    void operator()(ConvexHull& g) const {
        points(g.vertices);
        if (!solid) g.vertices = {g.vertices.rbegin(), g.vertices.rend()};  // counter-clockwise again
    }
    void operator()(HalfSpace& g) const { g.normal = polar(g.normal); }
    void operator()(Segment& g) const {
        g.a = polar(g.a);
        g.b = polar(g.b);
    }
    void operator()(Chain& g) const { points(g.vertices); }
    void operator()(TriangleMesh& g) const { points(g.vertices); }
    template <class Symmetric>
    void operator()(Symmetric&) const {}
};

void reflect(Body& b, const Mirror& m) {
    b.pose = m.pose(b.pose);
    b.velocity = m.polar(b.velocity);
    b.angularVelocity = m.axial(b.angularVelocity);
    b.massProperties.centerOfMass = m.polar(b.massProperties.centerOfMass);
    b.massProperties.inertia = m.tensor(b.massProperties.inertia);
    for (Shape& s : b.shapes) {
        s.pose = m.pose(s.pose);
        s.surfaceVelocity = {m.polar(s.surfaceVelocity.linear), m.axial(s.surfaceVelocity.angular)};
        std::visit(m, s.geometry);
    }
}

/// A hinge's axis is axial: its angle stays. In 2D the axis is +z for all, and the angle turns round.
void reflect(Joint& j, const Mirror& m) {
    j.anchorA = m.polar(j.anchorA);
    j.anchorB = m.polar(j.anchorB);
    const bool hinge = j.type == JointType::Hinge;
    if (m.solid || !hinge) {
        j.axisA = hinge ? m.axial(j.axisA) : m.polar(j.axisA);
        j.axisB = hinge ? m.axial(j.axisB) : m.polar(j.axisB);
        return;
    }
    JointAxis& angle = j.axes[0];
    angle.motorSpeed = -angle.motorSpeed;
    angle.target = -angle.target;
    const double lower = angle.lower;
    angle.lower = -angle.upper;
    angle.upper = -lower;
}

}  // namespace

std::string mirrorObstacle(const Scenario& s) {
    for (const Joint& j : s.joints)
        if (j.type == JointType::ConeTwist || j.type == JointType::SixDof || j.type == JointType::Wheel)
            return "joint " + j.name + " has an axis for travel and turn at once";
    for (const Body& b : s.bodies)
        for (const Shape& shape : b.shapes)
            if (std::holds_alternative<HeightField>(shape.geometry))
                return "the cells of a height field are split along one diagonal";
    return "";
}

Transformed mirror(const Scenario& scenario, const Trajectory*) {
    require(mirrorObstacle(scenario));
    Scenario s = bare(scenario);
    const Mirror m{s.dimension == 3};
    s.gravity = m.polar(s.gravity);
    for (Body& b : s.bodies) reflect(b, m);
    for (Joint& j : s.joints) reflect(j, m);
    for (Force& force : s.forces) {
        if (auto* f = std::get_if<ConstantForce>(&force)) {
            f->force = m.polar(f->force);
            f->torque = m.axial(f->torque);
        }
        if (auto* f = std::get_if<SpringForce>(&force)) {
            f->anchorA = m.polar(f->anchorA);
            f->anchorB = m.polar(f->anchorB);
        }
    }
    for (Event& e : s.events) {
        e.impulse = m.polar(e.impulse);
        e.angularImpulse = m.axial(e.angularImpulse);
    }
    return {s, 1.0, [m](const Trajectory& t) {
                return mapped(
                    t,
                    [m](const BodyState& b, double) {
                        return BodyState{m.polar(b.position), m.turn(b.orientation), m.polar(b.velocity),
                                         m.axial(b.angularVelocity)};
                    },
                    [m](ContactPoint c, double) {
                        for (Vec3* v : {&c.pointA, &c.pointB, &c.normal, &c.frictionImpulse})
                            *v = m.polar(*v);
                        return c;
                    });
            }};
}

}  // namespace rigor::validation
