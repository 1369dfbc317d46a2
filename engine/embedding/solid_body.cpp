// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/embedding/solid_body.hpp"

#include <vector>

#include "engine/math/rotation.hpp"

namespace rigor::engine {
namespace {

/// Inertia of a point mass at r about the origin.
template <class S>
typename S::Inertia pointInertia(typename S::Real mass, const typename S::Vec& r) {
    if constexpr (S::dim == 2)
        return mass * r.squaredNorm();
    else
        return mass * (r.squaredNorm() * S::Inertia::Identity() - r * r.transpose());
}

template <class S>
void setMass(std::span<const SolidPart<S>> parts, BodyDef<S>& def) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    std::vector<MassProperties<S>> masses;  // in the body frame
    Real mass = 0;
    Vec moment = Vec::Zero();
    for (const SolidPart<S>& part : parts) {
        MassProperties<S> own = massProperties<S>(part.shape, part.density);
        own.center = toWorld<S>(part.pose, own.center);
        own.inertia = worldInertia<S>(part.pose.q, own.inertia);
        mass += own.mass;
        moment += own.mass * own.center;
        masses.push_back(own);
    }
    def.mass = mass;
    def.centerOfMass = moment / mass;
    def.inertia = zeroInertia<S>();
    for (const MassProperties<S>& own : masses)
        def.inertia +=
            typename S::Inertia(own.inertia + pointInertia<S>(own.mass, own.center - def.centerOfMass));
}

}  // namespace

template <class S>
BodyId addSolid(World<S>& world, std::initializer_list<SolidPart<S>> parts, BodyDef<S> def) {
    if (def.type == BodyType::Dynamic && parts.size() > 0)
        setMass<S>(std::span(parts.begin(), parts.size()), def);
    const BodyId body = world.addBody(def);
    for (const SolidPart<S>& part : parts) world.addShape(body, {part.shape, part.pose, part.material});
    return body;
}

#define RIGOR_INSTANTIATE(S) \
    template BodyId addSolid<S>(World<S>&, std::initializer_list<SolidPart<S>>, BodyDef<S>);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
