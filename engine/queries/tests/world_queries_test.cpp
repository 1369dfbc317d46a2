// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Queries to a world of all kinds of shapes against queries to every shape alone; first touches against known
// configurations and against the distance just before and after.
#include "engine/queries/world_queries.hpp"

#include <gtest/gtest.h>

#include "engine/core/error.hpp"
#include "engine/narrowphase/distance.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"
#include "engine/queries/shape_cast.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Questions : public testing::Test {
  protected:
    using Scalar = typename S::Real;
    using V = typename S::Vec;
    /// Thirty bodies of every kind in turn, scattered, and a floor.
    Questions() : world(WorldDef<S>{}) {
        Random<S> random{std::mt19937(4)};
        for (int i = 0; i < 30; ++i) {
            const Shape<S> shape = shapeOfKind<S>(i % kKinds<S>);
            if (std::holds_alternative<HalfSpace<S>>(shape)) continue;
            add(shape,
                pose<S>(Scalar(4) * random.direction() * Scalar(random.uniform(0.1, 1)), random.rotation()));
        }
        add(HalfSpace<S>{vec<S>(0, 1, 0), Scalar(-4)}, Pose<S>{});
        add(HalfSpace<S>{vec<S>(0.6, 0.8, 0), Scalar(-5)}, Pose<S>{});
    }
    BodyId add(const Shape<S>& shape, const Pose<S>& X) {
        BodyDef<S> def;
        def.type = isStaticOnly<S>(shape) ? BodyType::Static : BodyType::Dynamic;
        def.pose = X;
        const BodyId body = world.addBody(def);
        ShapeDef<S> part;
        part.shape = shape;
        part.pose = pose<S>(vec<S>(0.1, 0.05, -0.1), turn<S>(0.4, 0.2));
        world.addShape(body, part);
        return body;
    }
    /// visit(index, convex shape or piece, pose, piece number) over everything there is.
    template <class Visit>
    void all(Visit visit) const {
        std::uint32_t i = 0;
        for (const ShapeRecord<S>& record : world.shapes()) {
            const Pose<S> X = world.shapePose(record);
            if (!isComposite<S>(record.shape)) visit(i, record.shape, X);
            withSurface<S>(record.shape, [&](const auto& data) {
                for (std::uint32_t k = 0; k < data.pieceCount(); ++k) visit(i, Shape<S>(data.piece(k)), X);
            });
            ++i;
        }
    }
    std::vector<Shape<S>> probes() const {
        std::vector<Shape<S>> list;
        for (int kind = 0; kind < kKinds<S>; ++kind)
            if (const Shape<S> s = shapeOfKind<S>(kind);
                !isComposite<S>(s) && !std::holds_alternative<HalfSpace<S>>(s))
                list.push_back(s);
        return list;
    }
    World<S> world;
};
using QuestionsSpaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Questions, QuestionsSpaces);

TYPED_TEST(Questions, RaysFindTheNearest) {
    using S = TypeParam;
    using R = typename S::Real;
    const WorldQueries<S> queries(this->world);
    Random<S> random{std::mt19937(40)};
    int hits = 0;
    for (int n = 0; n < 500; ++n) {
        const typename S::Vec o = R(5) * random.direction(),
                              d = R(random.uniform(1, 10)) * random.direction();
        R best = 2;
        std::size_t met = 0;
        for (const ShapeRecord<S>& record : this->world.shapes()) {
            RayHit<S> hit;
            if (!castRay<S>(record.shape, this->world.shapePose(record), o, d, hit)) continue;
            ++met;
            best = std::min(best, hit.fraction);
        }
        const auto hit = queries.castRay(o, d);
        ASSERT_EQ(hit.has_value(), met > 0);
        const auto list = queries.castRayAll(o, d);
        ASSERT_EQ(list.size(), met);
        for (std::size_t i = 1; i < list.size(); ++i) EXPECT_LE(list[i - 1].fraction, list[i].fraction);
        if (!hit) continue;
        ++hits;
        EXPECT_EQ(hit->fraction, best);
        EXPECT_EQ(list.front().fraction, best);
        EXPECT_TRUE(list.front().body == hit->body && list.front().shape == hit->shape);
        const auto without = queries.castRay(o, d, [&](BodyId body) { return !(body == hit->body); });
        if (without) {
            EXPECT_FALSE(without->body == hit->body);
        }
        EXPECT_EQ(without.has_value(), met > 1);
    }
    EXPECT_GT(hits, 100);
}

