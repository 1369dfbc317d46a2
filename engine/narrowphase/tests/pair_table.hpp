// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Helpers shared by the narrow phase's tests: shapes of all kinds, random poses, and a separation by supports
// alone.
#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "engine/narrowphase/manifold.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine::test {

template <class S>
typename S::Vec vec(double x, double y, double z = 0) {
    using R = typename S::Real;
    if constexpr (S::dim == 2) {
        (void)z;
        return {static_cast<R>(x), static_cast<R>(y)};
    } else {
        return {static_cast<R>(x), static_cast<R>(y), static_cast<R>(z)};
    }
}

/// `angle` about +z, and in 3D by `tilt` about +x before.
template <class S>
typename S::Rot turn(double angle, double tilt = 0) {
    using R = typename S::Real;
    if constexpr (S::dim == 2) {
        (void)tilt;
        return S::Rot::fromAngle(static_cast<R>(angle));
    } else {
        return typename S::Rot(Eigen::AngleAxis<R>(static_cast<R>(angle), S::Vec::UnitZ()) *
                               Eigen::AngleAxis<R>(static_cast<R>(tilt), S::Vec::UnitX()));
    }
}

template <class S>
Pose<S> pose(const typename S::Vec& p, const typename S::Rot& q = Pose<S>::identityRot()) {
    Pose<S> X;
    X.p = p;
    X.q = q;
    return X;
}

template <class S>
Shape<S> boxHull(const typename S::Vec& half) {
    std::vector<typename S::Vec> corners;
    for (unsigned i = 0; i < (1u << S::dim); ++i) {
        typename S::Vec v = half;
        for (int k = 0; k < S::dim; ++k)
            if (i >> k & 1) v[k] = -v[k];
        corners.push_back(v);
    }
    return makeHull<S>(corners);
}

template <class S>
double tol(double forDouble, double forFloat) {
    return sizeof(typename S::Real) == 4 ? forFloat : forDouble;
}

template <class S>
struct Random {
    using R = typename S::Real;
    std::mt19937 generator;
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(generator); }
    double normal() { return std::normal_distribution<double>()(generator); }
    typename S::Vec direction() { return vec<S>(normal(), normal(), normal()).normalized(); }
    typename S::Rot rotation() {
        if constexpr (S::dim == 2) {
            return S::Rot::fromAngle(static_cast<R>(uniform(-3, 3)));
        } else {
            typename S::Rot q(static_cast<R>(normal()), static_cast<R>(normal()), static_cast<R>(normal()),
                              static_cast<R>(normal()));
            return q.normalized();
        }
    }
};

/// Indices of Shape that tests name; the others are found by kKinds alone.
struct Kind {
    enum { Sphere, Box, Capsule, HalfSpace, Hull };
};
template <class S>
inline constexpr int kKinds = static_cast<int>(std::variant_size_v<Shape<S>>);

/// Two slopes of a roof, as a mesh of four triangles.
template <class S>
Shape<S> roof() {
    const typename S::Vec v[] = {vec<S>(-0.8, 0, -0.8), vec<S>(0, 0.3, -0.8), vec<S>(0.8, 0, -0.8),
                                 vec<S>(-0.8, 0, 0.8),  vec<S>(0, 0.3, 0.8),  vec<S>(0.8, 0, 0.8)};
    const std::array<std::uint32_t, 3> t[] = {{0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}};
    return makeTriangleMesh<S>(v, t);
}
/// A grid of bumps.
template <class S>
Shape<S> bumps() {
    using R = typename S::Real;
    std::vector<R> heights;
    for (int k = 0; k < 5; ++k)
        for (int i = 0; i < 6; ++i) heights.push_back(R(0.1) * static_cast<R>((3 * i + 2 * k) % 4) - R(0.2));
    return makeHeightField<S>(6, 5, R(0.4), R(0.4), heights, R(1));
}

