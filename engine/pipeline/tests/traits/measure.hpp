// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Traits found by what an algorithm does in small scenes, whatever it declares and whatever it is called. The
// name is looked up in the tables, as a world does.
#pragma once

#include <string>
#include <vector>

#include "engine/ccd/traits.hpp"
#include "engine/integrators/traits.hpp"
#include "engine/narrowphase/traits.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine::test {

/// Measured properties of a solver beside its traits.
struct MeasuredSolver {
    SolverTraits traits;       ///< iterations with relaxation; linearJointBaumgarte: any value for "rigid"
    double contactSpring = 0;  ///< frequency for the setting kSetContactFrequency [Hz]; 0: rigid
    double jointSpring = 0;    ///< frequency for the setting kSetJointFrequency [Hz]; 0: rigid
    bool ownsCorrection = false;
    bool countsIterations = false;  ///< traits.iterations could be measured
};
inline constexpr double kSetContactFrequency = 10, kSetJointFrequency = 12;

/// Measured properties of a law of restitution, as it declares them (solvers/restitution.hpp).
struct MeasuredRestitution {
    bool bounces = false;
    bool solvesImpacts = false;
};

MeasuredSolver measureSolver(const std::string& name);
FrictionTraits measureFriction(const std::string& name);
IntegratorTraits measureIntegrator(const std::string& name);
RotationTraits measureRotation(const std::string& name);
OrientationTraits measureOrientation(const std::string& name);
ContinuousCollisionTraits measureContinuousCollision(const std::string& name);
MeasuredRestitution measureRestitution(const std::string& name);
ManifoldTraits measureManifold(const std::string& name);
/// Whether the velocity that removes overlap stays in a body.
bool correctionKeepsVelocity(const std::string& name);

/// The traits in which what is declared is not what is measured; empty for an algorithm whose traits are
/// right.
std::vector<std::string> liesOfSolver(const std::string& name);
std::vector<std::string> liesOfFriction(const std::string& name);
std::vector<std::string> liesOfIntegrator(const std::string& name);
std::vector<std::string> liesOfRotation(const std::string& name);
std::vector<std::string> liesOfOrientation(const std::string& name);
std::vector<std::string> liesOfContinuousCollision(const std::string& name);
std::vector<std::string> liesOfRestitution(const std::string& name);
std::vector<std::string> liesOfManifold(const std::string& name);

}  // namespace rigor::engine::test
