// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The narrow phase allocates nothing: counted by replacing the global operator new of this test program.
#include <gtest/gtest.h>

#include "engine/core/tests/counting_new.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Allocation : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Allocation, Spaces);

TYPED_TEST(Allocation, NoneInAnyPair) {
    using S = TypeParam;
    using R = typename S::Real;
    Random<S> random{std::mt19937(3)};
    long counted = 0;
    int touching = 0;
    for (int ka = 0; ka < kKinds<S>; ++ka)
        for (int kb = 0; kb < kKinds<S>; ++kb) {
            const Shape<S> a = shapeOfKind<S>(ka), b = shapeOfKind<S>(kb);
            for (int i = 0; i < 20; ++i) {
                const Pose<S> Xa = pose<S>(vec<S>(0, 0, 0), random.rotation());
                const Pose<S> Xb =
                    pose<S>(static_cast<R>(random.uniform(0, 1)) * random.direction(), random.rotation());
                const long before = allocationCount();
                touching += collide<S>(a, Xa, b, Xb, 0.01).count > 0;
                counted += allocationCount() - before;
            }
        }
    EXPECT_EQ(counted, 0);
    EXPECT_GT(touching, 200);
    // The counter itself works.
    const long before = allocationCount();
    const Shape<S> hull = shapeOfKind<S>(Kind::Hull);
    EXPECT_GT(allocationCount(), before);
}

}  // namespace
}  // namespace rigor::engine::test
