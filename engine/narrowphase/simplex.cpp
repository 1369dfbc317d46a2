// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The point of a simplex nearest to the origin by signed volumes [Montanari2017]: the barycentric coordinates
// of the origin's projection are ratios of signed volumes (areas, lengths); where all agree in sign with the
// whole the projection is inside, else the nearest point is on a facet opposite to a vertex whose coordinate
// does not agree, and the search goes on there.
//   tetrahedron  l_i = V_i / V,  V_i: vertex i replaced by the origin
//   triangle     p = (s0 . n) n / n^2,  areas of the coordinate plane in which the triangle is largest
//   segment      t = -s0 . e / e^2
// Deviations: facets of a degenerate simplex are all searched; the result is made orthogonal to the segment
// or triangle once more, so that its direction is right however close the origin is.
#include "engine/narrowphase/minkowski.hpp"

namespace rigor::engine {
namespace {

template <class S>
struct Nearest {
    typename S::Vec v;
    std::array<typename S::Real, S::dim + 1> weights{};
    std::array<int, S::dim + 1> index{};
    int count = 0;
};

template <class S>
using Points = std::array<typename S::Vec, S::dim + 1>;

template <class S>
Nearest<S> onVertex(const Points<S>& s, int i) {
    Nearest<S> r;
    r.v = s[i];
    r.weights[0] = 1;
    r.index[0] = i;
    r.count = 1;
    return r;
}

template <class S>
Nearest<S> onSegment(const Points<S>& s, int i, int j) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const V &p = s[i], &q = s[j];
    const V e = q - p;
    const R ee = e.squaredNorm(), pe = -p.dot(e), qe = q.dot(e);
    if (!(pe > 0)) return onVertex<S>(s, i);
    if (!(qe > 0)) return onVertex<S>(s, j);
    Nearest<S> r;
    const R t = pe / ee;
    r.v = pe <= qe ? V(p + t * e) : V(q - (qe / ee) * e);
    r.v -= (r.v.dot(e) / ee) * e;
    r.weights[0] = 1 - t;
    r.weights[1] = t;
    r.index[0] = i;
    r.index[1] = j;
    r.count = 2;
    return r;
}

template <class S>
void keepNearer(const Nearest<S>& candidate, Nearest<S>& best) {
    if (best.count == 0 || candidate.v.squaredNorm() < best.v.squaredNorm()) best = candidate;
}

/// The weighted points `index` when their simplex holds the nearest point, which is v.
template <class S, std::size_t n>
Nearest<S> onInside(const typename S::Vec& v, const std::array<int, n>& index,
                    const std::array<typename S::Real, n>& part) {
    Nearest<S> r;
    r.v = v;
    typename S::Real sum = part[0];
    for (std::size_t m = 1; m < n; ++m) sum += part[m];
    for (std::size_t m = 0; m < n; ++m) {
        r.weights[m] = part[m] / sum;
        r.index[m] = index[m];
    }
    r.count = static_cast<int>(n);
    return r;
}

/// The nearest of the edges opposite to vertices that do not agree.
template <class S>
Nearest<S> onEdges(const Points<S>& s, const std::array<int, 3>& index,
                   const std::array<typename S::Real, 3>& part, bool flat) {
    Nearest<S> r;
    for (std::size_t m = 0; m < 3; ++m)
        if (flat || part[m] <= 0) keepNearer<S>(onSegment<S>(s, index[(m + 1) % 3], index[(m + 2) % 3]), r);
    return r;
}

/// Nearest point of a triangle in 2D: the triangle either contains the origin or an edge is nearest.
template <class R>
Nearest<Space<R, 2>> onTriangle(const Points<Space<R, 2>>& s, int i, int j, int k) {
    using S = Space<R, 2>;
    const std::array<int, 3> index{i, j, k};
    const auto at = [&](std::size_t m) -> const Vec2<R>& { return s[index[m % 3]]; };
    const R area = cross(Vec2<R>(at(1) - at(0)), Vec2<R>(at(2) - at(0)));
    const R size = std::max({at(0).norm(), at(1).norm(), at(2).norm()});
    const bool flat = !(std::abs(area) > kRounding<R> * size * size);
    bool inside = !flat;
    std::array<R, 3> part{};
    for (std::size_t m = 0; m < 3; ++m) {
        part[m] = cross(at(m + 1), at(m + 2)) / (flat ? R(1) : area);
        inside = inside && part[m] >= 0;
    }
    if (inside) return onInside<S>(Vec2<R>::Zero(), index, part);
    return onEdges<S>(s, index, part, flat);
}

template <class R>
Nearest<Space<R, 3>> onTriangle(const Points<Space<R, 3>>& s, int i, int j, int k) {
    using S = Space<R, 3>;
    const std::array<int, 3> index{i, j, k};
    const auto at = [&](std::size_t m) -> const Vec3<R>& { return s[index[m % 3]]; };
    // The two shorter edges lose least in the cross product.
    std::size_t apex = 0;
    R longest = -1;
    for (std::size_t m = 0; m < 3; ++m)
        if (const R l = (at(m + 2) - at(m + 1)).squaredNorm(); l > longest) {
            longest = l;
            apex = m;
        }
    const Vec3<R> e1 = at(apex + 1) - at(apex), e2 = at(apex + 2) - at(apex);
    const Vec3<R> n = e1.cross(e2);
    const R nn = n.squaredNorm();
    const R rounding = std::numeric_limits<R>::epsilon();
    const bool flat = !(nn > rounding * rounding * e1.squaredNorm() * e2.squaredNorm()) ||
                      !(nn > std::numeric_limits<R>::min());
    std::array<R, 3> part{};
    bool inside = !flat;
    if (!flat) {
        const Vec3<R> p = n * (at(apex).dot(n) / nn);
        int drop = 0;
        n.cwiseAbs().maxCoeff(&drop);
        const int x = (drop + 1) % 3, y = (drop + 2) % 3;
        for (std::size_t m = 0; m < 3; ++m) {
            const Vec3<R> f = at(m + 1) - p, g = at(m + 2) - p;
            part[m] = (f[x] * g[y] - f[y] * g[x]) / n[drop];
            inside = inside && part[m] > 0;
        }
        if (inside) return onInside<S>(p, index, part);
    }
    return onEdges<S>(s, index, part, flat);
}

template <class R>
Nearest<Space<R, 3>> onTetrahedron(const Points<Space<R, 3>>& s) {
    using S = Space<R, 3>;
    const Vec3<R> e1 = s[1] - s[0], e2 = s[2] - s[0], e3 = s[3] - s[0];
    const R volume = e1.dot(e2.cross(e3));
    const R scale = std::sqrt(e1.squaredNorm() * e2.squaredNorm() * e3.squaredNorm());
    const bool flat = !(std::abs(volume) > kRounding<R> * scale);
    const std::array<std::array<int, 3>, 4> faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    std::array<R, 4> part{};
    bool inside = !flat;
    for (std::size_t m = 0; m < 4 && !flat; ++m) {
        const auto at = [&](std::size_t i) -> const Vec3<R>& { return s[faces[m][i]]; };
        part[m] = at(0).dot((at(1) - at(0)).cross(at(2) - at(0))) / volume;
        inside = inside && part[m] >= 0;
    }
    if (inside) return onInside<S>(Vec3<R>::Zero(), std::array<int, 4>{0, 1, 2, 3}, part);
    Nearest<S> r;
    for (std::size_t m = 0; m < 4; ++m)
        if (flat || part[m] <= 0) keepNearer<S>(onTriangle<R>(s, faces[m][0], faces[m][1], faces[m][2]), r);
    return r;
}

}  // namespace

template <class S>
typename S::Vec reduceSimplex(Simplex<S>& simplex, const typename S::Vec& target) {
    Points<S> s;
    for (int i = 0; i < simplex.count; ++i) s[i] = simplex.points[i].w - target;
    Nearest<S> r;
    if (simplex.count == 1) r = onVertex<S>(s, 0);
    if (simplex.count == 2) r = onSegment<S>(s, 0, 1);
    if (simplex.count == 3) r = onTriangle<typename S::Real>(s, 0, 1, 2);
    if constexpr (S::dim == 3)
        if (simplex.count == 4) r = onTetrahedron<typename S::Real>(s);
    const Simplex<S> old = simplex;
    simplex.count = r.count;
    simplex.weights = r.weights;
    for (int i = 0; i < r.count; ++i) simplex.points[i] = old.points[r.index[i]];
    return r.v;
}

#define RIGOR_INSTANTIATE(S) template S::Vec reduceSimplex(Simplex<S>&, const S::Vec&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
