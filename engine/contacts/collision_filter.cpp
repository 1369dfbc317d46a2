// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/collision_filter.hpp"

#include <algorithm>

#include "engine/contacts/contact.hpp"

namespace rigor::engine {

template <class S>
bool CollisionFilter<S>::bodiesMayCollide(const BodyArrays<S>& bodies, std::uint32_t a,
                                          std::uint32_t b) const {
    if (a == b) return false;
    const BodyConstants<S>&A = bodies.constants[a], &B = bodies.constants[b];
    if (!A.collides || !B.collides) return false;
    if (A.type != BodyType::Dynamic && B.type != BodyType::Dynamic) return false;
    return excluded_.empty() || !std::binary_search(excluded_.begin(), excluded_.end(), pairKey(a, b));
}

RIGOR_INSTANTIATE_CLASS(CollisionFilter)

}  // namespace rigor::engine
