// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ray x(t) = o + t d against every kind of shape, in the frame of the shape.
//
//   convex by planes (box, hull, half-space; the caps of a cylinder): each plane n . x <= c bounds t on one
//     side; the last way in before the first way out is the hit [CyrusBeck1978]
//   sphere, side of capsule, cylinder, cone: |P x|^2 <= r(y)^2, a quadratic in t with roots
//     q = -(b + sign(b) sqrt(b^2 - a c)),  t = q / a, c / q, which loses no digits to cancellation
//   ellipsoid: the unit sphere in coordinates scaled by the half axes
//   triangle: o + t d = v0 + u e1 + w e2, by Cramer's rule [MollerTrumbore1997]; the ray is between its
//     sides where d . (a x b) has one sign for all of them, a -> b from o
//   segment: the same with one edge
//   composites: their pieces along the ray (surface.hpp), the nearest hit
// The hit of a capsule is the first of its side and its two spheres. Sides shared by two triangles belong to
// both, widened by rounding; and d . (a x b) is exactly -d . (b x a), so that both of them agree on which
// side of theirs a ray passes, as in [Woop2013]: nothing passes between them, slivers or not. Cost: O(1);
// O(faces) of hulls; O(log n + pieces hit) of composites.
#include "engine/shapes/ray_cast.hpp"

#include <cmath>

#include "engine/shapes/hull.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {
namespace {

template <class S>
struct Ray {
    typename S::Vec o, d;
    typename S::Vec at(typename S::Real t) const { return o + t * d; }
};

/// Interval of the ray inside the clipping planes so far, and the normal where it enters.
template <class S>
struct Interval {
    using R = typename S::Real;
    using V = typename S::Vec;
    R enter = 0, exit = 1;
    V normal = V::Zero();
    bool inside = true;  ///< the origin is

