// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/contact.hpp"

#include <algorithm>

namespace rigor::engine {

template <class S>
void placePoints(const BodyArrays<S>& bodies, Contact<S>& contact) {
    const std::uint32_t a = contact.bodyA, b = contact.bodyB;
    contact.placed = true;
    for (int i = 0; i < contact.manifold.count; ++i) {
        const ManifoldPoint<S>& where = contact.manifold.points[i];
        const typename S::Vec at = impulsePoint<S>(where, bodies.invMass[a] > 0, bodies.invMass[b] > 0);
        typename Contact<S>::Point& point = contact.points[i];
        point.rA = at - bodies.pose[a].p;
        point.rB = at - bodies.pose[b].p;
        point.separation = where.separation;
    }
}

template <class S>
bool hasRows(const ContactList<S>& contacts, std::uint32_t shapeA, std::uint32_t shapeB) {
    const std::uint64_t key = pairKey(shapeA, shapeB);
    const std::vector<std::uint32_t>& order = contacts.order();
    const auto first =
        std::lower_bound(order.begin(), order.end(), key, [&](std::uint32_t slot, std::uint64_t k) {
            return pairKey(contacts.at(slot).shapeA, contacts.at(slot).shapeB) < k;
        });
    if (first == order.end()) return false;
    const Contact<S>& found = contacts.at(*first);
    if (pairKey(found.shapeA, found.shapeB) != key) return false;
    return std::any_of(found.block.begin(), found.block.begin() + found.manifold.count,
                       [](std::uint32_t block) { return block != kNullIndex; });
}

#define RIGOR_INSTANTIATE(S)                                         \
    template void placePoints<S>(const BodyArrays<S>&, Contact<S>&); \
    template bool hasRows<S>(const ContactList<S>&, std::uint32_t, std::uint32_t);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
