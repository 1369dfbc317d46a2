// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The bodies of a world and their handles.
//
// Invariant: all arrays have one element per body, by dense index; body 0 is the world itself; ids() leads from
// arrays().id[i] back to i.
#pragma once

#include <vector>

#include "engine/core/ids.hpp"
#include "engine/pipeline/body_mass.hpp"
#include "engine/state/body_arrays.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

template <class S>
class WorldBodies {
  public:
    using Real = typename S::Real;

    WorldBodies();

    /// Throws EngineError for values out of range.
    BodyId add(const BodyDef<S>& def);
    /// The dense index that was the body's, and that of the body which takes it: the last.
    struct Removed {
        std::uint32_t gone, last;
    };
    Removed remove(BodyId body);

    BodyArrays<S>& arrays() { return arrays_; }
    const BodyArrays<S>& arrays() const { return arrays_; }
    IdTable<BodyTag>& ids() { return ids_; }
    const IdTable<BodyTag>& ids() const { return ids_; }
    std::size_t size() const { return arrays_.size(); }  ///< number of bodies, the world's own included
    std::uint32_t dense(BodyId body) const { return ids_.dense(body); }
    /// 0 for no body.
    std::uint32_t denseOrWorld(BodyId body) const { return body ? ids_.dense(body) : 0; }

    Pose<S> pose(BodyId body) const;  ///< pose of the body frame
    const Velocity<S>& velocity(BodyId body) const { return arrays_.velocity[ids_.dense(body)]; }
    const BodyConstants<S>& constants(BodyId body) const { return arrays_.constants[ids_.dense(body)]; }
    BodyMass<S>& mass(std::uint32_t body) { return masses_[body]; }
    /// Gives a body the mass properties of mass(), if it is dynamic; the motion of its points stays. Returns the way of
    /// its centre of mass, body axes [m]: places that refer to the centre have to follow (WorldParts::updateMass).
    typename S::Vec applyMass(std::uint32_t body);
    /// Static bodies lose their velocity.
    void setType(std::uint32_t body, BodyType type);
    /// Changes linear and angular momentum at once [N s], [N m s].
    void applyImpulse(std::uint32_t body, const typename S::Vec& impulse,
                      const typename S::Ang& angularImpulse);

  private:
    BodyArrays<S> arrays_;
    std::vector<BodyMass<S>> masses_;
    IdTable<BodyTag> ids_;
};

}  // namespace rigor::engine
