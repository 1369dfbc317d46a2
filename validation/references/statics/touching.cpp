// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See touching.hpp. In 2D every shape is a polygon of one, two or more corners grown by a radius; contacts
// are corners against edges, from both sides, and corners against corners where one is round. In 3D, balls
// against planes, balls and boxes; boxes against boxes where faces lie on each other (polygon clipping:
// Sutherland and Hodgman, Comm. ACM 17 (1974) 32).
#include "validation/references/statics/touching.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rigor::validation {
namespace {

using scenario::Shape;

constexpr double kReach = 1e-4;  // gap or overlap beside the size that still counts as touching

/// A convex core with a rounding radius; solid where normal . x <= offset for half-planes.
struct Core {
    std::vector<Vec3> corners;  ///< counter-clockwise in 2D
    double radius = 0.0;
    bool unbounded = false;
    Vec3 normal;
    double offset = 0.0;
    int material = 0;
};

Core coreOf(const Body& body, const Shape& shape, int dimension) {
    Core core;
    core.material = shape.material;
    const Pose pose = body.pose * shape.pose;
    const auto add = [&](Vec3 p) { core.corners.push_back(pose * p); };
    if (const auto* s = std::get_if<scenario::Sphere>(&shape.geometry)) {
        add({});
        core.radius = s->radius;
    } else if (const auto* h = std::get_if<scenario::HalfSpace>(&shape.geometry)) {
        core.unbounded = true;
        core.normal = unit(rotate(pose.orientation, h->normal));
        core.offset = dot(core.normal, pose.position) + h->offset;
    } else if (const auto* b = std::get_if<scenario::Box>(&shape.geometry)) {
        const Vec3 e = b->halfExtents;
        if (dimension == 2) {
            for (const Vec3 p :
                 {Vec3{-e.x, -e.y, 0}, Vec3{e.x, -e.y, 0}, Vec3{e.x, e.y, 0}, Vec3{-e.x, e.y, 0}})
                add(p);
        } else {
            for (int i = 0; i < 8; ++i) add({i & 1 ? e.x : -e.x, i & 2 ? e.y : -e.y, i & 4 ? e.z : -e.z});
        }
    } else if (const auto* c = std::get_if<scenario::Capsule>(&shape.geometry); c && dimension == 2) {
        add({0, -c->halfLength, 0});
        add({0, c->halfLength, 0});
        core.radius = c->radius;
    } else if (const auto* p = std::get_if<scenario::ConvexHull>(&shape.geometry); p && dimension == 2) {
        for (const Vec3 v : p->vertices) add(v);
    } else if (const auto* g = std::get_if<scenario::Segment>(&shape.geometry)) {
        add(g->a);
        add(g->b);
    } else {
        violated("body '" + body.name + "' has a " +
                 std::string(scenario::geometryName(shape.geometry, dimension)) +
                 ", whose contacts are not known here");
    }
    return core;
}

class Collector {
  public:
    Collector(const Scenario& scenario, std::vector<TouchingPoint>& out) : scenario_(scenario), out_(out) {}

    void pair(int a, int b) {
        a_ = a;
        b_ = b;
        const Body &one = body(a), &other = body(b);
        size_ = 1e300;
        for (const Body* x : {&one, &other})
            if (x->type == scenario::BodyType::Dynamic) size_ = std::min(size_, sizeOf(*x));
        first_ = out_.size();
        for (const auto& sa : one.shapes)
            for (const auto& sb : other.shapes) {
                if (!mayTouch(sa, sb)) continue;
                const Core ca = coreOf(one, sa, scenario_.dimension),
                           cb = coreOf(other, sb, scenario_.dimension);
                friction_ = holdingFriction(scenario::pairCoefficients(scenario_, sa.material, sb.material));
                scenario_.dimension == 2 ? flat(ca, cb) : space(ca, cb);
            }
    }

  private:
    const Body& body(int i) const { return scenario_.bodies[i]; }
    bool touches(double gap) const { return std::abs(gap) <= kReach * size_; }
    void add(Vec3 point, Vec3 normal) {
        for (std::size_t i = first_; i < out_.size(); ++i)
            if (norm(out_[i].point - point) < 10 * kReach * size_ && dot(out_[i].normal, normal) > 0.99)
                return;
        out_.push_back({a_, b_, point, normal, friction_});
    }

    /// One of the two is a half-space, or both are.
    void onPlane(const Core& a, const Core& b) {
        if (a.unbounded && b.unbounded) return;
        const Core &plane = a.unbounded ? a : b, &core = a.unbounded ? b : a;
        for (const Vec3 p : core.corners)
            if (touches(dot(plane.normal, p) - plane.offset - core.radius))
                add(p - core.radius * plane.normal, a.unbounded ? plane.normal : -plane.normal);
    }

    // -------------------------------------------------------------------------------------- two dimensions
    void flat(const Core& a, const Core& b) {
        if (a.unbounded || b.unbounded) return onPlane(a, b);
        const double reach = a.radius + b.radius;
        const std::size_t before = out_.size();
        for (const bool swapped : {false, true}) {
            const Core &corners = swapped ? b : a, &edges = swapped ? a : b;
            for (const Vec3 p : corners.corners) cornerOnEdges(p, corners, edges, reach, swapped);
        }
        if (out_.size() != before || reach == 0.0) return;
        for (const Vec3 p : a.corners)
            for (const Vec3 q : b.corners)
                if (touches(norm(q - p) - reach)) add(p + a.radius * unit(q - p), unit(q - p));
    }

