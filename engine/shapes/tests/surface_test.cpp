// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Chains, triangle meshes and height fields: neighbours by definition, pieces near boxes and rays against all
// pieces one by one, refused input.
#include "engine/shapes/surface.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "engine/core/error.hpp"

namespace rigor::engine {
namespace {

template <class F>
std::string errorOf(F f) {
    try {
        f();
    } catch (const EngineError& error) {
        return error.id();
    }
    return "none";
}

template <class S>
TriangleMesh<S> waves(int n) {
    using R = typename S::Real;
    std::vector<typename S::Vec> v;
    std::vector<std::array<std::uint32_t, 3>> t;
    for (int k = 0; k <= n; ++k)
        for (int i = 0; i <= n; ++i) v.push_back({R(i), R(0.3) * R((i * k + 2 * i) % 5), R(k)});
    const auto at = [n](int i, int k) { return static_cast<std::uint32_t>(k * (n + 1) + i); };
    for (int k = 0; k < n; ++k)
        for (int i = 0; i < n; ++i) {
            t.push_back({at(i, k), at(i, k + 1), at(i + 1, k)});
            t.push_back({at(i + 1, k + 1), at(i + 1, k), at(i, k + 1)});
        }
    return makeTriangleMesh<S>(v, t);
}
/// A flat field with a rise in column and row 2, as a mesh or a height field.
template <class S>
Shape<S> withRise(bool mesh) {
    using R = typename S::Real;
    constexpr int kSide = 6;
    std::vector<R> heights(kSide * kSide, R(0));
    heights[2 * kSide + 2] = R(0.4);
    const HeightField<S> ground = makeHeightField<S>(kSide, kSide, R(0.5), R(0.5), heights, R(1));
    if (!mesh) return ground;
    std::vector<typename S::Vec> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t v = 0; v < kSide * kSide; ++v) vertices.push_back(ground.data->point(v));
    for (std::uint32_t i = 0; i < ground.data->pieceCount(); ++i)
        triangles.push_back(ground.data->corners(i));
    return makeTriangleMesh<S>(vertices, triangles);
}

template <class S>
HeightField<S> field(int columns, int rows) {
    using R = typename S::Real;
    std::vector<R> h;
    for (int k = 0; k < rows; ++k)
        for (int i = 0; i < columns; ++i) h.push_back(R(0.3) * R((i * k + 2 * i) % 5));
    return makeHeightField<S>(columns, rows, R(0.7), R(1.1), h, R(0.5));
}
template <class S>
Chain<S> zigzag(bool loop) {
    using R = typename S::Real;
    std::vector<typename S::Vec> v;
    for (int i = 0; i < 12; ++i)
        v.push_back({R(3 * std::cos(0.5 * i)), R(3 * std::sin(0.5 * i) + 0.2 * (i % 2))});
    return makeChain<S>(v, loop);
}

template <class S, class Data>
Aabb<S> boxOf(const Data& data, std::uint32_t piece) {
    const Shape<S> shape = data.piece(piece);
    return boundingBox<S>(shape, Pose<S>{});
}

template <class S, class Data>
void expectFindsAll(const Data& data, double size) {
    using R = typename S::Real;
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> u(-1, 1);
    const auto any = [&] {
        typename S::Vec v;
        for (int i = 0; i < S::dim; ++i) v[i] = static_cast<R>(size * u(generator));
        return v;
    };
    int hits = 0;
    for (int n = 0; n < 300; ++n) {
        const typename S::Vec c = any(), half = (any() * R(0.2)).cwiseAbs();
        const Aabb<S> box{c - half, c + half};
        std::set<std::uint32_t> found, byRay;
        data.query(box, [&](std::uint32_t i) { EXPECT_TRUE(found.insert(i).second) << "twice"; });
        typename S::Vec d = any();
        if (n % 3 == 0) d[n % S::dim] = 0;
        const R limit = 1;
        data.ray(c, d, limit, [&](std::uint32_t i) { EXPECT_TRUE(byRay.insert(i).second) << "twice"; });
        for (std::uint32_t i = 0; i < data.pieceCount(); ++i) {
            const Aabb<S> b = boxOf<S>(data, i);
            // A solid field reports what is above the lowest point of the box; nothing near is missed.
            if (b.overlaps(box)) {
                EXPECT_TRUE(found.count(i)) << "box " << n << " piece " << i;
            }
            if (!rayMeetsBox<S>(c, d, limit, b)) continue;
            ++hits;
            EXPECT_TRUE(byRay.count(i)) << "ray " << n << " piece " << i;
        }
        EXPECT_LT(found.size(), data.pieceCount());
    }
    EXPECT_GT(hits, 50);
}

/// Test of the definition: the vertex beyond a side belongs to the one other piece with both corners of the
/// side.
template <class S, class Data>
void expectNeighbours(const Data& data) {
    for (std::uint32_t i = 0; i < data.pieceCount(); ++i)
        for (int side = 0; side < 3; ++side) {
            const auto c = data.corners(i);
            const std::uint32_t a = c[side], b = c[(side + 1) % 3];
            std::uint32_t beyond = kNullIndex;
            for (std::uint32_t j = 0; j < data.pieceCount(); ++j) {
                const auto other = data.corners(j);
                if (j == i || !std::count(other.begin(), other.end(), a) ||
                    !std::count(other.begin(), other.end(), b))
                    continue;
                for (const std::uint32_t v : other)
                    if (v != a && v != b) beyond = v;
            }
            EXPECT_EQ(data.across(i, side), beyond) << i << " side " << side;
            bool inRing = false;
            data.ring(a, [&](std::uint32_t w) { inRing = inRing || w == b; });
            EXPECT_TRUE(inRing);
        }
}

template <class S>
class Surfaces3d : public testing::Test {};
using Surfaces3dSpaces = testing::Types<Space3f, Space3d>;
TYPED_TEST_SUITE(Surfaces3d, Surfaces3dSpaces);
template <class S>
class Surfaces2d : public testing::Test {};
using Surfaces2dSpaces = testing::Types<Space2f, Space2d>;
TYPED_TEST_SUITE(Surfaces2d, Surfaces2dSpaces);

TYPED_TEST(Surfaces3d, PiecesNearBoxesAndRays) {
    expectFindsAll<TypeParam>(*waves<TypeParam>(8).data, 8);
    expectFindsAll<TypeParam>(*field<TypeParam>(9, 7).data, 4);
}
TYPED_TEST(Surfaces3d, NeighboursAreThoseThatShareCorners) {
    expectNeighbours<TypeParam>(*waves<TypeParam>(3).data);
    expectNeighbours<TypeParam>(*field<TypeParam>(4, 5).data);
}
TYPED_TEST(Surfaces3d, TrianglesFaceUp) {
    using S = TypeParam;
    const auto f = field<S>(4, 5);
    for (std::uint32_t i = 0; i < f.data->pieceCount(); ++i) {
        const Triangle<S> t = f.data->piece(i);
        EXPECT_GT((t.v[1] - t.v[0]).cross(t.v[2] - t.v[0]).y(), 0);
    }
}
TYPED_TEST(Surfaces3d, BadInputIsRefused) {
    using S = TypeParam;
    using R = typename S::Real;
    using V = typename S::Vec;
    using T = std::array<std::uint32_t, 3>;
    const V v[] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {2, 0, 0}};
    const V bad[] = {{0, 0, 0}, {1, std::numeric_limits<R>::quiet_NaN(), 0}, {0, 0, 1}};
    const T good[] = {{0, 2, 1}}, unknown[] = {{0, 2, 4}}, flat[] = {{0, 2, 1}, {0, 1, 3}},
            same[] = {{0, 1, 1}};
    EXPECT_EQ(errorOf([&] { makeTriangleMesh<S>(v, good); }), "none");
    EXPECT_EQ(errorOf([&] { makeTriangleMesh<S>(bad, good); }), "mesh_vertices");
    EXPECT_EQ(errorOf([&] { makeTriangleMesh<S>(v, {}); }), "mesh_triangles");
    EXPECT_EQ(errorOf([&] { makeTriangleMesh<S>(v, unknown); }), "mesh_triangles");
    EXPECT_EQ(errorOf([&] { makeTriangleMesh<S>(v, flat); }), "mesh_degenerate");
    EXPECT_EQ(errorOf([&] { makeTriangleMesh<S>(v, same); }), "mesh_degenerate");
    const R h[] = {0, 0, 0, 0}, nan[] = {0, 0, std::numeric_limits<R>::quiet_NaN(), 0};
    EXPECT_EQ(errorOf([&] { makeHeightField<S>(2, 2, 1, 1, h, 1); }), "none");
    EXPECT_EQ(errorOf([&] { makeHeightField<S>(2, 2, 1, 1, nan, 1); }), "height_field");
    EXPECT_EQ(errorOf([&] { makeHeightField<S>(4, 1, 1, 1, h, 1); }), "height_field");
    EXPECT_EQ(errorOf([&] { makeHeightField<S>(2, 3, 1, 1, h, 1); }), "height_field");
    EXPECT_EQ(errorOf([&] { makeHeightField<S>(2, 2, 0, 1, h, 1); }), "height_field");
    EXPECT_THROW(massProperties<S>(waves<S>(2), 1), std::invalid_argument);
}

