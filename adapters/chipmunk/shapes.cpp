// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes of the scenario format as Chipmunk's three: circle, segment with a radius, convex polygon. A capsule is a
// segment, a chain is segments that know their neighbours.
#include "adapters/chipmunk/shapes.hpp"

#include <cmath>

namespace rigor::chipmunk {
namespace {

using Shapes = std::vector<Owned<cpShape>>;

struct Builder {
    cpBody* body;
    const Pose& inBody;
    const Pose& bodyPose;
    const HalfPlane& halfPlane;

    static Shapes one(cpShape* shape) {
        Shapes shapes;
        shapes.emplace_back(shape);
        return shapes;
    }
    cpVect at(const Vec3& p) const { return toChipmunk(inBody * p); }
    Shapes polygon(const std::vector<Vec3>& corners) const {
        std::vector<cpVect> points;
        for (const Vec3& corner : corners) points.push_back(at(corner));
        return one(cpPolyShapeNewRaw(body, static_cast<int>(points.size()), points.data(), 0.0));
    }
    cpShape* segment(const Vec3& a, const Vec3& b, double radius) const {
        return cpSegmentShapeNew(body, at(a), at(b), radius);
    }

    Shapes operator()(const scenario::Sphere& s) const {
        return one(cpCircleShapeNew(body, s.radius, at({})));
    }
    Shapes operator()(const scenario::Box& b) const {
        const double x = b.halfExtents.x, y = b.halfExtents.y;
        return polygon({{x, -y, 0}, {x, y, 0}, {-x, y, 0}, {-x, -y, 0}});  // in the order of cpBoxShape
    }
    Shapes operator()(const scenario::Capsule& c) const {
        return one(segment({0, -c.halfLength, 0}, {0, c.halfLength, 0}, c.radius));
    }
    Shapes operator()(const scenario::ConvexHull& polygonal) const { return polygon(polygonal.vertices); }
    Shapes operator()(const scenario::Segment& s) const { return one(segment(s.a, s.b, 0.0)); }
    Shapes operator()(const scenario::HalfSpace& h) const {
        const Vec3 along{h.normal.y, -h.normal.x, 0.0};
        const Vec3 center = inverse(bodyPose * inBody) * halfPlane.center;
        const Vec3 foot = center + (h.offset - dot(h.normal, center)) * h.normal;
        const Vec3 side = halfPlane.reach * along, down = -2.0 * halfPlane.depth * h.normal;
        return polygon({foot - side, foot - side + down, foot + side + down, foot + side});
    }
    Shapes operator()(const scenario::Chain& c) const {
        Shapes shapes;
        const int count = static_cast<int>(c.vertices.size());
        const auto vertex = [&](int i) { return c.vertices[(i + count) % count]; };
        for (int i = 0; i + (c.loop ? 0 : 1) < count; ++i) {
            cpShape* link = segment(vertex(i), vertex(i + 1), 0.0);
            // A neighbour at the link's own end is none.
            const bool first = !c.loop && i == 0, last = !c.loop && i + 2 == count;
            cpSegmentShapeSetNeighbors(link, at(vertex(first ? i : i - 1)), at(vertex(last ? i + 1 : i + 2)));
            shapes.emplace_back(link);
        }
        return shapes;
    }
    template <class Other>
    Shapes operator()(const Other& other) const {
        throw adapter::notInAdapter("chipmunk",
                                    std::string("shape '") + scenario::geometryName(other, 2) + "'");
    }
};

}  // namespace

std::vector<Owned<cpShape>> buildShapes(cpBody* body, const adapter::Geometry& geometry, const Pose& inBody,
                                        const Pose& bodyPose, const HalfPlane& halfPlane) {
    return std::visit(Builder{body, inBody, bodyPose, halfPlane}, geometry);
}

}  // namespace rigor::chipmunk
