// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/core/error.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {

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
