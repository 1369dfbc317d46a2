// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Faces and edges by definition rather than by an algorithm: three vertices span a face when no vertex lies
// on one of the two sides of their plane; two vertices of a face span an edge when no vertex of the face lies
// on one of the two sides of their line. O(n^4); shapes of the testbed have tens of vertices.
#include "validation/oracle/core.hpp"

#include <algorithm>

namespace rigor::validation::oracle {
namespace {

/// Coordinates are doubles: what lies on a plane is off it by their rounding. Relative to the size.
constexpr Real kOnPlane = 1e-12L;
/// Triples whose triangle is thinner than this have no usable normal. Relative to the size, squared.
constexpr Real kThin = 1e-10L;

Real spread(const std::vector<Vec>& points) {
    Real size = 0;
    for (const Vec& a : points)
        for (const Vec& b : points) size = std::max(size, norm(a - b));
    return size;
}

struct Sides {
    bool above = false, below = false;
    void add(Real height, Real tolerance) {
        above = above || height > tolerance;
        below = below || height < -tolerance;
    }
    bool both() const { return above && below; }
};

const Vec& at(const std::vector<Vec>& v, int i) {
    return v[i];
}

std::vector<Face> findFaces(const std::vector<Vec>& v, Real size) {
    struct Found {
        Face face;
        Real area;
    };
    std::vector<Found> faces;
    for (std::size_t i = 0; i < v.size(); ++i)
        for (std::size_t j = i + 1; j < v.size(); ++j)
            for (std::size_t k = j + 1; k < v.size(); ++k) {
                const Vec n = cross(v[j] - v[i], v[k] - v[i]);
                const Real area = norm(n);
                if (area <= kThin * size * size) continue;
                const Vec unit = (1 / area) * n;
                Sides sides;
                std::vector<int> on;
                for (std::size_t m = 0; m < v.size() && !sides.both(); ++m) {
                    const Real height = dot(unit, v[m] - v[i]);
                    sides.add(height, kOnPlane * size);
                    if (std::abs(height) <= kOnPlane * size) on.push_back(m);
                }
                if (sides.both()) continue;
                const auto known = std::find_if(faces.begin(), faces.end(),
                                                [&](const Found& f) { return f.face.vertices == on; });
                if (known == faces.end())
                    faces.push_back({{on, {}, unit}, area});
                else if (area > known->area) {
                    known->face.normal = unit;
                    known->area = area;
                }
            }
    std::vector<Face> result;
    for (Found& f : faces) result.push_back(std::move(f.face));
    return result;
}

/// Pairs of `candidates` with all others on one side of their line, within the plane of `normal`.
std::vector<std::array<int, 2>> findEdges(const std::vector<Vec>& v, const std::vector<int>& candidates,
                                          Vec normal, Real size) {
    std::vector<std::array<int, 2>> edges;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        for (std::size_t j = i + 1; j < candidates.size(); ++j) {
            const Vec a = at(v, candidates[i]), along = at(v, candidates[j]) - a;
            const Real length = norm(along);
            if (length <= kOnPlane * size) continue;
            const Vec across = (1 / length) * cross(normal, along);
            Sides sides;
            for (int m : candidates) sides.add(dot(across, at(v, m) - a), kOnPlane * size);
            if (!sides.both()) edges.push_back({candidates[i], candidates[j]});
        }
    return edges;
}

void findFeatures(Core& core, int dimension) {
    const std::vector<Vec>& v = core.vertices;
    const Real size = spread(v);
    if (v.size() == 1) {
        core.edges = {{0, 0}};
    } else if (v.size() == 2) {
        core.edges = {{0, 1}};
    } else if (dimension == 2) {
        std::vector<int> all;
        for (std::size_t i = 0; i < v.size(); ++i) all.push_back(i);
        core.edges = findEdges(v, all, {0, 0, 1}, size);
    } else {
        core.faces = findFaces(v, size);
        for (Face& f : core.faces) {
            f.edges = findEdges(v, f.vertices, f.normal, size);
            core.edges.insert(core.edges.end(), f.edges.begin(), f.edges.end());
        }
        std::sort(core.edges.begin(), core.edges.end());
        core.edges.erase(std::unique(core.edges.begin(), core.edges.end()), core.edges.end());
    }
    core.size = size + 2 * core.radius;
}

std::vector<Vec> boxVertices(const scenario::Box& box, int dimension) {
    std::vector<Vec> v;
    for (int i = 0; i < (dimension == 2 ? 4 : 8); ++i) {
        const Vec h = widen(box.halfExtents);
        v.push_back({i & 1 ? h.x : -h.x, i & 2 ? h.y : -h.y, dimension == 2 ? 0.0L : (i & 4 ? h.z : -h.z)});
    }
    return v;
}

}  // namespace

Vec rotate(const scenario::Quat& q, Vec x) {
    const Real w = q.w;
    const Vec u{q.x, q.y, q.z};
    const Real s = 2 / (w * w + dot(u, u));  // exact for any length of q
    const Vec t = cross(u, x);
    return x + s * (w * t + cross(u, t));
}

std::optional<Core> makeCore(const scenario::Geometry& geometry, const scenario::Pose& pose, int dimension,
                             scenario::Vec3 origin, bool features) {
    Core core;
    if (const auto* s = std::get_if<scenario::Sphere>(&geometry)) {
        core.vertices = {Vec{}};
        core.radius = s->radius;
    } else if (const auto* b = std::get_if<scenario::Box>(&geometry)) {
        core.vertices = boxVertices(*b, dimension);
    } else if (const auto* c = std::get_if<scenario::Capsule>(&geometry)) {
        core.vertices = {Vec{0, -static_cast<Real>(c->halfLength), 0}, Vec{0, c->halfLength, 0}};
        core.radius = c->radius;
    } else if (const auto* h = std::get_if<scenario::ConvexHull>(&geometry)) {
        for (const scenario::Vec3& v : h->vertices) core.vertices.push_back(widen(v));
    } else if (const auto* e = std::get_if<scenario::Segment>(&geometry); e && dimension == 2) {
        core.vertices = {widen(e->a), widen(e->b)};
    } else {
        return std::nullopt;
    }
    const Vec shift = widen(pose.position) - widen(origin);
    for (Vec& v : core.vertices) v = shift + rotate(pose.orientation, v);
    if (features) findFeatures(core, dimension);
    return core;
}

}  // namespace rigor::validation::oracle
