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

#define RIGOR_INSTANTIATE(S)                           \
    template void checkForce<S>(const LinearDrag<S>&); \
    template void addForce<S>(const LinearDrag<S>&, const ForcePlace<S>&, const ForceMoment<S>&);
RIGOR_INSTANTIATE(Space2f)
RIGOR_INSTANTIATE(Space2d)
RIGOR_INSTANTIATE(Space3f)
RIGOR_INSTANTIATE(Space3d)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
