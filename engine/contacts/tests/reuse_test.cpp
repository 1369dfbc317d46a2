// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cached results of the narrow phase (contacts/contact_cache.hpp): against a new query, and through
// everything that happens to a world.
#include <gtest/gtest.h>

#include <random>

#include "engine/broadphase/broad_phase.hpp"
#include "engine/core/tests/counting_new.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Reuse : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Reuse, Spaces);

constexpr double kReuse = 1e-3, kSpeculative = 1e-3;

/// A static box and a dynamic one, posed by hand; contacts found with or without keeping them.
template <class S>
struct Pair {
    using R = typename S::Real;
    using Vec = typename S::Vec;
    BodyArrays<S> bodies;
    Contacts<S> set;
    std::unique_ptr<BroadPhase<S>> broadPhase =
        findAlgorithm(broadPhaseTable<S>(), "broad_phase", "brute_force").make();
    std::shared_ptr<const NarrowPhase<S>> narrowPhase = makeNarrowPhase<S>("sat");
    std::unique_ptr<ContinuousCollision<S>> ccd =
        findAlgorithm(continuousCollisionTable<S>(), "continuous_collision", "none").make();
    ContactSearch<S> search{R(kSpeculative), 0, 0};

    Pair(double reuse, double half) {
        search.cacheTolerance = static_cast<R>(reuse);
        for (const BodyType type : {BodyType::Static, BodyType::Dynamic}) {
            bodies.pose.emplace_back();
            bodies.velocity.emplace_back();
            bodies.asleep.push_back(0);
            bodies.islands.push_back(IslandKind::Usual);
            bodies.id.emplace_back();
            bodies.constants.emplace_back().type = type;
            bodies.invMass.push_back(type == BodyType::Dynamic ? R(1) : R(0));
            ShapeRecord<S> record;
            record.shape = Box<S>{Vec::Constant(static_cast<R>(type == BodyType::Dynamic ? half : 1.0))};
            record.body = static_cast<std::uint32_t>(bodies.pose.size() - 1);
            record.radius = Vec::Constant(static_cast<R>(type == BodyType::Dynamic ? half : 1.0)).norm();
            set.shapes().records().push_back(record);
        }
    }
    const ContactList<S>& find() {
        set.findPairs(bodies, *broadPhase, search, *ccd, Tasks::one());
        set.findManifolds(bodies, *narrowPhase, &manifoldClipped<S>, *ccd, Tasks::one());
        return set.list();
    }
};

template <class S>
struct Random {
    using R = typename S::Real;
    std::mt19937 bits{7};
    double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(bits); }
    typename S::Vec vec(double size) {
        typename S::Vec v;
        for (int i = 0; i < S::dim; ++i) v[i] = static_cast<R>(in(-size, size));
        return v;
    }
    typename S::Ang ang(double size) {
        if constexpr (S::dim == 2)
            return static_cast<R>(in(-size, size));
        else
            return vec(size);
    }
};

/// A box of half extent 0.3 on the top face of the static one, turned about the face's normal, its corners
/// within 0.3 mm of the face.
template <class S>
Pose<S> resting(Random<S>& random) {
    using R = typename S::Real;
    Pose<S> X;
    X.p = random.vec(0.3);
    X.p[1] = static_cast<R>(1.3 + random.in(-2e-4, 1e-4));
    if constexpr (S::dim == 3) X.q = expMap(typename S::Vec(0, static_cast<R>(random.in(-1, 1)), 0));
    X.q = rotatedBy(X.q, random.ang(2e-4));
    return X;
}

template <class S>
double deepest(const Contact<S>& contact) {
    double least = 1;
    for (int i = 0; i < contact.manifold.count; ++i)
        least = std::min(least, double(contact.manifold.points[i].separation));
    return least;
}

