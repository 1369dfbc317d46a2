// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/embedding/solid_body.hpp"

#include <gtest/gtest.h>

#include "engine/core/error.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class SolidBody : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(SolidBody, Spaces);

/// A box cut into two and put together again is the box.
TYPED_TEST(SolidBody, HasTheMassOfItsParts) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    typename S::Vec half = S::Vec::Constant(R(0.5));
    half[0] = 1;
    const BodyId whole = addSolid<S>(world, {{Box<S>{half}, R(3)}});
    half[0] = R(0.5);
    Pose<S> left, right;
    left.p = at<S>(1.5, 2);
    right.p = at<S>(2.5, 2);
    right.q = rotatedBy(right.q, spin<S>(1.5707963267948966));  // a cube looks the same
    const BodyId halves = addSolid<S>(world, {{Box<S>{half}, R(3), 0, left}, {Box<S>{half}, R(3), 0, right}});
    const auto &one = world.constants(whole), &two = world.constants(halves);
    EXPECT_NEAR(one.mass, R(6), R(1e-5)) << "2 x 1 (x 1) m of density 3";
    EXPECT_NEAR(two.mass, one.mass, R(1e-5));
    EXPECT_LT((two.centerOfMass - at<S>(2, 2)).norm(), R(1e-5));
    if constexpr (S::dim == 2)
        EXPECT_NEAR(two.inertia, one.inertia, R(1e-5));
    else
        EXPECT_LT((two.inertia - one.inertia).norm(), R(1e-5));
    EXPECT_EQ(world.shapes().size(), 3u);
}

TYPED_TEST(SolidBody, NeedsVolumeWhereItMoves) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    const Shape<S> ground = HalfSpace<S>{S::Vec::Unit(1), R(0)};
    EXPECT_THROW(addSolid<S>(world, {{ground}}), EngineError);
    EXPECT_EQ(world.bodyCount(), 0u);
    BodyDef<S> fixed;
    fixed.type = BodyType::Static;
    addSolid<S>(world, {{ground}}, fixed);
    EXPECT_EQ(world.shapes().size(), 1u);
}

}  // namespace
}  // namespace rigor::engine::test
