// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The choice of manifold in a running world: boxes at rest on each other, with every manifold and every
// narrow phase; and a narrow phase of the user's own.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/narrowphase/narrowphases.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
struct Stack {
    using R = typename S::Real;
    World<S> world;
    std::vector<BodyId> boxes;

    Stack(const WorldDef<S>& def, int count, double spin0 = 0) : world(def) {
        const std::uint32_t wood = world.addMaterial(R(0.5), R(0));
        addGround(world, wood);
        for (int i = 0; i < count; ++i) {
            BodyDef<S> body;
            body.pose.p = at<S>(0.01 * i, 0.5 + i);
            body.angularVelocity = spin<S>(spin0);
            body.mass = 1;
            body.inertia = isotropic<S>(1.0 / 6);
            boxes.push_back(world.addBody(body));
            attach<S>(world, boxes.back(), Box<S>{S::Vec::Constant(R(0.5))}, wood);
        }
    }
    void run(double seconds) {
        for (int i = 0; i < static_cast<int>(seconds * 120); ++i) world.step(R(1.0 / 120));
    }
    double height(std::size_t i) const { return static_cast<double>(world.pose(boxes[i]).p[1]); }
};

template <class S>
class Manifolds : public testing::Test {};
using ManifoldSpaces = testing::Types<Space2d, Space3d>;
TYPED_TEST_SUITE(Manifolds, ManifoldSpaces);

TYPED_TEST(Manifolds, StacksRestWithEveryNarrowPhase) {
    using S = TypeParam;
    for (const NarrowPhaseEntry& narrow : narrowPhases())
        for (const char* manifold : {"clipped", "persistent"}) {
            SCOPED_TRACE(std::string(narrow.name) + " " + manifold);
            WorldDef<S> def = earth<S>();
            def.narrowPhase = narrow.name;
            def.manifold = manifold;
            Stack<S> stack(def, 3);
            stack.run(2);
            for (std::size_t i = 0; i < 3; ++i)
                EXPECT_NEAR(stack.height(i), 0.5 + static_cast<double>(i), 2e-3);
            EXPECT_EQ(stack.world.lastStep().contacts, 3u * (S::dim == 2 ? 2 : 4));
        }
}

/// One point can not hold a box that turns: it goes on turning about its corner, where a full manifold stops
/// it.
TYPED_TEST(Manifolds, TheDeepestPointAloneLetsABoxRock) {
    using S = TypeParam;
    const auto spread = [](const char* manifold) {
        WorldDef<S> def = earth<S>();
        def.manifold = manifold;
        Stack<S> stack(def, 1, 0.2);
        double most = 0;
        stack.run(0.5);
        for (int i = 0; i < 60; ++i) {
            stack.world.step(1.0 / 120);
            EXPECT_LE(stack.world.lastStep().contacts, std::string(manifold) == "deepest" ? 1u : 4u);
            most = std::max(most, std::abs(spinOf<S>(stack.world.angularVelocity(stack.boxes[0]))));
        }
        return most;
    };
    EXPECT_LT(spread("clipped"), 1e-4);
    EXPECT_LT(spread("persistent"), 1e-3);
    EXPECT_GT(spread("deepest"), 1e-2);
}

/// Counts the queries and passes them on to "sat".
template <class S>
class Counting final : public NarrowPhase<S> {
  public:
    mutable int queries = 0;
    void collide(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                 typename S::Real speculativeDistance, Manifold<S>& out) const override {
        ++queries;
        collideSat<S>(a, Xa, b, Xb, speculativeDistance, out);
    }
};

TYPED_TEST(Manifolds, AWorldMayCarryANarrowPhaseOfItsOwn) {
    using S = TypeParam;
    const auto counting = std::make_shared<Counting<S>>();
    WorldDef<S> def = earth<S>();
    Stack<S> plain(def, 2);
    def.customNarrowPhase = counting;
    Stack<S> custom(def, 2);
    plain.run(0.5);
    custom.run(0.5);
    EXPECT_GT(counting->queries, 60);
    EXPECT_EQ(plain.world.stateHash(), custom.world.stateHash());
}

}  // namespace
}  // namespace rigor::engine::test
