// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Data of chains, triangle meshes and height fields: pieces (segments, triangles) numbered from 0, their
// vertices, their neighbours, and a way to find the pieces near a box or a ray. Immutable.
//
// All three have the same members, so that code is written once over them:
//   pieceCount(); corners(piece): vertex numbers; point(vertex); piece(i): the Segment or Triangle;
//   across(piece, side): the vertex beyond side `side` (from corner `side` to the next) of the piece,
//     kNullIndex at an open border; in 2D side 0, 1 is the end at corner 0, 1 and the result the vertex
//     beyond it;
//   ring(vertex, visit): the vertices that share an edge with it (2D: the chain's next ones);
//   query(box, visit), ray(o, d, limit, visit): pieces near; frame of the shape;
//   facets: which pieces lie in one plane.
#pragma once

#include <span>

#include "engine/core/ids.hpp"
#include "engine/shapes/facets.hpp"
#include "engine/shapes/shape.hpp"
#include "engine/shapes/static_tree.hpp"

namespace rigor::engine {
/// Throws EngineError "chain_vertices" for fewer than 2 points (loop: 3), points that are not finite, and
/// neighbours closer than rounding. Piece i runs from vertex i to the next.
template <class S>
Chain<S> makeChain(std::span<const typename S::Vec> vertices, bool loop);

/// Open meshes are fine; an edge of more than two triangles counts as open. Throws EngineError
/// "mesh_vertices" (not finite), "mesh_triangles" (none, or unknown vertices) and "mesh_degenerate" (a
/// triangle whose height over its longest side is below the rounding of its size).
template <class S>
TriangleMesh<S> makeTriangleMesh(std::span<const typename S::Vec> vertices,
                                 std::span<const std::array<std::uint32_t, 3>> triangles);

/// Vertex (i, k), i < columns along x, k < rows along z, is at (i dx, heights[k columns + i], k dz) less half
/// the extent in x and z. Each cell has two triangles, split from (i + 1, k) to (i, k + 1). Solid from the
/// surface down to `thickness` [m], > 0, under its lowest point. Throws EngineError "height_field" for fewer
/// than 2 rows or columns, spacings or thickness that are not positive, and heights that are not finite.
template <class S>
HeightField<S> makeHeightField(int columns, int rows, typename S::Real dx, typename S::Real dz,
                               std::span<const typename S::Real> heights, typename S::Real thickness);

template <class S>
struct ChainData {
    using Vec = typename S::Vec;
    static constexpr bool kSolidBelow = false;
    std::vector<Vec> vertices;
    bool loop = false;
    StaticTree<S> tree;
    Facets facets;

    std::uint32_t pieceCount() const { return static_cast<std::uint32_t>(vertices.size() - (loop ? 0 : 1)); }
    std::array<std::uint32_t, 2> corners(std::uint32_t i) const { return {i, next(i)}; }
    const Vec& point(std::uint32_t v) const { return vertices[v]; }
    Segment<S> piece(std::uint32_t i) const { return {vertices[i], vertices[next(i)]}; }
    std::uint32_t across(std::uint32_t i, int end) const { return end == 0 ? previous(i) : next(next(i)); }
    template <class Visit>
    void ring(std::uint32_t v, Visit visit) const {
        if (const std::uint32_t w = previous(v); w != kNullIndex) visit(w);
        if (const std::uint32_t w = next(v); w != kNullIndex) visit(w);
    }
    template <class Visit>
    void query(const Aabb<S>& box, Visit visit) const {
        tree.query(box, visit);
    }
    template <class Visit>
    void ray(const Vec& o, const Vec& d, const typename S::Real& limit, Visit visit) const {
        tree.ray(o, d, limit, visit);
    }