TYPED_TEST(Reuse, CachedPointsAreThoseOfANewQuery) {
    using S = TypeParam;
    Random<S> random;
    int kept = 0;
    for (int trial = 0; trial < 100; ++trial) {
        Pair<S> keeping(kReuse, 0.3), querying(0, 0.3);
        querying.search.speculativeDistance += static_cast<typename S::Real>(kReuse);
        const Pose<S> start = resting(random);
        keeping.bodies.pose[1] = start;
        ASSERT_EQ(keeping.find().size(), 1u);
        ASSERT_EQ(keeping.set.queries(), 1u);
        for (int motion = 0; motion < 10; ++motion) {
            const Pose<S> moved{start.p + random.vec(4e-4), rotatedBy(start.q, random.ang(5e-4))};
            keeping.bodies.pose[1] = querying.bodies.pose[1] = moved;
            const ContactList<S>&with = keeping.find(), &without = querying.find();
            ASSERT_EQ(with.size(), 1u);
            ASSERT_EQ(without.size(), 1u);
            if (keeping.set.queries() > 0) break;  // moved too far after all
            ++kept;
            const Contact<S>&a = with[0], &b = without[0];
            const double rounding = tol<S>(1e-12, 2e-6);
            EXPECT_NEAR(a.manifold.normal.dot(b.manifold.normal), 1, rounding);  // the static one's face
            EXPECT_NEAR(deepest<S>(a), deepest<S>(b), rounding);
            // Corners: each is the same one, where it is now.
            ASSERT_EQ(a.manifold.count, b.manifold.count);
            for (int i = 0; i < a.manifold.count; ++i) {
                const auto& p = a.manifold.points[i];
                double nearest = 1;
                for (int j = 0; j < b.manifold.count; ++j) {
                    const auto& q = b.manifold.points[j];
                    const double distance = double((p.pointB - q.pointB).norm());
                    if (distance < nearest) nearest = distance;
                }
                EXPECT_LT(nearest, rounding);
                EXPECT_NEAR(double((p.pointB - p.pointA).dot(a.manifold.normal)), double(p.separation),
                            rounding);
            }
        }
    }
    EXPECT_GT(kept, 300);
}

/// Any way two boxes may touch: the depth is within what they have moved.
template <class S>
void expectDepthWithinTheMotion(bool apart) {
    Random<S> random;
    int kept = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        Pair<S> keeping(kReuse, 0.3), querying(0, 0.3);
        querying.search.speculativeDistance = static_cast<typename S::Real>(apart ? kSpeculative : 0.01);
        Pose<S> start{random.vec(1.0), rotatedBy(Pose<S>{}.q, random.ang(2))};
        start.p[1] = static_cast<typename S::Real>(random.in(1.2, 1.5));
        keeping.bodies.pose[1] = start;
        if (keeping.find().empty() != apart) continue;
        const double found = apart ? 0 : deepest<S>(keeping.find()[0]);
        if (found < -0.02) continue;  // deep overlaps have more than one penetration vector
        for (int motion = 0; motion < 10; ++motion) {
            const Pose<S> moved{start.p + random.vec(4e-4), rotatedBy(start.q, random.ang(5e-4))};
            keeping.bodies.pose[1] = querying.bodies.pose[1] = moved;
            const ContactList<S>&with = keeping.find(), &without = querying.find();
            if (keeping.set.queries() > 0 || keeping.set.pairs().empty()) break;
            ++kept;
            if (apart) {
                EXPECT_TRUE(without.empty());
                EXPECT_TRUE(with.empty());
                continue;
            }
            ASSERT_EQ(with.size(), 1u);
            ASSERT_EQ(without.size(), 1u);
            EXPECT_NEAR(deepest<S>(with[0]), deepest<S>(without[0]), 2.2 * kReuse);
            EXPECT_NEAR(deepest<S>(with[0]), found, 1.01 * kReuse);
        }
    }
    EXPECT_GT(kept, apart ? 50 : 100);
}
TYPED_TEST(Reuse, KeptDepthsAreWithinTheMotion) {
    expectDepthWithinTheMotion<TypeParam>(false);
}
TYPED_TEST(Reuse, NothingFoundStaysTrue) {
    expectDepthWithinTheMotion<TypeParam>(true);
}

