// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/moving_shape.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "engine/shapes/hull.hpp"

namespace rigor::engine {
template <class S>
typename S::Real coreBoundingRadius(const Shape<S>& shape, const Pose<S>& local) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    return std::visit(
        [&](const auto& s) -> Real {
            using Kind = std::decay_t<decltype(s)>;
            if constexpr (std::is_same_v<Kind, Sphere<S>>) {
                return local.p.norm();
            } else if constexpr (std::is_same_v<Kind, Capsule<S>>) {
                const Vec end = rotate(local.q, Vec(s.halfLength * Vec::Unit(1)));
                return std::max((local.p + end).norm(), (local.p - end).norm());
            } else if constexpr (std::is_same_v<Kind, Ellipsoid<S>>) {
                return local.p.norm() + s.halfAxes.maxCoeff();
            } else if constexpr (std::is_same_v<Kind, HalfSpace<S>>) {
                return 0;  // static
            } else if constexpr (std::is_same_v<Kind, Hull<S>>) {
                Real radius = 0;
                for (const Vec& v : s.data->vertices) radius = std::max(radius, toWorld<S>(local, v).norm());
                return radius;
            } else {
                const Aabb<S> box = boundingBox<S>(shape, {});
                const Vec furthest = box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs());
                return local.p.norm() + furthest.norm();
            }
        },
        shape);
}

template <class S>
bool mayPassUnseen(const MovingShape<S>& a, const MovingShape<S>& b, typename S::Real t) {
    using Real = typename S::Real;
    const Real turning = std::sqrt(dotAng(a.velocity.w, a.velocity.w)) * a.boundingRadius +
                         std::sqrt(dotAng(b.velocity.w, b.velocity.w)) * b.boundingRadius;
    const Real motion = t * ((b.velocity.v - a.velocity.v).norm() + turning);
    return motion > Real(0.5) * a.inscribedRadius + Real(0.5) * b.inscribedRadius;
}

template <class S>
Aabb<S> sweptBox(const MovingShape<S>& shape, typename S::Real t) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    Aabb<S> box = boundingBox<S>(*shape.shape, shape.at(0));
    const Real turn =
        std::min(t * std::sqrt(dotAng(shape.velocity.w, shape.velocity.w)), Real(2)) * shape.boundingRadius;
    const Vec d = t * shape.velocity.v;
    box.min += d.cwiseMin(Real(0)) - Vec::Constant(turn);
    box.max += d.cwiseMax(Real(0)) + Vec::Constant(turn);
    return box;
}

#define RIGOR_INSTANTIATE(S)                                                               \
    template S::Real coreBoundingRadius<S>(const Shape<S>&, const Pose<S>&);               \
    template bool mayPassUnseen<S>(const MovingShape<S>&, const MovingShape<S>&, S::Real); \
    template Aabb<S> sweptBox<S>(const MovingShape<S>&, S::Real);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
