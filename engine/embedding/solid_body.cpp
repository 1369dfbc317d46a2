// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/embedding/solid_body.hpp"

#include "engine/pipeline/require.hpp"
#include "engine/pipeline/shape_def.hpp"

namespace rigor::engine {
namespace {

template <class S>
ShapeDef<S> shapeOf(const SolidPart<S>& part) {
    ShapeDef<S> shape;
    shape.shape = part.shape;
    shape.pose = part.pose;
    shape.material = part.material;
    shape.density = part.density;
    return shape;
}

/// Throws what World::addShape would, before there is a body.
template <class S>
void requirePart(const World<S>& world, BodyType type, const SolidPart<S>& part) {
    BodyConstants<S> constants;
    constants.type = type;
    makeShapeRecord<S>(shapeOf(part), constants, 0);
    requireMaterial(part.material, world.materialCount());
}

}  // namespace

template <class S>
BodyId addSolid(World<S>& world, std::initializer_list<SolidPart<S>> parts, BodyDef<S> def) {
    def.mass = 0;
    def.inertia = zeroInertia<S>();
    for (const SolidPart<S>& part : parts) requirePart(world, def.type, part);
    const BodyId body = world.addBody(def);
    for (const SolidPart<S>& part : parts) world.addShape(body, shapeOf(part));
    // The velocity of `def` is that of the centre of mass, which the shapes have moved.
    if (def.type != BodyType::Static) world.setVelocity(body, def.velocity, def.angularVelocity);
    return body;
}

#define RIGOR_INSTANTIATE(S) \
    template BodyId addSolid<S>(World<S>&, std::initializer_list<SolidPart<S>>, BodyDef<S>);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