TYPED_TEST(Questions, NearestAndOverlaps) {
    using S = TypeParam;
    using R = typename S::Real;
    const WorldQueries<S> queries(this->world);
    Random<S> random{std::mt19937(41)};
    int overlaps = 0;
    const auto probes = this->probes();
    for (int n = 0; n < 60; ++n) {
        const Shape<S> probe = probes[static_cast<std::size_t>(n) % probes.size()];
        const Pose<S> X = pose<S>(R(random.uniform(0, 6)) * random.direction(), random.rotation());
        R best = std::numeric_limits<R>::max();
        std::vector<std::uint32_t> touching;
        this->all([&](std::uint32_t i, const Shape<S>& shape, const Pose<S>& Xs) {
            const R d = closestPoints<S>(probe, X, shape, Xs).distance;
            best = std::min(best, d);
            if (d <= 0 && (touching.empty() || touching.back() != i)) touching.push_back(i);
        });
        const auto hit = queries.nearest(probe, X, R(100));
        ASSERT_TRUE(hit.has_value());
        EXPECT_EQ(hit->distance, best);
        EXPECT_NEAR((hit->onShape - hit->point).dot(hit->normal), hit->distance, tol<S>(1e-12, 1e-5));
        if (best > R(0.01)) {
            EXPECT_FALSE(queries.nearest(probe, X, best * R(0.99)).has_value());
        }
        std::vector<std::uint32_t> found;
        std::vector<std::uint32_t> solid;  // shapes under a height field count although no piece touches
        for (const ShapeRef& r : queries.overlapping(probe, X)) {
            std::uint32_t i = 0;
            for (const ShapeRecord<S>& record : this->world.shapes()) {
                if (record.id == r.shape) break;
                ++i;
            }
            if (isComposite<S>(this->world.shapes()[i].shape) && r.piece == kNullIndex)
                solid.push_back(i);
            else
                found.push_back(i);
        }
        EXPECT_EQ(found, touching);
        overlaps += !touching.empty();
        // Boxes: those of all that touch are among them.
        EXPECT_GE(queries.inBox(boundingBox<S>(probe, X)).size(), touching.size() + solid.size());
    }
    EXPECT_GT(overlaps, 10);
}

TYPED_TEST(Questions, ShapeCastsStopAtTheFirstTouch) {
    using S = TypeParam;
    using R = typename S::Real;
    const WorldQueries<S> queries(this->world);
    Random<S> random{std::mt19937(42)};
    int hits = 0, misses = 0;
    const auto probes = this->probes();
    for (int n = 0; n < 60; ++n) {
        const Shape<S> probe = probes[static_cast<std::size_t>(n) % probes.size()];
        const Pose<S> X = pose<S>(R(6) * random.direction(), random.rotation());
        const typename S::Vec d = R(random.uniform(1, 8)) * (R(0.4) * random.direction() - X.p.normalized());
        const auto gapAt = [&](R t) {
            Pose<S> moved = X;
            moved.p += t * d;
            R least = std::numeric_limits<R>::max();
            this->all([&](std::uint32_t, const Shape<S>& shape, const Pose<S>& Xs) {
                least = std::min(least, closestPoints<S>(probe, moved, shape, Xs).distance);
            });
            return least;
        };
        if (gapAt(0) <= 0) continue;
        const auto hit = queries.castShape(probe, X, d);
        if (!hit) {
            ++misses;
            for (int k = 0; k <= 20; ++k) EXPECT_GT(gapAt(R(k) / R(20)), -tol<S>(1e-9, 1e-4)) << n;
            continue;
        }
        ++hits;
        EXPECT_TRUE(hit->converged);
        EXPECT_NEAR(gapAt(hit->fraction), 0, tol<S>(2e-12, 2e-3)) << n;
        EXPECT_LE(hit->normal.dot(-d), 0) << "moving into it";
        for (int k = 0; k < 20; ++k)
            EXPECT_GT(gapAt(hit->fraction * R(k) / R(20)), -tol<S>(1e-12, 1e-5)) << n;
    }
    EXPECT_GT(hits, 20);
    EXPECT_GT(misses, 0);
}

