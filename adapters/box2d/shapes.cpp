// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Geometries of the scenario format as Box2D shapes. Box2D has circles, polygons of at most 8 vertices and
// edges; a capsule is two circles and a rectangle, a half-plane a large rectangle. Its asserts are compiled
// in and abort, so whatever would fail one is refused here.
#include "adapters/box2d/shapes.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::box2d {
namespace {

using adapter::notInLibrary;
using Shapes = std::vector<std::unique_ptr<b2Shape>>;

/// b2PolygonShape::Set welds vertices closer than half a slop and aborts when fewer than three are left.
void refuseWelding(const std::vector<b2Vec2>& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (b2Distance(points[i], points[j]) <= 0.51f * b2_linearSlop)
                throw notInLibrary("box2d", "polygon with vertices closer than half its slop (option scale)",
                                   "b2_common.h, b2_linearSlop: a tolerance of collision in lengths");
}

/// ... and aborts on an area that rounds to nothing.
void refuseSliver(const std::vector<b2Vec2>& points) {
    double area = 0.0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
        area += 0.5 * b2Cross(points[i] - points[0], points[i + 1] - points[0]);
    if (std::abs(area) < 1e-6)
        throw notInLibrary("box2d", "polygon of so small an area (option scale)", kSinglePrecision);
}

/// b2ChainShape aborts on neighbours within a slop.
void refuseShortLinks(const std::vector<b2Vec2>& points, bool loop) {
    for (std::size_t i = loop ? 0 : 1; i < points.size(); ++i)
        if (b2Distance(points[i], points[(i + points.size() - 1) % points.size()]) <= 1.02f * b2_linearSlop)
            throw notInLibrary("box2d", "chain with vertices closer than its slop (option scale)",
                               "b2_common.h, b2_linearSlop: a tolerance of collision in lengths");
}

struct Builder {
    const Pose& inBody;
    const Pose& bodyPose;
    const ShapeSettings& settings;

    Shapes operator()(const scenario::Sphere& s) const {
        Shapes shapes;
        shapes.push_back(circle({}, s.radius));
        return shapes;
    }
    Shapes operator()(const scenario::Box& b) const {
        Shapes shapes;
        shapes.push_back(rectangle({}, b.halfExtents.x, b.halfExtents.y, 0.0));
        return shapes;
    }
    Shapes operator()(const scenario::Capsule& c) const {
        Shapes shapes;
        shapes.push_back(rectangle({}, c.radius, c.halfLength, 0.0));
        shapes.push_back(circle({0.0, c.halfLength, 0.0}, c.radius));
        shapes.push_back(circle({0.0, -c.halfLength, 0.0}, c.radius));
        return shapes;
    }
    Shapes operator()(const scenario::ConvexHull& h) const {
        if (h.vertices.size() > b2_maxPolygonVertices)
            throw notInLibrary(
                "box2d", "polygon of " + std::to_string(h.vertices.size()) + " vertices",
                "b2_settings.h, b2_maxPolygonVertices " + std::to_string(b2_maxPolygonVertices));
        std::vector<b2Vec2> points;
        for (const Vec3& v : h.vertices) points.push_back(toBox2d(inBody * v, settings.scale));
        refuseWelding(points);
        refuseSliver(points);
        auto polygon = std::make_unique<b2PolygonShape>();
        polygon->Set(points.data(), points.size());
        polygon->m_radius = settings.skin.polygon;
        Shapes shapes;
        shapes.push_back(std::move(polygon));
        return shapes;
    }
    Shapes operator()(const scenario::HalfSpace& h) const {
        const Vec3 center = inverse(bodyPose * inBody) * settings.halfPlaneCenter;
        const Vec3 onPlane = center + (h.offset - dot(h.normal, center)) * h.normal;
        Shapes shapes;
        const double depth = settings.halfPlaneDepth;
        shapes.push_back(rectangle(onPlane - depth * h.normal, settings.halfPlaneReach, depth,
                                   std::atan2(-h.normal.x, h.normal.y)));
        return shapes;
    }
    Shapes operator()(const scenario::Segment& s) const {
        auto edge = std::make_unique<b2EdgeShape>();
        edge->SetTwoSided(toBox2d(inBody * s.a, settings.scale), toBox2d(inBody * s.b, settings.scale));
        edge->m_radius = settings.skin.polygon;
        Shapes shapes;
        shapes.push_back(std::move(edge));
        return shapes;
    }
    /// Box2D's chains have one side, the format's two: one chain there and one back. The ghost vertex of a
    /// free end is the neighbour, as if the chain came back itself, so that bodies collide with its last
    /// vertex.
    Shapes operator()(const scenario::Chain& c) const {
        std::vector<b2Vec2> points;
        for (const Vec3& v : c.vertices) points.push_back(toBox2d(inBody * v, settings.scale));
        refuseShortLinks(points, c.loop);
        Shapes shapes;
        for (int side = 0; side < 2; ++side) {
            auto chain = std::make_unique<b2ChainShape>();
            const auto count = static_cast<int32>(points.size());
            if (c.loop)
                chain->CreateLoop(points.data(), count);
            else
                chain->CreateChain(points.data(), count, points[1], points[points.size() - 2]);
            chain->m_radius = settings.skin.polygon;
            shapes.push_back(std::move(chain));
            std::reverse(points.begin(), points.end());
        }
        return shapes;
    }
    template <class Other>
    Shapes operator()(const Other& other) const {
        throw adapter::notInAdapter("box2d", std::string("shape '") + scenario::geometryName(other, 2) + "'");
    }

  private:
    std::unique_ptr<b2Shape> circle(const Vec3& center, double radius) const {
        auto shape = std::make_unique<b2CircleShape>();
        shape->m_p = toBox2d(inBody * center, settings.scale);
        shape->m_radius = static_cast<float>(settings.scale * radius) + settings.skin.circle;
        return shape;
    }
    /// Half extents in metres, turned by `angle` in the shape's frame.
    std::unique_ptr<b2Shape> rectangle(const Vec3& center, double hx, double hy, double angle) const {
        auto shape = std::make_unique<b2PolygonShape>();
        const double turn = angle + angleAboutZ(inBody.orientation);
        shape->SetAsBox(static_cast<float>(settings.scale * hx), static_cast<float>(settings.scale * hy),
                        toBox2d(inBody * center, settings.scale), static_cast<float>(turn));
        shape->m_radius = settings.skin.polygon;
        return shape;
    }
};

}  // namespace

Skin librarySkin() {
    return {b2_polygonRadius, 0.0f};
}

Skin leastSkin() {
    return {0.5f * b2_linearSlop, 0.5f * b2_linearSlop};
}

Shapes buildGeometry(const adapter::Geometry& geometry, const Pose& inBody, const Pose& bodyPose,
                     const ShapeSettings& settings) {
    return std::visit(Builder{inBody, bodyPose, settings}, geometry);
}

float skinOf(const b2Shape& shape, const Skin& skin) {
    return shape.GetType() == b2Shape::e_circle ? skin.circle : skin.polygon;
}

}  // namespace rigor::box2d
