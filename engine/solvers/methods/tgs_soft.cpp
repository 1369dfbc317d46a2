// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Small steps with soft constraints: "TGS soft", the "soft step" of [Catto2024]. Many sub-steps of one
// iteration each solve better than one step of many iterations [Macklin2019], because errors of position and
// of direction fall with the square of the sub-step. Each sub-step (pipeline/step.cpp) is
//     forces      v += h a
//     warm start  v += M^-1 J^T lambda of the sub-step before
//     solve       one row-by-row iteration (sequential_impulses.hpp) with soft errors, soft.hpp [Catto2011]; all
//                 normals before all friction, which would otherwise have no limit yet where bodies meet, and
//                 hold on to the rotation that one corner makes and the next takes back
//     move        x += h v
//     relax       one more iteration, rigid and without the bias of the errors: the pushing velocity has
//                 done its work and is taken out again, the impulses keep the load
// Contacts are found once per step; their separations follow the motion to first order. Restitution is a
// target of the rows of the sub-step in which an impact occurs (contact_rows.cpp), kept by the relaxation,
// where [Catto2024] applies it after the last sub-step.
//
// substeps and velocity_iterations 0 mean 8 and 1 ([Catto2024] has 4). Cost per step: substeps * 2 * rows.
// Known limits: errors die out at the springs' rate and not within a step: 9 mm of overlap in sum in a stack
// of five boxes of 1 m, 35 mm in one of ten; a load of 100 times the mass squeezes its support out, one of 30
// stands; a body that starts to slide or lands has lost a part of one sub-step's friction. Each row of a
// joint is as soft as its own effective mass says, which on a long arm is mostly the turn's: a small ball on
// a rod of 1 m gives way by 15 mm at the default 60 Hz, whatever the step (joint_frequency 240: 1 mm; a
// spring of the masses alone gains energy without bound at 1/60).
#include "engine/solvers/sequential_impulses.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {

SolverTraits makeTgsSoftTraits() {
    return {.substeps = 8, .iterations = 1, .relaxIterations = 1, .errors = ErrorHandling::Springs};
}

template <class S>
std::unique_ptr<Solver<S>> makeTgsSoft() {
    return std::make_unique<RowByRow<S>>(ContactOrder::FrictionLast, styleOf<S>(makeTgsSoftTraits()));
}
RIGOR_INSTANTIATE_FACTORY(makeTgsSoft, Solver);

}  // namespace rigor::engine
