// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/integrators/integrator.hpp"
#include "engine/integrators/traits.hpp"

namespace rigor::engine {

#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    Integrator<S> factory();
#include "engine/integrators/integrators.def"
#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    RotationScheme<S> factory();
#include "engine/integrators/rotations.def"
#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    TurnRotation<S> factory();
#include "engine/integrators/orientation_updates.def"

template <class S>
std::span<const AlgorithmEntry<IntegratorFactory<S>>> integratorTable() {
    static constexpr AlgorithmEntry<IntegratorFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/integrators/integrators.def"
    };
    return table;
}
template <class S>
std::span<const AlgorithmEntry<RotationFactory<S>>> rotationTable() {
    static constexpr AlgorithmEntry<RotationFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/integrators/rotations.def"
    };
    return table;
}

template <class S>
std::span<const AlgorithmEntry<OrientationFactory<S>>> orientationUpdateTable() {
    static constexpr AlgorithmEntry<OrientationFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/integrators/orientation_updates.def"
    };
    return table;
}

#define RIGOR_INSTANTIATE(S)                                                             \
    template std::span<const AlgorithmEntry<IntegratorFactory<S>>> integratorTable<S>(); \
    template std::span<const AlgorithmEntry<RotationFactory<S>>> rotationTable<S>();     \
    template std::span<const AlgorithmEntry<OrientationFactory<S>>> orientationUpdateTable<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

#define ALGORITHM(name, factory, summary) IntegratorTraits factory##Traits();
#include "engine/integrators/integrators.def"

std::span<const TraitsEntry<IntegratorTraits>> integratorTraitsTable() {
    static const TraitsEntry<IntegratorTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/integrators/integrators.def"
    };
    return table;
}

#define ALGORITHM(name, factory, summary) RotationTraits factory##Traits();
#include "engine/integrators/rotations.def"

std::span<const TraitsEntry<RotationTraits>> rotationTraitsTable() {
    static const TraitsEntry<RotationTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/integrators/rotations.def"
    };
    return table;
}

#define ALGORITHM(name, factory, summary) OrientationTraits factory##Traits();
#include "engine/integrators/orientation_updates.def"

std::span<const TraitsEntry<OrientationTraits>> orientationTraitsTable() {
    static const TraitsEntry<OrientationTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/integrators/orientation_updates.def"
    };
    return table;
}

}  // namespace rigor::engine
