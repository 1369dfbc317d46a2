// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The order and number of the contacts that a collision engine answers with.
#pragma once

#include <algorithm>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::adapter {

/// Orders contacts by depth, the deepest first; equal ones keep their order.
inline void orderDeepestFirst(std::vector<ContactPoint>& contacts) {
    std::stable_sort(contacts.begin(), contacts.end(),
                     [](const ContactPoint& p, const ContactPoint& q) { return p.depth > q.depth; });
}

/// Keeps the first `most` contacts (CollisionQuery::maxContacts).
inline void keepFirst(std::vector<ContactPoint>& contacts, int most) {
    const auto count = static_cast<std::size_t>(std::max(most, 0));
    if (contacts.size() > count) contacts.resize(count);
}

}  // namespace rigor::adapter
