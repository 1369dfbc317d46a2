// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every narrow phase of the table, both dimensions, both precisions: the contract of a manifold, and the same
// result as the closest points. "mpr" promises the verdict and a way out, but not always the shortest one.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "engine/core/error.hpp"
#include "engine/core/tests/counting_new.hpp"
#include "engine/narrowphase/distance.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class NarrowPhases : public testing::Test {
  protected:
    /// `visit(a, Xa, b, Xb)` for every pair of kinds in `perPair` random poses.
    template <class Visit>
    static void forEachPair(int perPair, Visit visit) {
        for (int ka = 0; ka < kKinds<S>; ++ka)
            for (int kb = 0; kb < kKinds<S>; ++kb) {
                const Shape<S> a = shapeOfKind<S>(ka), b = shapeOfKind<S>(kb);
                if (!isConvexPair<S>(a, b)) continue;
                SCOPED_TRACE(std::string(shapeName<S>(a)) + " and " + shapeName<S>(b));
                Random<S> random{std::mt19937(static_cast<unsigned>(10 * ka + kb))};
                for (int i = 0; i < perPair; ++i) {
                    const auto far = static_cast<typename S::Real>(random.uniform(0, 1.3));
                    const typename S::Vec p = vec<S>(0.5, -0.2, 0.3);
                    visit(a, pose<S>(p, random.rotation()), b,
                          pose<S>(p + far * random.direction(), random.rotation()));
                }
            }
    }
    /// Distance of a point from a shape.
    static double outside(const typename S::Vec& x, const Shape<S>& s, const Pose<S>& X) {
        const Shape<S> dot = Sphere<S>{typename S::Real(0)};
        return static_cast<double>(closestPoints<S>(dot, pose<S>(x), s, X).distance);
    }
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(NarrowPhases, Spaces);

TYPED_TEST(NarrowPhases, AgreeWithTheClosestPoints) {
    using S = TypeParam;
    // mpr's curved portals end within rounding of the surface, their points and normals at its square root.
    const double sharp = tol<S>(2e-14, 8e-6), root = tol<S>(2e-7, 5e-3);
    for (const NarrowPhaseEntry& entry : narrowPhases()) {
        SCOPED_TRACE(entry.name);
        const bool exact = std::string(entry.name) != "mpr";
        const auto function = findNarrowPhase<S>(entry.name);
        int compared = 0, tooDeep = 0;
        this->forEachPair(30, [&](const auto& a, const auto& Xa, const auto& b, const auto& Xb) {
            const double eps = std::max(sharp, curvedTolerance<S>(a, b));
            const ClosestPoints<S> truth = closestPoints<S>(a, Xa, b, Xb);
            const auto d = static_cast<double>(truth.distance);
            Manifold<S> m;
            function(a, Xa, b, Xb, 0, m);
            if (std::abs(d) > eps) {
                ASSERT_EQ(m.count > 0, d < 0) << d;
            }
            if (m.count == 0) return;
            ++compared;
            ASSERT_NEAR(static_cast<double>(m.normal.norm()), 1, tol<S>(1e-14, 1e-6));
            std::set<std::uint32_t> names;
            for (int i = 0; i < m.count; ++i) {
                const auto& p = m.points[i];
                names.insert(p.feature);
                const typename S::Vec gap = p.pointB - p.pointA;
                EXPECT_LE(static_cast<double>((gap - p.separation * m.normal).norm()), eps);
                EXPECT_LE(this->outside(p.pointA, a, Xa), exact ? eps : std::max(root, 5 * eps));
                EXPECT_LE(this->outside(p.pointB, b, Xb), exact ? eps : std::max(root, 5 * eps));
            }
            EXPECT_EQ(names.size(), static_cast<std::size_t>(m.count));
            const double found = leastSeparation(m);
            if (a.index() != Kind::HalfSpace && b.index() != Kind::HalfSpace) {
                EXPECT_NEAR(separationAlong<S>(a, Xa, b, Xb, m.normal), found, eps);
            }
            EXPECT_LE(found, d + eps);
            if (exact)
                EXPECT_GE(found, d - eps);
            else
                tooDeep += found < d - std::max(eps, 1e-6);
        });
        EXPECT_GT(compared, 300);
        EXPECT_LE(tooDeep, compared / 50);
    }
}

