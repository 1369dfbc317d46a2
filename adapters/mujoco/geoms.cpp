// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Axis of MuJoCo's capsules, cylinders, planes and height fields: local z, where the format has local y.
#include "adapters/mujoco/geoms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace rigor::mujoco {
namespace {

/// Turns MuJoCo's z to the format's y, and its y to the format's -z.
Quat zToY() {
    return scenario::fromAxisAngle({1.0, 0.0, 0.0}, -0.5 * std::numbers::pi);
}

/// The shortest rotation that turns z to a unit vector.
Quat zTo(const Vec3& n) {
    if (n.z < -1.0 + 1e-12) return {0.0, 1.0, 0.0, 0.0};
    return normalized(Quat{1.0 + n.z, -n.y, n.x, 0.0});
}

struct GeomWriter {
    const std::string& name;

    GeomText operator()(const scenario::Sphere& s) const {
        return {"type=\"sphere\" size=\"" + exact(s.radius) + "\"", {}, {}};
    }
    GeomText operator()(const scenario::Box& b) const {
        return {"type=\"box\" size=\"" + exact(b.halfExtents) + "\"", {}, {}};
    }
    GeomText operator()(const scenario::Ellipsoid& e) const {
        return {"type=\"ellipsoid\" size=\"" + exact(e.halfAxes) + "\"", {}, {}};
    }
    GeomText operator()(const scenario::Capsule& c) const {
        return {"type=\"capsule\" size=\"" + exact(c.radius) + " " + exact(c.halfLength) + "\"",
                {{}, zToY()},
                {}};
    }
    GeomText operator()(const scenario::Cylinder& c) const {
        return {"type=\"cylinder\" size=\"" + exact(c.radius) + " " + exact(c.halfLength) + "\"",
                {{}, zToY()},
                {}};
    }
    GeomText operator()(const scenario::HalfSpace& h) const {
        return {"type=\"plane\" size=\"0 0 1\"", {h.offset * h.normal, zTo(h.normal)}, {}};
    }
    GeomText operator()(const scenario::ConvexHull& hull) const {
        std::string vertices;
        for (const Vec3& v : hull.vertices) vertices += exact(v) + " ";
        return {"type=\"mesh\" mesh=\"" + name + "\"",
                {},
                "<mesh name=\"" + name + "\" vertex=\"" + vertices + "\"/>"};
    }
    GeomText operator()(const scenario::HeightField& f) const {
        const auto [low, high] = std::minmax_element(f.heights.begin(), f.heights.end());
        const std::string size = exact(0.5 * (f.columns - 1) * f.spacingX) + " " +
                                 exact(0.5 * (f.rows - 1) * f.spacingZ) + " " +
                                 exact(std::max(*high - *low, 1e-6)) + " " + exact(f.thickness);
        return {"type=\"hfield\" hfield=\"" + name + "\"",
                {{0.0, *low, 0.0}, zToY()},
                "<hfield name=\"" + name + "\" nrow=\"" + std::to_string(f.rows) + "\" ncol=\"" +
                    std::to_string(f.columns) + "\" size=\"" + size + "\"/>"};
    }
    GeomText operator()(const scenario::TriangleMesh&) const {
        throw adapter::notInLibrary("mujoco", "shape 'triangle_mesh'", kConvexMeshes);
    }
    template <class Other>
    GeomText operator()(const Other& other) const {
        throw adapter::notInLibrary("mujoco", std::string("shape '") + scenario::geometryName(other, 3) + "'",
                                    kGeomTypes);
    }
};

}  // namespace

GeomText geomText(const adapter::Geometry& geometry, const std::string& name) {
    return std::visit(GeomWriter{name}, geometry);
}

std::vector<float> elevations(const scenario::HeightField& field) {
    const auto [low, high] = std::minmax_element(field.heights.begin(), field.heights.end());
    const double range = std::max(*high - *low, 1e-6);
    std::vector<float> all;
    for (int row = field.rows - 1; row >= 0; --row)  // MuJoCo's y is the format's -z
        for (int column = 0; column < field.columns; ++column)
            all.push_back(static_cast<float>((field.heights[row * field.columns + column] - *low) / range));
    return all;
}

std::string exact(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}
std::string exact(const Vec3& v) {
    return exact(v.x) + " " + exact(v.y) + " " + exact(v.z);
}
std::string exact(const Quat& q) {
    return exact(q.w) + " " + exact(q.x) + " " + exact(q.y) + " " + exact(q.z);
}

}  // namespace rigor::mujoco