/// Times of touch in closed form.
TYPED_TEST(Questions, KnownTouches) {
    using S = TypeParam;
    using R = typename S::Real;
    const double eps = tol<S>(1e-13, 1e-6);
    const Shape<S> ball = Sphere<S>{R(0.1)}, box = Box<S>{S::Vec::Constant(R(0.5))},
                   wall = Box<S>{vec<S>(0.0005, 1, 1)};
    const Pose<S> here;
    // 500 m/s for a 60th of a second at a wall of a millimetre: (x - 0.1 - 0.0005) / (500 / 60).
    auto r = castConvex<S>(ball, pose<S>(vec<S>(-4, 0.2)), vec<S>(500.0 / 60, 0), wall, here, R(1));
    ASSERT_TRUE(r.touches);
    EXPECT_NEAR(r.fraction, (4 - 0.1005) / (500.0 / 60), eps);
    EXPECT_LE((r.normal - vec<S>(1, 0)).norm(), 1e-6);
    // A sphere on a box's corner (in 3D edge): |x - corner| = r.
    r = castConvex<S>(ball, pose<S>(vec<S>(-2, 0.56)), vec<S>(4, 0), box, here, R(1));
    ASSERT_TRUE(r.touches);
    EXPECT_NEAR(r.fraction, (1.5 - std::sqrt(0.01 - 0.0036)) / 4, tol<S>(1e-12, 1e-5));
    EXPECT_FALSE(castConvex<S>(ball, pose<S>(vec<S>(-2, 0.61)), vec<S>(4, 0), box, here, R(1)).touches);
    // Away from it, short of it, and in it.
    EXPECT_FALSE(castConvex<S>(ball, pose<S>(vec<S>(-2, 0)), vec<S>(-4, 0), box, here, R(1)).touches);
    EXPECT_FALSE(castConvex<S>(ball, pose<S>(vec<S>(-2, 0)), vec<S>(4, 0), box, here, R(0.3)).touches);
    EXPECT_TRUE(castConvex<S>(ball, here, vec<S>(4, 0), box, here, R(1)).startsTouching);
}

TYPED_TEST(Questions, BadQuestionsAreRefused) {
    using S = TypeParam;
    using R = typename S::Real;
    const WorldQueries<S> queries(this->world);
    const auto nan = vec<S>(std::nan(""), 0);
    EXPECT_THROW(queries.castRay(vec<S>(0, 0), vec<S>(0, 0)), EngineError);
    EXPECT_THROW(queries.castRay(nan, vec<S>(1, 0)), EngineError);
    EXPECT_THROW(queries.castShape(HalfSpace<S>{vec<S>(0, 1), R(0)}, Pose<S>{}, vec<S>(1, 0)), EngineError);
    EXPECT_THROW(queries.nearest(vec<S>(0, 0), R(-1)), EngineError);
    EXPECT_THROW(queries.overlapping(shapeOfKind<S>(kKinds<S> - 1), Pose<S>{}), EngineError);
    const World<S> empty{WorldDef<S>{}};
    EXPECT_FALSE(WorldQueries<S>(empty).castRay(vec<S>(0, 0), vec<S>(1, 0)).has_value());
}

}  // namespace
}  // namespace rigor::engine::test
