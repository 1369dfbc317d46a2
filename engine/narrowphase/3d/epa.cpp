// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The expanding polytope algorithm: the shortest penetration vector of a Minkowski difference D that holds
// the origin,
//   depth = min over unit n of h(n),   h(n) = max over w in D of n . w.
// A polytope of support points grows inside D: its face of least offset n . w_0 gets the support point of D
// along n, the faces that see the point give way to a cone from their horizon.
//   least offset of all faces <= depth <= least h(n) of all directions queried
// Source: [Bergen2003, sec. 4.3.8]; growth as in quickhull [Barber1996].
//
// Deviations:
//  - It starts from a tetrahedron of its own, as wide as D, whether it holds the origin or not: a face with
//    the origin outside has a negative offset and is simply the first to grow. The flat, tiny or touching
//    simplices that GJK can end with never matter.
//  - It ends when the two bounds above meet within rounding; the result is the direction of least h, never
//    below the true depth.
//  - A face that the new point lies on (within rounding) counts as seen, so that facets of D with many
//    vertices leave no slivers. A face that is a sliver all the same keeps its place in the surface, but is
//    neither grown nor is its offset used.
//  - The final normal is computed again from the widest triangle of D's points in the facet.
// Cost: about as many support points as D has vertices near the facet; O(faces) each. Curved sides converge
// quadratically in the number of points per direction; kMaxVertices ends it and `converged` reports it.
#include "engine/narrowphase/minkowski.hpp"

namespace rigor::engine {
namespace {

constexpr int kMaxVertices = 128;
constexpr int kMaxFaces = 2 * kMaxVertices + 64;  ///< 2 V - 4, and room for those that give way
constexpr int kMaxHorizon = 128;

struct Link {
    int face, edge;
};
enum class Mark : char { Unknown, Seen, Beyond };

template <class R>
struct Face {
    std::array<int, 3> v;      ///< counter-clockwise seen from outside
    std::array<Link, 3> next;  ///< neighbour across the edge from v[i] to v[i + 1]
    Vec3<R> normal;
    R offset;
    bool alive = false, sliver = false;
};

template <class R>
class ExpandingPolytope {
  public:
    using S = Space<R, 3>;

    ExpandingPolytope(const std::array<DifferencePoint<S>, 4>& start, R tolerance) : tolerance_(tolerance) {
        center_.setZero();
        for (const DifferencePoint<S>& p : start) center_ += R(0.25) * p.w;
        for (std::size_t i = 0; i < 4; ++i) points_[i] = start[i];
        count_ = 4;
        const Vec3<R> n = (point(1).w - point(0).w).cross(point(2).w - point(0).w);
        if (n.dot(point(3).w - point(0).w) > 0) std::swap(points_[1], points_[2]);
        // Face 0 looks away from point 3.
        constexpr std::array<std::array<int, 3>, 4> kFaces{{{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}}};
        for (const auto& f : kFaces) add(f[0], f[1], f[2]);
        for (int f = 1; f < 4; ++f) {
            link({0, f - 1}, {f, 0});
            link({f, 1}, {f % 3 == 0 ? 2 : (f == 1 ? 3 : 1), 2});
        }
    }

    int least() const {
        int best = -1;
        for (int i = 0; i < used_; ++i)
            if (face(i).alive && !face(i).sliver && (best < 0 || face(i).offset < face(best).offset))
                best = i;
        return best;
    }
    const Face<R>& face(int i) const { return faces_[i]; }
    const DifferencePoint<S>& point(int i) const { return points_[i]; }
    int count() const { return count_; }
    int used() const { return used_; }

    /// Face i grows no further: `support` is the support of D along its normal.
    void raiseOffset(int i, R support) { at(i).offset = std::max(at(i).offset, support); }
    bool contains(const Vec3<R>& w) const {
        for (int i = 0; i < count_; ++i)
            if (point(i).w == w) return true;
        return false;
    }

    /// False when there is no room left, or rounding leaves no proper horizon.
    bool grow(int seed, const DifferencePoint<S>& p) {
        if (count_ == kMaxVertices) return false;
        findHorizon(seed, p.w);
        const int n = horizonCount_;
        if (n < 3 || n == kMaxHorizon || !ordered()) return false;
        for (int i = 0; i < seenCount_; ++i) at(seen_[i]).alive = false;
        points_[count_] = p;
        int first = -1, last = -1;
        for (int i = 0; i < n; ++i) {
            const Link outer = horizon_[i];
            const Face<R>& beyond = face(outer.face);
            const int to = beyond.v[outer.edge];
            const int from = beyond.v[(outer.edge + 1) % 3];
            const int added = add(from, to, count_);
            if (added < 0) return false;
            if (face(added).sliver) at(added).normal = face(outer.face).normal;
            link({added, 0}, outer);
            if (last >= 0) link({last, 1}, {added, 2});
            if (first < 0) first = added;
            last = added;
        }
        link({last, 1}, {first, 2});
        ++count_;
        return true;
    }

