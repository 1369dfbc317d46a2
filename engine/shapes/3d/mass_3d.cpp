// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Volume, centroid and inertia tensor of the solid shapes; computed in double.
//   polyhedron: tetrahedra (o, a, b, c) of signed volume T = a . (b x c) / 6 from a vertex o:
//     centroid (a + b + c) / 4, integral of x x^T: T / 20 (a a^T + b b^T + c c^T + s s^T), s = a + b + c
//   capsule: a cylinder and two half spheres, whose centroids lie 3r/8 beyond the ends
//   cone: centroid a quarter of its height over the base; about it 3/10 m r^2 along the axis, 3/20 m r^2 +
//     3/80 m (2h)^2 across [Goldstein2002, ch. 5].
//   ellipsoid: 4/3 pi a b c; m/5 (b^2 + c^2) about the axis a
#include <numbers>
#include <stdexcept>

#include "engine/shapes/hull.hpp"

namespace rigor::engine {
namespace {

using V = Eigen::Vector3d;
using M = Eigen::Matrix3d;
struct Moments {
    double volume = 0.0;
    V center = V::Zero();
    M inertia = M::Zero();  ///< inertia per unit density, about the centre
};

M diagonal(double x, double y, double z) {
    return V(x, y, z).asDiagonal();
}

template <class R>
Moments moments(const Sphere<Space<R, 3>>& s) {
    const double r = s.radius, volume = 4.0 / 3.0 * std::numbers::pi * r * r * r;
    return {volume, V::Zero(), M(0.4 * volume * r * r * M::Identity())};
}
template <class R>
Moments moments(const Box<Space<R, 3>>& s) {
    const V h = s.halfExtents.template cast<double>(), q = h.cwiseProduct(h);
    const double volume = 8.0 * h.prod(), k = volume / 3.0;
    return {volume, V::Zero(), diagonal(k * (q.y() + q.z()), k * (q.z() + q.x()), k * (q.x() + q.y()))};
}
template <class R>
Moments moments(const Capsule<Space<R, 3>>& s) {
    const double r = s.radius, h = s.halfLength, pi = std::numbers::pi;
    const double cylinder = 2.0 * pi * r * r * h, ball = 4.0 / 3.0 * pi * r * r * r;
    const double axial = 0.5 * cylinder * r * r + 0.4 * ball * r * r;
    // The two half spheres: 2/5 r^2 about the sphere's centre; shifted by h each, centroids 3r/8 further out.
    const double across =
        cylinder * (h * h / 3.0 + 0.25 * r * r) + ball * (0.4 * r * r + h * h + 0.75 * h * r);
    return {cylinder + ball, V::Zero(), diagonal(across, axial, across)};
}
template <class R>
Moments moments(const Cylinder<Space<R, 3>>& s) {
    const double r = s.radius, h = s.halfLength, volume = 2.0 * std::numbers::pi * r * r * h;
    const double across = volume * (0.25 * r * r + h * h / 3.0);
    return {volume, V::Zero(), diagonal(across, 0.5 * volume * r * r, across)};
}
template <class R>
Moments moments(const Cone<Space<R, 3>>& s) {
    const double r = s.radius, h = s.halfLength, volume = 2.0 / 3.0 * std::numbers::pi * r * r * h;
    const double across = 0.15 * volume * (r * r + h * h);
    return {volume, V(0, -0.5 * h, 0), diagonal(across, 0.3 * volume * r * r, across)};
}
template <class R>
Moments moments(const Ellipsoid<Space<R, 3>>& s) {
    const V h = s.halfAxes.template cast<double>(), q = h.cwiseProduct(h);
    const double volume = 4.0 / 3.0 * std::numbers::pi * h.prod(), k = 0.2 * volume;
    return {volume, V::Zero(), diagonal(k * (q.y() + q.z()), k * (q.z() + q.x()), k * (q.x() + q.y()))};
}
template <class R>
Moments moments(const Hull<Space<R, 3>>& s) {
    const auto& hull = *s.data;
    const V origin = hull.vertices[0].template cast<double>();
    const auto vertex = [&](int i) {
        return V(hull.vertices[hull.loops[i]].template cast<double>() - origin);
    };
    Moments m;
    M second = M::Zero();
    for (const HullFace<R>& f : hull.faces) {
        const V a = vertex(f.first);
        for (int i = 1; i + 1 < f.count; ++i) {
            const V b = vertex(f.first + i), c = vertex(f.first + i + 1), sum = a + b + c;
            const double tetrahedron = a.dot(b.cross(c)) / 6.0;
            m.volume += tetrahedron;
            m.center += 0.25 * tetrahedron * sum;
            second += tetrahedron / 20.0 *
                      (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
        }
    }
    m.center /= m.volume;
    second -= m.volume * m.center * m.center.transpose();
    m.inertia = second.trace() * M::Identity() - second;
    m.center += origin;
    return m;
}

template <class R>
MassProperties<Space<R, 3>> massOf(const Shape<Space<R, 3>>& shape, R density) {
    const Moments m = std::visit(
        []<class Kind>(const Kind& s) -> Moments {
            if constexpr (kStaticOnly<Kind>)
                throw std::invalid_argument("half-spaces and surfaces have no mass");
            else
                return moments<R>(s);
        },
        shape);
    const double rho = density;
    return {static_cast<R>(rho * m.volume), m.center.cast<R>(), (rho * m.inertia).cast<R>()};
}

}  // namespace

template <>
MassProperties<Space3f> massProperties<Space3f>(const Shape<Space3f>& shape, float density) {
    return massOf<float>(shape, density);
}
template <>
MassProperties<Space3d> massProperties<Space3d>(const Shape<Space3d>& shape, double density) {
    return massOf<double>(shape, density);
}

}  // namespace rigor::engine
