// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The "sat" narrow phase: a table of pair functions by the kinds of A and B. Each pair is written in one
// order of kinds; the other order swaps the arguments and flips the result.
#include <array>
#include <utility>

#include "engine/narrowphase/detail.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {
namespace {

template <class S>
inline constexpr std::size_t kKinds = std::variant_size_v<Shape<S>>;

/// Pairs are written with the kind of lower order first; two kinds of one order never meet.
template <class S>
constexpr int order(std::size_t kind) {
    constexpr std::array<int, 5> kOrder{0, 1, 2, 4, 3};  // sphere, box, capsule, half-space, hull
    static_assert(kOrder.size() == kKinds<S>);
    return kOrder[kind];
}
inline constexpr std::size_t kHalfSpaceKind = 3;

template <class S, std::size_t A, std::size_t B>
void collideKinds(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                  typename S::Real speculative, Manifold<S>& out) {
    if constexpr (A == kHalfSpaceKind && B == kHalfSpaceKind) {
        // Both are static and unbounded: no contact is asked for.
    } else if constexpr (order<S>(A) <= order<S>(B)) {
        collidePair(*std::get_if<A>(&a), Xa, *std::get_if<B>(&b), Xb, speculative, out);
    } else {
        collidePair(*std::get_if<B>(&b), Xb, *std::get_if<A>(&a), Xa, speculative, out);
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
}

#define INSTANTIATE(S)                                                                                     \
    template void collideSat<S>(const Shape<S>&, const Pose<S>&, const Shape<S>&, const Pose<S>&, S::Real, \
                                Manifold<S>&);
INSTANTIATE(Space2f)
INSTANTIATE(Space2d)
INSTANTIATE(Space3f)
INSTANTIATE(Space3d)
#undef INSTANTIATE

}  // namespace rigor::engine
