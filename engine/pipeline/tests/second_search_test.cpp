// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// WorldDef::secondSearch: contacts of bodies in violent motion are found again in the middle of the step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/pipeline/tests/scene.hpp"
#include "engine/shapes/shape.hpp"

namespace rigor::engine::test {
namespace {

constexpr double kBrickStep = 1.0 / 60, kBrickDensity = 2000;
constexpr double kBrickHalf[] = {0.25, 0.125, 0.125};  ///< half extents of a brick [m]

template <class S>
Shape<S> brick() {
    typename S::Vec half;
    for (int k = 0; k < S::dim; ++k) half[k] = static_cast<typename S::Real>(kBrickHalf[k]);
    return Box<S>{half};
}

template <class S>
WorldDef<S> violent(bool twice) {
    WorldDef<S> def = earth<S>();
    def.solver = "wide";
    def.secondSearch = twice;
    return def;
}

template <class S>
struct Thrown {
    using R = typename S::Real;
    World<S> world;
    BodyId brick;
    double mass = 0;

    /// A brick that tumbles down to a half-space, thrown by the numbers of a seed.
    Thrown(const WorldDef<S>& def, unsigned seed) : world(def) {
        std::mt19937 random(seed);
        const auto any = [&](double most) {
            return std::uniform_real_distribution<double>(-most, most)(random);
        };
        const std::uint32_t material = world.addMaterial(R(0.6), R(0));
        BodyDef<S> still;
        still.type = BodyType::Static;
        attach<S>(world, world.addBody(still), Shape<S>(HalfSpace<S>{S::Vec::Unit(1), R(0)}), material);
        const MassProperties<S> properties = massProperties<S>(test::brick<S>(), R(kBrickDensity));
        BodyDef<S> body;
        body.mass = properties.mass;
        body.inertia = properties.inertia;
        body.pose.p = at<S>(0, 1 + any(0.1));
        body.velocity = at<S>(any(3), -6 + any(3));
        if constexpr (S::dim == 2) {
            body.pose.q = S::Rot::fromAngle(R(any(3)));
            body.angularVelocity = R(any(12));
        } else {
            body.pose.q = typename S::Rot(R(any(1)), R(any(1)), R(any(1)), R(any(1))).normalized();
            body.angularVelocity = typename S::Vec(R(any(8)), R(any(8)), R(any(8)));
        }
        mass = static_cast<double>(body.mass);
        brick = world.addBody(body);
        attach<S>(world, brick, test::brick<S>(), material);
    }

    double overlap() const {
        return -static_cast<double>(boundingBox<S>(test::brick<S>(), world.pose(brick)).min.y());
    }
    double momentum() const { return mass * static_cast<double>(world.velocity(brick).y()); }
};

template <class S>
double deepestOf(int bricks) {
    double deepest = 0;
    for (int seed = 0; seed < bricks; ++seed) {
        Thrown<S> thrown(violent<S>(true), static_cast<unsigned>(seed));
        for (int step = 0; step < 30; ++step) {
            thrown.world.step(typename S::Real(kBrickStep));
            deepest = std::max(deepest, thrown.overlap());
        }
    }
    return deepest;
}

template <class S>
class SecondSearch : public testing::Test {};
using SecondSearchSpaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(SecondSearch, SecondSearchSpaces);

TYPED_TEST(SecondSearch, BricksThatLandOnCornersDoNotSinkIn) {
    EXPECT_LT(deepestOf<TypeParam>(120), 0.1 * kBrickHalf[1]);
}

/// The contacts of a step report the impulses of all of it: they add up to the vertical momentum that the brick got.
TYPED_TEST(SecondSearch, ImpulsesAreThoseOfTheWholeStep) {
    using S = TypeParam;
    int violentSteps = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        Thrown<S> thrown(violent<S>(true), seed), once(violent<S>(false), seed);
        for (int step = 0; step < 30; ++step) {
            const double before = thrown.momentum();
            const std::size_t queries = thrown.world.step(typename S::Real(kBrickStep)).narrowPhaseCalls;
            violentSteps += queries > once.world.step(typename S::Real(kBrickStep)).narrowPhaseCalls;
            std::vector<ContactView<S>> contacts;
            thrown.world.readContacts(contacts);
            double impulse = 0;
            for (const ContactView<S>& contact : contacts)
                impulse += static_cast<double>(contact.normalImpulse);
            const double given = thrown.momentum() - before + thrown.mass * kGravity * kBrickStep;
            ASSERT_NEAR(impulse, given, 1e-4 * thrown.mass) << "seed " << seed << " step " << step;
        }
    }
    EXPECT_GT(violentSteps, 20);
}

/// Bodies that move as the first search foresees are not searched for again.
TYPED_TEST(SecondSearch, QuietStepsAreTheSameBits) {
    using S = TypeParam;
    using R = typename S::Real;
    const auto stack = [](bool twice) {
        World<S> world(violent<S>(twice));
        const std::uint32_t wood = world.addMaterial(R(0.5), R(0));
        addGround<S>(world, wood);
        for (int i = 0; i < 6; ++i) addCube<S>(world, 0.01 * i, 0.25 + 0.5 * i, 0.25, 1, wood, 0);
        return world;
    };
    World<S> once = stack(false), twice = stack(true);
    for (int step = 0; step < 60; ++step) {
        const std::size_t calls = once.step(R(kBrickStep)).narrowPhaseCalls;
        EXPECT_EQ(twice.step(R(kBrickStep)).narrowPhaseCalls, calls);
        ASSERT_EQ(twice.stateHash(), once.stateHash()) << step;
    }
}

/// Bricks that fall on each other in large islands, and in small ones in violent motion, in steps from midpoint to midpoint:
/// contacts begin, end and change within steps. A restored snapshot, and any number of threads, go the same way to the bit.
TYPED_TEST(SecondSearch, HeapsAreTheSameBitsWithThreadsAndSnapshots) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const int contacts : {4, 400}) {
        const auto heap = [contacts](int threads) {
            WorldDef<S> def = earth<S>();
            def.islandContacts = contacts;
            def.threads = threads;
            World<S> world(def);
            const std::uint32_t stone = world.addMaterial(R(0.6), R(0));
            addGround<S>(world, stone);
            for (int i = 0; i < 40; ++i)
                addCube<S>(world, 0.3 * (i % 5), 0.3 + 0.6 * (i / 5.0), 0.2, 1 + i % 3, stone,
                           6.0 * (i % 4) - 9);
            return world;
        };
        World<S> world = heap(1), threads = heap(2), restored = heap(1);
        std::vector<unsigned char> bytes;
        for (int step = 0; step < 90; ++step) {
            if (step == 30) world.saveSnapshot(bytes);
            world.step(R(kBrickStep));
            threads.step(R(kBrickStep));
            ASSERT_EQ(threads.stateHash(), world.stateHash()) << step;
            if (step == 30) restored.restoreSnapshot(bytes);
            if (step < 30) continue;
            restored.step(R(kBrickStep));
            ASSERT_EQ(restored.stateHash(), world.stateHash()) << step;
        }
    }
}

}  // namespace
}  // namespace rigor::engine::test
