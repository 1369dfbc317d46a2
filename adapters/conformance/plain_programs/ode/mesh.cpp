// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Meshes: a ball in a trough of a triangle mesh, a block on a level height field.
#include <algorithm>

#include "adapters/conformance/plain_programs/ode/simulation.hpp"

namespace rigor::plain {
namespace {

TEST(PlainOde, TriangleMesh) {
    const Scenario scene = load("scenarios/library/3d/ball_in_trough.json");
    // 602 corners are taken from the file instead of written out.
    const auto& mesh = std::get<scenario::TriangleMesh>(scene.bodies[0].shapes[0].geometry);
    std::vector<dReal> corners;
    std::vector<dTriIndex> triangles;
    for (const Vec3& v : mesh.vertices)
        for (const double c : {v.x, v.y, v.z, 0.0}) corners.push_back(c);
    for (const auto& triangle : mesh.triangles)
        for (const int i : triangle) triangles.push_back(i);

    OdeSimulation demo;
    demo.surface.mu = 0.9;
    const dTriMeshDataID data = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildSimple(data, corners.data(), mesh.vertices.size(), triangles.data(),
                                triangles.size());
    demo.inSpace(dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr));
    demo.addBody(nullptr, {0, 0, 0});
    dMass mass;
    dMassSetSphereTotal(&mass, 1, 0.1);
    const dBodyID ball = demo.addBody(&mass, scene.bodies[1].pose.position);
    dGeomSetBody(demo.inSpace(dCreateSphere(nullptr, 0.1)), ball);
    const Trajectory plain = demo.run(1.0 / 240, 120);
    EXPECT_GT(travel(plain, 1), 0.3);
    // The program takes the first 8 points that dCollide finds; the adapter requests all and keeps the
    // deepest and the farthest from it. These steps have at most 8.
    EXPECT_TRUE(same(plain, adapterRun("ode:preset=default", scene, 1.0 / 240, 120)));
    dGeomTriMeshDataDestroy(data);
}

TEST(PlainOde, HeightField) {
    OdeSimulation demo;
    demo.surface.mu = 0.5;
    const std::vector<double> heights(41 * 9, 0.0);
    const dHeightfieldDataID data = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildDouble(data, heights.data(), 0, 40 * 0.31, 8 * 0.29, 41, 9, 1, 0, 1, 0);
    demo.inSpace(dCreateHeightfield(nullptr, data, 1));
    demo.addBody(nullptr, {0, 0, 0});
    dMass mass;
    dMassSetParameters(&mass, 2, 0, 0, 0, 0.045, 0.085, 0.045, 0, 0, 0);
    const dBodyID block = demo.addBody(&mass, {-1, 0.05, 0});
    dGeomSetBody(demo.inSpace(dCreateBox(nullptr, 0.5, 0.1, 0.5)), block);
    dBodySetLinearVel(block, 4, 0, 0);
    const Trajectory plain = demo.run(1.0 / 60, 90);

    const Scenario scene =
        load("scenarios/library/3d/slide_on_height_field.json", {"bodies.block.inertia=[0.045,0.085,0.045]"});
    EXPECT_GT(travel(plain, 1), 1.5);
    EXPECT_TRUE(same(plain, adapterRun("ode:preset=default", scene, 1.0 / 60, 90)));
    dGeomHeightfieldDataDestroy(data);
}

}  // namespace
}  // namespace rigor::plain
