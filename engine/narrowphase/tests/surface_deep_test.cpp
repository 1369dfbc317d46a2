// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes that are deep in a chain, mesh or height field, as in a pile or after a fast impact: as long as their
// middle is on its side of the surface there is a contact, and none pushes them to the other side.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/surface_contact.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

/// Ridges and gullies of 45 degrees along z (flat: all at height 0), `pitch` from ridge to gully. The gullies
/// are at odd multiples of it along x, `pitch` / 2 under the middle; all kinds of surface.
template <class S>
std::vector<Shape<S>> ridges(double pitch, bool flat = false) {
    using R = typename S::Real;
    using V = typename S::Vec;
    constexpr int kHalf = 8, kSide = 2 * kHalf + 1;
    const auto height = [&](int i) { return flat ? 0 : ((i - kHalf) % 2 == 0 ? 0.5 : -0.5) * pitch; };
    if constexpr (S::dim == 2) {
        std::vector<V> line;
        for (int i = 0; i < kSide; ++i) line.push_back(vec<S>(pitch * (i - kHalf), height(i)));
        return {makeChain<S>(line, false), makeChain<S>(std::vector<V>(line.rbegin(), line.rend()), false)};
    } else {
        std::vector<V> v;
        std::vector<R> heights;
        std::vector<std::array<std::uint32_t, 3>> up, down;
        for (int k = 0; k < kSide; ++k)
            for (int i = 0; i < kSide; ++i) {
                v.push_back(vec<S>(pitch * (i - kHalf), height(i), pitch * (k - kHalf)));
                heights.push_back(static_cast<R>(height(i)));
            }
        for (std::uint32_t k = 0; k + 1 < kSide; ++k)
            for (std::uint32_t a = kSide * k; a + 1 < kSide * (k + 1); ++a) {
                up.push_back({a, a + kSide, a + 1});
                up.push_back({a + 1, a + kSide, a + kSide + 1});
            }
        for (const auto& t : up) down.push_back({t[1], t[0], t[2]});
        return {makeTriangleMesh<S>(v, up), makeTriangleMesh<S>(v, down),
                makeHeightField<S>(kSide, kSide, R(pitch), R(pitch), heights, R(1))};
    }
}

/// The contacts that the engine finds with a surface at the origin.
template <class S>
std::vector<Manifold<S>> contactsOf(const Shape<S>& surface, const Shape<S>& convex, const Pose<S>& X,
                                    const typename S::Vec& middle) {
    const Pose<S> here;
    std::vector<std::uint32_t> names;
    addFacetNames<S>(surface, boxOnSurface<S>(here, convex, X, 0), names);
    const bool ridge = facesDiffer<S>(surface, names, middle);
    std::vector<Manifold<S>> found;
    for (const std::uint32_t name : names) {
        Manifold<S> m;
        collideFacet<S>(*makeNarrowPhase<S>("sat"), surface, name, ridge, here, convex, X, 0, m);
        if (m.count > 0) found.push_back(m);
    }
    return found;
}

template <class S>
class DeepInSurface : public testing::Test {};
using DeepSpaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(DeepInSurface, DeepSpaces);

/// Its corners are under the gully, beside both slopes, and its shortest way out is to the side.
TYPED_TEST(DeepInSurface, APlateThatStandsInAGullyIsLifted) {
    using S = TypeParam;
    using R = typename S::Real;
    typename S::Vec half = S::Vec::Constant(R(0.12));
    half[0] = R(0.02);
    for (const Shape<S>& surface : ridges<S>(0.09))
        for (const double tilt : {-0.2, 0.0, 0.25}) {
            const auto middle = vec<S>(0.09, -0.042, 0.01);
            const auto found = contactsOf<S>(surface, Box<S>{half}, pose<S>(middle, turn<S>(tilt)), middle);
            SCOPED_TRACE(std::string(shapeName<S>(surface)) + " tilt " + std::to_string(tilt));
            EXPECT_FALSE(found.empty());
            for (const auto& m : found) EXPECT_GT(static_cast<double>(m.normal.y()), 0.1);
        }
}

/// A hull has its middle nearer to one end than to the other. It is over the ground while most of its height is
/// under it.
TYPED_TEST(DeepInSurface, AHullIsOnTheSideOfItsMiddle) {
    using S = TypeParam;
    std::vector<typename S::Vec> points{vec<S>(0, -0.3)};
    for (int k = 0; k < 8; ++k) {
        const double angle = 2 * M_PI * (k + 0.3) / 8;
        points.push_back(
            vec<S>(0.06 * std::cos(angle), 0.02 + 0.04 * std::sin(2 * angle), 0.06 * std::sin(angle)));
    }
    const Shape<S> hull = makeHull<S>(points);
    const typename S::Vec center = std::get<Hull<S>>(hull).data->center;
    for (const bool flat : {true, false})
        for (const Shape<S>& surface : ridges<S>(0.15, flat)) {
            const auto middle = vec<S>(0.01, (flat ? 0 : 0.075) + 0.005, 0.02);
            const auto found = contactsOf<S>(surface, hull, pose<S>(middle - center), middle);
            SCOPED_TRACE(std::string(shapeName<S>(surface)) + (flat ? " flat" : " ridges"));
            EXPECT_FALSE(found.empty());
            for (const auto& m : found) EXPECT_GT(static_cast<double>(m.normal.y()), 0.1);
        }
}

}  // namespace
}  // namespace rigor::engine::test
