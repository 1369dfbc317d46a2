// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Short pieces, a comparison that is fair where runs part: every k steps the bodies are put back on the
// truth, and the error of one piece of k steps is what counts (Erez, Tassa and Todorov, Simulation tools for
// model-based robotics, ICRA 2015, on consistency). An error cannot grow beyond its piece, so that chaos does
// not drown it.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "adapters/interface/engine.hpp"
#include "validation/references/reference.hpp"
#include "validation/results/types.hpp"

namespace rigor::validation {

/// Steps of the converged run within one step of the case, where there is no reference for the whole scene.
inline constexpr int kConvergedSteps = 16;

/// A world of the engine at a time step.
using WorldMaker = std::function<std::unique_ptr<adapter::World>(double dt)>;

/// Four rows of kind "pieces" for every number of steps, their subject "every K steps": `piece_error` and
/// `piece_error_worst` [m], the largest way of a body's origin from where it should be at the end of a piece,
/// as the median over the pieces and the worst; `piece_turn` and `piece_turn_worst` [rad] likewise. The truth
/// is the reference where it knows the state of every dynamic body at every step, else the run of the same
/// engine with kConvergedSteps steps for one; the note says which. Engines whose worlds cannot be put
/// somewhere else, and runs that are shorter than a piece, have rows without a value whose note says why.
std::vector<results::MetricRow> measurePieces(const scenario::Scenario& scenario, double dt,
                                              const std::vector<int>& every, const WorldMaker& build,
                                              const Reference* reference);

}  // namespace rigor::validation
