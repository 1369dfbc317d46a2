// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <ode/ode.h>

#include <memory>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::ode {

/// Shape and body of a geom; ODE's user pointer of the geom points to it.
struct GeomTag {
    int body = 0, shape = 0, material = 0;
    bool back = false;  ///< true for a triangle mesh with reversed triangles
};

/// One shape as an ODE geom. Owns the geom and what ODE keeps pointers to.
class Geom {
  public:
    /// A geom without a body at `pose` (shape to world). Throws adapter::Unsupported for cones, and for
    /// segments and chains, which are meshes in adapter::planarGeometry.
    Geom(const adapter::Geometry& geometry, const adapter::Pose& pose);
    ~Geom();
    Geom(const Geom&) = delete;
    Geom& operator=(const Geom&) = delete;

    dGeomID id() const { return id_; }
    /// The back of a triangle mesh: ODE's spheres, capsules and cylinders pass through triangles from behind.
    /// Null for other shapes.
    dGeomID back() const { return back_; }
    /// True if a geom has to be tested against the backs of meshes too: boxes find triangles from both sides,
    /// and hulls find wrong normals from behind.
    static bool meetsBacks(dGeomID geom);
    /// Hands the geom to a body whose frame has the shape at `inBody`.
    void attach(dBodyID body, const adapter::Pose& inBody);
    /// ODE's frame of this geom in the frame of the shape.
    const adapter::Pose& frame() const { return frame_; }
    void setTag(const GeomTag& tag);
    static const GeomTag& tagOf(dGeomID geom);

  private:
    struct Convex {
        std::vector<dReal> planes, points;
        std::vector<unsigned> polygons;
    };
    /// ODE keeps pointers to vertices and indices; its own data goes after the geom.
    struct Mesh {
        std::vector<dReal> vertices;
        std::vector<dTriIndex> front, back;
        dTriMeshDataID data[2] = {nullptr, nullptr};
        ~Mesh();
    };
    struct Field {
        dHeightfieldDataID data = nullptr;
        ~Field();
    };
    void createConvex(const scenario::ConvexHull& hull);
    void createMesh(const scenario::TriangleMesh& mesh);
    void createField(const scenario::HeightField& field);

    dGeomID id_ = nullptr, back_ = nullptr;
    adapter::Pose frame_;
    std::unique_ptr<Convex> convex_;
    std::unique_ptr<Mesh> mesh_;
    std::unique_ptr<Field> field_;
    GeomTag tag_, backTag_;
};

}  // namespace rigor::ode
