// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A choice by island: islands of up to WorldDef::islandContacts contacts are solved by `block` (block.cpp), where
// that is nearest to the contact law; larger ones by `wide` (wide.cpp) in small steps with soft contacts, where
// sweeps would need hundreds of iterations and positions are what people look at. The step decides which island
// is large (pipeline/island_method.hpp); this solver sees the others alone.
#include "engine/solvers/solver.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {

SolverTraits makeBlockTraits();
SolverTraits makeByIslandTraits() {
    SolverTraits traits = makeBlockTraits();
    traits.largeIslands = "wide";
    return traits;
}

template <class S>
std::unique_ptr<Solver<S>> makeBlock();
template <class S>
std::unique_ptr<Solver<S>> makeByIsland() {
    return makeBlock<S>();
}
RIGOR_INSTANTIATE_FACTORY(makeByIsland, Solver);

}  // namespace rigor::engine
