// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/world_bodies.hpp"

#include <cmath>

#include "engine/pipeline/pose_check.hpp"
#include "engine/pipeline/require.hpp"

namespace rigor::engine {
namespace {

template <class S>
void checkBody(const BodyDef<S>& def) {
    using Real = typename S::Real;
    require(validPose<S>(def.pose), "body_pose", "position must be finite, orientation a unit rotation");
    require(def.velocity.allFinite() && finiteAng(def.angularVelocity), "body_velocity",
            "velocities must be finite");
    require(def.centerOfMass.allFinite(), "body_center_of_mass", "centre of mass must be finite");
    require(std::isfinite(def.gravityScale), "body_gravity_scale", "gravity scale must be finite");
    const auto kept = [](Real k) { return k > 0 && k <= 1; };
    require(kept(def.linearVelocityKept) && kept(def.angularVelocityKept), "body_damping",
            "velocity kept per second must be in (0, 1]");
    if (def.type != BodyType::Dynamic) return;
    BodyMass<S> given{def.mass, def.centerOfMass, def.inertia};
    require(def.mass >= 0 && std::isfinite(def.mass), "body_mass",
            "mass of a dynamic body must be positive, or 0 for that of its shapes");
    require(def.mass > 0 || !given.byHand(), "body_mass", "an inertia needs a mass");
    if (given.byHand()) checkMass<S>({def.mass, def.centerOfMass, def.inertia});
}

}  // namespace

template <class S>
WorldBodies<S>::WorldBodies() {
    arrays_.pose.emplace_back();
    arrays_.velocity.emplace_back();
    arrays_.wrench.emplace_back();
    arrays_.asleep.push_back(0);
    arrays_.stillTime.push_back(0);
    arrays_.islands.push_back(IslandKind::Usual);
    arrays_.constants.emplace_back();
    arrays_.constants[0].collides = false;
    arrays_.invMass.push_back(0);
    arrays_.invInertiaLocal.push_back(zeroInertia<S>());
    arrays_.invInertia.push_back(zeroInertia<S>());
    arrays_.id.emplace_back();
    masses_.emplace_back();
}

template <class S>
BodyId WorldBodies<S>::add(const BodyDef<S>& def) {
    checkBody<S>(def);
    const bool dynamic = def.type == BodyType::Dynamic;
    BodyConstants<S> constants;
    constants.type = def.type;
    constants.collides = def.collides;
    constants.centerOfMass = def.centerOfMass;
    constants.gravityScale = def.gravityScale;
    constants.linearVelocityKept = def.linearVelocityKept;
    constants.angularVelocityKept = def.angularVelocityKept;
    constants.continuousMode = def.continuous;
    BodyMass<S> mass{def.mass, def.centerOfMass, def.inertia};
    if constexpr (S::dim == 3) mass.inertia = Real(0.5) * (def.inertia + def.inertia.transpose());
    if (dynamic) {
        const MassProperties<S> properties = mass.properties();
        constants.mass = properties.mass;
        constants.inertia = properties.inertia;
    }
    const Pose<S> pose{def.pose.p, normalizedRot(def.pose.q)};
    const BodyId id = ids_.add(static_cast<std::uint32_t>(arrays_.size()));
    arrays_.pose.push_back({toWorld<S>(pose, def.centerOfMass), pose.q});
    arrays_.velocity.push_back(def.type == BodyType::Static ? Velocity<S>{}
                                                            : Velocity<S>{def.velocity, def.angularVelocity});
    arrays_.wrench.emplace_back();
    arrays_.asleep.push_back(0);
    arrays_.stillTime.push_back(0);
    arrays_.islands.push_back(IslandKind::Usual);
    arrays_.constants.push_back(constants);
    arrays_.invMass.push_back(dynamic ? Real(1) / constants.mass : Real(0));
    arrays_.invInertiaLocal.push_back(dynamic ? inverseInertia<S>(constants.inertia) : zeroInertia<S>());
    arrays_.invInertia.push_back(zeroInertia<S>());
    arrays_.id.push_back(id);
    masses_.push_back(mass);
    return id;
}

template <class S>
typename WorldBodies<S>::Removed WorldBodies<S>::remove(BodyId body) {
    const std::uint32_t gone = ids_.dense(body);
    arrays_.leaveMidpoint(gone);
    const auto last = static_cast<std::uint32_t>(arrays_.size() - 1);
    const auto fill = [gone](auto& array) {
        array[gone] = array.back();
        array.pop_back();
    };
    fill(arrays_.pose);
    fill(arrays_.velocity);
    fill(arrays_.wrench);
    fill(arrays_.constants);
    fill(arrays_.asleep);
    fill(arrays_.stillTime);
    fill(arrays_.islands);
    fill(arrays_.invMass);
    fill(arrays_.invInertiaLocal);
    fill(arrays_.invInertia);
    fill(arrays_.id);
    fill(masses_);
    // They may be fewer than the bodies.
    Midpoints<S>& midpoints = arrays_.midpoints;
    if (!midpoints.pose.empty()) {
        midpoints.pose.resize(last + 1);
        midpoints.velocity.resize(last + 1);
        midpoints.valid.resize(last + 1, 0);
        fill(midpoints.pose);
        fill(midpoints.velocity);
        fill(midpoints.valid);
    }
    ids_.remove(body);
    if (gone != last) ids_.move(arrays_.id[gone], gone);
    return {gone, last};
}

template <class S>
Pose<S> WorldBodies<S>::pose(BodyId body) const {
    const std::uint32_t i = ids_.dense(body);
    const Pose<S>& X = arrays_.pose[i];
    if (arrays_.constants[i].centerOfMass.isZero(0)) return X;
    return {X.p - rotate(X.q, arrays_.constants[i].centerOfMass), X.q};
}

template <class S>
typename S::Vec WorldBodies<S>::applyMass(std::uint32_t body) {
    using Vec = typename S::Vec;
    BodyConstants<S>& constants = arrays_.constants[body];
    if (constants.type != BodyType::Dynamic) return Vec::Zero();
    const MassProperties<S> properties = masses_[body].properties();
    const Vec way = properties.center - constants.centerOfMass;
    constants.mass = properties.mass;
    constants.inertia = properties.inertia;
    constants.centerOfMass = properties.center;
    arrays_.invInertiaLocal[body] = inverseInertia<S>(constants.inertia);
    if (!arrays_.asleep[body]) arrays_.invMass[body] = Real(1) / constants.mass;
    arrays_.leaveMidpoint(body);
    if (way.isZero(0)) return way;
    Pose<S>& X = arrays_.pose[body];
    Velocity<S>& velocity = arrays_.velocity[body];
    const Vec moved = rotate(X.q, way);
    X.p += moved;
    velocity.v += cross(velocity.w, moved);
    return way;
}

template <class S>
void WorldBodies<S>::setType(std::uint32_t body, BodyType type) {
    BodyConstants<S>& constants = arrays_.constants[body];
    constants.type = type;
    constants.mass = 0;
    constants.inertia = zeroInertia<S>();
    arrays_.asleep[body] = 0;
    arrays_.stillTime[body] = 0;
    arrays_.islands[body] = IslandKind::Usual;
    arrays_.invMass[body] = 0;
    arrays_.invInertiaLocal[body] = arrays_.invInertia[body] = zeroInertia<S>();
    if (type == BodyType::Static) arrays_.velocity[body] = {};
    arrays_.leaveMidpoint(body);
}

template <class S>
void WorldBodies<S>::applyImpulse(std::uint32_t body, const typename S::Vec& impulse,
                                  const typename S::Ang& angularImpulse) {
    arrays_.velocity[body].v += arrays_.invMass[body] * impulse;
    arrays_.velocity[body].w += typename S::Ang(
        worldInertia<S>(arrays_.pose[body].q, arrays_.invInertiaLocal[body]) * angularImpulse);
    arrays_.leaveMidpoint(body);
}

RIGOR_INSTANTIATE_CLASS(WorldBodies)

}  // namespace rigor::engine
