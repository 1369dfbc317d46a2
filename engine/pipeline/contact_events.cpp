// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What began and what ended in a step.
#include "engine/pipeline/contact_set.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace rigor::engine {

template <class S>
void ContactSet<S>::noteEvents(const BodyArrays<S>& bodies, std::vector<Event<S>>& events,
                               const Tasks& tasks) {
    constexpr std::size_t kContactGrain = 64;  // worth sharing: some microseconds of work
    turned_.resize(contacts_.size());
    tasks.forEach(contacts_.size(), kContactGrain,
                  [this](std::size_t k) { turned_[k] = contacts_[k].touching != contacts_[k].touched; });
    const auto key = [](const auto& c) { return std::pair(pairKey(c.shapeA, c.shapeB), c.piece); };
    const auto add = [&](EventKind kind, const auto& c) -> Event<S>& {
        Event<S>& event = events.emplace_back();
        event.kind = kind;
        event.bodyA = bodies.id[c.bodyA];
        event.bodyB = bodies.id[c.bodyB];
        event.shapeA = shapes_[c.shapeA].id;
        event.shapeB = shapes_[c.shapeB].id;
        return event;
    };
    const auto begins = [&](const Contact<S>& contact) {
        Event<S>& event = add(EventKind::ContactBegins, contact);
        event.normal = contact.manifold.normal;
        event.depth = -std::numeric_limits<Real>::infinity();
        for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
            event.depth = std::max(event.depth, -contact.manifold.points[i].separation);
            event.impulse += contact.totals[i].normal;
        }
    };
    auto gone = gone_.begin();
    const std::uint8_t* const end = turned_.data() + turned_.size();
    const auto next = [end](const std::uint8_t* from) {
        const void* found =
            from == end ? nullptr : std::memchr(from, 1, static_cast<std::size_t>(end - from));
        return found == nullptr ? end : static_cast<const std::uint8_t*>(found);
    };
    for (const std::uint8_t* turned = next(turned_.data()); turned != end; turned = next(turned + 1)) {
        const Contact<S>& contact = contacts_[static_cast<std::size_t>(turned - turned_.data())];
        for (; gone != gone_.end() && key(*gone) < key(contact); ++gone) add(EventKind::ContactEnds, *gone);
        if (contact.touching)
            begins(contact);
        else
            add(EventKind::ContactEnds, contact);
    }
    for (; gone != gone_.end(); ++gone) add(EventKind::ContactEnds, *gone);
}

RIGOR_INSTANTIATE_CLASS(ContactSet)

}  // namespace rigor::engine
