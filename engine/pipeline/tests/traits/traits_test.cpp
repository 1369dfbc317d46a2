// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every algorithm does what it declares, and every false declaration is found. Listing an algorithm is enough
// to be measured. The tables of this program have false entries as well (tables.cpp).
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/ccd/continuous_collision.hpp"
#include "engine/integrators/integrator.hpp"
#include "engine/narrowphase/manifolds.hpp"
#include "engine/pipeline/tests/traits/measure.hpp"
#include "engine/solvers/position_correction.hpp"
#include "engine/solvers/restitution.hpp"

namespace rigor::engine::test {
namespace {

using S = Space3d;
using Lies = std::vector<std::string>;

/// Compares each entry of a table with its measured traits: deliberately false entries differ in the trait
/// that their summary begins with, the others in none.
template <class Table>
void expectTruth(Table table, Lies (*liesOf)(const std::string&)) {
    int falseEntries = 0;
    for (const auto& entry : table) {
        const std::string name = entry.name, summary = entry.summary;
        const Lies lies = liesOf(name);
        if (!name.starts_with("false_")) {
            EXPECT_EQ(lies, Lies{}) << name;
            continue;
        }
        ++falseEntries;
        bool found = false;
        for (const std::string& lie : lies) found = found || summary.starts_with(lie);
        EXPECT_TRUE(found) << name << " was believed";
    }
    EXPECT_GT(falseEntries, 0);
}

TEST(Traits, OfSolversAreMeasured) {
    expectTruth(solverTable<S>(), &liesOfSolver);
}
TEST(Traits, OfFrictionLawsAreMeasured) {
    expectTruth(frictionTable<S>(), &liesOfFriction);
}
TEST(Traits, OfIntegratorsAreMeasured) {
    expectTruth(integratorTable<S>(), &liesOfIntegrator);
}
TEST(Traits, OfRotationSchemesAreMeasured) {
    expectTruth(rotationTable<S>(), &liesOfRotation);
}
TEST(Traits, OfOrientationUpdatesAreMeasured) {
    expectTruth(orientationUpdateTable<S>(), &liesOfOrientation);
}
TEST(Traits, OfContinuousCollisionAreMeasured) {
    expectTruth(continuousCollisionTable<S>(), &liesOfContinuousCollision);
}

TEST(Traits, OfRestitutionLawsAreMeasured) {
    expectTruth(restitutionTable<S>(), &liesOfRestitution);
}
TEST(Traits, OfManifoldsAreMeasured) {
    expectTruth(manifoldTable<S>(), &liesOfManifold);
}

/// Statement of the adapter's parity ledger on position corrections.
TEST(Traits, PositionCorrectionsLeaveVelocityAsTheirBiasSays) {
    for (const auto& entry : positionCorrectionTable<S>()) {
        const auto correction = entry.make();
        const BiasRule<double> bias = correction->bias();
        const bool keeps = (bias.baumgarte > 0 || bias.soft) && correction->relaxIterations() == 0;
        EXPECT_EQ(correctionKeepsVelocity(entry.name), keeps) << entry.name;
    }
}

}  // namespace
}  // namespace rigor::engine::test
