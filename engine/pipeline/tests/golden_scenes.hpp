// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The scenes whose state hashes are recorded (golden_test.cpp) and compared across processors
// (print_golden_hashes.cpp).
#pragma once

#include <cstdint>
#include <string>

#include "engine/pipeline/tests/scene.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::test {

template <class S>
std::string spaceName() {
    return std::to_string(S::dim) + (sizeof(typename S::Real) == 4 ? "f" : "d");
}

/// A leaning stack that a sphere hits, another sphere falling from high up, a pendulum of two links with a
/// limit, a crate that spins on a spring in damping air, a shot at a thin plate: contacts that rest, hit,
/// slide and roll; joints; forces; what passes through without continuous collision.
template <class S>
World<S> everything(const WorldDef<S>& def) {
    using R = typename S::Real;
    World<S> world(def);
    const auto wood = world.addMaterial(R(0.5), R(0.2)), rubber = world.addMaterial(R(0.3), R(0.8), R(0.6));
    const BodyId ground = addGround<S>(world, wood);
    for (int i = 0; i < 4; ++i) addCube<S>(world, 0.03 * i, 0.25 + 0.5 * i, 0.25, 1 + i, wood);
    addBall<S>(world, -2, 0.8, 0.2, 2, rubber, 4, 1, -3);
    addBall<S>(world, -3, 2.8, 0.2, 2, rubber, 4, -10, -3);
    JointDef<S> joint;
    const BodyId upper = addBall<S>(world, 4, 3, 0.1, 1, wood), lower = addCube<S>(world, 5, 3, 0.1, 1, wood);
    joint.bodyB = upper;
    joint.anchorA = at<S>(3, 3);
    joint.anchorB = at<S>(-1, 0);
    world.addJoint(joint);
    joint.type = JointType::Hinge;
    joint.bodyA = upper;
    joint.bodyB = lower;
    joint.anchorA = at<S>(0, 0);
    joint.anchorB = at<S>(-1, 0);
    joint.axes[0].mode = AxisMode::Limited;
    joint.axes[0].lower = R(-0.3);
    joint.axes[0].upper = R(0.3);
    world.addJoint(joint);
    BodyDef<S> crate;
    crate.pose.p = at<S>(-5, 2);
    crate.mass = 2;
    crate.angularVelocity = spin<S>(1);
    crate.linearVelocityKept = R(0.9);
    if constexpr (S::dim == 3) {
        crate.inertia = typename S::Vec(R(0.1), R(0.2), R(0.25)).asDiagonal();
        crate.angularVelocity = {3, -2, 1};
    }
    LinearSpring<S> spring;
    spring.bodyA = ground;
    spring.bodyB = world.addBody(crate);
    spring.anchorA = at<S>(-5, 4);
    spring.anchorB = at<S>(0.2, 0.3);
    spring.stiffness = 60;
    spring.damping = R(0.5);
    spring.restLength = 1;
    world.addForce(spring);
    BodyDef<S> plate;
    plate.type = BodyType::Static;
    plate.pose.p = at<S>(-9, 1.2);
    typename S::Vec half = S::Vec::Constant(R(0.8));
    half[0] = R(0.02);
    attach<S>(world, world.addBody(plate), Box<S>{half}, wood);
    addBall<S>(world, -12.9, 1.4, 0.05, 0.1, rubber, 60, 1, 5);
    return world;
}

/// A line of the table: settings, by name. Together they have every integrator, rotation and solver, and most
/// of the rest, at least once.
struct GoldenScene {
    const char* name;
    const char* solver = "block";
    const char* integrator = "symplectic_euler";
    const char* rotation = "lie_midpoint";
    const char* narrowPhase = "sat";
    const char* correction = "ngs";
    const char* continuous = "none";
    int threads = 1;
    bool fast = false;         ///< true: set by preferSpeed() instead: `wide` and what suits it
    int islandContacts = 128;  ///< line above which an island is large
};
inline constexpr GoldenScene kGoldenScenes[] = {
    {.name = "default"},
    {.name = "moreau_midpoint", .integrator = "moreau_midpoint", .correction = "processed_rattle"},
    {.name = "pgs_verlet", .solver = "pgs", .integrator = "velocity_verlet", .narrowPhase = "gjk_epa"},
    {.name = "pgs_soft", .solver = "pgs_soft", .rotation = "explicit", .correction = "soft"},
    {.name = "single_pass", .solver = "single_pass", .rotation = "none", .correction = "baumgarte"},
    {.name = "jacobi_rk4", .solver = "jacobi", .integrator = "rk4", .narrowPhase = "mpr"},
    {.name = "tgs_soft", .solver = "tgs_soft", .rotation = "implicit"},
    {.name = "xpbd", .solver = "xpbd", .rotation = "moser_veselov"},
    {.name = "nsgs", .solver = "nsgs", .correction = "split_impulse"},
    {.name = "dantzig", .solver = "dantzig", .integrator = "explicit_euler", .correction = "none"},
    {.name = "lemke", .solver = "lemke"},
    {.name = "conservative_advancement", .continuous = "conservative_advancement"},
    {.name = "speculative_threads", .continuous = "speculative", .threads = 2},
    {.name = "fast", .fast = true},
    {.name = "large_islands", .solver = "by_island", .islandContacts = 2},
};

struct GoldenResult {
    std::uint64_t hash = 0;
    bool finite = false;
    std::size_t contacts = 0;  ///< at the end
};

template <class S>
GoldenResult runGolden(const GoldenScene& scene) {
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    def.solver = scene.solver;
    def.integrator = scene.integrator;
    def.rotation = scene.rotation;
    def.narrowPhase = scene.narrowPhase;
    def.positionCorrection = scene.correction;
    def.continuousCollision = scene.continuous;
    def.threads = scene.threads;
    def.islandContacts = scene.islandContacts;
    if (scene.fast) preferSpeed(def);
    World<S> world = everything<S>(def);
    for (int i = 0; i < 120; ++i) world.step(R(1.0 / 120));
    return {world.stateHash(), !world.lastStep().nonFinite, world.lastStep().contacts};
}

/// Calls each(name, result) for every scene in every space: "3f_default". `oneThread`: also where the scene has more.
template <class Visitor>
void forEachGolden(const Visitor& each, bool oneThread = false) {
    for (GoldenScene scene : kGoldenScenes) {
        if (oneThread) scene.threads = 1;
        each(spaceName<Space2f>() + "_" + scene.name, runGolden<Space2f>(scene));
        each(spaceName<Space2d>() + "_" + scene.name, runGolden<Space2d>(scene));
        each(spaceName<Space3f>() + "_" + scene.name, runGolden<Space3f>(scene));
        each(spaceName<Space3d>() + "_" + scene.name, runGolden<Space3d>(scene));
    }
}

}  // namespace rigor::engine::test