  private:
    std::uint32_t next(std::uint32_t v) const {
        if (v == kNullIndex) return kNullIndex;
        return v + 1 < vertices.size() ? v + 1 : (loop ? 0 : kNullIndex);
    }
    std::uint32_t previous(std::uint32_t v) const {
        return v > 0 ? v - 1 : (loop ? static_cast<std::uint32_t>(vertices.size() - 1) : kNullIndex);
    }
};

template <class S>
struct MeshData {
    using Vec = typename S::Vec;
    static constexpr bool kSolidBelow = false;
    std::vector<Vec> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<std::uint32_t, 3>> beyond;  ///< across() of each side
    std::vector<std::uint32_t> ringStart, rings;       ///< neighbours of vertex v: rings[ringStart[v] ...]
    StaticTree<S> tree;
    Facets facets;

    std::uint32_t pieceCount() const { return static_cast<std::uint32_t>(triangles.size()); }
    const std::array<std::uint32_t, 3>& corners(std::uint32_t i) const { return triangles[i]; }
    const Vec& point(std::uint32_t v) const { return vertices[v]; }
    Triangle<S> piece(std::uint32_t i) const {
        const auto& t = triangles[i];
        return {{vertices[t[0]], vertices[t[1]], vertices[t[2]]}};
    }
    std::uint32_t across(std::uint32_t i, int side) const { return beyond[i][side]; }
    template <class Visit>
    void ring(std::uint32_t v, Visit visit) const {
        for (std::uint32_t k = ringStart[v]; k < ringStart[v + 1]; ++k) visit(rings[k]);
    }
    template <class Visit>
    void query(const Aabb<S>& box, Visit visit) const {
        tree.query(box, visit);
    }
    template <class Visit>
    void ray(const Vec& o, const Vec& d, const typename S::Real& limit, Visit visit) const {
        tree.ray(o, d, limit, visit);
    }
};

template <class S>
struct HeightFieldData {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    static constexpr bool kSolidBelow = true;
    int columns = 0, rows = 0;
    Real dx = 0, dz = 0;
    std::vector<Real> heights;
    Real lowest = 0, highest = 0, thickness = 0;
    Facets facets;