    /// Keeps what has s + t v <= 0; `n` is the outward normal.
    bool clip(R s, R v, const V& n) {
        if (s > 0) inside = false;
        if (v == 0) return s <= 0;
        const R t = -s / v;
        if (v > 0)
            exit = std::min(exit, t);
        else if (s > 0 && t >= enter) {
            enter = t;
            normal = n;
        }
        return enter <= exit;
    }
};

/// Computes both roots of a t^2 + 2 b t + c = 0, smaller first; false if there are none.
template <class R>
bool roots(R a, R b, R c, R& t0, R& t1) {
    const R disc = b * b - a * c;
    if (disc < 0) return false;
    const R q = -(b + (b < 0 ? -std::sqrt(disc) : std::sqrt(disc)));
    if (q == 0) {
        if (a == 0) return false;
        t0 = t1 = 0;
        return true;
    }
    t1 = c / q;
    t0 = a != 0 ? q / a : t1;
    if (t0 > t1) std::swap(t0, t1);
    return true;
}

template <class S>
struct Found {
    typename S::Real t = 2;
    typename S::Vec normal = S::Vec::Zero();
    bool inside = false;
    std::uint32_t piece = kNullIndex;
    void consider(typename S::Real at, const typename S::Vec& n) {
        if (at >= 0 && at <= 1 && at < t) {
            t = at;
            normal = n;
        }
    }
};

template <class S>
void take(const Interval<S>& s, bool met, Found<S>& found) {
    if (!met) return;
    found.inside = s.inside;
    if (!s.inside) found.consider(s.enter, s.normal);
}

/// Entry into the sphere of radius r around c.
template <class S>
void meetBall(const Ray<S>& ray, const typename S::Vec& c, typename S::Real r, Found<S>& found) {
    using R = typename S::Real;
    const typename S::Vec m = ray.o - c;
    const R dd = ray.d.squaredNorm(), b = m.dot(ray.d), outside = m.squaredNorm() - r * r;
    if (outside <= 0) found.inside = true;
    if (outside <= 0 || b >= 0) return;
    // The discriminant from the ray's distance to the centre: exact for small far spheres.
    const typename S::Vec nearest = m - (b / dd) * ray.d;
    const R disc = r * r - nearest.squaredNorm();
    if (disc < 0) return;
    const R t = outside / (-b + std::sqrt(dd * disc));
    found.consider(t, typename S::Vec((ray.at(t) - c).normalized()));
}

/// v without its component along y.
template <class S>
typename S::Vec across(typename S::Vec v) {
    v.y() = 0;
    return v;
}

template <class S>
void meet(const Ray<S>& ray, const Sphere<S>& s, Found<S>& found) {
    meetBall<S>(ray, S::Vec::Zero(), s.radius, found);
}
template <class S>
void meet(const Ray<S>& ray, const Box<S>& s, Found<S>& found) {
    Interval<S> interval;
    bool met = true;
    for (int i = 0; i < S::dim && met; ++i) {
        const typename S::Vec e = S::Vec::Unit(i);
        met = interval.clip(ray.o[i] - s.halfExtents[i], ray.d[i], e) &&
              interval.clip(-ray.o[i] - s.halfExtents[i], -ray.d[i], -e);
    }
    take(interval, met, found);
}
template <class S>
void meet(const Ray<S>& ray, const Capsule<S>& s, Found<S>& found) {
    using V = typename S::Vec;
    const V end = s.halfLength * V::UnitY();
    meetBall<S>(ray, end, s.radius, found);
    meetBall<S>(ray, -end, s.radius, found);
    const V o = across<S>(ray.o), d = across<S>(ray.d);
    const typename S::Real c = o.squaredNorm() - s.radius * s.radius;
    if (c <= 0 && std::abs(ray.o.y()) <= s.halfLength) found.inside = true;
    typename S::Real t0 = 0, t1 = 0;
    if (found.inside || c <= 0 || !roots(typename S::Real(d.squaredNorm()), o.dot(d), c, t0, t1)) return;
    if (std::abs(ray.at(t0).y()) <= s.halfLength) found.consider(t0, V((o + t0 * d).normalized()));
}
template <class S>
void meet(const Ray<S>& ray, const HalfSpace<S>& s, Found<S>& found) {
    Interval<S> interval;
    const bool met = interval.clip(s.normal.dot(ray.o) - s.offset, s.normal.dot(ray.d), s.normal);
    take(interval, met, found);
}
template <class S>
void meet(const Ray<S>& ray, const Hull<S>& s, Found<S>& found) {
    Interval<S> interval;
    bool met = true;
    const auto& data = *s.data;
    if constexpr (S::dim == 2) {
        for (std::size_t i = 0; i < data.normals.size() && met; ++i)
            met = interval.clip(data.normals[i].dot(ray.o - data.vertices[i]), data.normals[i].dot(ray.d),
                                data.normals[i]);
    } else {
        for (std::size_t i = 0; i < data.faces.size() && met; ++i) {
            const auto& f = data.faces[i];
            met = interval.clip(f.normal.dot(ray.o) - f.offset, f.normal.dot(ray.d), f.normal);
        }
    }
    take(interval, met, found);
}
template <class S>
void meet(const Ray<S>& ray, const Cylinder<S>& s, Found<S>& found) {
    using R = typename S::Real;
    using V = typename S::Vec;
    Interval<S> interval;
    bool met = interval.clip(ray.o.y() - s.halfLength, ray.d.y(), V::UnitY()) &&
               interval.clip(-ray.o.y() - s.halfLength, -ray.d.y(), -V::UnitY());
    const V o = across<S>(ray.o), d = across<S>(ray.d);
    const R a = d.squaredNorm(), c = o.squaredNorm() - s.radius * s.radius;
    R t0 = 0, t1 = 0;
    if (c > 0) interval.inside = false;
    if (a == 0 || !roots<R>(a, o.dot(d), c, t0, t1)) {
        met = met && c <= 0;
    } else {
        if (c > 0 && t0 >= interval.enter) {
            interval.enter = t0;
            interval.normal = V((o + t0 * d).normalized());
        }
        met = met && interval.enter <= std::min(interval.exit, t1) && (c <= 0 || t0 >= 0);
    }
    take(interval, met, found);
}
/// Side |P x| = k (h - y), k = r / (2 h), below the apex and above the base.
template <class S>
void meet(const Ray<S>& ray, const Cone<S>& s, Found<S>& found) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const R h = s.halfLength, k = s.radius / (2 * h);
    const V o = across<S>(ray.o), d = across<S>(ray.d);
    const R below = h - ray.o.y();
    const R c = o.squaredNorm() - k * k * below * below;
    found.inside = c <= 0 && below >= 0 && ray.o.y() >= -h;
    if (found.inside) return;
    if (ray.d.y() != 0) {
        const R t = (-h - ray.o.y()) / ray.d.y();
        if ((o + t * d).squaredNorm() <= s.radius * s.radius) found.consider(t, -V::UnitY());
    }
    R t0 = 0, t1 = 0;
    if (!roots<R>(d.squaredNorm() - k * k * ray.d.y() * ray.d.y(), o.dot(d) + k * k * below * ray.d.y(), c,
                  t0, t1))
        return;
    for (const R t : {t0, t1}) {
        const V x = ray.at(t);
        if (!(x.y() <= h && x.y() >= -h)) continue;
        const R rho = across<S>(x).norm();
        const V radial = rho > 0 ? V(across<S>(x) / rho) : V(V::Zero());
        found.consider(t, V((radial + k * V::UnitY()).normalized()));
    }
}

