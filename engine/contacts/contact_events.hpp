// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Events: contacts, and overlaps with sensors, that have begun or ended in a step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/contacts/contact.hpp"
#include "engine/contacts/contact_finder.hpp"
#include "engine/contacts/shape_record.hpp"

namespace rigor::engine {

enum class EventKind : std::uint8_t {
    ContactBegins,  ///< two shapes that did not touch in the last step touch (overlap, or push each other)
    ContactEnds,    ///< they touched and do not any more, or one of them was removed
    SensorBegins,  ///< a shape (B) overlaps a sensor (A) that it did not at the end of the last step (sensors.hpp)
    SensorEnds,  ///< it did and does not any more
};

/// Fields that do not belong to the kind keep their defaults.
template <class S>
struct Event {
    using Real = typename S::Real;
    EventKind kind = EventKind::ContactBegins;
    BodyId bodyA, bodyB;  ///< A is the body of lower index, or the sensor
    ShapeId shapeA, shapeB;
    typename S::Vec normal = S::Vec::Zero();  ///< unit, A to B, world frame
    Real depth = 0;                           ///< deepest overlap when found [m]; < 0: a gap
    Real impulse = 0;                         ///< sum of the normal impulses of the step [N s]
};

template <class S>
class ContactEvents {
  public:
    /// Appends an event for every contact that has begun or ended, in the order of contacts. `ended`: those
    /// that have been removed.
    void add(const BodyArrays<S>& bodies, std::span<const ShapeRecord<S>> shapes,
             const ContactList<S>& contacts, std::span<const EndedContact> ended,
             std::vector<Event<S>>& events, const Tasks& tasks);

  private:
    std::vector<std::uint8_t> touchChanged_;  ///< flag of each contact: 1 where touching has begun or ended
};

}  // namespace rigor::engine
