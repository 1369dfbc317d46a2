// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Planes, supports and support polygons of the bodies of a reference.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scenarios/model/surfaces.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr int kRimPoints = 64;  // a circular base is taken as this inscribed polygon

std::vector<Vec3> rim(double radius, double y) {
    std::vector<Vec3> points;
    for (int i = 0; i < kRimPoints; ++i) {
        const double a = 2.0 * 3.14159265358979323846 * i / kRimPoints;
        points.push_back({radius * std::cos(a), y, radius * std::sin(a)});
    }
    return points;
}

/// Points whose convex hull, grown by `radius`, is the shape (an inscribed polygon for circular rims).
struct PointShape {
    std::vector<Vec3> points;
    double radius = 0.0;
    Vec3 halfAxes = {};  ///< half axes of an ellipsoid, which has no points; else 0
    /// The shape's point furthest along the unit vector d, of an ellipsoid.
    Vec3 furthest(Vec3 d) const {
        const Vec3 h = halfAxes, e{h.x * d.x, h.y * d.y, h.z * d.z};
        return 1.0 / norm(e) * Vec3{h.x * e.x, h.y * e.y, h.z * e.z};
    }
};

struct ToPoints {
    int dimension;
    PointShape operator()(const Sphere& s) const { return {{{}}, s.radius}; }
    PointShape operator()(const Box& b) const {
        PointShape shape;
        const Vec3 h = b.halfExtents;
        for (const double x : {-h.x, h.x})
            for (const double y : {-h.y, h.y}) {
                if (dimension == 2) {
                    shape.points.push_back({x, y, 0.0});
                    continue;
                }
                for (const double z : {-h.z, h.z}) shape.points.push_back({x, y, z});
            }
        return shape;
    }
    PointShape operator()(const Capsule& c) const {
        return {{{0, -c.halfLength, 0}, {0, c.halfLength, 0}}, c.radius};
    }
    PointShape operator()(const Cylinder& c) const {
        PointShape shape{rim(c.radius, -c.halfLength), 0.0};
        for (const Vec3 p : rim(c.radius, c.halfLength)) shape.points.push_back(p);
        return shape;
    }
    PointShape operator()(const Cone& c) const {
        PointShape shape{rim(c.radius, -c.halfLength), 0.0};
        shape.points.push_back({0, c.halfLength, 0});
        return shape;
    }
    PointShape operator()(const Ellipsoid& e) const { return {{}, 0.0, e.halfAxes}; }
    PointShape operator()(const ConvexHull& h) const { return {h.vertices, 0.0}; }
    PointShape operator()(const HalfSpace&) const { return {}; }
    PointShape operator()(const Segment& s) const { return {{s.a, s.b}, 0.0}; }
    PointShape operator()(const Chain& s) const { return {scenario::surfaceVertices(s), 0.0}; }
    PointShape operator()(const TriangleMesh& s) const { return {scenario::surfaceVertices(s), 0.0}; }
    PointShape operator()(const HeightField& s) const { return {scenario::surfaceVertices(s), 0.0}; }
};

Plane facePlane(const Pose& pose, Vec3 localNormal, double localOffset) {
    Plane plane;
    plane.normal = unit(rotate(pose.orientation, localNormal));
    plane.offset = dot(plane.normal, pose.position) + localOffset;
    return plane;
}

/// The face of the box that the point is farthest out of.
Plane boxPlane(const Pose& pose, Vec3 halfExtents, Vec3 from, int dimension) {
    const std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    const std::array<double, 3> half{halfExtents.x, halfExtents.y, halfExtents.z};
    Plane best;
    std::size_t bestAxis = 0;
    double bestHeight = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i)
        for (const double sign : {-1.0, 1.0}) {
            const Plane plane = facePlane(pose, sign * axes[i], half[i]);
            if (plane.height(from) <= bestHeight) continue;
            bestHeight = plane.height(from);
            best = plane;
            bestAxis = i;
        }
    for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i) {
        if (i == bestAxis) continue;
        const Vec3 axis = rotate(pose.orientation, axes[i]);
        best.edges.push_back({axis, dot(axis, pose.position), half[i]});
    }
    return best;
}

Plane segmentPlane(const Pose& pose, const Segment& segment, Vec3 from) {
    const Vec3 a = pose * segment.a, b = pose * segment.b, along = unit(b - a);
    Plane plane;
    plane.normal = {-along.y, along.x, 0.0};
    if (dot(plane.normal, from - a) < 0.0) plane.normal = -plane.normal;
    plane.offset = dot(plane.normal, a);
    plane.edges.push_back({along, dot(along, 0.5 * (a + b)), 0.5 * norm(b - a)});
    return plane;
}