/// A box that comes slowly towards an edge of the other, face first, while their boxes overlap: it is found
/// as early as by a query in every step, which far away is not done.
TYPED_TEST(Reuse, DistantShapesAreNotQueriedUntilTheyMayBeNear) {
    using S = TypeParam;
    using R = typename S::Real;
    Random<S> random;
    int steps = 0, queries = 0, found = 0;
    for (int trial = 0; trial < 20; ++trial) {
        Pair<S> keeping(kReuse, 0.3), near(0, 0.3), wide(0, 0.3);
        wide.search.speculativeDistance += static_cast<R>(1.01 * kReuse);
        typename S::Vec out = S::Vec::Zero(), edge = S::Vec::Zero();
        out[0] = out[1] = std::sqrt(R(0.5));
        edge[0] = edge[1] = R(1);
        typename S::Ang turned = zeroAng<S>();
        if constexpr (S::dim == 3)
            turned[2] = R(0.7853981634);
        else
            turned = R(0.7853981634);
        Pose<S> X;
        X.q = rotatedBy(Pose<S>::identityRot(), turned);
        for (double gap = 0.15; gap > -0.002; gap -= random.in(0.5e-3, 2e-3)) {
            X.p = edge + static_cast<R>(0.3 + gap) * out + random.vec(2e-4);
            X.q = rotatedBy(X.q, random.ang(3e-4));
            keeping.bodies.pose[1] = near.bodies.pose[1] = wide.bodies.pose[1] = X;
            const bool kept = !keeping.find().empty();
            EXPECT_TRUE(kept || near.find().empty()) << "gap " << gap;
            EXPECT_FALSE(kept && wide.find().empty()) << "gap " << gap;
            ++steps;
            queries += static_cast<int>(keeping.set.queries());
            found += kept;
        }
    }
    EXPECT_GT(found, 20);
    EXPECT_LT(queries, steps / 2);
}

TYPED_TEST(Reuse, MovingFurtherQueriesAgain) {
    using S = TypeParam;
    using R = typename S::Real;
    Random<S> random;
    Pair<S> pair(kReuse, 0.3);
    pair.bodies.pose[1] = resting(random);
    pair.find();
    pair.find();
    EXPECT_EQ(pair.set.queries(), 0u);
    pair.bodies.pose[1].p[0] += R(1.1 * kReuse);
    pair.find();
    EXPECT_EQ(pair.set.queries(), 1u);
    pair.bodies.pose[1].q =
        rotatedBy(pair.bodies.pose[1].q, spin<S>(1.2 * kReuse / (0.3 * std::sqrt(S::dim))));
    pair.find();
    EXPECT_EQ(pair.set.queries(), 1u);
    pair.bodies.pose[0].p[0] += R(1.1 * kReuse);  // the other one, as a fault may move it
    pair.set.structureChanged();
    pair.find();
    EXPECT_EQ(pair.set.queries(), 1u);
    pair.search.speculativeDistance *= 2;
    pair.find();
    EXPECT_EQ(pair.set.queries(), 1u);
    pair.bodies.pose[1].p[1] += R(1);
    EXPECT_TRUE(pair.find().empty());
    pair.bodies.pose[1].p[1] -= R(1);
    EXPECT_EQ(pair.find().size(), 1u);
}

/// Small shapes are queried again after a fiftieth of their radius, however large the cache tolerance: so
/// much at most has their normal turned, and twice that is their depth wrong.
TYPED_TEST(Reuse, SmallShapesAreQueriedSooner) {
    using S = TypeParam;
    using R = typename S::Real;
    Random<S> random;
    const double half = 3e-3, slack = 0.02 * half * std::sqrt(S::dim);
    const auto queriesAfter = [&](double moved, double turned) {
        Pair<S> pair(kReuse, half);
        Pose<S>& X = pair.bodies.pose[1];
        X.p = at<S>(0.2, 1 + half);
        EXPECT_EQ(pair.find().size(), 1u);
        X.p[0] += static_cast<R>(moved);
        X.q = rotatedBy(X.q, spin<S>(turned));
        EXPECT_EQ(pair.find().size(), 1u);
        return pair.set.queries();
    };
    EXPECT_EQ(queriesAfter(0.9 * slack, 0), 0u);
    EXPECT_EQ(queriesAfter(1.1 * slack, 0), 1u);
    EXPECT_EQ(queriesAfter(0, 0.9 * 0.02), 0u);
    EXPECT_EQ(queriesAfter(0, 1.1 * 0.02), 1u);
    EXPECT_EQ(queriesAfter(0.6 * slack, 0.6 * 0.02), 1u);
}

/// A pair that parts and comes back while the broad phase goes on listing it, because of fat AABBs: what
/// was known of it is forgotten, and it is found again.
TYPED_TEST(Reuse, WhatComesBackIsFoundAgain) {
    using S = TypeParam;
    using R = typename S::Real;
    Random<S> random;
    Pair<S> pair(kReuse, 0.3);
    pair.search.boxMargin = R(0.2);
    pair.bodies.pose[1] = resting(random);
    ASSERT_EQ(pair.find().size(), 1u);
    for (int i = 0; i < 2; ++i) {
        pair.bodies.pose[1].p[1] += R(0.05);
        EXPECT_TRUE(pair.find().empty());
        pair.bodies.pose[1].p[1] -= R(0.05);
        EXPECT_EQ(pair.find().size(), 1u);
    }
}

