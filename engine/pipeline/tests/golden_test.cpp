// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The same bits today as yesterday, in Debug as in Release: the state hashes of a table of scenes against
// recorded ones (golden_hashes.def). They depend on IEEE arithmetic, on the order of operations that the
// source prescribes (-ffp-contract=off, no fast-math), on Eigen's SSE2 kernels, hence x86-64, and on the last
// bit of libm's sin, cos, log and their like, which differs between versions of glibc and between processors
// with and without fused multiply-add: another libm is recognised by a hash of its own results, and the test
// skipped.
//
// A difference says that results have changed. If the change was intended, renew the file by
//     RIGOR_RENEW_GOLDEN=1 build/release/tests/engine_pipeline_state_test --gtest_filter=Golden.*
// and say in the commit why. If it was not, or if Debug and Release differ, look for what depends on the
// compiler: libm calls folded at compile time, uninitialised values, the order of evaluation.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <string>

#include "engine/core/hash.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

const char* const kFile = RIGOR_SOURCE_DIR "/engine/pipeline/tests/golden_hashes.def";

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
struct Scene {
    const char* name;
    const char* solver = "block";
    const char* integrator = "symplectic_euler";
    const char* rotation = "lie_midpoint";
    const char* narrowPhase = "sat";
    const char* correction = "ngs";
    const char* continuous = "none";
    int threads = 1;
};
constexpr Scene kScenes[] = {
    {.name = "default"},
    {.name = "moreau_midpoint", .integrator = "moreau_midpoint"},
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
};

template <class S>
std::uint64_t hashOf(const Scene& scene) {
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    def.solver = scene.solver;
    def.integrator = scene.integrator;
    def.rotation = scene.rotation;
    def.narrowPhase = scene.narrowPhase;
    def.positionCorrection = scene.correction;
    def.continuousCollision = scene.continuous;
    def.threads = scene.threads;
    World<S> world = everything<S>(def);
    for (int i = 0; i < 120; ++i) world.step(R(1.0 / 120));
    EXPECT_FALSE(world.lastStep().nonFinite) << scene.name;
    EXPECT_GT(world.lastStep().contacts, 0u) << scene.name;
    return world.stateHash();
}

/// Hash of the results of libm for arguments that the compiler does not know.
std::uint64_t libmHash() {
    Hasher hash;
    const auto probe = [&hash](auto x) {
        for (const auto y : {std::sin(x), std::cos(x), std::atan2(x, decltype(x)(1.5)), std::log(x),
                             std::expm1(-x), std::cbrt(x), std::acos(x / decltype(x)(20)), std::sqrt(x)})
            hash.add(y);
    };
    volatile double start = 1e-4;
    for (double x = start; x < 15; x += 0.0137) {
        probe(x);
        probe(static_cast<float>(x));
    }
    return hash.value();
}

std::map<std::string, std::uint64_t> recorded() {
    std::map<std::string, std::uint64_t> golden;
#define GOLDEN(scene, hash) golden[#scene] = hash##ull;
#include "engine/pipeline/tests/golden_hashes.def"
#undef GOLDEN
    return golden;
}

TEST(Golden, EverySceneHasItsBits) {
#if !defined(__x86_64__) || !defined(__GLIBC__)
    GTEST_SKIP() << "the recorded hashes are those of x86-64 with glibc";
#endif
    std::map<std::string, std::uint64_t> hashes;
    for (const Scene& scene : kScenes) {
        hashes[spaceName<Space2f>() + "_" + scene.name] = hashOf<Space2f>(scene);
        hashes[spaceName<Space2d>() + "_" + scene.name] = hashOf<Space2d>(scene);
        hashes[spaceName<Space3f>() + "_" + scene.name] = hashOf<Space3f>(scene);
        hashes[spaceName<Space3d>() + "_" + scene.name] = hashOf<Space3d>(scene);
    }
    std::map<std::uint64_t, std::string> sceneOf;
    for (const auto& [name, hash] : hashes) {
        const auto [other, isNew] = sceneOf.emplace(hash, name);
        EXPECT_TRUE(isNew) << name << " is no other than " << other->second;
    }
    hashes["libm"] = libmHash();
    if (std::getenv("RIGOR_RENEW_GOLDEN") != nullptr) {
        std::ofstream out(kFile);
        out << "// SPDX-License-Identifier: MIT\n// SPDX-FileCopyrightText: 2026 The Rigor authors\n"
            << "// GOLDEN(scene, state hash), written by golden_test.cpp, which describes how and when.\n";
        for (const auto& [name, hash] : hashes) {
            char line[100];
            std::snprintf(line, sizeof line, "GOLDEN(%s, 0x%016llx)\n", name.c_str(),
                          static_cast<unsigned long long>(hash));
            out << line;
        }
        ASSERT_TRUE(out.good()) << kFile;
        GTEST_SKIP() << "renewed " << kFile;
    }
    const std::map<std::string, std::uint64_t> golden = recorded();
    if (golden.count("libm") && golden.at("libm") != hashes["libm"])
        GTEST_SKIP() << "libm rounds other results another way than the one the hashes were recorded with";
    for (const auto& [name, hash] : hashes) {
        ASSERT_TRUE(golden.count(name)) << name << " has no golden hash";
        EXPECT_EQ(hash, golden.at(name)) << name;
    }
    EXPECT_EQ(hashes.size(), golden.size()) << "golden hashes of scenes that are gone";
}

}  // namespace
}  // namespace rigor::engine::test
