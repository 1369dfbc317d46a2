// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Touch: a block that starts exactly on the floor, in ODE alone. Whether ODE finds contacts then depends on the
// kind of floor, and for boxes on which of the two is first in the pair. Without contacts the block falls
// freely for one step, g dt^2, and it is that overlap which the joints' ERP then takes out: the whole of the
// penetration of slide_on_height_field (0.0027 m at 1/60 s), and that of slide_and_stop where the block is
// inserted first.
#include "adapters/conformance/plain_programs/ode/simulation.hpp"

namespace rigor::plain {
namespace {

constexpr double kTouchStep = 1.0 / 60;

dGeomID levelField(int columns, int rows, double dx, double dz) {
    static std::vector<double> heights;
    heights.assign(static_cast<std::size_t>(columns * rows), 0.0);
    const dHeightfieldDataID data = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildDouble(data, heights.data(), 0, (columns - 1) * dx, (rows - 1) * dz, columns,
                                    rows, 1, 0, 1, 0);
    dGeomHeightfieldDataSetBounds(data, 0, 0);
    return dCreateHeightfield(nullptr, data, 1);
}

/// Contacts of a block on a floor that it overlaps so far.
int contacts(dGeomID floor, double overlap, bool floorFirst) {
    const dGeomID block = dCreateBox(nullptr, 0.5, 0.1, 0.5);
    dGeomSetPosition(block, -1, 0.05 - overlap, 0);
    dContactGeom found[16];
    const int count = floorFirst ? dCollide(floor, block, 16, found, sizeof found[0])
                                 : dCollide(block, floor, 16, found, sizeof found[0]);
    dGeomDestroy(block);
    return count;
}

TEST(PlainOde, WhatTouchesIsFoundByTheKindOfFloorAndTheOrder) {
    OdeSimulation initialised;
    const dGeomID plane = dCreatePlane(nullptr, 0, 1, 0, 0), box = dCreateBox(nullptr, 40, 1, 40),
                  field = levelField(41, 9, 0.31, 0.29);
    dGeomSetPosition(box, 0, -0.5, 0);
    for (const dGeomID floor : {plane, box, field})
        for (const bool floorFirst : {true, false}) {
            EXPECT_EQ(contacts(floor, -1e-15, floorFirst), 0);
            EXPECT_EQ(contacts(floor, 1e-15, floorFirst), 4);
        }
    EXPECT_GT(contacts(plane, 0, true), 0);
    EXPECT_GT(contacts(plane, 0, false), 0);
    EXPECT_EQ(contacts(box, 0, true), 4);
    EXPECT_EQ(contacts(box, 0, false), 0);
    EXPECT_EQ(contacts(field, 0, true), 0);
    EXPECT_EQ(contacts(field, 0, false), 0);
    for (const dGeomID floor : {plane, box, field}) dGeomDestroy(floor);
}

/// Largest depth of the block below the height at which it starts.
double deepest(const Trajectory& run, std::size_t block) {
    double depth = 0.0;
    for (const auto& states : run) depth = std::max(depth, 0.05 - states[block].position.y);
    return depth;
}

dBodyID addBlock(OdeSimulation& demo, const Vec3& position) {
    dMass mass;
    dMassSetParameters(&mass, 2, 0, 0, 0, 0.045, 0.085, 0.045, 0, 0, 0);
    const dBodyID block = demo.addBody(&mass, position);
    dGeomSetBody(demo.inSpace(dCreateBox(nullptr, 0.5, 0.1, 0.5)), block);
    dBodySetLinearVel(block, 4, 0, 0);
    return block;
}

/// mesh.cpp has the adapter beside it.
TEST(PlainOde, ABlockOnAHeightFieldFallsForOneStep) {
    OdeSimulation demo;
    demo.surface.mu = 0.5;
    demo.inSpace(levelField(41, 9, 0.31, 0.29));
    demo.addBody(nullptr, {0, 0, 0});
    addBlock(demo, {-1, 0.05, 0});
    EXPECT_NEAR(deepest(demo.run(kTouchStep, 90), 1), 9.81 * kTouchStep * kTouchStep, 1e-9);
}

/// The block of slide_and_stop as the first of the pair: no contact at the touch, one free step.
TEST(PlainOde, ABlockInsertedFirstFallsForOneStep) {
    OdeSimulation demo;
    demo.surface.mu = 0.5;
    addBlock(demo, {0, 0.05, 0});
    dGeomSetPosition(demo.inSpace(dCreateBox(nullptr, 40, 1, 40)), 0, -0.5, 0);
    demo.addBody(nullptr, {0, -0.5, 0});
    const Trajectory plain = demo.run(kTouchStep, 90);
    EXPECT_NEAR(deepest(plain, 0), 9.81 * kTouchStep * kTouchStep, 1e-9);

    Scenario scene =
        load("scenarios/library/3d/slide_and_stop.json", {"bodies.block.inertia=[0.045,0.085,0.045]"});
    std::swap(scene.bodies[0], scene.bodies[1]);
    EXPECT_TRUE(same(plain, adapterRun("ode:preset=default", scene, kTouchStep, 90)));
}

}  // namespace
}  // namespace rigor::plain