TYPED_TEST(Surfaces2d, PiecesNearBoxesAndRays) {
    expectFindsAll<TypeParam>(*zigzag<TypeParam>(false).data, 4);
    expectFindsAll<TypeParam>(*zigzag<TypeParam>(true).data, 4);
}
TYPED_TEST(Surfaces2d, ChainsAreOpenOrClosed) {
    const auto open = zigzag<TypeParam>(false).data, loop = zigzag<TypeParam>(true).data;
    EXPECT_EQ(open->pieceCount(), 11u);
    EXPECT_EQ(loop->pieceCount(), 12u);
    EXPECT_EQ(open->across(0, 0), kNullIndex);
    EXPECT_EQ(open->across(0, 1), 2u);
    EXPECT_EQ(open->across(10, 1), kNullIndex);
    EXPECT_EQ(loop->across(0, 0), 11u);
    EXPECT_EQ(loop->across(11, 1), 1u);
    EXPECT_EQ(loop->corners(11)[1], 0u);
}
TYPED_TEST(Surfaces2d, BadInputIsRefused) {
    using S = TypeParam;
    using V = typename S::Vec;
    const V two[] = {{0, 0}, {1, 0}}, same[] = {{0, 0}, {1, 0}, {1, 0}}, three[] = {{0, 0}, {1, 0}, {0, 1}};
    EXPECT_EQ(errorOf([&] { makeChain<S>(two, false); }), "none");
    EXPECT_EQ(errorOf([&] { makeChain<S>(three, true); }), "none");
    EXPECT_EQ(errorOf([&] { makeChain<S>(two, true); }), "chain_vertices");
    EXPECT_EQ(errorOf([&] { makeChain<S>(same, false); }), "chain_vertices");
    EXPECT_EQ(errorOf([&] { makeChain<S>(std::span<const V>(two, 1), false); }), "chain_vertices");
}

