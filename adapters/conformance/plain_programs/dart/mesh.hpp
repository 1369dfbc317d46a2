// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A triangle mesh as DART's programs have it: a scene of assimp, which MeshShape frees.
#pragma once

#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <dart/dynamics/MeshShape.hpp>

#include "adapters/conformance/plain_programs/plain_program.hpp"

namespace rigor::plain {

inline dart::dynamics::ShapePtr meshShape(const scenario::TriangleMesh& mesh) {
    auto* scene = new aiScene;
    scene->mNumMaterials = 1;
    scene->mMaterials = new aiMaterial* [1] { new aiMaterial };
    scene->mNumMeshes = 1;
    scene->mMeshes = new aiMesh* [1] { new aiMesh };
    aiMesh& out = *scene->mMeshes[0];
    out.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    out.mNumVertices = static_cast<unsigned>(mesh.vertices.size());
    out.mVertices = new aiVector3D[mesh.vertices.size()];
    out.mNormals = new aiVector3D[mesh.vertices.size()];
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const auto real = [&](double x) { return static_cast<ai_real>(x); };
        out.mVertices[i] = {real(mesh.vertices[i].x), real(mesh.vertices[i].y), real(mesh.vertices[i].z)};
        out.mNormals[i] = {0, 1, 0};
    }
    out.mNumFaces = static_cast<unsigned>(mesh.triangles.size());
    out.mFaces = new aiFace[mesh.triangles.size()];
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        out.mFaces[i].mNumIndices = 3;
        out.mFaces[i].mIndices = new unsigned[3];
        for (int k = 0; k < 3; ++k) out.mFaces[i].mIndices[k] = static_cast<unsigned>(mesh.triangles[i][k]);
    }
    scene->mRootNode = new aiNode;
    scene->mRootNode->mNumMeshes = 1;
    scene->mRootNode->mMeshes = new unsigned[1]{0};
    return std::make_shared<dart::dynamics::MeshShape>(Eigen::Vector3d::Ones(), scene);
}

}  // namespace rigor::plain