/// A resting box has four points (two in 2D) on the box below, whichever algorithm finds the normal.
TYPED_TEST(NarrowPhases, FaceOnFaceHasAFullManifold) {
    using S = TypeParam;
    const Shape<S> box = Box<S>{vec<S>(0.5, 0.5, 0.5)}, hull = boxHull<S>(vec<S>(0.5, 0.5, 0.5));
    for (const NarrowPhaseEntry& entry : narrowPhases())
        for (const Shape<S>& a : {box, hull})
            for (const Shape<S>& b : {box, hull})
                for (const double gap : {-0.01, 0.005})
                    for (const double angle : {0.0, 1e-5}) {
                        SCOPED_TRACE(entry.name);
                        Manifold<S> m;
                        findNarrowPhase<S>(entry.name)(
                            a, pose<S>(vec<S>(0, 0, 0)), b,
                            pose<S>(vec<S>(0.2, 1 + gap, 0.1), turn<S>(angle, angle)), typename S::Real(0.01),
                            m);
                        EXPECT_EQ(m.count, S::dim == 2 ? 2 : 4);
                        EXPECT_NEAR(static_cast<double>(m.normal.y()), 1, 1e-6);
                        EXPECT_NEAR(leastSeparation(m), gap, 2e-5);
                    }
}

TYPED_TEST(NarrowPhases, LyingCapsuleHasTwoPoints) {
    using S = TypeParam;
    const Shape<S> box = Box<S>{vec<S>(0.5, 0.5, 0.5)},
                   capsule = Capsule<S>{typename S::Real(0.25), typename S::Real(0.5)};
    const double kQuarter = std::acos(0.0);
    for (const NarrowPhaseEntry& entry : narrowPhases()) {
        SCOPED_TRACE(entry.name);
        Manifold<S> m;
        findNarrowPhase<S>(entry.name)(box, pose<S>(vec<S>(0, 0, 0)), capsule,
                                       pose<S>(vec<S>(0.1, 0.745, 0), turn<S>(kQuarter)), 0, m);
        ASSERT_EQ(m.count, 2);
        EXPECT_NEAR(static_cast<double>((m.points[0].pointA - m.points[1].pointA).norm()), 0.9,
                    tol<S>(1e-6, 1e-2));
        findNarrowPhase<S>(entry.name)(capsule, pose<S>(vec<S>(0, 0, 0)), capsule,
                                       pose<S>(vec<S>(0.495, 0.3, 0)), 0, m);
        EXPECT_EQ(m.count, 2);
        EXPECT_NEAR(leastSeparation(m), -0.005, tol<S>(1e-14, 1e-6));
    }
}

TYPED_TEST(NarrowPhases, AllocateNothing) {
    using S = TypeParam;
    for (const NarrowPhaseEntry& entry : narrowPhases()) {
        const auto function = findNarrowPhase<S>(entry.name);
        long counted = 0;
        int touching = 0;
        this->forEachPair(5, [&](const auto& a, const auto& Xa, const auto& b, const auto& Xb) {
            Manifold<S> m;
            const long before = allocationCount();
            function(a, Xa, b, Xb, typename S::Real(0.01), m);
            counted += allocationCount() - before;
            touching += m.count > 0;
        });
        EXPECT_EQ(counted, 0) << entry.name;
        EXPECT_GT(touching, 50) << entry.name;
    }
}

TEST(NarrowPhaseTable, UnknownNamesAreRefusedWithTheKnownOnes) {
    EXPECT_NE(makeNarrowPhase<Space3d>("gjk_epa"), nullptr);
    try {
        makeNarrowPhase<Space3d>("magic");
        FAIL();
    } catch (const EngineError& error) {
        EXPECT_EQ(error.id(), "unknown_algorithm");
        EXPECT_NE(std::string(error.what()).find("mpr"), std::string::npos);
    }
}

}  // namespace
}  // namespace rigor::engine::test