  private:
    Face<R>& at(int i) { return faces_[i]; }
    void link(Link a, Link b) {
        at(a.face).next[a.edge] = b;
        at(b.face).next[b.edge] = a;
    }

    int add(int a, int b, int c) {
        int slot = 0;
        while (slot < used_ && face(slot).alive) ++slot;
        if (slot == kMaxFaces) return -1;
        used_ = std::max(used_, slot + 1);
        Face<R>& f = at(slot);
        f.v = {a, b, c};
        f.alive = true;
        const Vec3<R> ab = point(b).w - point(a).w, ac = point(c).w - point(a).w, bc = ac - ab;
        // Computed from the two shorter edges.
        const R lab = ab.squaredNorm(), lac = ac.squaredNorm(), lbc = bc.squaredNorm();
        Vec3<R> n = ab.cross(ac);
        if (lab > lac && lab > lbc)
            n = ac.cross(bc);
        else if (lac > lbc)
            n = ab.cross(bc);
        const R area = n.norm(), longest = std::sqrt(std::max({lab, lac, lbc}));
        // Thinner than a few roundings: no normal to speak of.
        f.sliver = !(area > R(4) * tolerance_ * longest);
        if (!f.sliver) {
            f.normal = n / area;
            f.offset = f.normal.dot(point(a).w + point(b).w + point(c).w) / R(3);
            f.sliver = f.normal.dot(center_) >= f.offset;
        }
        return slot;
    }

    /// Faces that see x, reached from `seed`; their horizon as links to the faces beyond.
    void findHorizon(int seed, const Vec3<R>& x) {
        mark_.fill(Mark::Unknown);
        seen_[0] = seed;
        mark_[seed] = Mark::Seen;
        seenCount_ = 1;
        horizonCount_ = 0;
        for (int k = 0; k < seenCount_; ++k)
            for (const Link& l : face(seen_[k]).next) {
                Mark& mark = mark_[l.face];
                if (mark != Mark::Unknown) continue;
                const Face<R>& g = face(l.face);
                const R offset = g.sliver ? g.normal.dot(point(g.v[0]).w) : g.offset;
                mark = g.normal.dot(x) - offset >= -tolerance_ ? Mark::Seen : Mark::Beyond;
                if (mark == Mark::Seen) seen_[seenCount_++] = l.face;
            }
        for (int k = 0; k < seenCount_; ++k)
            for (const Link& l : face(seen_[k]).next)
                if (mark_[l.face] == Mark::Beyond && horizonCount_ < kMaxHorizon)
                    horizon_[horizonCount_++] = l;
    }

    /// Sorts the horizon into one loop; false when it is none.
    bool ordered() {
        const auto start = [&](int i) {
            const Link l = horizon_[i];
            return face(l.face).v[(l.edge + 1) % 3];
        };
        const auto end = [&](int i) {
            const Link l = horizon_[i];
            return face(l.face).v[l.edge];
        };
        for (int i = 0; i + 1 < horizonCount_; ++i) {
            int j = i + 1;
            while (j < horizonCount_ && start(j) != end(i)) ++j;
            if (j == horizonCount_) return false;
            std::swap(horizon_[i + 1], horizon_[j]);
        }
        return end(horizonCount_ - 1) == start(0);
    }

