// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The faces of the in-house engine, one per file of this folder.
#pragma once

#include <memory>

#include "adapters/interface/engine.hpp"

namespace rigor::adapter {

/// The engine with all of them.
std::unique_ptr<Engine> makeRigorEngine();

std::unique_ptr<DynamicsEngine> makeRigorDynamics();
std::unique_ptr<CollisionEngine> makeRigorCollision();
std::unique_ptr<BroadPhaseEngine> makeRigorBroadPhase();
std::unique_ptr<ContactSolverEngine> makeRigorContactSolvers();

}  // namespace rigor::adapter
