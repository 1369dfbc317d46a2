// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The event log: what happened in a step, in words that name bodies by id.
#pragma once

#include <functional>
#include <string>

#include "engine/core/ids.hpp"
#include "engine/math/space.hpp"

namespace rigor::engine {

enum class EventKind : std::uint8_t {
    ContactBegins,  ///< two shapes that did not touch in the last step touch (overlap, or push each other)
    ContactEnds,    ///< they touched and do not any more
};
const char* eventName(EventKind kind);  ///< "contact_begins", ...

/// Fields that do not belong to the kind keep their defaults.
template <class S>
struct Event {
    using Real = typename S::Real;
    EventKind kind = EventKind::ContactBegins;
    BodyId bodyA, bodyB;  ///< A is the body of lower index
    ShapeId shapeA, shapeB;
    typename S::Vec normal = S::Vec::Zero();  ///< unit, A to B, world frame
    Real depth = 0;                           ///< deepest overlap when found [m]; < 0: a gap
    Real impulse = 0;                         ///< sum of the normal impulses of the step [N s]
};

template <class S>
struct ContactView;

/// How a body is called in the log.
using NameOf = std::function<std::string(BodyId)>;
/// "body_3" for the body of index 3, "world" for none.
std::string bodyName(BodyId body);

/// contact_begins a=box_3 b=ground n=(0,1,0) depth=1.2e-4 jn=0.163
template <class S>
std::string describe(const Event<S>& event, const NameOf& nameOf = bodyName);
/// contact a=box_3 b=ground n=(0,1,0) depth=1.2e-4 jn=0.163
template <class S>
std::string describe(const ContactView<S>& contact, const NameOf& nameOf = bodyName);

}  // namespace rigor::engine
