// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Triangle meshes and height fields: checks, neighbours, and the tree of a mesh.
#include <algorithm>
#include <map>

#include "engine/core/error.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {
namespace {

/// Height over the longest side.
template <class S>
typename S::Real thickness(const Triangle<S>& t, typename S::Real& longest) {
    longest = std::max({(t.v[1] - t.v[0]).norm(), (t.v[2] - t.v[1]).norm(), (t.v[0] - t.v[2]).norm()});
    return (t.v[1] - t.v[0]).cross(t.v[2] - t.v[0]).norm() / longest;
}

/// Sine of the angle up to which two triangles are in one plane: the normal of a triangle of 3 cm ten metres
/// from the origin is good to half of that where its vertices are single precision.
template <class R>
inline constexpr R kSamePlane = R(1e-4);

/// Facets of a mesh or field whose piece i has the pieces neighbours(i) beyond its sides.
template <class S, class Data, class Neighbours>
Facets facetsOf(const Data& data, const Neighbours& neighbours) {
    using R = typename S::Real;
    using Vec = typename S::Vec;
    const auto normal = [&](std::uint32_t piece) {
        const Triangle<S> t = data.piece(piece);
        return Vec((t.v[1] - t.v[0]).cross(t.v[2] - t.v[0]).normalized());
    };
    const auto flat = [&](std::uint32_t piece, int side) {
        const std::uint32_t w = data.across(piece, side);
        if (w == kNullIndex) return false;
        const Triangle<S> t = data.piece(piece);
        const auto k = static_cast<std::size_t>(side);
        const Vec n = normal(piece), d = data.point(w) - t.v[k];
        const Vec outward = (t.v[(k + 1) % 3] - t.v[k]).cross(n).normalized();
        const R out = outward.dot(d);
        return out > 0 && std::abs(n.dot(d)) <= kSamePlane<R> * out;
    };
    const auto parallel = [&](std::uint32_t a, std::uint32_t b) {
        return std::abs(normal(a).dot(normal(b))) > R(1) - R(1e-6);
    };
    return findFacets(data.pieceCount(), neighbours, flat, parallel);
}

/// Neighbours across edges and around vertices. An edge with more than two triangles has none.
template <class S>
void connect(MeshData<S>& mesh) {
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    struct Side {
        std::uint32_t triangle;
        std::size_t side;
    };
    std::map<Edge, std::vector<Side>> sides;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
            sides[{std::min(a, b), std::max(a, b)}].push_back({t, k});
        }
    mesh.beyond.assign(mesh.triangles.size(), {kNullIndex, kNullIndex, kNullIndex});
    std::vector<std::array<std::uint32_t, 3>> neighbours = mesh.beyond;
    std::vector<std::vector<std::uint32_t>> rings(mesh.vertices.size());
    for (const auto& [edge, both] : sides) {
        rings[edge.first].push_back(edge.second);
        rings[edge.second].push_back(edge.first);
        if (both.size() != 2) continue;
        for (std::size_t i = 0; i < 2; ++i) {
            const Side &here = both[i], &there = both[1 - i];
            mesh.beyond[here.triangle][here.side] = mesh.triangles[there.triangle][(there.side + 2) % 3];
            neighbours[here.triangle][here.side] = there.triangle;
        }
    }
    mesh.ringStart.push_back(0);
    for (const auto& ring : rings) {
        mesh.rings.insert(mesh.rings.end(), ring.begin(), ring.end());
        mesh.ringStart.push_back(static_cast<std::uint32_t>(mesh.rings.size()));
    }
    mesh.facets = facetsOf<S>(mesh, [&](std::uint32_t piece) { return neighbours[piece]; });
}

/// Pieces beyond the sides of a piece of a height field; the order of its sides is that of across().
template <class S>
std::array<std::uint32_t, 3> neighboursOf(const HeightFieldData<S>& field, std::uint32_t piece) {
    const int cell = static_cast<int>(piece / 2), i = cell % (field.columns - 1),
              k = cell / (field.columns - 1);
    const bool first = piece % 2 == 0;
    const auto other = [&](int column, int row) {
        if (column < 0 || column >= field.columns - 1 || row < 0 || row >= field.rows - 1) return kNullIndex;
        return static_cast<std::uint32_t>(2 * (row * (field.columns - 1) + column) + (first ? 1 : 0));
    };
    const int step = first ? -1 : 1;
    return {other(i + step, k), other(i, k), other(i, k + step)};
}

}  // namespace

