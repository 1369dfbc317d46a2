// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/narrowphase/shape_overlap.hpp"

#include "engine/core/ids.hpp"
#include "engine/narrowphase/distance.hpp"
#include "engine/narrowphase/surface_contact.hpp"
#include "engine/shapes/ray_cast.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {
namespace {

/// True if the lowest point of the shape is in the solid under a height field.
template <class S>
bool underField(const Shape<S>& field, const Pose<S>& Xf, const Shape<S>& shape, const Pose<S>& X) {
    if constexpr (S::dim == 3) {
        const auto* f = std::get_if<HeightField<S>>(&field);
        if (!f) return false;
        const Pose<S> local{toLocal<S>(Xf, X.p), compose(inverse(Xf.q), X.q)};
        using R = typename S::Real;
        using V = typename S::Vec;
        const V low = toWorld<S>(local, support<S>(shape, rotateInverse<R>(local.q, V(-V::UnitY()))));
        const auto& d = *f->data;
        if (low.y() < d.lowest - d.thickness || low.y() > d.highest) return false;
        RayHit<S> hit;
        return castRay<S>(field, Pose<S>{}, low, V(0, d.highest - low.y() + d.thickness, 0), hit);
    } else {
        (void)field;
        (void)Xf;
        (void)shape;
        (void)X;
        return false;
    }
}

}  // namespace

template <class S>
std::optional<std::uint32_t> findOverlap(const Shape<S>& shape, const Pose<S>& X, const Shape<S>& other,
                                         const Pose<S>& Xother) {
    if (!isComposite<S>(other)) {
        if (closestPoints<S>(shape, X, other, Xother).distance > 0) return std::nullopt;
        return kNullIndex;
    }
    std::uint32_t piece = kNullIndex;
    withSurface<S>(other, [&](const auto& data) {
        data.query(boxOnSurface<S>(Xother, shape, X, typename S::Real(0)), [&](std::uint32_t k) {
            const Shape<S> part = data.piece(k);
            if (k < piece && closestPoints<S>(shape, X, part, Xother).distance <= 0) piece = k;
        });
    });
    if (piece == kNullIndex && !underField<S>(other, Xother, shape, X)) return std::nullopt;
    return piece;
}

#define RIGOR_INSTANTIATE(S)                                                                               \
    template std::optional<std::uint32_t> findOverlap<S>(const Shape<S>&, const Pose<S>&, const Shape<S>&, \
                                                         const Pose<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
