// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Area, centroid and second moment of 2D shapes; computed in double.
//   polygon: fan of triangles (o, a, b) of signed area T = (a x b) / 2 from a vertex o:
//     centroid (a + b) / 3, second moment about o: T (a.a + a.b + b.b) / 6
//   capsule: rectangle 2r x 2h and two half discs, whose centroids lie 4r / (3 pi) beyond the ends.
#include <numbers>
#include <stdexcept>

#include "engine/shapes/hull.hpp"

namespace rigor::engine {
namespace {

using V = Eigen::Vector2d;
struct Moments {
    double area = 0.0;
    V center = V::Zero();
    double inertia = 0.0;  ///< inertia per unit density, about the centre
};

template <class R>
Moments moments(const Sphere<Space<R, 2>>& s) {
    const double r = s.radius, area = std::numbers::pi * r * r;
    return {area, V::Zero(), 0.5 * area * r * r};
}
template <class R>
Moments moments(const Box<Space<R, 2>>& s) {
    const V h = s.halfExtents.template cast<double>();
    const double area = 4.0 * h.x() * h.y();
    return {area, V::Zero(), area * h.squaredNorm() / 3.0};
}
template <class R>
Moments moments(const Capsule<Space<R, 2>>& s) {
    const double r = s.radius, h = s.halfLength, pi = std::numbers::pi;
    const double rectangle = 4.0 * r * h, disc = pi * r * r;
    // The two half discs: about the full disc's centre r^2/2; shifted apart by h each, with centroids 4r/(3
    // pi) further out: mean square distance to the capsule's centre r^2/2 + h^2 + 2h 4r/(3 pi).
    const double ends = disc * (0.5 * r * r + h * h + 8.0 * h * r / (3.0 * pi));
    return {rectangle + disc, V::Zero(), rectangle * (r * r + h * h) / 3.0 + ends};
}
template <class R>
Moments moments(const Hull<Space<R, 2>>& s) {
    const auto& v = s.data->vertices;
    const V origin = v[0].template cast<double>();
    Moments m;
    for (std::size_t i = 1; i + 1 < v.size(); ++i) {
        const V a = v[i].template cast<double>() - origin, b = v[i + 1].template cast<double>() - origin;
        const double triangle = 0.5 * (a.x() * b.y() - a.y() * b.x());
        m.area += triangle;
        m.center += triangle * (a + b) / 3.0;
        m.inertia += triangle * (a.dot(a) + a.dot(b) + b.dot(b)) / 6.0;
    }
    m.center /= m.area;
    m.inertia -= m.area * m.center.squaredNorm();
    m.center += origin;
    return m;
}

}  // namespace

template <class R>
MassProperties<Space<R, 2>> massOf(const Shape<Space<R, 2>>& shape, R density) {
    const Moments m = std::visit(
        []<class Kind>(const Kind& s) -> Moments {
            if constexpr (kStaticOnly<Kind>)
                throw std::invalid_argument("half-planes and curves have no mass");
            else
                return moments<R>(s);
        },
        shape);
    const double rho = density;
    return {static_cast<R>(rho * m.area), m.center.cast<R>(), static_cast<R>(rho * m.inertia)};
}

template <>
MassProperties<Space2f> massProperties<Space2f>(const Shape<Space2f>& shape, float density) {
    return massOf<float>(shape, density);
}
template <>
MassProperties<Space2d> massProperties<Space2d>(const Shape<Space2d>& shape, double density) {
    return massOf<double>(shape, density);
}

}  // namespace rigor::engine