    R tolerance_;
    Vec3<R> center_;
    std::array<DifferencePoint<S>, kMaxVertices> points_;
    std::array<Face<R>, kMaxFaces> faces_;
    std::array<Mark, kMaxFaces> mark_;
    std::array<int, kMaxFaces> seen_;
    std::array<Link, kMaxHorizon> horizon_;
    int count_ = 0, used_ = 0, seenCount_ = 0, horizonCount_ = 0;
};

/// Finds four support points of D with about the largest distances; returns fewer where D is flat.
template <class R>
int initialTetrahedron(const Minkowski<Space<R, 3>>& D, std::array<DifferencePoint<Space<R, 3>>, 4>& start,
                       R& size, EpaResult<Space<R, 3>>& result) {
    using V = Vec3<R>;
    const auto supportAlong = [&](const V& d) {
        ++result.iterations;
        DifferencePoint<Space<R, 3>> p = D.point(d);
        size = std::max({size, p.a.norm(), p.b.norm()});
        return p;
    };
    R widest = -1;
    for (int i = 0; i < 3; ++i) {
        const auto low = supportAlong(-V::Unit(i)), high = supportAlong(V::Unit(i));
        if (const R l = (high.w - low.w).norm(); l > widest) {
            widest = l;
            start[0] = low;
            start[1] = high;
        }
    }
    result.normal = V::UnitY();
    if (!(widest > R(4) * kRounding<R> * size)) return 1;
    const V along = (start[1].w - start[0].w) / widest;
    const V u = along.unitOrthogonal(), w = along.cross(u);
    result.normal = u;
    R farthest = -1;
    for (const V& d : {u, V(-u), w, V(-w)}) {
        const auto p = supportAlong(d);
        if (const R l = along.cross(p.w - start[0].w).norm(); l > farthest) {
            farthest = l;
            start[2] = p;
        }
    }
    if (!(farthest > R(4) * kRounding<R> * size)) return 2;
    const V n = along.cross(start[2].w - start[0].w).normalized();
    result.normal = n;
    R highest = -1;
    for (const V& d : {n, V(-n)}) {
        const auto p = supportAlong(d);
        if (const R l = std::abs(n.dot(p.w - start[0].w)); l > highest) {
            highest = l;
            start[3] = p;
        }
    }
    return highest > R(4) * kRounding<R> * size ? 4 : 3;
}

/// Computes the normal again from the largest triangle of the points in the facet.
template <class R>
void refineNormal(const Minkowski<Space<R, 3>>& D, const ExpandingPolytope<R>& polytope, R tolerance,
                  EpaResult<Space<R, 3>>& best) {
    std::array<int, kMaxVertices> on;
    int n = 0;
    for (int i = 0; i < polytope.count(); ++i)
        if (best.normal.dot(polytope.point(i).w) >= best.depth - R(8) * tolerance) on[n++] = i;
    const auto w = [&](int i) -> const Vec3<R>& { return polytope.point(on[i]).w; };
    if (n < 4) return;
    int p = 0, q = 0, r = 0;
    R widest = 0;
    for (int i = 1; i < n; ++i)
        if (const R l = (w(i) - w(0)).squaredNorm(); l > widest) {
            widest = l;
            p = i;
        }
    widest = 0;
    for (int i = 0; i < n; ++i)
        if (const R l = (w(i) - w(p)).squaredNorm(); l > widest) {
            widest = l;
            q = i;
        }
    Vec3<R> normal = best.normal;
    widest = 0;
    for (int i = 0; i < n; ++i) {
        const Vec3<R> c = (w(q) - w(p)).cross(w(i) - w(p));
        if (const R l = c.squaredNorm(); l > widest) {
            widest = l;
            r = i;
            normal = c;
        }
    }
    if (!(widest > 0) || r == p || r == q) return;
    normal.normalize();
    if (normal.dot(best.normal) < 0) normal = -normal;
    const R support = normal.dot(D.point(normal).w);
    ++best.iterations;
    if (support < best.depth) {
        best.depth = support;
        best.normal = normal;
    }
}

}  // namespace

template <class R>
EpaResult<Space<R, 3>> epa(const Minkowski<Space<R, 3>>& D) {
    using S = Space<R, 3>;
    EpaResult<S> best;
    std::array<DifferencePoint<S>, 4> start;
    R size = 0;
    if (const int rank = initialTetrahedron<R>(D, start, size, best); rank < 4) {
        best.depth = 0;
        best.flat = best.converged = true;
        return best;
    }
    const R tolerance = kRounding<R> * size;
    ExpandingPolytope<R> polytope(start, tolerance);
    best.depth = std::numeric_limits<R>::max();
    while (true) {
        const int i = polytope.least();
        if (i < 0) break;
        const Face<R>& f = polytope.face(i);
        const DifferencePoint<S> x = D.point(f.normal);
        ++best.iterations;
        const R support = f.normal.dot(x.w);
        if (support < best.depth) {
            best.depth = support;
            best.normal = f.normal;
        }
        best.converged = best.depth - f.offset <= tolerance;
        if (best.converged) break;
        if (polytope.contains(x.w))
            polytope.raiseOffset(i, support);
        else if (!polytope.grow(i, x))
            break;
    }
    refineNormal<R>(D, polytope, tolerance, best);
    const Vec3<R> target = best.depth * best.normal;
    R nearest = std::numeric_limits<R>::max();
    for (int i = 0; i < polytope.used(); ++i) {
        const Face<R>& f = polytope.face(i);
        if (!f.alive || f.sliver) continue;
        Simplex<S> triangle;
        for (std::size_t k = 0; k < 3; ++k) triangle.points[k] = polytope.point(f.v[k]);
        triangle.count = 3;
        const R squared = reduceSimplex<S>(triangle, target).squaredNorm();
        if (squared < nearest) {
            nearest = squared;
            best.simplex = triangle;
        }
    }
    return best;
}

template EpaResult<Space3f> epa<float>(const Minkowski<Space3f>&);
template EpaResult<Space3d> epa<double>(const Minkowski<Space3d>&);

}  // namespace rigor::engine