/// In the coordinates x / h it is the unit sphere, with the same fractions t; its normals are along x / h^2.
template <class S>
void meet(const Ray<S>& ray, const Ellipsoid<S>& s, Found<S>& found) {
    using V = typename S::Vec;
    const Ray<S> scaled{ray.o.cwiseQuotient(s.halfAxes), ray.d.cwiseQuotient(s.halfAxes)};
    meetBall<S>(scaled, V::Zero(), 1, found);
    if (found.t <= 1) found.normal = found.normal.cwiseQuotient(s.halfAxes).normalized();
}

/// True where the ray's line passes a triangle, by signs that its neighbours agree with.
template <class S>
bool passesBetween(const Ray<S>& ray, const Triangle<S>& s) {
    using V = typename S::Vec;
    const V a = s.v[0] - ray.o, b = s.v[1] - ray.o, c = s.v[2] - ray.o;
    const auto u = ray.d.dot(a.cross(b)), v = ray.d.dot(b.cross(c)), w = ray.d.dot(c.cross(a));
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// Rounding allowed beside the ends of a segment and the sides of a triangle.
template <class R>
inline constexpr R kSlack = R(8) * std::numeric_limits<R>::epsilon();

template <class S>
void meet(const Ray<S>& ray, const Segment<S>& s, Found<S>& found) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const V e = s.b - s.a, m = s.a - ray.o;
    const R det = cross(ray.d, e);
    if (det == 0) return;
    const R u = cross(m, ray.d) / det;
    if (u < -kSlack<R> || u > 1 + kSlack<R>) return;
    V n = V(-e.y(), e.x()).normalized();
    if (n.dot(ray.d) > 0) n = -n;
    found.consider(cross(m, e) / det, n);
}
template <class S>
void meet(const Ray<S>& ray, const Triangle<S>& s, Found<S>& found) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const V e1 = s.v[1] - s.v[0], e2 = s.v[2] - s.v[0], m = ray.o - s.v[0];
    V n = e1.cross(e2);
    const R det = -n.dot(ray.d);
    if (det == 0) return;
    const V moment = m.cross(ray.d);
    const R u = e2.dot(moment) / det, w = -e1.dot(moment) / det;
    const bool near = u >= -kSlack<R> && w >= -kSlack<R> && u + w <= 1 + kSlack<R>;
    if (!near && !passesBetween(ray, s)) return;
    found.consider(n.dot(m) / det, V(n.normalized() * (det > 0 ? R(1) : R(-1))));
}
template <class S, class Composite>
requires kComposite<Composite>
void meet(const Ray<S>& ray, const Composite& s, Found<S>& found) {
    typename S::Real limit = 1;
    s.data->ray(ray.o, ray.d, limit, [&](std::uint32_t piece) {
        Found<S> own;
        meet(ray, s.data->piece(piece), own);
        // The lowest number of equals: a side belongs to two.
        if (own.t > found.t || (own.t == found.t && piece > found.piece) || own.t > 1) return;
        found.t = own.t;
        found.normal = own.normal;
        found.piece = piece;
        limit = own.t;
    });
}

}  // namespace

template <class S>
bool castRay(const Shape<S>& shape, const Pose<S>& X, const typename S::Vec& origin,
             const typename S::Vec& translation, RayHit<S>& hit) {
    using R = typename S::Real;
    const Ray<S> ray{toLocal<S>(X, origin), rotateInverse<R>(X.q, translation)};
    Found<S> found;
    std::visit([&](const auto& s) { meet(ray, s, found); }, shape);
    hit = {};
    hit.startsInside = found.inside;
    if (found.inside) {
        hit.point = origin;
        hit.normal = -translation.normalized();
        return true;
    }
    if (found.t > 1) return false;
    hit.fraction = found.t;
    hit.point = origin + found.t * translation;
    hit.normal = rotate(X.q, found.normal);
    hit.piece = found.piece;
    return true;
}

#define INSTANTIATE(S) \
    template bool castRay<S>(const Shape<S>&, const Pose<S>&, const S::Vec&, const S::Vec&, RayHit<S>&);
RIGOR_FOR_ALL_SPACES(INSTANTIATE)
#undef INSTANTIATE

}  // namespace rigor::engine
