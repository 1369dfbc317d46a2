// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/embedding/debug_lines.hpp"

#include <vector>

namespace rigor::engine {
namespace {

template <class S>
typename S::Vec centerOf(const World<S>& world, BodyId body) {
    return toWorld<S>(world.pose(body), world.constants(body).centerOfMass);
}

template <class S>
void drawShapes(const World<S>& world, const DebugOptions<S>& options, LineSink<S>& sink) {
    const auto shapes = world.shapes();
    const auto boxes = world.boxes();
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const BodyId body = world.bodyOf(shapes[i]);
        if (options.outlines) drawShape<S>(shapes[i].shape, world.shapePose(shapes[i]), body, options, sink);
        // The boxes of half-spaces have no end.
        if (options.boxes && i < boxes.size() && !std::holds_alternative<HalfSpace<S>>(shapes[i].shape))
            drawBox<S>(boxes[i], body, sink);
    }
}

template <class S>
void drawContacts(const World<S>& world, const DebugOptions<S>& options, LineSink<S>& sink) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    if (!options.contacts && !options.normals && !options.impulses) return;
    std::vector<ContactView<S>> contacts;
    world.readContacts(contacts);
    for (const ContactView<S>& contact : contacts) {
        const Vec at = Real(0.5) * (contact.pointA + contact.pointB);
        const Vec impulse = contact.normalImpulse * contact.normal + contact.frictionImpulse;
        drawContact<S>(at, contact.normal, impulse, contact.bodyB, options, sink);
    }
}

template <class S>
void drawMotion(const World<S>& world, const DebugOptions<S>& options, LineSink<S>& sink) {
    if (!options.velocities) return;
    for (const BodyId body : world.bodies())
        drawVelocity<S>(centerOf(world, body), world.velocity(body), body, options, sink);
}

template <class S>
void drawJoints(const World<S>& world, LineSink<S>& sink) {
    std::vector<JointPlace<S>> joints;
    world.readJoints(joints);
    for (const JointPlace<S>& joint : joints) {
        if (joint.bodyA)
            sink.line(centerOf(world, joint.bodyA), joint.anchorA, DebugKind::Joint, joint.bodyA);
        if (joint.bodyB)
            sink.line(centerOf(world, joint.bodyB), joint.anchorB, DebugKind::Joint, joint.bodyB);
        drawAnchors<S>(joint.anchorA, joint.anchorB, joint.bodyA, joint.bodyB, sink);
    }
}

template <class S>
void drawIslands(const World<S>& world, LineSink<S>& sink) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    const Islands& islands = world.islands();
    for (std::size_t k = 0; k < islands.count(); ++k) {
        Real mass = 0;
        Vec center = Vec::Zero();
        for (const BodyId body : islands.bodies(k)) {
            mass += world.constants(body).mass;
            center += world.constants(body).mass * centerOf(world, body);
        }
        center /= mass;
        for (const BodyId body : islands.bodies(k))
            sink.line(centerOf(world, body), center, DebugKind::Island, body);
    }
}

}  // namespace

const char* debugKindName(DebugKind kind) {
    static constexpr const char* names[kDebugKinds] = {"outline", "box",      "contact", "normal",
                                                       "impulse", "velocity", "joint",   "island"};
    return names[static_cast<std::size_t>(kind)];
}

template <class S>
void drawBox(const Aabb<S>& box, BodyId body, LineSink<S>& sink) {
    using Vec = typename S::Vec;
    if (!box.min.allFinite() || !box.max.allFinite()) return;
    const auto corner = [&](int signs) {
        Vec v = box.min;
        for (int i = 0; i < S::dim; ++i)
            if ((signs >> i & 1) != 0) v[i] = box.max[i];
        return v;
    };
    for (int signs = 0; signs < 1 << S::dim; ++signs)
        for (int i = 0; i < S::dim; ++i)
            if ((signs >> i & 1) == 0) sink.line(corner(signs), corner(signs | 1 << i), DebugKind::Box, body);
}

template <class S>
void drawAnchors(const typename S::Vec& anchorA, const typename S::Vec& anchorB, BodyId bodyA, BodyId bodyB,
                 LineSink<S>& sink) {
    sink.point(anchorA, DebugKind::Joint, bodyA);
    if (anchorA != anchorB) sink.line(anchorA, anchorB, DebugKind::Joint, bodyB);
}

template <class S>
void drawContact(const typename S::Vec& at, const typename S::Vec& normal, const typename S::Vec& impulse,
                 BodyId bodyB, const DebugOptions<S>& options, LineSink<S>& sink) {
    using Vec = typename S::Vec;
    if (options.contacts) sink.point(at, DebugKind::Contact, bodyB);
    if (options.normals) sink.line(at, Vec(at + options.normalLength * normal), DebugKind::Normal, bodyB);
    if (options.impulses && !impulse.isZero(0))
        sink.line(at, Vec(at + options.impulseScale * impulse), DebugKind::Impulse, bodyB);
}

template <class S>
void drawVelocity(const typename S::Vec& center, const typename S::Vec& velocity, BodyId body,
                  const DebugOptions<S>& options, LineSink<S>& sink) {
    using Vec = typename S::Vec;
    if (!options.velocities || velocity.isZero(0)) return;
    sink.line(center, Vec(center + options.velocityScale * velocity), DebugKind::Velocity, body);
}

template <class S>
void drawWorld(const World<S>& world, const DebugOptions<S>& options, LineSink<S>& sink) {
    drawShapes(world, options, sink);
    drawContacts(world, options, sink);
    drawMotion(world, options, sink);
    if (options.joints) drawJoints(world, sink);
    if (options.islands) drawIslands(world, sink);
}

#define RIGOR_INSTANTIATE(S)                                                                    \
    template void drawContact<S>(const S::Vec&, const S::Vec&, const S::Vec&, BodyId,           \
                                 const DebugOptions<S>&, LineSink<S>&);                         \
    template void drawVelocity<S>(const S::Vec&, const S::Vec&, BodyId, const DebugOptions<S>&, \
                                  LineSink<S>&);                                                \
    template void drawBox<S>(const Aabb<S>&, BodyId, LineSink<S>&);                             \
    template void drawAnchors<S>(const S::Vec&, const S::Vec&, BodyId, BodyId, LineSink<S>&);   \
    template void drawWorld<S>(const World<S>&, const DebugOptions<S>&, LineSink<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