    void cornerOnEdges(Vec3 p, const Core& corners, const Core& edges, double reach, bool swapped) {
        const std::size_t n = edges.corners.size();
        if (n < 2) return;
        for (std::size_t i = 0; i < (n == 2 ? 1 : n); ++i) {
            const Vec3 q = edges.corners[i], along = edges.corners[(i + 1) % n] - q, u = unit(along);
            const double s = dot(u, p - q), length = norm(along);
            if (s < -kReach * size_ || s > length + kReach * size_) continue;
            Vec3 out{u.y, -u.x, 0};  // counter-clockwise corners: to the right of the edge
            if (n == 2 && dot(out, p - q) < 0) out = -out;
            if (!touches(dot(out, p - q) - reach)) continue;
            // An edge whose far side the other body lies on is not the touching one.
            Vec3 middle;
            for (const Vec3 c : corners.corners) middle += c / corners.corners.size();
            if (corners.corners.size() > 1 && dot(out, middle - q) < 0) continue;
            // `out` leads from the edges' body to the corner's: from b to a unless swapped.
            add(p - corners.radius * out, swapped ? out : -out);
        }
    }

    // ------------------------------------------------------------------------------------ three dimensions
    void space(const Core& a, const Core& b) {
        if (a.unbounded || b.unbounded) {
            onPlane(a, b);
        } else if (a.corners.size() == 1 && b.corners.size() == 1) {
            const Vec3 d = b.corners[0] - a.corners[0];
            if (touches(norm(d) - a.radius - b.radius)) add(a.corners[0] + a.radius * unit(d), unit(d));
        } else if (a.corners.size() == 1 || b.corners.size() == 1) {
            ballOnBox(a.corners.size() == 1 ? a : b, a.corners.size() == 1 ? b : a, a.corners.size() == 1);
        } else {
            boxOnBox(a, b);
        }
    }

    struct Face {
        Vec3 normal, u, v, center;
        double halfU = 0.0, halfV = 0.0;
    };
    /// Corner i of a box core is at (-+x, -+y, -+z) by the bits of i.
    static std::array<Face, 6> facesOf(const Core& box) {
        const Vec3 c = 0.5 * (box.corners[0] + box.corners[7]);
        const std::array<Vec3, 3> half{0.5 * (box.corners[1] - box.corners[0]),
                                       0.5 * (box.corners[2] - box.corners[0]),
                                       0.5 * (box.corners[4] - box.corners[0])};
        std::array<Face, 6> faces;
        for (std::size_t i = 0; i < 6; ++i) {
            const Vec3 n = half[i / 2], u = half[(i / 2 + 1) % 3], v = half[(i / 2 + 2) % 3];
            const double side = i % 2 ? 1.0 : -1.0;
            faces[i] = {side * unit(n), unit(u), unit(v), c + side * n, norm(u), norm(v)};
        }
        return faces;
    }

    void ballOnBox(const Core& ball, const Core& box, bool ballFirst) {
        for (const Face& f : facesOf(box)) {
            const Vec3 d = ball.corners[0] - f.center;
            if (std::abs(dot(d, f.u)) > f.halfU || std::abs(dot(d, f.v)) > f.halfV) continue;
            if (!touches(dot(d, f.normal) - ball.radius)) continue;
            add(ball.corners[0] - ball.radius * f.normal, ballFirst ? -f.normal : f.normal);
        }
    }

    void boxOnBox(const Core& a, const Core& b) {
        for (const Face& f : facesOf(a))
            for (const Face& g : facesOf(b)) {
                if (dot(f.normal, g.normal) > -1 + 1e-6 || !touches(dot(f.normal, g.center - f.center)))
                    continue;
                std::vector<Vec3> area;
                for (const auto& [su, sv] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
                    area.push_back(g.center + (su * g.halfU) * g.u + (sv * g.halfV) * g.v);
                for (const auto& [axis, half] : {std::pair{f.u, f.halfU}, {f.v, f.halfV}})
                    for (const double side : {-1.0, 1.0}) area = cut(area, side * axis, f.center, half);
                for (const Vec3 p : area) add(p, f.normal);
            }
    }

    /// The part of a convex polygon where axis . (p - center) <= half.
    static std::vector<Vec3> cut(const std::vector<Vec3>& area, Vec3 axis, Vec3 center, double half) {
        std::vector<Vec3> kept;
        for (std::size_t i = 0; i < area.size(); ++i) {
            const Vec3 p = area[i], q = area[(i + 1) % area.size()];
            const double dp = dot(axis, p - center) - half, dq = dot(axis, q - center) - half;
            if (dp <= 0) kept.push_back(p);
            if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) kept.push_back(p + (dp / (dp - dq)) * (q - p));
        }
        return kept;
    }

    const Scenario& scenario_;
    std::vector<TouchingPoint>& out_;
    int a_ = 0, b_ = 0;
    std::size_t first_ = 0;
    double size_ = 1.0, friction_ = 0.0;
};

}  // namespace

std::vector<TouchingPoint> touchingPoints(const Scenario& scenario) {
    std::vector<TouchingPoint> points;
    Collector collector(scenario, points);
    const int count = scenario.bodies.size();
    for (int a = 0; a < count; ++a)
        for (int b = a + 1; b < count; ++b)
            if (scenario::mayCollide(scenario, a, b)) collector.pair(a, b);
    return points;
}

}  // namespace rigor::validation