/// A height field that is one flat floor.
Plane fieldPlane(const Pose& pose, const HeightField& field, const std::string& subject) {
    for (const double h : field.heights)
        require(h == field.heights[0], subject + " is a height field that is not flat");
    Plane plane = facePlane(pose, {0, 1, 0}, field.heights[0]);
    const Vec3 x = rotate(pose.orientation, {1, 0, 0}), z = rotate(pose.orientation, {0, 0, 1});
    plane.edges.push_back({x, dot(x, pose.position), 0.5 * (field.columns - 1) * field.spacingX});
    plane.edges.push_back({z, dot(z, pose.position), 0.5 * (field.rows - 1) * field.spacingZ});
    return plane;
}

/// A chain that is one straight floor, its vertices in order along local x.
Plane chainPlane(const Pose& pose, const Chain& chain, const std::string& subject) {
    const Vec3 &a = chain.vertices.front(), &b = chain.vertices.back();
    const double way = b.x < a.x ? -1.0 : 1.0;
    for (std::size_t i = 0; i < chain.vertices.size(); ++i)
        require(chain.vertices[i].y == a.y &&
                    (i == 0 || way * (chain.vertices[i].x - chain.vertices[i - 1].x) > 0.0),
                subject + " is a chain that is not straight along its x");
    Plane plane = facePlane(pose, {0, 1, 0}, a.y);
    const Vec3 x = rotate(pose.orientation, {1, 0, 0});
    plane.edges.push_back({x, dot(x, pose * (0.5 * (a + b))), 0.5 * std::abs(b.x - a.x)});
    return plane;
}

/// A mesh that is one flat floor: its triangles have the area of the rectangle around it.
Plane meshPlane(const Pose& pose, const TriangleMesh& mesh, const std::string& subject) {
    Vec3 low = mesh.vertices.front(), high = low;
    for (const Vec3& v : mesh.vertices) {
        require(v.y == low.y, subject + " is a mesh that is not flat across its y");
        low = {std::min(low.x, v.x), low.y, std::min(low.z, v.z)};
        high = {std::max(high.x, v.x), low.y, std::max(high.z, v.z)};
    }
    double area = 0.0;
    for (const std::array<int, 3>& t : mesh.triangles) {
        const Vec3& a = mesh.vertices[t[0]];
        area += 0.5 * norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
    }
    const double whole = (high.x - low.x) * (high.z - low.z);
    require(std::abs(area - whole) <= 1e-9 * whole,
            subject + " is a mesh that is no rectangle along its x and z");
    Plane plane = facePlane(pose, {0, 1, 0}, low.y);
    const Vec3 center = pose * (0.5 * (low + high));
    const Vec3 x = rotate(pose.orientation, {1, 0, 0}), z = rotate(pose.orientation, {0, 0, 1});
    plane.edges.push_back({x, dot(x, center), 0.5 * (high.x - low.x)});
    plane.edges.push_back({z, dot(z, center), 0.5 * (high.z - low.z)});
    return plane;
}

/// The end of the cylinder that the point is farther out of.
Plane cylinderPlane(const Pose& pose, const Cylinder& cylinder, Vec3 from) {
    const double side = dot(rotate(pose.orientation, {0, 1, 0}), from - pose.position) < 0.0 ? -1.0 : 1.0;
    Plane plane = facePlane(pose, {0, side, 0}, cylinder.halfLength);
    plane.discCenter = pose.position;
    plane.discRadius = cylinder.radius;
    return plane;
}

double crossZ(double ax, double ay, double bx, double by) {
    return ax * by - ay * bx;
}

using Point2 = std::array<double, 2>;

double distanceToSegment(Point2 p, Point2 a, Point2 b) {
    const double dx = b[0] - a[0], dy = b[1] - a[1], length = dx * dx + dy * dy;
    double s = length > 0.0 ? ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length : 0.0;
    s = std::clamp(s, 0.0, 1.0);
    return std::hypot(p[0] - a[0] - s * dx, p[1] - a[1] - s * dy);
}

/// Counter-clockwise convex hull (monotone chain).
std::vector<Point2> hull(std::vector<Point2> points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<Point2> result(2 * points.size());
    std::size_t n = 0;
    const auto turnsLeft = [&](Point2 a, Point2 b, Point2 c) {
        return crossZ(b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]) > 0.0;
    };
    for (const auto& p : points) {
        while (n >= 2 && !turnsLeft(result[n - 2], result[n - 1], p)) --n;
        result[n++] = p;
    }
    const std::size_t lower = n + 1;
    for (auto it = points.rbegin() + 1; it != points.rend(); ++it) {
        while (n >= lower && !turnsLeft(result[n - 2], result[n - 1], *it)) --n;
        result[n++] = *it;
    }
    result.resize(n - 1);
    return result;
}

}  // namespace

bool Plane::holds(Vec3 p) const {
    for (const auto& edge : edges)
        if (std::abs(dot(edge.axis, p) - edge.center) > edge.halfLength) return false;
    const Vec3 away = p - discCenter;
    return discRadius == 0.0 || norm(away - dot(normal, away) * normal) <= discRadius;
}