/// All level triangles around the rise are one facet, each of its slopes is one of its own; sides between two
/// pieces of a facet are inner sides.
template <class S>
void checkFacets() {
    for (const bool mesh : {false, true})
        withSurface<S>(withRise<S>(mesh), [&](const auto& data) {
            const auto rises = [&](std::uint32_t piece) {
                for (const std::uint32_t v : data.corners(piece))
                    if (data.point(v).y() > 0) return true;
                return false;
            };
            int slopes = 0;
            for (std::uint32_t piece = 0; piece < data.pieceCount(); ++piece) {
                slopes += rises(piece);
                EXPECT_EQ(data.facets.of(piece), rises(piece) ? piece : 0u) << "mesh " << mesh;
                for (int side = 0; side < 3; ++side) {
                    const std::uint32_t beyond = data.across(piece, side);
                    const bool inner = data.facets.innerSides(piece) >> side & 1u;
                    if (rises(piece) || beyond == kNullIndex)
                        EXPECT_FALSE(inner);
                    else
                        EXPECT_EQ(inner, data.point(beyond).y() == 0) << "mesh " << mesh;
                }
            }
            EXPECT_EQ(slopes, 6);
        });
}

TEST(Facets, AreThePiecesOfAPlane) {
    checkFacets<Space3f>();
    checkFacets<Space3d>();
}

/// A chain with a corner has two facets; one that folds back on itself does not go on in its line.
TEST(Facets, AreTheSegmentsOfALine) {
    using V = Space2d::Vec;
    const V corner[] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 3}};
    const Chain<Space2d> chain = makeChain<Space2d>(corner, false);
    const auto& data = *chain.data;
    const std::uint32_t first[] = {0, 0, 2, 2};
    const unsigned inner[] = {2, 1, 2, 1};
    for (std::uint32_t i = 0; i < 4; ++i) {
        EXPECT_EQ(data.facets.of(i), first[i]);
        EXPECT_EQ(data.facets.innerSides(i), inner[i]);
    }
    const V folded[] = {{0, 0}, {2, 0}, {1, 0}};
    EXPECT_EQ(makeChain<Space2d>(folded, false).data->facets.of(1), 1u);
}

}  // namespace
}  // namespace rigor::engine
