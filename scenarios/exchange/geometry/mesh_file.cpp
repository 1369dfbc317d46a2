// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/exchange/geometry/mesh_file.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>

#include "scenarios/model/surfaces.hpp"

namespace rigor::models {
namespace {

using scenario::Vec3;

constexpr std::size_t kMostTriangles = 200000;
constexpr double kTolerance = 1e-6;  ///< relative to the size: coordinates are in single precision

/// The double nearest to the shortest decimal of a single-precision number: what the file says.
double asWritten(float value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    double out = 0.0;
    std::from_chars(text, end, out);
    return out;
}

struct Collected {
    std::vector<Vec3> vertices;
    std::map<std::array<double, 3>, int> indexOf;
    std::vector<std::array<int, 3>> triangles;

    int vertex(const Vec3& v) {
        const auto [at, isNew] = indexOf.try_emplace({v.x, v.y, v.z}, static_cast<int>(vertices.size()));
        if (isNew) vertices.push_back(v);
        return at->second;
    }
};

void collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above, const Vec3& scale,
             Collected& out) {
    const aiMatrix4x4 transform = above * node.mTransformation;
    const bool isPlain = transform.IsIdentity();
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            if (face.mNumIndices != 3) continue;
            std::array<int, 3> triangle{};
            for (unsigned k = 0; k < 3; ++k) {
                aiVector3D v = mesh.mVertices[face.mIndices[k]];
                if (!isPlain) v = transform * v;
                triangle[k] = out.vertex(
                    {asWritten(v.x) * scale.x, asWritten(v.y) * scale.y, asWritten(v.z) * scale.z});
            }
            if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
                out.triangles.push_back(triangle);
        }
    }
    for (unsigned c = 0; c < node.mNumChildren; ++c)
        collect(scene, *node.mChildren[c], transform, scale, out);
}

/// Pieces that share no vertex.
std::vector<MeshPart> split(const Collected& all) {
    std::vector<int> root(all.vertices.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int v) {
        while (root[static_cast<std::size_t>(v)] != v) v = root[static_cast<std::size_t>(v)];
        return v;
    };
    for (const auto& t : all.triangles)
        for (const int v : t) root[static_cast<std::size_t>(find(v))] = find(t[0]);
    std::map<int, std::size_t> partOf;
    std::vector<MeshPart> parts;
    std::vector<int> local(all.vertices.size(), -1);
    for (const auto& t : all.triangles) {
        const auto [at, isNew] = partOf.try_emplace(find(t[0]), parts.size());
        if (isNew) parts.emplace_back();
        MeshPart& part = parts[at->second];
        std::array<int, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            int& index = local[static_cast<std::size_t>(t[k])];
            if (index < 0) {
                index = static_cast<int>(part.vertices.size());
                part.vertices.push_back(all.vertices[static_cast<std::size_t>(t[k])]);
            }
            triangle[k] = index;
        }
        part.triangles.push_back(triangle);
    }
    return parts;
}

double sizeOf(const std::vector<Vec3>& points) {
    double size = 0.0;
    for (const Vec3& p : points) size = std::max(size, norm(p - points.front()));
    return size;
}

double volumeOf(const MeshPart& part) {
    const auto at = [&](int v) { return part.vertices[static_cast<std::size_t>(v)] - part.vertices.front(); };
    double volume = 0.0;
    for (const auto& t : part.triangles) volume += dot(at(t[0]), cross(at(t[1]), at(t[2]))) / 6.0;
    return std::abs(volume);
}

void addTriangles(SceneBuilder& builder, Report& report, int body, const std::vector<MeshPart>& parts,
                  const scenario::Pose& pose, const Surface& surface, int kind, const Place& place) {
    MeshPart whole;
    for (const MeshPart& part : parts) {
        const int offset = static_cast<int>(whole.vertices.size());
        whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
        for (const auto& t : part.triangles)
            whole.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    }
    const std::size_t before = whole.triangles.size();
    std::erase_if(whole.triangles, [&](const auto& t) {
        MeshPart one;
        for (const int v : t) one.vertices.push_back(whole.vertices[static_cast<std::size_t>(v)]);
        one.triangles.push_back({0, 1, 2});
        const Vec3 a = one.vertices[1] - one.vertices[0], b = one.vertices[2] - one.vertices[0];
        const double longest = std::max({norm(a), norm(b), norm(b - a)});
        return norm(cross(a, b)) / longest <= 2e-5 * sizeOf(whole.vertices);
    });
    if (whole.triangles.size() < before)
        report.changed(
            "mesh", place,
            std::to_string(before - whole.triangles.size()) + " triangles without area are left out");
    if (const std::string problem = scenario::surfaceProblem(whole); !problem.empty())
        return report.refuse("mesh", place, problem);
    builder.addShape(body, whole, pose, surface, kind);
}

}  // namespace

std::vector<MeshPart> readMesh(const std::filesystem::path& file, const Vec3& scale, const Place& place) {
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_LINE | aiPrimitiveType_POINT);
    const aiScene* scene = importer.ReadFile(
        file.string(), aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_JoinIdenticalVertices);
    if (!scene || !scene->mRootNode)
        throw Refusal(place, "assimp can not read the mesh '" + file.filename().string() +
                                 "': " + importer.GetErrorString());
    Collected all;
    collect(*scene, *scene->mRootNode, {}, scale, all);
    const std::string name = file.filename().string();
    if (all.triangles.empty()) throw Refusal(place, "the mesh '" + name + "' has no triangles");
    if (all.triangles.size() > kMostTriangles)
        throw Refusal(place, "the mesh '" + name + "' has more than 200000 triangles");
    for (const Vec3& v : all.vertices)
        if (!isFinite(v)) throw Refusal(place, "the mesh '" + name + "' has a vertex that is not a number");
    return split(all);
}

bool isConvex(const MeshPart& part, const HullOfMesh& hull) {
    return hull.dent <= kTolerance * sizeOf(part.vertices) &&
           std::abs(volumeOf(part) - hull.volume) <= 10.0 * kTolerance * hull.volume;
}

void addMesh(SceneBuilder& builder, Report& report, int body, const std::vector<MeshPart>& parts,
             const scenario::Pose& pose, const Surface& surface, int kind, const ReadOptions& options,
             const Place& place) {
    if (builder.scene.bodies[static_cast<std::size_t>(body)].type == scenario::BodyType::Static)
        return addTriangles(builder, report, body, parts, pose, surface, kind, place);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const HullOfMesh hull = hullOf(parts[i].vertices, place);
        const std::string which =
            parts.size() > 1 ? "part " + std::to_string(i + 1) + " of the mesh" : "the mesh";
        if (!isConvex(parts[i], hull)) {
            const std::string why = which + " is open or not convex (it has " +
                                    std::to_string(100.0 * (1.0 - volumeOf(parts[i]) / hull.volume)) +
                                    " % less volume than its hull)";
            if (!options.hull) {
                report.refuse(
                    "mesh", place,
                    why + " and its body moves; --hull takes the convex hull of each connected part. " +
                        "A file whose parts are convex, as tools of convex decomposition write, " +
                        "becomes one body of their hulls");
                continue;
            }
            report.changed("mesh", place, why + ": its convex hull");
        }
        addHull(builder, report, body, hull.corners, pose, surface, kind, options.hullCorners, "mesh", which,
                place);
    }
    if (parts.size() > 1)
        report.changed("mesh", place,
                       "its " + std::to_string(parts.size()) + " connected parts are hulls of one body");
}

}  // namespace rigor::models
