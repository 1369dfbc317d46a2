// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Quickhull [Barber1996]: a tetrahedron grows by the point furthest out of one of its faces; the faces that
// see the point are replaced by a cone from their horizon.
//
// Deviation: among points equally far from a face (within the tolerance) the one furthest along a fixed
// direction of the face's plane is taken, then along the other, so that points on the middle of an edge never
// become vertices before the ends of the edge, which would leave triangles without area. Adjacency is a map
// from directed edges to triangles. Cost O(n log n) for points in general position.
#include "engine/shapes/3d/quickhull.hpp"

#include <map>
#include <stdexcept>
#include <utility>

namespace rigor::engine {
namespace {

using V = Eigen::Vector3d;
using EdgeMap = std::map<std::pair<int, int>, int>;

struct Face : HullTriangle {
    std::vector<int> outside;  ///< points further than the tolerance out of this face, each listed once
    bool alive = true;
};

class Builder {
  public:
    Builder(const std::vector<V>& points, double tolerance) : points_(points), tolerance_(tolerance) {}

    std::vector<HullTriangle> run() {
        startTetrahedron();
        // Faces are only appended; a face stays at its index, dead or alive.
        for (std::size_t f = 0; f < faces_.size(); ++f)
            if (faces_[f].alive && !faces_[f].outside.empty()) addPoint(static_cast<int>(f));
        std::vector<HullTriangle> result;
        for (const Face& f : faces_)
            if (f.alive) result.push_back(f);
        return result;
    }

  private:
    const V& at(int i) const { return points_[i]; }
    Face& face(int i) { return faces_[i]; }

    double distance(const Face& f, int p) const { return f.normal.dot(at(p)) - f.offset; }

    int addFace(int a, int b, int c) {
        Face f;
        f.v = {a, b, c};
        const V n = (at(b) - at(a)).cross(at(c) - at(a));
        const double length = n.norm();
        f.area = 0.5 * length;
        f.normal = length > 0 ? V(n / length) : V::Zero();
        f.offset = f.normal.dot(at(a) + at(b) + at(c)) / 3.0;
        const int index = static_cast<int>(faces_.size());
        faces_.push_back(f);
        edges_[{a, b}] = edges_[{b, c}] = edges_[{c, a}] = index;
        return index;
    }

    /// The candidate furthest along the first direction; ties within the tolerance go to the next direction.
    int extreme(std::vector<int> candidates, const std::array<V, 3>& directions) const {
        for (const V& d : directions) {
            double best = -1e300;
            for (int p : candidates) best = std::max(best, d.dot(at(p)));
            std::vector<int> kept;
            for (int p : candidates)
                if (d.dot(at(p)) >= best - tolerance_) kept.push_back(p);
            candidates = std::move(kept);
        }
        return candidates.front();
    }

    static std::array<V, 3> frameOf(const V& normal) {
        const V u = normal.unitOrthogonal();
        return {normal, u, normal.cross(u)};
    }

    void startTetrahedron() {
        std::vector<int> all;
        for (std::size_t i = 0; i < points_.size(); ++i) all.push_back(static_cast<int>(i));
        const int a = extreme(all, {V::UnitX(), V::UnitY(), V::UnitZ()});
        const int b = furthest(all, [&](int p) { return (at(p) - at(a)).norm(); });
        const V ab = (at(b) - at(a)).normalized();
        const int c = furthest(all, [&](int p) { return ab.cross(at(p) - at(a)).norm(); });
        V n = ab.cross(at(c) - at(a)).normalized();
        const int d = furthest(all, [&](int p) { return std::abs(n.dot(at(p) - at(a))); });
        if (n.dot(at(d) - at(a)) > 0) n = -n;
        const bool flipped = n.dot((at(b) - at(a)).cross(at(c) - at(a))) < 0;
        const int b2 = flipped ? c : b, c2 = flipped ? b : c;
        const std::array<int, 4> created{addFace(a, b2, c2), addFace(a, d, b2), addFace(b2, d, c2),
                                         addFace(c2, d, a)};
        for (int p : all) assign(p, created);
    }

    template <class Measure>
    int furthest(const std::vector<int>& candidates, Measure measure) const {
        int best = candidates.front();
        for (int p : candidates)
            if (measure(p) > measure(best)) best = p;
        if (!(measure(best) > 2.0 * tolerance_))
            throw std::invalid_argument("hull: the points have no volume");
        return best;
    }

    template <class Range>
    void assign(int p, const Range& faces) {
        double best = tolerance_;
        int owner = -1;
        for (int f : faces)
            if (const double d = distance(face(f), p); d > best) {
                best = d;
                owner = f;
            }
        if (owner >= 0) face(owner).outside.push_back(p);
    }

    void addPoint(int seed) {
        const int apex = extreme(face(seed).outside, frameOf(face(seed).normal));
        std::vector<int> visible{seed}, orphans;
        face(seed).alive = false;
        std::vector<std::pair<int, int>> horizon;
        for (std::size_t k = 0; k < visible.size(); ++k) {
            const Face& f = face(visible[k]);
            orphans.insert(orphans.end(), f.outside.begin(), f.outside.end());
            for (std::size_t i = 0; i < 3; ++i) {
                const int a = f.v[i], b = f.v[(i + 1) % 3];
                Face& neighbour = face(edges_.at({b, a}));
                if (neighbour.alive && distance(neighbour, apex) > tolerance_) {
                    neighbour.alive = false;
                    visible.push_back(edges_.at({b, a}));
                }
            }
        }
        for (int index : visible) {
            const Face& f = face(index);
            for (std::size_t i = 0; i < 3; ++i) {
                const int a = f.v[i], b = f.v[(i + 1) % 3];
                if (face(edges_.at({b, a})).alive) horizon.emplace_back(a, b);
            }
        }
        std::vector<int> created;
        for (const auto& [a, b] : horizon) created.push_back(addFace(a, b, apex));
        for (int p : orphans)
            if (p != apex) assign(p, created);
    }

    const std::vector<V>& points_;
    const double tolerance_;
    std::vector<Face> faces_;
    EdgeMap edges_;
};

}  // namespace

std::vector<HullTriangle> quickhull(const std::vector<Eigen::Vector3d>& points, double tolerance) {
    return Builder(points, tolerance).run();
}

}  // namespace rigor::engine
