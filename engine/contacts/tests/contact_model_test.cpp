// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The contact models by themselves, on a sphere that touches the ground at one point.
#include <gtest/gtest.h>

#include <array>

#include "engine/contacts/contact_model.hpp"
#include "engine/solvers/tests/row_problem.hpp"
#include "engine/solvers/wide/patch_solver.hpp"

namespace rigor::engine::test {
namespace {

using Vec = Space3d::Vec;

struct BallOnGround {
    BodyArrays<Space3d> bodies;
    ContactList<Space3d> contacts;
    ConstraintRows<Space3d> rows;
    ContactStep<Space3d> step{0.01, 1, 0, 10, {}, 0, 0, 1, true};

    /// The sphere has mass 2 and falls with 1 m/s.
    explicit BallOnGround(double friction) {
        for (const double invMass : {0.0, 0.5}) {
            bodies.pose.emplace_back();
            bodies.velocity.emplace_back();
            bodies.asleep.push_back(0);
            bodies.islands.push_back(IslandKind::Usual);
            bodies.constants.emplace_back().type = invMass > 0 ? BodyType::Dynamic : BodyType::Static;
            bodies.invMass.push_back(invMass);
            bodies.invInertia.push_back(invMass * Space3d::Inertia::Identity());
        }
        bodies.pose[1].p = Vec(0, 1, 0);
        bodies.velocity[1].v = Vec(0, -1, 0);
        contacts.reset(1);
        Contact<Space3d>& contact = contacts[0];
        contact.bodyB = 1;
        contact.shapeB = 1;
        contact.coefficients.friction = friction;
        contact.manifold.count = 1;
        contact.manifold.normal = Vec(0, 1, 0);
        contact.manifold.points[0].pointA = contact.manifold.points[0].pointB = Vec::Zero();
    }
    void begin(ContactModel<Space3d>& model, bool stepBegins) {
        rows.clear();
        if (stepBegins) model.prepare(contacts, bodies, step, Tasks::one());
        model.beginSubstep(contacts, bodies, step, rows, Tasks::one());
    }
};

TEST(RowContacts, AddUpTheImpulsesOfTheSubsteps) {
    BallOnGround scene(0.5);
    const auto model = makeContactModel<Space3d>(ContactForm::Rows);
    for (int substep = 0; substep < 3; ++substep) {
        scene.begin(*model, substep == 0);
        ASSERT_EQ(model->counts().points, 1u);
        ASSERT_EQ(model->counts().rows, 3u);
        scene.rows.rows[scene.rows.blocks[0].first].impulse = 0.25;
        model->store(scene.contacts, scene.rows, substep == 2, Tasks::one());
        EXPECT_EQ(scene.contacts[0].impulses[0].normal, 0.25);
        EXPECT_EQ(scene.contacts[0].totals[0].normal, 0.25 * (substep + 1));
    }
    EXPECT_TRUE(scene.contacts[0].touching);
    scene.begin(*model, true);
    EXPECT_EQ(scene.contacts[0].totals[0].normal, 0) << "of the new step";
    EXPECT_EQ(scene.rows.rows[scene.rows.blocks[0].first].impulse, 0.25) << "warm start";
}

TEST(RowContacts, FollowTheBodies) {
    BallOnGround scene(0);
    const auto model = makeContactModel<Space3d>(ContactForm::Rows);
    scene.begin(*model, true);
    EXPECT_EQ(model->counts().rows, 1u) << "without friction";
    std::vector<Velocity<Space3d>> velocities(2);
    velocities[1] = {Vec(3, 2, 0), Vec(0, 0, 5)};  // rolling adds nothing: the arm is along the normal
    model->advance(scene.contacts, velocities, 0.1, Tasks::one());
    EXPECT_DOUBLE_EQ(scene.contacts[0].points[0].separation, 0.2);
}

TEST(RowContacts, RenewTheSlipsOfTheBlocksThatAreNamed) {
    BallOnGround scene(0.5);
    scene.step.meanSlip = true;
    scene.bodies.velocity[1].v = Vec(3, -1, 0);
    const auto model = makeContactModel<Space3d>(ContactForm::Rows);
    scene.begin(*model, true);
    ASSERT_TRUE(model->hasSlip(0));
    const auto biases = [&] {
        const std::uint32_t first = scene.rows.blocks[0].first;
        return Eigen::Vector2d(scene.rows.rows[first + 1].bias, scene.rows.rows[first + 2].bias);
    };
    std::vector<Velocity<Space3d>> velocities(2);
    velocities[1].v = Vec(2, 0, 1);
    const std::array<std::uint32_t, 1> block{0};
    model->updateSlips(velocities, std::span<const std::uint32_t>(), scene.rows);
    EXPECT_EQ(biases(), Eigen::Vector2d::Zero()) << "no block is named";
    model->updateSlips(velocities, block, scene.rows);
    const Eigen::Vector2d named = biases();
    EXPECT_GT(named.norm(), 0.1);
    model->updateSlips(velocities, scene.rows);
    EXPECT_EQ(biases(), named);

    scene.bodies.velocity[1].v = Vec(0, -1, 0);
    scene.begin(*model, true);
    EXPECT_FALSE(model->hasSlip(0)) << "a ball that does not slide";
}

/// Both models stop the sphere with the same impulse.
TEST(ContactModels, AgreeOnOnePointWithoutFriction) {
    for (const char* name : {"pgs", "wide"}) {
        BallOnGround scene(0);
        const auto model = makeContactModel<Space3d>(solverTraits(name).contacts);
        const auto solver = findAlgorithm(solverTable<Space3d>(), "solver", std::string(name)).make();
        const auto friction = findAlgorithm(frictionTable<Space3d>(), "friction", std::string("cone")).make;
        QuietMonitor<Space3d> monitor;
        scene.begin(*model, true);
        SolverInput<Space3d> input{scene.rows, scene.bodies.velocity, friction, monitor, 1, scene.step.h};
        model->solve(*solver, input, Tasks::one());
        input.warmStarted = true;
        model->solve(*solver, input, Tasks::one());
        model->store(scene.contacts, scene.rows, true, Tasks::one());
        EXPECT_NEAR(scene.bodies.velocity[1].v[1], 0, 1e-6) << name;
        EXPECT_NEAR(scene.contacts[0].totals[0].normal, 2, 1e-5) << name;
        EXPECT_EQ(model->counts().points, 1u) << name;
    }
}

/// A solver that requests patches is one that solves them, and the other way round.
TEST(ContactModels, AreWhatTheSolversTake) {
    for (const auto& entry : solverTable<Space3d>()) {
        const std::unique_ptr<Solver<Space3d>> solver = entry.make();
        const bool solvesPatches = dynamic_cast<PatchSolver<Space3d>*>(solver.get()) != nullptr;
        EXPECT_EQ(solverTraits(entry.name).contacts == ContactForm::Patches, solvesPatches) << entry.name;
    }
}

}  // namespace
}  // namespace rigor::engine::test
