// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Round shapes that overlap at an angle do so in a region: one point would let them turn about it and sink further in. The
// separations of its points are those of the surfaces there.
#include <gtest/gtest.h>

#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

constexpr double kTilt = 0.17;   ///< 10 degrees
constexpr double kDepth = 0.05;  ///< [m]

template <class S>
class TiltedOverlap : public testing::Test {
  protected:
    using R = typename S::Real;
    const Shape<S> cylinder = Cylinder<S>{R(0.2), R(0.3)};
    const Shape<S> capsule = Capsule<S>{R(0.2), R(0.3)};
    const Shape<S> table = Box<S>{vec<S>(2, 1, 2)};

    /// Largest distance of two points' places on A [m].
    static double extent(const Manifold<S>& m) {
        double most = 0;
        for (int i = 0; i < m.count; ++i)
            for (int k = 0; k < i; ++k)
                most = std::max(most, static_cast<double>((m.points[i].pointA - m.points[k].pointA).norm()));
        return most;
    }
};
using TiltedOverlapSpaces = testing::Types<Space3f, Space3d>;
TYPED_TEST_SUITE(TiltedOverlap, TiltedOverlapSpaces);

/// Axes that cross at 10 degrees: at the ends of their common stretch the sides are nearly as deep in each other.
TYPED_TEST(TiltedOverlap, CrossingSidesHaveTheirEndsAndTheMiddle) {
    using S = TypeParam;
    const Pose<S> A = pose<S>(vec<S>(0, 0, 0)), B = pose<S>(vec<S>(0.4 - kDepth, 0, 0), turn<S>(0, kTilt));
    const double end = 0.3 * std::cos(kTilt), beside = end * std::tan(kTilt);
    const double atEnds = 0.2 - kDepth - std::sqrt(0.04 - beside * beside);  // over the line of B
    for (const Shape<S>& shape : {this->cylinder, this->capsule}) {
        SCOPED_TRACE(shapeName<S>(shape));
        const Manifold<S> m = collide<S>(shape, A, shape, B);
        ASSERT_EQ(m.count, 3);
        EXPECT_NEAR(leastSeparation(m), -kDepth, 1e-5);
        EXPECT_NEAR(this->extent(m), 2 * end, 0.02);
        int ends = 0;
        for (int i = 0; i < m.count; ++i) ends += std::abs(m.points[i].separation - atEnds) < 1e-3;
        EXPECT_EQ(ends, 2);
    }
}

/// A cylinder that stands 10 degrees off its cap, in a table: the part of the cap that is below its top.
TYPED_TEST(TiltedOverlap, ACapHasAPolygon) {
    using S = TypeParam;
    const double lowest = 0.3 * std::cos(kTilt) + 0.2 * std::sin(kTilt);
    const Manifold<S> m = collide<S>(this->table, pose<S>(vec<S>(0, -1, 0)), this->cylinder,
                                     pose<S>(vec<S>(0.1, lowest - kDepth, 0), turn<S>(kTilt)));
    ASSERT_GE(m.count, 3);
    EXPECT_NEAR(leastSeparation(m), -kDepth, 1e-5);
    // The cap is 0.05 / sin 10 degrees across below the top of the table.
    EXPECT_GT(this->extent(m), 0.2);
    for (int i = 0; i < m.count; ++i)
        EXPECT_NEAR(static_cast<double>(m.points[i].pointB.y()), static_cast<double>(m.points[i].separation),
                    1e-5);
}

/// A side that lies 10 degrees off a face, with one end in it.
TYPED_TEST(TiltedOverlap, ASideOnAFaceHasAnInterval) {
    using S = TypeParam;
    const double quarter = std::acos(0.0);
    for (const Shape<S>& shape : {this->cylinder, this->capsule}) {
        SCOPED_TRACE(shapeName<S>(shape));
        const Pose<S> X = pose<S>(vec<S>(0, 0, 0), turn<S>(quarter + kTilt));
        const double lowest = boundingBox<S>(shape, X).min.y();
        const Manifold<S> m = collide<S>(this->table, pose<S>(vec<S>(0, -1, 0)), shape,
                                         pose<S>(vec<S>(0.1, -lowest - 0.15, 0), turn<S>(quarter + kTilt)));
        ASSERT_EQ(m.count, 2);
        EXPECT_NEAR(leastSeparation(m), -0.15, 1e-4);
        EXPECT_NEAR(this->extent(m), 0.6, 0.05);
    }
}

/// A capsule whose core crosses the edge of a box, 10 degrees off the box's top.
TYPED_TEST(TiltedOverlap, ACoreOverAnEdgeHasAnInterval) {
    using S = TypeParam;
    const double quarter = std::acos(0.0);
    const Shape<S> hull = boxHull<S>(vec<S>(0.5, 0.5, 0.5)), box = Box<S>{vec<S>(0.5, 0.5, 0.5)};
    for (const Shape<S>& other : {box, hull}) {
        SCOPED_TRACE(shapeName<S>(other));
        // The core is 0.15 m over the edge x = y = 0.5, which is nearest, and higher over the top.
        const double up = 0.15;
        const Manifold<S> m =
            collide<S>(other, pose<S>(vec<S>(0, 0, 0)), this->capsule,
                       pose<S>(vec<S>(0.5 + up * std::sin(kTilt), 0.5 + up * std::cos(kTilt), 0),
                               turn<S>(quarter - kTilt)),
                       0.01);
        EXPECT_EQ(m.count, 2);
        EXPECT_NEAR(leastSeparation(m), -kDepth, 1e-4);
    }
}

}  // namespace
}  // namespace rigor::engine::test
