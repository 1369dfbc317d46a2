// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/core/error.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {
namespace {

/// Sine of the angle up to which two segments are on one line, as of triangles (3d/surfaces_3d.cpp).
template <class R>
inline constexpr R kSameLine = R(1e-4);

template <class S>
Facets facetsOf(const ChainData<S>& chain) {
    using R = typename S::Real;
    const auto along = [&](std::uint32_t piece) {
        const Segment<S> s = chain.piece(piece);
        return typename S::Vec((s.b - s.a).normalized());
    };
    const std::uint32_t last = chain.pieceCount() - 1;
    const auto neighbours = [&](std::uint32_t piece) {
        const std::uint32_t open = kNullIndex;
        return std::array<std::uint32_t, 3>{piece > 0    ? piece - 1
                                            : chain.loop ? last
                                                         : open,
                                            piece < last ? piece + 1
                                            : chain.loop ? 0
                                                         : open,
                                            open};
    };
    const auto flat = [&](std::uint32_t piece, int end) {
        const Segment<S> s = chain.piece(piece);
        const typename S::Vec out = end == 0 ? typename S::Vec(-along(piece)) : along(piece);
        const typename S::Vec d = chain.point(chain.across(piece, end)) - (end == 0 ? s.a : s.b);
        const R ahead = out.dot(d);
        return ahead > 0 && std::abs(cross(out, d)) <= kSameLine<R> * ahead;
    };
    const auto parallel = [&](std::uint32_t a, std::uint32_t b) {
        return along(a).dot(along(b)) > R(1) - R(1e-6);
    };
    return findFacets(chain.pieceCount(), neighbours, flat, parallel);
}

}  // namespace

template <class S>
Chain<S> makeChain(std::span<const typename S::Vec> vertices, bool loop) {
    using R = typename S::Real;
    if (vertices.size() < (loop ? 3u : 2u))
        throw EngineError("chain_vertices", "a chain needs two vertices, a loop three");
    R size = 0;
    for (const auto& v : vertices) {
        if (!v.allFinite()) throw EngineError("chain_vertices", "vertices must be finite");
        size = std::max(size, v.cwiseAbs().maxCoeff());
    }
    auto data = std::make_shared<ChainData<S>>();
    data->vertices.assign(vertices.begin(), vertices.end());
    data->loop = loop;
    std::vector<Aabb<S>> boxes;
    for (std::uint32_t i = 0; i < data->pieceCount(); ++i) {
        const Segment<S> s = data->piece(i);
        // 64 roundings of the coordinates: nearer points give a segment without a direction.
        if (!((s.b - s.a).norm() > R(64) * std::numeric_limits<R>::epsilon() * size))
            throw EngineError("chain_vertices",
                              "vertices " + std::to_string(i) + " and the next are the same");
        boxes.push_back({s.a.cwiseMin(s.b), s.a.cwiseMax(s.b)});
    }
    data->tree.build(boxes);
    data->facets = facetsOf<S>(*data);
    return {data};
}

template <class S>
Shape<S> pieceOf(const Shape<S>& shape, std::uint32_t piece) {
    if (const auto* chain = std::get_if<Chain<S>>(&shape)) return chain->data->piece(piece);
    return shape;
}

template Chain<Space2f> makeChain(std::span<const Space2f::Vec>, bool);
template Chain<Space2d> makeChain(std::span<const Space2d::Vec>, bool);
template Shape<Space2f> pieceOf<Space2f>(const Shape<Space2f>&, std::uint32_t);
template Shape<Space2d> pieceOf<Space2d>(const Shape<Space2d>&, std::uint32_t);

}  // namespace rigor::engine
