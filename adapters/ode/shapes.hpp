// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <ode/ode.h>

#include <memory>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::ode {

/// Which shape of which body a geom is; what ODE's user pointer of a geom points to.
struct GeomTag {
    int body = 0, shape = 0, material = 0;
};

/// One shape as an ODE geom. Owns the geom and what ODE keeps pointers to.
class Geom {
  public:
    /// A geom without a body at `pose` (shape to world). Throws adapter::Unsupported for cones and segments.
    Geom(const adapter::Geometry& geometry, const adapter::Pose& pose);
    ~Geom();
    Geom(const Geom&) = delete;
    Geom& operator=(const Geom&) = delete;

    dGeomID id() const { return id_; }
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
    void createConvex(const scenario::ConvexHull& hull);

    dGeomID id_ = nullptr;
    adapter::Pose frame_;
    std::unique_ptr<Convex> convex_;
    GeomTag tag_;
};

}  // namespace rigor::ode
