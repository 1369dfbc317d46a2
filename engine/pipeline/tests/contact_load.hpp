// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Impulses of the contacts of a body.
#pragma once

#include <vector>

#include "engine/pipeline/world.hpp"

namespace rigor::engine::test {

/// Sum of the normal impulses of a body's contacts in the last step [N s].
template <class S>
double normalImpulseOn(const World<S>& world, BodyId body) {
    std::vector<ContactView<S>> contacts;
    world.readContacts(contacts);
    double sum = 0;
    for (const ContactView<S>& contact : contacts)
        if (contact.bodyA == body || contact.bodyB == body) sum += static_cast<double>(contact.normalImpulse);
    return sum;
}

}  // namespace rigor::engine::test
