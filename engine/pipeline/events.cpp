// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/events.hpp"

#include <charconv>

#include "engine/pipeline/world.hpp"

namespace rigor::engine {
namespace {

/// The shortest text that reads back as the same number.
template <class R>
std::string text(R value) {
    char buffer[32];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return error == std::errc{} ? std::string(buffer, end) : "nan";
}

template <class Vec>
std::string text(const Vec& v, int size) {
    std::string out = "(";
    for (int i = 0; i < size; ++i) out += (i > 0 ? "," : "") + text(v[i]);
    return out + ")";
}

template <class S>
std::string line(const char* what, BodyId a, BodyId b, const typename S::Vec& normal, typename S::Real depth,
                 typename S::Real impulse, const NameOf& nameOf) {
    return std::string(what) + " a=" + nameOf(a) + " b=" + nameOf(b) + " n=" + text(normal, S::dim) +
           " depth=" + text(depth) + " jn=" + text(impulse);
}

}  // namespace

const char* eventName(EventKind kind) {
    switch (kind) {
        case EventKind::ContactBegins:
            return "contact_begins";
        case EventKind::SensorBegins:
            return "sensor_begins";
        case EventKind::SensorEnds:
            return "sensor_ends";
        case EventKind::ContactEnds:
            break;
    }
    return "contact_ends";
}

std::string bodyName(BodyId body) {
    return body ? "body_" + std::to_string(body.index) : "world";
}

template <class S>
std::string describe(const Event<S>& e, const NameOf& nameOf) {
    if (e.kind != EventKind::ContactBegins)
        return std::string(eventName(e.kind)) + " a=" + nameOf(e.bodyA) + " b=" + nameOf(e.bodyB);
    return line<S>(eventName(e.kind), e.bodyA, e.bodyB, e.normal, e.depth, e.impulse, nameOf);
}

template <class S>
std::string describe(const ContactView<S>& c, const NameOf& nameOf) {
    return line<S>("contact", c.bodyA, c.bodyB, c.normal, 0 - c.separation, c.normalImpulse, nameOf);
}

#define RIGOR_INSTANTIATE(S)                                       \
    template std::string describe(const Event<S>&, const NameOf&); \
    template std::string describe(const ContactView<S>&, const NameOf&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
