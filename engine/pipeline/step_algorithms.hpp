// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The algorithms that a world has chosen, each with its own scratch.
#pragma once

#include <memory>
#include <optional>

#include "engine/broadphase/broad_phase.hpp"
#include "engine/ccd/continuous_collision.hpp"
#include "engine/core/clone_ptr.hpp"
#include "engine/faults/fault.hpp"
#include "engine/narrowphase/manifolds.hpp"
#include "engine/pipeline/island_method.hpp"
#include "engine/sleeping/sleeping.hpp"
#include "engine/solvers/combine_rules.hpp"
#include "engine/solvers/position_correction.hpp"
#include "engine/solvers/restitution.hpp"

namespace rigor::engine {

template <class S>
struct StepAlgorithms {
    using Real = typename S::Real;

    /// Makes the algorithms that `def` names. Throws EngineError for unknown names, for settings out of
    /// range, and for choices that do not go together.
    explicit StepAlgorithms(const WorldDef<S>& def);

    const IslandMethod<S>& method(IslandKind islands) const {
        return islands == IslandKind::Usual ? usual : islands == IslandKind::Large ? *large : *violent;
    }
    IslandMethod<S>& method(IslandKind islands) {
        return const_cast<IslandMethod<S>&>(std::as_const(*this).method(islands));
    }

    IslandMethod<S> usual;
    std::optional<IslandMethod<S>> large;  ///< method of large islands, where they have one of their own
    std::optional<IslandMethod<S>>
        violent;  ///< method of islands in violent motion; only where large ones have theirs
    ClonePtr<BroadPhase<S>> broadPhase;
    BoundingVolume boundingVolume;
    std::shared_ptr<const NarrowPhase<S>> narrowPhase;
    ManifoldFunction<S> makeManifold = nullptr;
    CombineRule<Real> combineFriction = nullptr, combineRestitution = nullptr;
    FrictionLaw<S> friction = nullptr;
    ClonePtr<Restitution<S>> restitution;
    ClonePtr<PositionCorrection<S>> correction;
    ClonePtr<ContinuousCollision<S>> ccd;
    ClonePtr<ContinuousCollision<S>>
        ccdToMidpoints;  ///< on the way to midpoints that are found anew, or null
    SleepingScheme<S> sleeping;
    bool continuous = false;          ///< `ccd` acts
    bool locatesImpacts = false;      ///< impacts of bodies in flight take place at their own times (ccd)
    const Fault<S>* fault = nullptr;  ///< null: none
};

}  // namespace rigor::engine