/// Two boxes that overlap and turn together by a right angle: the penetration vector that was chosen turns
/// with them, and another one that has become as good as that is not taken.
TYPED_TEST(Reuse, WhatTurnsTogetherKeepsItsWayOut) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const char* narrowPhase : {"gjk_epa", "mpr"})
        for (const double quarter : {0.0, 1.0, 2.0, 3.0}) {
            Pair<S> pair(kReuse, 0.3);
            pair.narrowPhase = makeNarrowPhase<S>(narrowPhase);
            pair.bodies.constants[0].type = BodyType::Dynamic;
            typename S::Vec from = at<S>(1.3 - 0.05, 1.3 - 0.052);  // x is the nearer way
            Pose<S>&A = pair.bodies.pose[0], &B = pair.bodies.pose[1];
            B.p = from;
            ASSERT_EQ(pair.find().size(), 1u);
            const auto& contact = pair.set.list()[0];
            ASSERT_NEAR(contact.manifold.normal[0], 1, 1e-3);
            A.q = B.q = rotatedBy(A.q, spin<S>(quarter * 1.5707963267948966));
            B.p = rotate<R>(A.q, from);
            ASSERT_EQ(pair.find().size(), 1u);
            ASSERT_EQ(pair.set.queries(), 0u);
            from = at<S>(1.3 - 0.05, 1.3 - 0.05 + 1e-5);  // the limit is exceeded by the small change of y
            B.p = rotate<R>(A.q, from);
            ASSERT_EQ(pair.find().size(), 1u);
            ASSERT_EQ(pair.set.queries(), 1u);
            const typename S::Vec normal = rotateInverse<R>(A.q, pair.set.list()[0].manifold.normal);
            EXPECT_NEAR(normal[0], 1, 1e-3) << narrowPhase << " " << quarter;
        }
}

/// Five cubes on the ground, and one that slides towards them.
template <class S>
World<S> stack(double reuse, double boxMargin, int threads = 1, const char* sleeping = "off",
               const char* integrator = "symplectic_euler") {
    WorldDef<S> def = earth<S>();
    def.integrator = integrator;
    def.cacheTolerance = static_cast<typename S::Real>(reuse);
    def.boxMargin = static_cast<typename S::Real>(boxMargin);
    def.threads = threads;
    def.sleeping = sleeping;
    World<S> world(def);
    const auto wood = world.addMaterial(typename S::Real(0.5), 0);
    addGround<S>(world, wood);
    for (int i = 0; i < 5; ++i) addCube<S>(world, 0.01 * i, 0.25 + 0.5 * i, 0.25, 1, wood);
    addCube<S>(world, -2, 0.25, 0.25, 1, wood, 3.6);
    return world;
}

TYPED_TEST(Reuse, AStackAtRestIsNotQueriedAndStands) {
    using S = TypeParam;
    World<S> world = stack<S>(kReuse, 0.1);
    for (int i = 0; i < 240; ++i) world.step(typename S::Real(1.0 / 60));
    std::size_t calls = 0;
    const long before = allocationCount();
    for (int i = 0; i < 60; ++i) calls += world.step(typename S::Real(1.0 / 60)).narrowPhaseCalls;
    EXPECT_EQ(allocationCount(), before);
    EXPECT_LE(calls, 6u);
    EXPECT_GE(world.manifolds().size(), 6u);
    for (const ShapeRecord<S>& shape : world.shapes())
        if (const BodyId body = world.bodyOf(shape); world.constants(body).type == BodyType::Dynamic) {
            EXPECT_LT(world.velocity(body).norm(), 1e-3);
        }
    for (const Contact<S>& contact : world.manifolds()) EXPECT_GT(deepest<S>(contact), -1e-3);
}

TYPED_TEST(Reuse, BoxMarginsAndThreadsAreNoPartOfTheResult) {
    using S = TypeParam;
    for (const double reuse : {0.0, kReuse}) {
        World<S> plain = stack<S>(reuse, 0), margin = stack<S>(reuse, 0.2), two = stack<S>(reuse, 0.05, 2);
        for (int i = 0; i < 120; ++i) {
            plain.step(typename S::Real(1.0 / 60));
            margin.step(typename S::Real(1.0 / 60));
            two.step(typename S::Real(1.0 / 60));
            ASSERT_EQ(plain.stateHash(), margin.stateHash()) << reuse << " step " << i;
            ASSERT_EQ(plain.stateHash(), two.stateHash()) << reuse << " step " << i;
            ASSERT_EQ(plain.pairs().size(), margin.pairs().size());
        }
    }
}

