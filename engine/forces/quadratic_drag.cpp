// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Drag of a fast body, whose wake carries momentum away [LandauLifshitz1987, section 45]: F = -c |v| v.
#include "engine/core/error.hpp"
#include "engine/forces/force.hpp"

namespace rigor::engine {

template <class S>
void checkForce(const QuadraticDrag<S>& force) {
    if (!(force.coefficient >= 0 && std::isfinite(force.coefficient)))
        throw EngineError("drag_coefficient", "the coefficient of a drag must not be negative");
}

template <class S>
void addForce(const QuadraticDrag<S>& force, const ForcePlace<S>& place, const ForceMoment<S>& moment) {
    const typename S::Vec v = moment.velocity[place.b].v;
    moment.wrench[place.b].force -= (force.coefficient * v.norm()) * v;
}

RIGOR_INSTANTIATE_FORCE(QuadraticDrag);

}  // namespace rigor::engine
