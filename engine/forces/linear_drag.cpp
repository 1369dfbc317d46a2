// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Drag of a slow body in a viscous medium [LandauLifshitz1987, section 20]: F = -c v.
#include "engine/core/error.hpp"
#include "engine/forces/force.hpp"

namespace rigor::engine {

template <class S>
void checkForce(const LinearDrag<S>& force) {
    if (!(force.coefficient >= 0 && std::isfinite(force.coefficient)))
        throw EngineError("drag_coefficient", "the coefficient of a drag must not be negative");
}

template <class S>
void addForce(const LinearDrag<S>& force, const ForcePlace<S>& place, const ForceMoment<S>& moment) {
    moment.wrench[place.b].force -= force.coefficient * moment.velocity[place.b].v;
}

RIGOR_INSTANTIATE_FORCE(LinearDrag);

}  // namespace rigor::engine
