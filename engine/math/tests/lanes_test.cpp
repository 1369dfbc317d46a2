// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// SIMD arithmetic against the same arithmetic on one thing at a time, for every instruction set of this machine
// (hwy/foreach_target.h includes this file again). The bits must be the same: results do not depend on the machine.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/math/tests/lanes_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "engine/math/lanes-inl.hpp"
#include "engine/math/tests/lanes_case.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

/// All functions of lanes-inl.hpp on eight things, as many at a time as a register has lanes.
template <class S>
void computeLanes(const LanesInput<S>& in, LanesOutput<S>& out) {
    for (std::size_t first = 0; first < kLanes; first += hn::MaxLanes(Tag<S>())) {
        const At<S> at{first};
        const auto a = at(in.a), b = at(in.b);
        const auto w = at(in.w), u = at(in.u);
        const auto x = at(in.x);
        at.set(out.dot, dot(a, b));
        at.set(out.minus, minus(a, b));
        auto sum = a;
        add(sum, x, b);
        at.set(out.add, sum);
        auto difference = a;
        subtract(difference, x, b);
        at.set(out.subtract, difference);
        at.set(out.moment, moment(a, b));
        at.set(out.turning, turning(w, a));
        at.set(out.times, times(at(in.matrix), u));
        at.set(out.inverse, inverseOrZero(x));
    }
}

/// Groups of four numbers from entries in any order, and back into others.
template <class R>
void moveGroups(const R* from, const std::size_t* index, const bool* stored, R* to) {
    const LanesTag<R> d;
    for (std::size_t first = 0; first < kLanes; first += hn::MaxLanes(d)) {
        const auto q = gatherQuads(d, [&](std::size_t lane) { return from + 4 * index[first + lane]; });
        scatterQuads(d, q, [&](std::size_t lane) {
            return stored[first + lane] ? to + 4 * (first + lane) : static_cast<R*>(nullptr);
        });
    }
}

#define RIGOR_LANES(S)                                              \
    void compute##S(const LanesInput<S>& in, LanesOutput<S>& out) { \
        computeLanes<S>(in, out);                                   \
    }
RIGOR_FOR_ALL_SPACES(RIGOR_LANES)
#undef RIGOR_LANES
void moveFloats(const float* from, const std::size_t* index, const bool* stored, float* to) {
    moveGroups(from, index, stored, to);
}
void moveDoubles(const double* from, const std::size_t* index, const bool* stored, double* to) {
    moveGroups(from, index, stored, to);
}

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "engine/math/tests/random_values.hpp"

namespace rigor::engine {

HWY_EXPORT(moveFloats);
HWY_EXPORT(moveDoubles);
#define RIGOR_LANES(S)                                                \
    HWY_EXPORT(compute##S);                                           \
    void computeSpace(const LanesInput<S>& in, LanesOutput<S>& out) { \
        HWY_DYNAMIC_DISPATCH(compute##S)(in, out);                    \
    }
RIGOR_FOR_ALL_SPACES(RIGOR_LANES)
#undef RIGOR_LANES

namespace {

/// Runs `test` with each instruction set that this machine has.
template <class Test>
void forEachInstructionSet(const Test& test) {
    int tried = 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        SCOPED_TRACE(hwy::TargetName(target));
        test();
        ++tried;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GT(tried, 0);
}

template <class S>
class LanesOf : public testing::Test, public RandomValues<S> {
  public:
    LanesInput<S> input() {
        LanesInput<S> in;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            for (auto& number : in.a) number[lane] = this->uniform(3);
            for (auto& number : in.b) number[lane] = this->uniform(3);
            for (auto& number : in.w) number[lane] = this->uniform(3);
            for (auto& number : in.u) number[lane] = this->uniform(3);
            for (auto& number : in.matrix) number[lane] = this->uniform(3);
            in.x[lane] = this->uniform(3);
        }
        return in;
    }
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(LanesOf, Spaces);

TYPED_TEST(LanesOf, HaveTheBitsOfScalars) {
    using S = TypeParam;
    forEachInstructionSet([&] {
        for (int trial = 0; trial < 200; ++trial) {
            const LanesInput<S> in = this->input();
            LanesOutput<S> out, expected;
            computeSpace(in, out);
            for (std::size_t lane = 0; lane < kLanes; ++lane) computeScalar<S>(in, lane, expected);
            ASSERT_EQ(std::memcmp(&out, &expected, sizeof out), 0) << "trial " << trial;
        }
    });
}

/// 1 / x is finite or 0, whatever x is: 0 stands for "nothing can move along this row".
TYPED_TEST(LanesOf, InvertNothingThatIsZeroOrNextToIt) {
    using S = TypeParam;
    using R = typename S::Real;
    constexpr R tiny = std::numeric_limits<R>::min(), huge = std::numeric_limits<R>::max();
    const R values[kLanes] = {0, -0.0, tiny, 4 * tiny, 8 * tiny, 1, huge, -1};
    forEachInstructionSet([&] {
        LanesInput<S> in = this->input();
        LanesOutput<S> out;
        std::copy(std::begin(values), std::end(values), std::begin(in.x));
        computeSpace(in, out);
        for (const std::size_t lane : {0, 1, 2, 3, 7}) EXPECT_EQ(out.inverse[lane], 0) << values[lane];
        for (const std::size_t lane : {4, 5, 6})
            EXPECT_EQ(out.inverse[lane], 1 / values[lane]) << values[lane];
    });
}

template <class R, class Move>
void expectGroupsArrive(const Move& move) {
    std::vector<R> from(4 * 20), to(4 * kLanes);
    for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<R>(i);
    const std::size_t index[kLanes] = {7, 0, 19, 3, 3, 12, 1, 18};
    for (unsigned mask = 0; mask < 256; ++mask) {
        bool stored[kLanes];
        for (std::size_t lane = 0; lane < kLanes; ++lane) stored[lane] = mask >> lane & 1;
        std::fill(to.begin(), to.end(), R(-1));
        move(from.data(), index, stored, to.data());
        for (std::size_t i = 0; i < to.size(); ++i)
            ASSERT_EQ(to[i], stored[i / 4] ? static_cast<R>(4 * index[i / 4] + i % 4) : R(-1))
                << "number " << i % 4 << " of lane " << i / 4 << ", mask " << mask;
    }
}

TEST(GatheredGroups, AreStoredWhereTheyBelongAndNowhereElse) {
    forEachInstructionSet([] {
        expectGroupsArrive<float>([](auto... of) { HWY_DYNAMIC_DISPATCH(moveFloats)(of...); });
        expectGroupsArrive<double>([](auto... of) { HWY_DYNAMIC_DISPATCH(moveDoubles)(of...); });
    });
}

}  // namespace
}  // namespace rigor::engine
#endif
