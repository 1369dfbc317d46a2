// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Events: contacts that have begun or ended in a step.
#include "engine/contacts/contact_set.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace rigor::engine {

template <class S>
void ContactSet<S>::addEvents(const BodyArrays<S>& bodies, std::vector<Event<S>>& events,
                              const Tasks& tasks) {
    constexpr std::size_t kContactGrain = 64;  // worth a task: some microseconds of work
    touchChanged_.resize(contacts_.size());
    tasks.forEach(contacts_.size(), kContactGrain, [this](std::size_t k) {
        touchChanged_[k] = contacts_[k].touching != contacts_[k].touched;
    });
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
    auto ended = ended_.begin();
    const std::uint8_t* const end = touchChanged_.data() + touchChanged_.size();
    const auto next = [end](const std::uint8_t* from) {
        const void* found =
            from == end ? nullptr : std::memchr(from, 1, static_cast<std::size_t>(end - from));
        return found == nullptr ? end : static_cast<const std::uint8_t*>(found);
    };
    for (const std::uint8_t* changed = next(touchChanged_.data()); changed != end;
         changed = next(changed + 1)) {
        const Contact<S>& contact = contacts_[static_cast<std::size_t>(changed - touchChanged_.data())];
        for (; ended != ended_.end() && key(*ended) < key(contact); ++ended)
            add(EventKind::ContactEnds, *ended);
        if (contact.touching)
            begins(contact);
        else
            add(EventKind::ContactEnds, contact);
    }
    for (; ended != ended_.end(); ++ended) add(EventKind::ContactEnds, *ended);
}

RIGOR_INSTANTIATE_CLASS(ContactSet)

}  // namespace rigor::engine
