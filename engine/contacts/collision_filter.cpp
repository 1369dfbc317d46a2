// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/collision_filter.hpp"

#include <algorithm>

#include "engine/contacts/contact.hpp"

namespace rigor::engine {

/// Two bodies, both with collisions, that no joint excludes.
template <class S>
bool CollisionFilter<S>::connects(const BodyArrays<S>& bodies, std::uint32_t a, std::uint32_t b) const {
    if (a == b) return false;
    if (!bodies.constants[a].collides || !bodies.constants[b].collides) return false;
    return excluded_.empty() || !std::binary_search(excluded_.begin(), excluded_.end(), pairKey(a, b));
}

template <class S>
bool CollisionFilter<S>::bodiesMayCollide(const BodyArrays<S>& bodies, std::uint32_t a,
                                          std::uint32_t b) const {
    const BodyConstants<S>&A = bodies.constants[a], &B = bodies.constants[b];
    if (A.type != BodyType::Dynamic && B.type != BodyType::Dynamic) return false;
    return connects(bodies, a, b);
}

template <class S>
bool CollisionFilter<S>::mayFind(const BodyArrays<S>& bodies, const ShapeRecord<S>& sensor,
                                 const ShapeRecord<S>& other) const {
    const auto isStatic = [&](const ShapeRecord<S>& shape) {
        return bodies.constants[shape.body].type == BodyType::Static;
    };
    return sensor.sensor && !other.sensor && lets(sensor.filter, other.filter) &&
           !(isStatic(sensor) && isStatic(other)) && connects(bodies, sensor.body, other.body);
}

RIGOR_INSTANTIATE_CLASS(CollisionFilter)

}  // namespace rigor::engine
