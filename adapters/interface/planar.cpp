// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/planar.hpp"

#include <stdexcept>

namespace rigor::adapter {

using namespace scenario;

namespace {

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
    for (Joint& joint : lifted.joints)
        if (joint.type == JointType::Hinge) joint.axisA = joint.axisB = {0.0, 0.0, 1.0};
    return lifted;
}

}  // namespace rigor::adapter
