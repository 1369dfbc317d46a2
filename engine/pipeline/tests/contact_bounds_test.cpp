// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bounding volumes: the contacts are the same, the work is not.
#include <gtest/gtest.h>

#include <functional>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

/// Cost of a run of a pile of plates, balls and rods, and a hash of where it has ended.
struct Run {
    std::uint64_t hash = 0;
    std::size_t contacts = 0, pairs = 0, queries = 0;
};

template <class S>
Run dropPile(const std::string& volume, typename S::Real motion) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    WorldDef<S> def = earth<S>();
    def.boundingVolume = volume;
    def.speculativeMotion = motion;
    World<S> world(def);
    const std::uint32_t material = world.addMaterial(Real(0.5), 0);
    addGround<S>(world, material);
    Vec plate = Vec::Constant(Real(0.4));
    plate[1] = Real(0.05);
    const Shape<S> shapes[] = {Box<S>{plate}, Sphere<S>{Real(0.2)}, Capsule<S>{Real(0.05), Real(0.4)}};
    for (int i = 0; i < 30; ++i) {
        BodyDef<S> body;
        body.mass = 1;
        body.inertia = isotropic<S>(0.1);
        body.pose.p = at<S>(0.3 * (i % 5), 0.3 + 0.25 * i);
        body.pose.q = expMap(spin<S>(0.1 * i));
        body.angularVelocity = spin<S>(i % 7 - 3);
        attach<S>(world, world.addBody(body), shapes[i % 3], material);
    }
    Run run;
    // Spheres may find points of shapes that are apart which boxes do not find, but not within these steps.
    for (int i = 0; i < 50; ++i) {
        const StepResult<S>& step = world.step(Real(1) / 60);
        run.contacts += step.contacts;
        run.pairs += step.pairs;
        run.queries += step.narrowPhaseCalls;
    }
    for (const BodyId body : world.bodies())
        for (int k = 0; k < S::dim; ++k) run.hash = run.hash * 31 + std::hash<Real>{}(world.pose(body).p[k]);
    return run;
}

template <class S>
void expectTheSameContacts(typename S::Real motion) {
    const Run box = dropPile<S>("aabb", motion);
    const Run both = dropPile<S>("aabb_and_sphere", motion);
    const Run sphere = dropPile<S>("bounding_sphere", motion);
    ASSERT_GT(box.contacts, 500u);
    EXPECT_EQ(both.hash, box.hash);
    EXPECT_EQ(sphere.hash, box.hash);
    EXPECT_EQ(both.contacts, box.contacts);
    EXPECT_EQ(both.pairs, box.pairs);
    EXPECT_LT(both.queries, box.queries);
    EXPECT_GT(sphere.pairs, box.pairs);
}

TEST(BoundingVolumes, FindTheSameContacts) {
    expectTheSameContacts<Space2f>(0);
    expectTheSameContacts<Space2d>(0);
    expectTheSameContacts<Space3f>(0);
    expectTheSameContacts<Space3d>(0);
}

TEST(BoundingVolumes, FindTheSameContactsAhead) {
    expectTheSameContacts<Space2d>(1);
    expectTheSameContacts<Space3d>(1);
}

/// Two plates that lie beside each other, aligned with the axes: their boxes are apart, their spheres are not.
TEST(BoundingVolumes, SpheresOfFlatPlatesMeetWhereBoxesDoNot) {
    using S = Space3d;
    const auto pairsOf = [](const std::string& volume) {
        WorldDef<S> def;
        def.gravity.setZero();
        def.boundingVolume = volume;
        World<S> world(def);
        for (int i = 0; i < 2; ++i) {
            BodyDef<S> body;
            body.pose.p = at<S>(0, 0.5 * i);
            attach<S>(world, world.addBody(body), Box<S>{{1, 0.1, 1}}, 0);
        }
        return world.step(0.01).pairs;
    };
    EXPECT_EQ(pairsOf("aabb"), 0u);
    EXPECT_EQ(pairsOf("aabb_and_sphere"), 0u);
    EXPECT_EQ(pairsOf("bounding_sphere"), 1u);
}

}  // namespace
}  // namespace rigor::engine::test