TYPED_TEST(Reuse, ASnapshotHoldsWhatIsKept) {
    using S = TypeParam;
    for (const char* integrator : {"symplectic_euler", "moreau_midpoint"})
        for (const char* sleeping : {"off", "islands"}) {
            SCOPED_TRACE(std::string(integrator) + " sleeping " + sleeping);
            World<S> one = stack<S>(kReuse, 0.1, 1, sleeping, integrator),
                     other = stack<S>(kReuse, 0, 1, sleeping, integrator);
            for (int i = 0; i < 57; ++i) one.step(typename S::Real(1.0 / 60));
            std::vector<unsigned char> bytes;
            one.saveSnapshot(bytes);
            other.restoreSnapshot(bytes);
            ASSERT_EQ(one.stateHash(), other.stateHash());
            for (int i = 0; i < 100; ++i) {
                const std::size_t calls = one.step(typename S::Real(1.0 / 60)).narrowPhaseCalls;
                ASSERT_EQ(other.step(typename S::Real(1.0 / 60)).narrowPhaseCalls, calls) << i;
                ASSERT_EQ(one.stateHash(), other.stateHash()) << i;
            }
            if (sleeping == std::string("islands"))
                continue;  // pairs of sleeping bodies are not queried at all
            // Cached manifolds of these settings do not hold under other settings.
            World<S> third = stack<S>(2 * kReuse, 0, 1, sleeping, integrator);
            third.restoreSnapshot(bytes);
            EXPECT_GE(third.step(typename S::Real(1.0 / 60)).narrowPhaseCalls, 5u);
        }
}

TYPED_TEST(Reuse, RemovedBodiesTakeTheirAnswersAlong) {
    using S = TypeParam;
    World<S> world = stack<S>(kReuse, 0.1);
    for (int i = 0; i < 30; ++i) world.step(typename S::Real(1.0 / 60));
    const ShapeRecord<S>& second = world.shapes()[2];
    world.removeBody(world.bodyOf(second));
    for (int i = 0; i < 240; ++i) world.step(typename S::Real(1.0 / 60));
    EXPECT_FALSE(world.lastStep().nonFinite);
    double top = 0;
    for (const ShapeRecord<S>& shape : world.shapes())
        top = std::max(top, double(world.shapePose(shape).p[1]));
    EXPECT_LT(top, 1.8);  // the boxes on top have come down
    for (const Contact<S>& contact : world.manifolds()) EXPECT_GT(deepest<S>(contact), -2e-3);
}

TYPED_TEST(Reuse, ShapesThatMoveTogetherAreNotQueried) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    def.cacheTolerance = static_cast<R>(kReuse);
    World<S> world(def);
    const auto wood = world.addMaterial(R(0.8), 0);
    BodyDef<S> platform;
    platform.type = BodyType::Kinematic;
    platform.velocity = at<S>(1, 0.5);
    attach<S>(world, world.addBody(platform), Box<S>{S::Vec::Constant(R(1))}, wood);
    const BodyId cube = addCube<S>(world, 0.2, 1.25, 0.25, 1, wood, 1);
    world.setVelocity(cube, at<S>(1, 0.5), zeroAng<S>());
    std::size_t calls = 0;
    for (int i = 0; i < 120; ++i) calls += world.step(R(1.0 / 60)).narrowPhaseCalls;
    EXPECT_LE(calls, 5u);
    EXPECT_NEAR(double(world.pose(cube).p[1]), 2.25, 1e-3);
    EXPECT_NEAR(double(world.pose(cube).p[0]), 2.2, 2e-3);
}

TYPED_TEST(Reuse, IsRefusedWithAManifoldThatGrowsByQueries) {
    WorldDef<TypeParam> def;
    def.cacheTolerance = typename TypeParam::Real(kReuse);
    def.manifold = "persistent";
    EXPECT_THROW(World<TypeParam>{def}, EngineError);
    def.manifold = "clipped";
    def.cacheTolerance = -1;
    EXPECT_THROW(World<TypeParam>{def}, EngineError);
    def.cacheTolerance = 0;
    def.boxMargin = -1;
    EXPECT_THROW(World<TypeParam>{def}, EngineError);
}

}  // namespace
}  // namespace rigor::engine::test
