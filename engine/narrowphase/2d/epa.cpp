// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The expanding polytope algorithm in 2D: see 3d/epa.cpp for the method and the bounds. A convex
// polygon of support points, counter-clockwise, grows at its edge of least offset; an edge's support point
// always fits between the edge's ends, so nothing is ever removed. Two points are enough to start from: a
// polygon of two edges with opposite normals.
#include "engine/narrowphase/minkowski.hpp"

namespace rigor::engine {
namespace {

constexpr int kMostVertices = 96;

template <class R>
struct Edge {
    Vec2<R> normal;
    R offset;
};

template <class R>
class Polygon {
  public:
    using S = Space<R, 2>;
    explicit Polygon(R tolerance) : tolerance_(tolerance) {}

    void insert(int at, const DifferencePoint<S>& p) {
        for (int i = count_; i > at; --i) {
            points_[index(i)] = points_[index(i - 1)];
            edges_[index(i)] = edges_[index(i - 1)];
        }
        points_[index(at)] = p;
        ++count_;
        setEdge((at + count_ - 1) % count_);
        setEdge(at);
    }
    int least() const {
        int best = 0;
        for (int i = 1; i < count_; ++i)
            if (edges_[index(i)].offset < edges_[index(best)].offset) best = i;
        return best;
    }
    const Edge<R>& edge(int i) const { return edges_[index(i)]; }
    const DifferencePoint<S>& point(int i) const { return points_[index(i % count_)]; }
    int count() const { return count_; }
    /// Edge i grows no further: `support` is the support of D along its normal.
    void raiseOffset(int i, R support) {
        edges_[index(i)].offset = std::max(edges_[index(i)].offset, support);
    }

  private:
    static std::size_t index(int i) { return static_cast<std::size_t>(i); }
    void setEdge(int i) {
        const Vec2<R>&p = point(i).w, &q = point(i + 1).w;
        const Vec2<R> e = q - p;
        const R length = e.norm();
        // Ends within rounding of each other: no normal to speak of.
        if (!(length > tolerance_)) {
            edges_[index(i)] = {Vec2<R>::Zero(), std::numeric_limits<R>::max()};
            return;
        }
        const Vec2<R> n(e.y() / length, -e.x() / length);
        edges_[index(i)] = {n, R(0.5) * n.dot(p + q)};
    }

    std::array<DifferencePoint<S>, kMostVertices + 1> points_;
    std::array<Edge<R>, kMostVertices + 1> edges_;
    int count_ = 0;
    R tolerance_;
};

}  // namespace

template <class R>
EpaResult<Space<R, 2>> epa(const Minkowski<Space<R, 2>>& D) {
    using S = Space<R, 2>;
    using V = Vec2<R>;
    EpaResult<S> best;
    const DifferencePoint<S> low = D.point(-V::UnitX()), high = D.point(V::UnitX());
    const DifferencePoint<S> under = D.point(-V::UnitY()), over = D.point(V::UnitY());
    best.iterations = 4;
    const bool wide = (high.w - low.w).squaredNorm() >= (over.w - under.w).squaredNorm();
    const DifferencePoint<S>&p = wide ? low : under, &q = wide ? high : over;
    R size = 0;
    for (const auto* x : {&low, &high, &under, &over}) size = std::max({size, x->a.norm(), x->b.norm()});
    const R tolerance = kRounding<R> * size;
    if (!((q.w - p.w).norm() > tolerance)) {
        best.normal = V::UnitY();
        best.depth = 0;
        best.flat = best.converged = true;
        return best;
    }
    Polygon<R> polygon(tolerance);
    polygon.insert(0, p);
    polygon.insert(1, q);
    best.depth = std::numeric_limits<R>::max();
    while (true) {
        const int i = polygon.least();
        const Edge<R> edge = polygon.edge(i);
        const DifferencePoint<S> x = D.point(edge.normal);
        ++best.iterations;
        const R support = edge.normal.dot(x.w);
        if (support < best.depth) {
            best.depth = support;
            best.normal = edge.normal;
        }
        best.converged = best.depth - edge.offset <= tolerance;
        if (best.converged || polygon.count() == kMostVertices) break;
        if (x.w == polygon.point(i).w || x.w == polygon.point(i + 1).w)
            polygon.raiseOffset(i, support);
        else
            polygon.insert(i + 1, x);
    }
    const V target = best.depth * best.normal;
    R nearest = std::numeric_limits<R>::max();
    for (int i = 0; i < polygon.count(); ++i) {
        Simplex<S> edge;
        edge.points[0] = polygon.point(i);
        edge.points[1] = polygon.point(i + 1);
        edge.count = 2;
        const R squared = reduceSimplex<S>(edge, target).squaredNorm();
        if (squared < nearest) {
            nearest = squared;
            best.simplex = edge;
        }
    }
    return best;
}

template EpaResult<Space2f> epa<float>(const Minkowski<Space2f>&);
template EpaResult<Space2d> epa<double>(const Minkowski<Space2d>&);

}  // namespace rigor::engine
