// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/embedding/solid_body.hpp"

namespace rigor::engine {
namespace {

template <class S>
void addPart(World<S>& world, BodyId body, const SolidPart<S>& part) {
    ShapeDef<S> shape;
    shape.shape = part.shape;
    shape.pose = part.pose;
    shape.material = part.material;
    shape.density = part.density;
    world.addShape(body, shape);
}

}  // namespace

template <class S>
BodyId addSolid(World<S>& world, std::initializer_list<SolidPart<S>> parts, BodyDef<S> def) {
    def.mass = 0;
    def.inertia = zeroInertia<S>();
    const BodyId body = world.addBody(def);
    try {
        for (const SolidPart<S>& part : parts) addPart(world, body, part);
    } catch (...) {
        world.removeBody(body);
        throw;
    }
    // The velocity of `def` is that of the centre of mass, which the shapes have moved.
    if (def.type != BodyType::Static) world.setVelocity(body, def.velocity, def.angularVelocity);
    return body;
}

#define RIGOR_INSTANTIATE(S) \
    template BodyId addSolid<S>(World<S>&, std::initializer_list<SolidPart<S>>, BodyDef<S>);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