template <class S>
TriangleMesh<S> makeTriangleMesh(std::span<const typename S::Vec> vertices,
                                 std::span<const std::array<std::uint32_t, 3>> triangles) {
    using R = typename S::Real;
    if (triangles.empty()) throw EngineError("mesh_triangles", "a mesh needs a triangle");
    for (const auto& v : vertices)
        if (!v.allFinite()) throw EngineError("mesh_vertices", "vertices must be finite");
    auto data = std::make_shared<MeshData<S>>();
    data->vertices.assign(vertices.begin(), vertices.end());
    data->triangles.assign(triangles.begin(), triangles.end());
    std::vector<Aabb<S>> boxes;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        for (const std::uint32_t v : triangles[i])
            if (v >= vertices.size())
                throw EngineError("mesh_triangles",
                                  "triangle " + std::to_string(i) + " has no vertex " + std::to_string(v));
        const Triangle<S> t = data->piece(i);
        R longest = 0, size = 0;
        for (const auto& v : t.v) size = std::max(size, v.cwiseAbs().maxCoeff());
        const R high = thickness<S>(t, longest);
        // 64 roundings of its own size and of its coordinates: thinner, and its normal is noise.
        if (!(high > R(64) * std::numeric_limits<R>::epsilon() * std::max(longest, size)))
            throw EngineError("mesh_degenerate", "triangle " + std::to_string(i) + " has no area");
        boxes.push_back({t.v[0].cwiseMin(t.v[1]).cwiseMin(t.v[2]), t.v[0].cwiseMax(t.v[1]).cwiseMax(t.v[2])});
    }
    connect(*data);
    data->tree.build(boxes);
    return {data};
}

template <class S>
HeightField<S> makeHeightField(int columns, int rows, typename S::Real dx, typename S::Real dz,
                               std::span<const typename S::Real> heights, typename S::Real thickness) {
    using R = typename S::Real;
    const auto require = [](bool ok, const std::string& message) {
        if (!ok) throw EngineError("height_field", message);
    };
    require(columns >= 2 && rows >= 2, "at least two rows and columns");
    require(heights.size() == static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
            "as many heights as rows times columns");
    require(dx > 0 && std::isfinite(dx) && dz > 0 && std::isfinite(dz), "spacings must be positive");
    require(thickness > 0 && std::isfinite(thickness), "the thickness must be positive");
    require(std::all_of(heights.begin(), heights.end(), [](R h) { return std::isfinite(h); }),
            "heights must be finite");
    auto data = std::make_shared<HeightFieldData<S>>();
    data->columns = columns;
    data->rows = rows;
    data->dx = dx;
    data->dz = dz;
    data->heights.assign(heights.begin(), heights.end());
    data->lowest = *std::min_element(heights.begin(), heights.end());
    data->highest = *std::max_element(heights.begin(), heights.end());
    data->thickness = thickness;
    data->facets = facetsOf<S>(*data, [&](std::uint32_t piece) { return neighboursOf<S>(*data, piece); });
    return {data};
}

/// The corner that the neighbouring cell or the other half of this one has beyond the side.
template <class S>
std::uint32_t HeightFieldData<S>::across(std::uint32_t piece, int side) const {
    const int cell = static_cast<int>(piece / 2), i = cell % (columns - 1), k = cell / (columns - 1);
    const bool first = piece % 2 == 0;
    // Sides of the first half: at i, the diagonal, at k; of the second: at i + 1, the diagonal, at k + 1.
    int a = first ? i + 1 : i, b = first ? k + 1 : k;
    if (side == 0) {
        a = first ? i - 1 : i + 2;
        b = first ? k + 1 : k;
    }
    if (side == 2) {
        a = first ? i + 1 : i;
        b = first ? k - 1 : k + 2;
    }
    if (a < 0 || a >= columns || b < 0 || b >= rows) return kNullIndex;
    return static_cast<std::uint32_t>(b * columns + a);
}

template <class S>
Shape<S> pieceOf(const Shape<S>& shape, std::uint32_t piece) {
    if (const auto* mesh = std::get_if<TriangleMesh<S>>(&shape)) return mesh->data->piece(piece);
    if (const auto* field = std::get_if<HeightField<S>>(&shape)) return field->data->piece(piece);
    return shape;
}

#define INSTANTIATE(S)                                                                                      \
    template TriangleMesh<S> makeTriangleMesh(std::span<const S::Vec>,                                      \
                                              std::span<const std::array<std::uint32_t, 3>>);               \
    template HeightField<S> makeHeightField(int, int, S::Real, S::Real, std::span<const S::Real>, S::Real); \
    template struct HeightFieldData<S>;                                                                     \
    template Shape<S> pieceOf<S>(const Shape<S>&, std::uint32_t);
INSTANTIATE(Space3f)
INSTANTIATE(Space3d)
#undef INSTANTIATE

}  // namespace rigor::engine
