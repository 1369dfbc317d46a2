// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/planar.hpp"

#include <stdexcept>
#include <utility>

namespace rigor::adapter {

using namespace scenario;

namespace {

/// Two triangles over each segment.
Geometry strip(const std::vector<Vec3>& points, bool loop) {
    TriangleMesh mesh;
    for (const Vec3& p : points)
        for (const double z : {-kPlanarHalfDepth, kPlanarHalfDepth}) mesh.vertices.push_back({p.x, p.y, z});
    const int count = points.size();
    for (int i = 0; i + (loop ? 0 : 1) < count; ++i) {
        const int here = 2 * i, next = 2 * ((i + 1) % count);
        mesh.triangles.push_back({here, here + 1, next});
        mesh.triangles.push_back({next, here + 1, next + 1});
    }
    return mesh;
}

struct Lift {
    Geometry operator()(const Sphere& s) const { return s; }
    Geometry operator()(const Capsule& c) const { return c; }
    Geometry operator()(const HalfSpace& h) const { return h; }
    Geometry operator()(const Box& b) const {
        return Box{{b.halfExtents.x, b.halfExtents.y, kPlanarHalfDepth}};
    }
    Geometry operator()(const ConvexHull& polygon) const {
        ConvexHull prism;
        for (const double z : {-kPlanarHalfDepth, kPlanarHalfDepth})
            for (const Vec3& v : polygon.vertices) prism.vertices.push_back({v.x, v.y, z});
        return prism;
    }
    Geometry operator()(const Segment& s) const { return strip({s.a, s.b}, false); }
    Geometry operator()(const Chain& c) const { return strip(c.vertices, c.loop); }
    template <class Other>
    Geometry operator()(const Other&) const {
        throw std::invalid_argument("this shape has no solid over the plane");
    }
};

}  // namespace

Geometry planarGeometry(const Geometry& geometry) {
    return std::visit(Lift{}, geometry);
}

Scenario planarLift(const Scenario& scenario) {
    Scenario lifted = scenario;
    lifted.dimension = 3;
    for (Body& body : lifted.bodies) {
        for (Shape& shape : body.shapes) shape.geometry = planarGeometry(shape.geometry);
        const double inertia = body.massProperties.inertia(2, 2);
        body.massProperties.inertia = Mat3::diagonal(inertia, inertia, inertia);
    }
    for (Joint& joint : lifted.joints) {
        const Vec3 up{0.0, 0.0, 1.0};
        if (joint.type == JointType::Hinge) joint.axisA = joint.axisB = up;
        if (joint.type == JointType::Wheel) joint.spinAxisB = up;
        if (joint.type == JointType::SixDof) {
            // x, y and the angle: the swing about z of the lifted joint.
            joint.normalA = cross(up, joint.axisA);
            std::swap(joint.axes[2], joint.axes[5]);
        }
    }
    return lifted;
}

}  // namespace rigor::adapter
