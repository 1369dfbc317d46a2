// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The event log: what happened in a step, in words that name bodies by id.
#pragma once

#include <functional>
#include <string>

#include "engine/contacts/contact_events.hpp"

namespace rigor::engine {

const char* eventName(EventKind kind);  ///< "contact_begins", ...

template <class S>
struct ContactView;

/// Function that names a body in the log.
using NameOf = std::function<std::string(BodyId)>;
/// "body_3" for the body of index 3, "world" for none.
std::string bodyName(BodyId body);

/// contact_begins a=box_3 b=ground n=(0,1,0) depth=1.2e-4 jn=0.163; of other kinds: contact_ends a=box_3 b=ground
template <class S>
std::string describe(const Event<S>& event, const NameOf& nameOf = bodyName);
/// contact a=box_3 b=ground n=(0,1,0) depth=1.2e-4 jn=0.163
template <class S>
std::string describe(const ContactView<S>& contact, const NameOf& nameOf = bodyName);

}  // namespace rigor::engine
