// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The "sat" narrow phase: a table of pair functions by the kinds of A and B. Each pair is written in one
// order of kinds; the other order swaps the arguments and flips the result. The method itself, from the axes to
// the clipped manifold:
//     boxes      3d/box_axis.cpp, 3d/box_box.cpp; 2d/box_box.cpp
//     polytopes  3d/polytope_axis.cpp (faces, then edges on the Gauss map), 3d/polytope_manifold.cpp;
//                2d/polygon_pairs.cpp
//     others     closed forms; pairs with a curved side between features (3d/feature_pairs.cpp)
//
// Known limits: faces are preferred to edges within 1e-7 of the depth. Measured in double precision against
// the separations along all normals of three vertices and all cross products of two differences of vertices,
// in extended precision: 10 000 pairs of hulls of 8 to 20 vertices, boxes, spheres and capsules, 1e-3 m to
// 1e3 m, up to 1e4 m from the origin, touching to 1e-9 m, grazing, with parallel or nearly parallel edges and
// faces, plates and needles 1:1000, concentric, identical: no wrong verdict beyond 1e-9 m of touching, depths
// within max(1e-9 m, 2e-7 of the depth), normals that lose no more. Overlapping curved sides: as EPA's.
#include <array>
#include <utility>

#include "engine/narrowphase/detail.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/pairs.hpp"
#include "engine/narrowphase/surface_contact.hpp"

namespace rigor::engine {
namespace {

template <class S>
inline constexpr std::size_t kKinds = std::variant_size_v<Shape<S>>;

/// True if there is a function for kinds A and B in this order.
template <class S, class A, class B>
inline constexpr bool kHasPair = requires(const A& a, const B& b, const Pose<S>& X, Manifold<S>& out) {
    collidePair(a, X, b, X, typename S::Real(0), out);
};

template <class S, std::size_t IndexA, std::size_t IndexB>
void collideKinds(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                  typename S::Real speculative, Manifold<S>& out) {
    using A = std::variant_alternative_t<IndexA, Shape<S>>;
    using B = std::variant_alternative_t<IndexB, Shape<S>>;
    if constexpr (kStaticOnly<A> && kStaticOnly<B>) {
        // Both bodies are static: no contact is needed.
    } else if constexpr (kComposite<A>) {
        collideDeepestPiece<S>(&collideSat<S>, a, Xa, b, Xb, speculative, out);
    } else if constexpr (kComposite<B>) {
        collideDeepestPiece<S>(&collideSat<S>, b, Xb, a, Xa, speculative, out);
        flip(out);
    } else if constexpr (kHasPair<S, A, B>) {
        collidePair(*std::get_if<A>(&a), Xa, *std::get_if<B>(&b), Xb, speculative, out);
    } else if constexpr (kHasPair<S, B, A>) {
        flip(out);  // the memory
        collidePair(*std::get_if<B>(&b), Xb, *std::get_if<A>(&a), Xa, speculative, out);
        flip(out);
    } else if constexpr (IndexA <= IndexB) {
        collideFeatures(a, Xa, b, Xb, speculative, out);
    } else {
        flip(out);  // the memory
        collideFeatures(b, Xb, a, Xa, speculative, out);
        flip(out);
    }
}

template <class S, std::size_t... I>
constexpr std::array<CollideFunction<S>, sizeof...(I)> makeTable(std::index_sequence<I...>) {
    return {&collideKinds<S, I / kKinds<S>, I % kKinds<S>>...};
}

}  // namespace

template <class S>
void collideSat(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                typename S::Real speculativeDistance, Manifold<S>& out) {
    static constexpr auto kTable = makeTable<S>(std::make_index_sequence<kKinds<S> * kKinds<S>>());
    out.count = 0;
    kTable[a.index() * kKinds<S> + b.index()](a, Xa, b, Xb, speculativeDistance, out);
    remember(out);
}

#define INSTANTIATE(S)                                                                                     \
    template void collideSat<S>(const Shape<S>&, const Pose<S>&, const Shape<S>&, const Pose<S>&, S::Real, \
                                Manifold<S>&);
RIGOR_FOR_ALL_SPACES(INSTANTIATE)
#undef INSTANTIATE

}  // namespace rigor::engine