/// One shape of each kind, by Shape index.
template <class S>
Shape<S> shapeOfKind(int kind) {
    using R = typename S::Real;
    switch (kind) {
        case Kind::Sphere:
            return Sphere<S>{R(0.6)};
        case Kind::Box:
            return Box<S>{vec<S>(0.5, 0.3, 0.7)};
        case Kind::Capsule:
            return Capsule<S>{R(0.25), R(0.5)};
        case Kind::HalfSpace:
            return HalfSpace<S>{vec<S>(0, 1, 0), R(0)};
        case Kind::Hull: {
            Random<S> random{std::mt19937(77)};
            std::vector<typename S::Vec> points;
            for (int i = 0; i < 12; ++i)
                points.push_back(static_cast<R>(random.uniform(0.4, 0.8)) * random.direction());
            return makeHull<S>(points);
        }
        default:
            break;
    }
    constexpr std::size_t known = 5;
    if constexpr (S::dim == 3) {
        const Shape<S> more[] = {
            Cylinder<S>{R(0.4), R(0.5)},
            Cone<S>{R(0.5), R(0.6)},
            Ellipsoid<S>{vec<S>(0.6, 0.3, 0.45)},
            Triangle<S>{{vec<S>(-0.6, -0.1, -0.5), vec<S>(0.7, 0, -0.3), vec<S>(0, 0.2, 0.7)}},
            roof<S>(),
            bumps<S>()};
        static_assert(std::size(more) + known == std::variant_size_v<Shape<S>>, "a kind without an example");
        return more[static_cast<std::size_t>(kind) - known];
    } else {
        const typename S::Vec points[] = {vec<S>(-0.7, 0.2), vec<S>(-0.2, -0.1), vec<S>(0.3, 0),
                                          vec<S>(0.6, 0.4)};
        const Shape<S> more[] = {Segment<S>{vec<S>(-0.6, -0.2), vec<S>(0.7, 0.3)},
                                 makeChain<S>(points, false)};
        static_assert(std::size(more) + known == std::variant_size_v<Shape<S>>, "a kind without an example");
        return more[static_cast<std::size_t>(kind) - known];
    }
}

/// True if the pair is in the tables of convex pairs. Two static shapes never collide; composites are not
/// convex (surface_contact_test.cpp).
template <class S>
bool isConvexPair(const Shape<S>& a, const Shape<S>& b) {
    return !(isStaticOnly<S>(a) && isStaticOnly<S>(b)) && !isComposite<S>(a) && !isComposite<S>(b);
}
template <class S>
bool isRound(const Shape<S>& s) {
    const std::string name = shapeName<S>(s);
    return name == "cylinder" || name == "cone";
}
/// Tolerance for curved sides: points of a cap are good to 4e-6 of its radius (kRimNoise); a sphere near the
/// axis of a cylinder has all directions as penetration directions, which an iteration over support points
/// meets to 1e-4. The tolerance is 0 for other shapes.
template <class S>
double curvedTolerance(const Shape<S>& a, const Shape<S>& b) {
    if (!isRound<S>(a) && !isRound<S>(b)) return 0;
    const auto ball = [](const Shape<S>& s) { return std::holds_alternative<Sphere<S>>(s); };
    return ball(a) || ball(b) ? 2e-4 : tol<S>(1e-5, 5e-5);
}

template <class S>
Manifold<S> collide(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                    double speculative = 0.0) {
    Manifold<S> m;
    findNarrowPhase<S>("sat")(a, Xa, b, Xb, static_cast<typename S::Real>(speculative), m);
    return m;
}

template <class S>
double leastSeparation(const Manifold<S>& m) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < m.count; ++i) least = std::min(least, static_cast<double>(m.points[i].separation));
    return least;
}

/// Gap between the supporting planes of bounded shapes along the unit direction n, from A to B.
template <class S>
double separationAlong(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                       const typename S::Vec& n) {
    const auto reach = [](const Shape<S>& s, const Pose<S>& X, const typename S::Vec& d) {
        return rotate(X.q, support<S>(s, rotateInverse<typename S::Real>(X.q, d))).dot(d);
    };
    return static_cast<double>(n.dot(Xb.p - Xa.p) - reach(b, Xb, -n) - reach(a, Xa, n));
}

}  // namespace rigor::engine::test
