// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The manifolds one by one, fed by hand: what the deepest point is, and how the persistent manifold grows,
// carries its points along with both bodies, measures them anew, and drops, merges and reduces them.
#include <gtest/gtest.h>

#include <set>

#include "engine/narrowphase/manifolds.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class ManifoldKinds : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(ManifoldKinds, Spaces);

/// A pair of shapes 1 m in size, normal y, and what it finds.
template <class S>
struct Pairing {
    using R = typename S::Real;
    using V = typename S::Vec;
    Pose<S> Xa, Xb;
    ManifoldCache<S> cache;
    Manifold<S> manifold;

    /// The narrow phase finds the given points: (x, z) on B, this deep.
    void find(const std::vector<std::array<double, 3>>& points, const V& normal = V::UnitY()) {
        manifold.count = 0;
        manifold.normal = normal;
        for (const auto& [x, z, separation] : points) {
            auto& p = manifold.points[manifold.count++];
            p.pointB = Xa.p + vec<S>(x, separation, z);
            p.pointA = p.pointB - static_cast<R>(separation) * normal;
            p.separation = static_cast<R>(separation);
        }
        manifoldPersistent<S>({Xa, Xb, R(1), R(0.01)}, cache, manifold);
    }
    std::set<std::uint32_t> names() const {
        std::set<std::uint32_t> all;
        for (int i = 0; i < manifold.count; ++i) all.insert(manifold.points[i].feature);
        return all;
    }
    const ManifoldPoint<S>* near(double x, double z = 0) const {
        for (int i = 0; i < manifold.count; ++i) {
            const auto& p = manifold.points[i];
            V d = p.pointB - vec<S>(x, 0, z);
            d.y() = 0;
            if (d.norm() < R(1e-3)) return &p;
        }
        return nullptr;
    }
};

TYPED_TEST(ManifoldKinds, TheDeepestIsTheDeepestWhereverItStands) {
    using S = TypeParam;
    for (int deepest = 0; deepest < 2; ++deepest) {
        Manifold<S> m;
        m.count = 2;
        for (int i = 0; i < 2; ++i) {
            m.points[i].pointA = m.points[i].pointB = S::Vec::Zero();
            m.points[i].separation = typename S::Real(i == deepest ? -0.02 : -0.01);
            m.points[i].feature = static_cast<std::uint32_t>(7 + i);
        }
        ManifoldCache<S> cache;
        const Pose<S> X;
        manifoldDeepest<S>({X, X, 1, 0}, cache, m);
        ASSERT_EQ(m.count, 1);
        EXPECT_EQ(m.points[0].feature, static_cast<std::uint32_t>(7 + deepest));
    }
}

TYPED_TEST(ManifoldKinds, ThePersistentGrowsByOneAStepUnderNamesOfTheirOwn) {
    using S = TypeParam;
    Pairing<S> pair;
    pair.find({{0.4, 0, -1e-3}, {0.1, 0, -5e-4}});
    ASSERT_EQ(pair.manifold.count, 1) << "the deepest of two";
    EXPECT_NE(pair.near(0.4), nullptr);
    const std::uint32_t first = pair.near(0.4)->feature;
    pair.find({{-0.4, 0, -1e-3}});
    ASSERT_EQ(pair.manifold.count, 2);
    EXPECT_EQ(pair.names().size(), 2u);
    ASSERT_NE(pair.near(0.4), nullptr);
    EXPECT_EQ(pair.near(0.4)->feature, first) << "a point keeps its name";
    pair.find({{0.405, 0, -1.2e-3}});
    ASSERT_EQ(pair.manifold.count, 2) << "one so near takes the place of the old one";
    ASSERT_NE(pair.near(0.405), nullptr);
    EXPECT_EQ(pair.near(0.405)->feature, first) << "and its name";
    if constexpr (S::dim == 3) {
        pair.find({{0, 0.4, -1e-3}});
        pair.find({{0, -0.4, -1e-3}});
        ASSERT_EQ(pair.manifold.count, 4);
        EXPECT_EQ(pair.names().size(), 4u);
        pair.find({{0.1, 0.1, -2e-3}});
        EXPECT_EQ(pair.manifold.count, 4);
        EXPECT_NE(pair.near(0.1, 0.1), nullptr) << "the deepest stays when one has to go";
    }
}

/// Both bodies move together by a large distance: the old point has moved with them and has the same depth.
TYPED_TEST(ManifoldKinds, ThePersistentCarriesItsPointsAlong) {
    using S = TypeParam;
    using R = typename S::Real;
    Pairing<S> pair;
    pair.Xb.p = vec<S>(0.3, 0.2, -0.1);
    pair.Xb.q = turn<S>(0.4);
    pair.find({{0.4, 0.1, -1e-3}});
    const auto old = pair.manifold.points[0];
    const Pose<S> move = pose<S>(vec<S>(2, -1, 0.5), turn<S>(0.7, 0.2));
    pair.Xa = compose<S>(move, pair.Xa);
    pair.Xb = compose<S>(move, pair.Xb);
    const typename S::Vec n = rotate(move.q, typename S::Vec(S::Vec::UnitY()));
    pair.manifold.count = 1;
    pair.manifold.normal = n;
    auto& fresh = pair.manifold.points[0];
    fresh.pointA = fresh.pointB = toWorld<S>(move, vec<S>(-0.4, 0, 0));
    fresh.separation = 0;
    manifoldPersistent<S>({pair.Xa, pair.Xb, R(1), R(0.01)}, pair.cache, pair.manifold);
    ASSERT_EQ(pair.manifold.count, 2);
    double nearest = 1;
    for (int i = 0; i < 2; ++i) {
        const auto& p = pair.manifold.points[i];
        const double away = std::max((p.pointA - toWorld<S>(move, old.pointA)).norm(),
                                     (p.pointB - toWorld<S>(move, old.pointB)).norm());
        if (away > nearest) continue;
        nearest = away;
        EXPECT_NEAR(p.separation, -1e-3, tol<S>(1e-14, 1e-6));
    }
    EXPECT_LT(nearest, tol<S>(1e-14, 2e-6));
}

/// B lifts by 2 mm, slides by 1 % or 3 % of the size, or lifts beyond the speculative distance of 1 cm.
TYPED_TEST(ManifoldKinds, ThePersistentMeasuresAnewAndDropsWhatHasSlidOrParted) {
    using S = TypeParam;
    struct Case {
        double slide, lift;
        bool stays;
    };
    for (const Case& c :
         {Case{0, 2e-3, true}, Case{0.01, 0, true}, Case{0.019, 0, true}, Case{0.021, 0, false},
          Case{0.03, 0, false}, Case{0, 0.0105, true}, Case{0, 0.0115, false}}) {
        SCOPED_TRACE(std::to_string(c.slide) + " " + std::to_string(c.lift));
        Pairing<S> pair;
        pair.find({{0.4, 0, -1e-3}});
        pair.Xb.p += vec<S>(c.slide, c.lift, 0);
        pair.find({{-0.4, 0, -1e-3}});
        ASSERT_EQ(pair.manifold.count, c.stays ? 2 : 1);
        if (!c.stays) continue;
        ASSERT_NE(pair.near(0.4 + c.slide), nullptr);
        EXPECT_NEAR(pair.near(0.4 + c.slide)->separation, -1e-3 + c.lift, tol<S>(1e-14, 1e-6));
    }
}

}  // namespace
}  // namespace rigor::engine::test