    std::uint32_t pieceCount() const { return static_cast<std::uint32_t>(2 * (columns - 1) * (rows - 1)); }
    /// Counter-clockwise seen from +y.
    std::array<std::uint32_t, 3> corners(std::uint32_t i) const {
        const std::uint32_t cell = i / 2, n = static_cast<std::uint32_t>(columns);
        const std::uint32_t v = cell / (n - 1) * n + cell % (n - 1);
        if (i % 2 == 0) return {v, v + n, v + 1};
        return {v + n + 1, v + 1, v + n};
    }
    Vec point(std::uint32_t v) const {
        const std::uint32_t n = static_cast<std::uint32_t>(columns), i = v % n, k = v / n;
        return {static_cast<Real>(i) * dx - halfX(), heights[v], static_cast<Real>(k) * dz - halfZ()};
    }
    Triangle<S> piece(std::uint32_t i) const {
        const auto t = corners(i);
        return {{point(t[0]), point(t[1]), point(t[2])}};
    }
    std::uint32_t across(std::uint32_t i, int side) const;
    template <class Visit>
    void ring(std::uint32_t v, Visit visit) const {
        const int i = static_cast<int>(v) % columns, k = static_cast<int>(v) / columns;
        // The six neighbours that the diagonals leave.
        constexpr std::array<std::array<int, 2>, 6> kStep{
            {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {1, -1}, {-1, 1}}};
        for (const auto& s : kStep)
            if (i + s[0] >= 0 && i + s[0] < columns && k + s[1] >= 0 && k + s[1] < rows)
                visit(static_cast<std::uint32_t>((k + s[1]) * columns + i + s[0]));
    }
    /// Cells under the box by their place in the grid; those whose heights the box misses are left out.
    template <class Visit>
    void query(const Aabb<S>& box, Visit visit) const {
        if (box.min.y() > highest || box.max.y() < lowest - thickness) return;
        const int i0 = cellOf(box.min.x() + halfX(), dx, columns),
                  i1 = cellOf(box.max.x() + halfX(), dx, columns);
        const int k0 = cellOf(box.min.z() + halfZ(), dz, rows), k1 = cellOf(box.max.z() + halfZ(), dz, rows);
        if (box.max.x() < -halfX() || box.min.x() > halfX() || box.max.z() < -halfZ() ||
            box.min.z() > halfZ())
            return;
        for (int k = k0; k <= k1; ++k)
            for (int i = i0; i <= i1; ++i) visitCell(i, k, box.min.y(), visit);
    }
    /// Column after column: within one the ray spans a stretch of z. A ray near the border of a cell visits
    /// the cells on both sides: rounding decides on neither.
    template <class Visit>
    void ray(const Vec& o, const Vec& d, const Real& limit, Visit visit) const {
        const Real far = limit;
        constexpr Real kRounding = Real(64) * std::numeric_limits<Real>::epsilon();
        const Real near = kRounding * (halfX() + halfZ()), low = kRounding * std::max(-lowest, highest);
        const auto clampX = [&](Real x) { return std::clamp(x, -halfX(), halfX()); };
        const Vec end = o + far * d;
        const Real ahead = d.x() < 0 ? -near : near;
        const int i0 = cellOf(clampX(o.x() - ahead) + halfX(), dx, columns);
        const int i1 = cellOf(clampX(end.x() + ahead) + halfX(), dx, columns);
        for (int i = i0;; i += i1 > i0 ? 1 : -1) {
            Real t0 = 0, t1 = far;
            if (d.x() != 0) {
                const Real a = (static_cast<Real>(i) * dx - halfX() - o.x()) / d.x();
                const Real b = (static_cast<Real>(i + 1) * dx - halfX() - o.x()) / d.x();
                const Real slack = kRounding * far + near / std::abs(d.x());
                t0 = std::max(t0, std::min(a, b) - slack);
                t1 = std::min(t1, std::max(a, b) + slack);
            }
            if (t0 <= t1 && t0 <= limit) {
                const Real za = o.z() + t0 * d.z() + halfZ(), zb = o.z() + t1 * d.z() + halfZ();
                const int k0 = cellOf(std::min(za, zb) - near, dz, rows);
                const int k1 = cellOf(std::max(za, zb) + near, dz, rows);
                for (int k = k0; k <= k1; ++k)
                    visitCell(i, k, std::min(o.y() + t0 * d.y(), o.y() + t1 * d.y()) - low, visit);
            }
            if (i == i1) break;
        }
    }
    Real halfX() const { return Real(0.5) * static_cast<Real>(columns - 1) * dx; }
    Real halfZ() const { return Real(0.5) * static_cast<Real>(rows - 1) * dz; }

  private:
    static int cellOf(Real x, Real spacing, int vertices) {
        return static_cast<int>(
            std::clamp(std::floor(x / spacing), Real(0), static_cast<Real>(vertices - 2)));
    }
    template <class Visit>
    void visitCell(int i, int k, Real from, Visit visit) const {
        const auto at = [&](int a, int b) { return heights[b * columns + a]; };
        if (std::max({at(i, k), at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)}) < from) return;
        const auto cell = static_cast<std::uint32_t>(k * (columns - 1) + i);
        visit(2 * cell);
        visit(2 * cell + 1);
    }
};

/// The data of a composite shape: calls use(data). `use` is not called for any other shape.
template <class S, class Use>
void withSurface(const Shape<S>& shape, Use use) {
    std::visit(
        [&]<class Kind>(const Kind& s) {
            if constexpr (kComposite<Kind>) use(*s.data);
        },
        shape);
}

/// The piece of a composite shape as a shape of its own; a shape that is none is its own piece.
template <class S>
Shape<S> pieceOf(const Shape<S>& shape, std::uint32_t piece);

}  // namespace rigor::engine
