// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/contact_events.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace rigor::engine {

template <class S>
void ContactEvents<S>::add(const BodyArrays<S>& bodies, std::span<const ShapeRecord<S>> shapes,
                           const ContactList<S>& contacts, std::span<const EndedContact> ended,
                           std::vector<Event<S>>& events, const Tasks& tasks) {
    using Real = typename S::Real;
    // least number of contacts for a task: some microseconds of work
    constexpr std::size_t kContactGrain = 64;
    touchChanged_.resize(contacts.size());
    tasks.forEach(contacts.size(), kContactGrain,
                  [&](std::size_t k) { touchChanged_[k] = contacts[k].touching != contacts[k].touched; });
    const auto changes = std::count(touchChanged_.begin(), touchChanged_.end(), std::uint8_t(1));
    events.reserve(events.size() + static_cast<std::size_t>(changes) + ended.size());
    const auto key = [](const auto& c) { return std::pair(pairKey(c.shapeA, c.shapeB), c.piece); };
    const auto append = [&](EventKind kind, const auto& c) -> Event<S>& {
        Event<S>& event = events.emplace_back();
        event.kind = kind;
        event.bodyA = bodies.id[c.bodyA];
        event.bodyB = bodies.id[c.bodyB];
        event.shapeA = shapes[c.shapeA].id;
        event.shapeB = shapes[c.shapeB].id;
        return event;
    };
    const auto begins = [&](const Contact<S>& contact) {
        Event<S>& event = append(EventKind::ContactBegins, contact);
        event.normal = contact.manifold.normal;
        event.depth = -std::numeric_limits<Real>::infinity();
        for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
            event.depth = std::max(event.depth, -contact.manifold.points[i].separation);
            event.impulse += contact.totals[i].normal;
        }
    };
    auto nextEnded = ended.begin();
    const std::uint8_t* const end = touchChanged_.data() + touchChanged_.size();
    const auto next = [end](const std::uint8_t* from) {
        const void* found =
            from == end ? nullptr : std::memchr(from, 1, static_cast<std::size_t>(end - from));
        return found == nullptr ? end : static_cast<const std::uint8_t*>(found);
    };
    for (const std::uint8_t* changed = next(touchChanged_.data()); changed != end;
         changed = next(changed + 1)) {
        const Contact<S>& contact = contacts[changed - touchChanged_.data()];
        for (; nextEnded != ended.end() && key(*nextEnded) < key(contact); ++nextEnded)
            append(EventKind::ContactEnds, *nextEnded);
        if (contact.touching)
            begins(contact);
        else
            append(EventKind::ContactEnds, contact);
    }
    for (; nextEnded != ended.end(); ++nextEnded) append(EventKind::ContactEnds, *nextEnded);
}

RIGOR_INSTANTIATE_CLASS(ContactEvents)

}  // namespace rigor::engine
