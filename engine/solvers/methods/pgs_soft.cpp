// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Projected Gauss-Seidel with soft contacts and joints, the "PGS soft" of [Catto2024]: pgs.cpp on rows whose
// position errors are damped springs [Catto2011],
//     J v + (omega / a) C + gamma lambda = 0,   a = 2 zeta + h omega,   gamma = K / (h omega a)
// (soft.hpp) with the frequencies and damping ratios of the world (contact_frequency, joint_frequency, ...).
// The springs take the place of position correction; there is no relaxation after the step, so the velocity
// that pushes bodies apart stays in them, as with Baumgarte's method, but bounded by the spring's rate.
//
// Cost: that of pgs. Known limits: the spring's frequency is at most a quarter of the step rate, 15 Hz at 60
// Hz. A load is carried by an overlap in proportion to it: 1 mm under a box of 1 m, 35 mm in sum in a stack
// of five of them, 0.3 m under a load of 100 times the mass; joints stretch by millimetres and lose energy.
#include "engine/solvers/sequential_impulses.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {

SolverTraits makePgsSoftTraits() {
    return {.errors = ErrorHandling::Springs};
}

template <class S>
std::unique_ptr<Solver<S>> makePgsSoft() {
    return std::make_unique<RowByRow<S>>(ContactOrder::FrictionFirst, styleOf<S>(makePgsSoftTraits()));
}
RIGOR_INSTANTIATE_FACTORY(makePgsSoft, Solver);

}  // namespace rigor::engine
