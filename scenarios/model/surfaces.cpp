// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/model/surfaces.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::scenario {
namespace {

bool allFinite(const std::vector<Vec3>& points) {
    return std::all_of(points.begin(), points.end(),
                       [](const Vec3& v) { return std::isfinite(v.x + v.y + v.z); });
}
double sizeOf(const std::vector<Vec3>& points) {
    double size = 0.0;
    for (const Vec3& p : points) size = std::max(size, norm(p));
    return size;
}
/// Relative to the size of the shape: closer is the same place. Coordinates rounded to single precision keep
/// their shape above it.
constexpr double kSame = 1e-5;

}  // namespace

bool isStaticOnly(const Geometry& geometry) {
    return std::holds_alternative<HalfSpace>(geometry) || std::holds_alternative<Segment>(geometry) ||
           std::holds_alternative<Chain>(geometry) || std::holds_alternative<TriangleMesh>(geometry) ||
           std::holds_alternative<HeightField>(geometry);
}

std::string surfaceProblem(const Chain& chain) {
    const std::size_t n = chain.vertices.size();
    if (n < (chain.loop ? 3u : 2u))
        return chain.loop ? "a loop needs three vertices" : "a chain needs two vertices";
    if (!allFinite(chain.vertices)) return "a vertex is not finite";
    const double least = kSame * sizeOf(chain.vertices);
    for (std::size_t i = 0; i + (chain.loop ? 0 : 1) < n; ++i)
        if (!(norm(chain.vertices[(i + 1) % n] - chain.vertices[i]) > least))
            return "vertices " + std::to_string(i) + " and " + std::to_string((i + 1) % n) +
                   " are at one place";
    return {};
}

std::string surfaceProblem(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) return "a mesh needs a triangle";
    if (!allFinite(mesh.vertices)) return "a vertex is not finite";
    const double least = kSame * sizeOf(mesh.vertices);
    const int n = static_cast<int>(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (const int v : mesh.triangles[i])
            if (v < 0 || v >= n)
                return "triangle " + std::to_string(i) + " has no vertex " + std::to_string(v);
        const auto at = [&](std::size_t k) { return mesh.vertices[mesh.triangles[i][k]]; };
        const Vec3 a = at(1) - at(0), b = at(2) - at(0);
        const double longest = std::max({norm(a), norm(b), norm(b - a)});
        if (!(longest > 0.0) || !(norm(cross(a, b)) / longest > least))
            return "triangle " + std::to_string(i) + " has no area";
    }
    return {};
}

std::string surfaceProblem(const HeightField& field) {
    if (field.columns < 2 || field.rows < 2) return "a height field needs two rows and two columns";
    if (field.heights.size() !=
        static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows))
        return std::to_string(field.heights.size()) + " heights for " + std::to_string(field.rows) +
               " rows of " + std::to_string(field.columns);
    if (!(field.spacingX > 0.0) || !(field.spacingZ > 0.0) || !std::isfinite(field.spacingX * field.spacingZ))
        return "the spacing must be positive";
    if (!(field.thickness > 0.0) || !std::isfinite(field.thickness)) return "the thickness must be positive";
    if (!std::all_of(field.heights.begin(), field.heights.end(), [](double h) { return std::isfinite(h); }))
        return "a height is not finite";
    return {};
}

std::vector<Vec3> surfaceVertices(const Chain& chain) {
    return chain.vertices;
}
std::vector<Vec3> surfaceVertices(const TriangleMesh& mesh) {
    return mesh.vertices;
}
std::vector<Vec3> surfaceVertices(const HeightField& field) {
    std::vector<Vec3> vertices;
    for (int k = 0; k < field.rows; ++k)
        for (int i = 0; i < field.columns; ++i)
            vertices.push_back({(i - 0.5 * (field.columns - 1)) * field.spacingX,
                                field.heights[k * field.columns + i],
                                (k - 0.5 * (field.rows - 1)) * field.spacingZ});
    return vertices;
}

}  // namespace rigor::scenario
