// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The narrow phase allocates nothing: counted by replacing the global operator new of this test program.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "engine/narrowphase/tests/pair_table.hpp"

namespace {
std::atomic<long> allocations{0};
}

// Not inlined: the compiler would take malloc and delete for a mismatched pair.
[[gnu::noinline]] void* operator new(std::size_t size) {
    ++allocations;
    if (void* p = std::malloc(size ? size : 1)) return p;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept {
    std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept {
    std::free(p);
}

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
    for (int ka = 0; ka < Kind::Count; ++ka)
        for (int kb = 0; kb < Kind::Count; ++kb) {
            const Shape<S> a = shapeOfKind<S>(ka), b = shapeOfKind<S>(kb);
            for (int i = 0; i < 20; ++i) {
                const Pose<S> Xa = pose<S>(vec<S>(0, 0, 0), random.rotation());
                const Pose<S> Xb =
                    pose<S>(static_cast<R>(random.uniform(0, 1)) * random.direction(), random.rotation());
                const long before = allocations;
                touching += collide<S>(a, Xa, b, Xb, 0.01).count > 0;
                counted += allocations - before;
            }
        }
    EXPECT_EQ(counted, 0);
    EXPECT_GT(touching, 200);
    // The counter itself works.
    const long before = allocations;
    const Shape<S> hull = shapeOfKind<S>(Kind::Hull);
    EXPECT_GT(allocations, before);
}

}  // namespace
}  // namespace rigor::engine::test