Plane planeOf(const Scenario& scenario, int floor, Vec3 from) {
    const Body& body = scenario.bodies[floor];
    const std::string subject = bodyTitle(scenario, floor);
    require(body.type != BodyType::Dynamic, subject + " is not fixed");
    require(body.shapes.size() == 1, subject + " must be a single half-space, box, cylinder or segment");
    const Shape& shape = body.shapes[0];
    const Pose pose = body.pose * shape.pose;
    Plane plane;
    if (const auto* half = std::get_if<HalfSpace>(&shape.geometry)) {
        plane = facePlane(pose, half->normal, half->offset);
    } else if (const auto* box = std::get_if<Box>(&shape.geometry)) {
        plane = boxPlane(pose, box->halfExtents, from, scenario.dimension);
    } else if (const auto* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
        plane = cylinderPlane(pose, *cylinder, from);
    } else if (const auto* segment = std::get_if<Segment>(&shape.geometry)) {
        plane = segmentPlane(pose, *segment, from);
    } else if (const auto* field = std::get_if<HeightField>(&shape.geometry)) {
        plane = fieldPlane(pose, *field, subject);
    } else if (const auto* chain = std::get_if<Chain>(&shape.geometry)) {
        plane = chainPlane(pose, *chain, subject);
    } else if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
        plane = meshPlane(pose, *mesh, subject);
    } else {
        violated(subject + " must be a half-space, a box, a cylinder, a segment or a flat surface");
    }
    require(plane.holds(from), "the body starts beyond the edge of " + subject);
    plane.material = shape.material;
    return plane;
}

Support supportOf(const Scenario& scenario, int index, const Plane& plane) {
    const Body& body = scenario.bodies[index];
    const double tolerance = 1e-6 * sizeOf(body);
    struct Low {
        double height;
        Vec3 point;
        int material;
    };
    std::vector<Low> all;
    for (const auto& shape : body.shapes) {
        const Pose pose = body.pose * shape.pose;
        const PointShape points = std::visit(ToPoints{scenario.dimension}, shape.geometry);
        if (norm(points.halfAxes) > 0.0) {
            const Vec3 lowest = pose * points.furthest(rotateInverse(pose.orientation, -plane.normal));
            all.push_back({plane.height(lowest), lowest, shape.material});
        }
        for (const Vec3 p : points.points) {
            const Vec3 lowest = pose * p - points.radius * plane.normal;
            all.push_back({plane.height(lowest), lowest, shape.material});
        }
    }
    require(!all.empty(), bodyTitle(scenario, index) + " has no shape that could touch");
    Support support;
    const auto lowest = std::min_element(all.begin(), all.end(),
                                         [](const Low& a, const Low& b) { return a.height < b.height; });
    support.gap = lowest->height;
    support.material = lowest->material;
    for (const auto& low : all) {
        if (low.height > support.gap + tolerance) continue;
        const auto mine = pairCoefficients(scenario, low.material, plane.material);
        const auto first = pairCoefficients(scenario, support.material, plane.material);
        require(mine.friction == first.friction && holdingFriction(mine) == holdingFriction(first),
                bodyTitle(scenario, index) + " stands on shapes of different friction");
        support.points.push_back(low.point);
    }
    return support;
}

double supportMargin(const std::vector<Vec3>& points, Vec3 p, Vec3 n, int dimension) {
    const Vec3 s = perpendicular(n), t = cross(n, s);
    if (dimension == 2) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vec3 q : points) {
            low = std::min(low, dot(s, q));
            high = std::max(high, dot(s, q));
        }
        return std::min(dot(s, p) - low, high - dot(s, p));
    }
    std::vector<Point2> flat;
    for (const Vec3 q : points) flat.push_back({dot(s, q - p), dot(t, q - p)});
    const auto border = hull(std::move(flat));
    if (border.empty()) return -std::numeric_limits<double>::infinity();
    const Point2 origin{0.0, 0.0};
    double distance = std::numeric_limits<double>::infinity();
    bool inside = border.size() >= 3;
    for (std::size_t i = 0; i < border.size(); ++i) {
        const Point2 a = border[i], b = border[(i + 1) % border.size()];
        distance = std::min(distance, distanceToSegment(origin, a, b));
        if (crossZ(b[0] - a[0], b[1] - a[1], -a[0], -a[1]) < 0.0) inside = false;
    }
    return inside ? distance : -distance;
}

double sizeOf(const Body& body) {
    double size = 0.0;
    for (const auto& shape : body.shapes) {
        const PointShape points = std::visit(ToPoints{3}, shape.geometry);
        const Vec3 h = points.halfAxes;
        if (norm(h) > 0.0)
            size = std::max(size, norm(shape.pose.position - body.massProperties.centerOfMass) +
                                      std::max({h.x, h.y, h.z}));
        for (const Vec3 p : points.points)
            size = std::max(size, norm(shape.pose * p - body.massProperties.centerOfMass) + points.radius);
    }
    return size;
}

}  // namespace rigor::validation
