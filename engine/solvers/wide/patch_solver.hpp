// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A solver of contacts as patches (patch.hpp). Joints are rows for it as for every other solver. The patches
// belong to the caller (contacts/contact_patches.hpp), which makes them and reads their impulses.
#pragma once

#include "engine/solvers/solver.hpp"
#include "engine/solvers/wide/patches.hpp"

namespace rigor::engine {

template <class S>
class PatchSolver : public Solver<S> {
  public:
    /// Changes the impulses of the rows of `input`, which are those of joints alone, the impulses of the
    /// patches, and velocities. `pass`: parameters of the sub-step.
    virtual void solvePatches(const SolverInput<S>& input, Patches<S>& patches, const PatchPass& pass,
                              const Tasks& tasks) = 0;
};

}  // namespace rigor::engine
