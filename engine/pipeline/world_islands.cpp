// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/world_islands.hpp"

namespace rigor::engine {

template <class S>
void WorldIslands<S>::find(const Links& links) const {
    const BodyArrays<S>& bodies = links.bodies;
    stale_ = false;
    const auto dynamic = [&](std::uint32_t i) { return bodies.constants[i].type == BodyType::Dynamic; };
    marks_.resize(bodies.size());
    for (std::uint32_t i = 0; i < bodies.size(); ++i) marks_[i] = dynamic(i);
    islands_.begin(static_cast<std::uint32_t>(bodies.size()));
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        if (dynamic(a) && dynamic(b)) islands_.join(a, b);
    };
    for (const Contact<S>& contact : links.contacts)
        if (!contact.vetoed) join(contact.bodyA, contact.bodyB);
    for (const auto& record : links.joints.records()) join(record.joint.a, record.joint.b);
    islands_.finish(marks_, bodies.id);
}

RIGOR_INSTANTIATE_CLASS(WorldIslands)

}  // namespace rigor::engine
