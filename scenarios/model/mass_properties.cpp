// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Mass properties of solids of uniform density. Per shape: mass, centre and inertia about the centre, in the
// shape frame; bodies by rotation and the parallel-axis theorem. Polyhedra and polygons are summed over
// signed tetrahedra and triangles.
#include <cmath>
#include <stdexcept>

#include "scenarios/model/hull.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::scenario {
namespace {

constexpr double kPi = 3.14159265358979323846;

Mat3 scaled(const Mat3& a, double s) {
    Mat3 r = a;
    for (auto& row : r.m)
        for (double& value : row) value *= s;
    return r;
}

/// Inertia that a point mass at d adds: m (|d|^2 1 - d d^T).
Mat3 pointInertia(double m, Vec3 d) {
    const double dd = dot(d, d);
    Mat3 r = Mat3::diagonal(m * dd, m * dd, m * dd);
    const double v[3] = {d.x, d.y, d.z};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) r(i, j) -= m * v[i] * v[j];
    return r;
}

/// Inertia from the second moments C = integral of x x^T dm about the centre: I = trace(C) 1 - C.
Mat3 inertiaFromCovariance(const Mat3& c) {
    const double trace = c(0, 0) + c(1, 1) + c(2, 2);
    Mat3 r = scaled(c, -1.0);
    for (int i = 0; i < 3; ++i) r(i, i) += trace;
    return r;
}

Mat3 outer(Vec3 a, Vec3 b) {
    const double u[3] = {a.x, a.y, a.z}, v[3] = {b.x, b.y, b.z};
    Mat3 r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) r(i, j) = u[i] * v[j];
    return r;
}

/// Sums simplices (o, corners) with o = first corner of the shape, all of unit density. For a simplex with n
/// corners besides o at offsets c_i and content V: integral of x = V sum(c_i)/(n+1), integral of x x^T = V
/// (sum c_i c_i^T + s s^T)/((n+1)(n+2)).
struct SimplexSum {
    double content = 0.0;
    Vec3 first;
    Mat3 second;
    template <std::size_t N>
    void add(const Vec3 (&corners)[N], double signedContent) {
        constexpr double n = N;
        Vec3 s;
        Mat3 c;
        for (const Vec3& corner : corners) {
            s += corner;
            c = c + outer(corner, corner);
        }
        content += signedContent;
        first += (signedContent / (n + 1.0)) * s;
        second = second + scaled(c + outer(s, s), signedContent / ((n + 1.0) * (n + 2.0)));
    }
    MassProperties finish(double density, Vec3 origin) const {
        const Vec3 center = first / content;
        const Mat3 about = second + scaled(outer(center, center), -content);
        return {density * content, origin + center, scaled(inertiaFromCovariance(about), density)};
    }
};

struct OfShape {
    double density;
    int dimension;

    MassProperties operator()(const Sphere& s) const {
        const double r2 = s.radius * s.radius;
        if (dimension == 2) {
            const double m = density * kPi * r2;
            return {m, {}, Mat3::diagonal(m * r2 / 4.0, m * r2 / 4.0, m * r2 / 2.0)};
        }
        const double m = density * 4.0 / 3.0 * kPi * r2 * s.radius, i = 0.4 * m * r2;
        return {m, {}, Mat3::diagonal(i, i, i)};
    }
    MassProperties operator()(const Box& b) const {
        const Vec3 h = dimension == 2 ? Vec3{b.halfExtents.x, b.halfExtents.y, 0.0} : b.halfExtents;
        const double m = density * 4.0 * h.x * h.y * (dimension == 2 ? 1.0 : 2.0 * h.z);
        return {m,
                {},
                Mat3::diagonal(m * (h.y * h.y + h.z * h.z) / 3.0, m * (h.x * h.x + h.z * h.z) / 3.0,
                               m * (h.x * h.x + h.y * h.y) / 3.0)};
    }
    /// Cylinder (2D: rectangle) between two half balls (half discs) whose own centres of mass lie at 3r/8
    /// (4r/3pi) from their bases.
    MassProperties operator()(const Capsule& c) const {
        const double r = c.radius, l = 2.0 * c.halfLength, r2 = r * r;
        if (dimension == 2) {
            const double mr = density * 2.0 * r * l, md = density * kPi * r2, offset = 4.0 * r / (3.0 * kPi);
            const double disc =
                md * r2 / 2.0 + md * (c.halfLength * c.halfLength + 2.0 * c.halfLength * offset);
            const double izz = mr * (l * l + 4.0 * r2) / 12.0 + disc;
            return {mr + md, {}, Mat3::diagonal(0.0, 0.0, izz)};
        }
        const double mc = density * kPi * r2 * l, ms = density * 4.0 / 3.0 * kPi * r2 * r;
        const double axial = mc * r2 / 2.0 + 2.0 * ms * r2 / 5.0;
        const double across =
            mc * (l * l / 12.0 + r2 / 4.0) + ms * (2.0 * r2 / 5.0 + l * l / 4.0 + 3.0 * l * r / 8.0);
        return {mc + ms, {}, Mat3::diagonal(across, axial, across)};
    }
    MassProperties operator()(const Cylinder& c) const {
        const double l = 2.0 * c.halfLength, r2 = c.radius * c.radius, m = density * kPi * r2 * l;
        const double across = m * (3.0 * r2 + l * l) / 12.0;
        return {m, {}, Mat3::diagonal(across, m * r2 / 2.0, across)};
    }
    MassProperties operator()(const Ellipsoid& e) const {
        const Vec3 h = e.halfAxes;
        const double m = density * 4.0 / 3.0 * kPi * h.x * h.y * h.z, k = 0.2 * m;
        return {m,
                {},
                Mat3::diagonal(k * (h.y * h.y + h.z * h.z), k * (h.z * h.z + h.x * h.x),
                               k * (h.x * h.x + h.y * h.y))};
    }
    MassProperties operator()(const Cone& c) const {
        const double h = 2.0 * c.halfLength, r2 = c.radius * c.radius, m = density * kPi * r2 * h / 3.0;
        const double across = 3.0 * m * (r2 + h * h / 4.0) / 20.0;
        return {m, {0.0, -c.halfLength + h / 4.0, 0.0}, Mat3::diagonal(across, 3.0 * m * r2 / 10.0, across)};
    }
    MassProperties operator()(const ConvexHull& hull) const {
        SimplexSum sum;
        if (dimension == 2) {
            const auto loop = convexHull2d(hull.vertices);
            const Vec3 o = loop.front();
            for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
                const Vec3 corners[2] = {loop[i] - o, loop[i + 1] - o};
                sum.add(corners, 0.5 * cross(corners[0], corners[1]).z);
            }
            return sum.finish(density, o);
        }
        const HullMesh mesh = convexHull3d(hull.vertices);
        const Vec3 o = mesh.vertices.front();
        const auto at = [&](int i) { return mesh.vertices[i] - o; };
        for (const auto& face : mesh.faces)
            for (std::size_t i = 1; i + 1 < face.size(); ++i) {
                const Vec3 corners[3] = {at(face[0]), at(face[i]), at(face[i + 1])};
                sum.add(corners, dot(corners[0], cross(corners[1], corners[2])) / 6.0);
            }
        return sum.finish(density, o);
    }
    MassProperties operator()(const HalfSpace&) const {
        throw std::invalid_argument("a half-space has no mass");
    }
    MassProperties operator()(const Segment&) const { throw std::invalid_argument("a segment has no mass"); }
    template <class Surface>
    MassProperties operator()(const Surface&) const {
        throw std::invalid_argument("chains, meshes and height fields have no mass");
    }
};

}  // namespace

MassProperties massPropertiesFromShapes(const std::vector<Shape>& shapes,
                                        const std::vector<Material>& materials, int dimension) {
    std::vector<MassProperties> parts;
    MassProperties whole;
    for (const Shape& shape : shapes) {
        const double density = materials.at(shape.material).density;
        MassProperties part = std::visit(OfShape{density, dimension}, shape.geometry);
        const Mat3 r = toMatrix(shape.pose.orientation);
        part.centerOfMass = shape.pose * part.centerOfMass;
        part.inertia = r * part.inertia * transpose(r);
        whole.mass += part.mass;
        whole.centerOfMass += part.mass * part.centerOfMass;
        parts.push_back(part);
    }
    if (!(whole.mass > 0.0)) throw std::invalid_argument("the shapes have no mass");
    whole.centerOfMass = whole.centerOfMass / whole.mass;
    for (const MassProperties& part : parts)
        whole.inertia =
            whole.inertia + part.inertia + pointInertia(part.mass, part.centerOfMass - whole.centerOfMass);
    return whole;
}

MassProperties scaledToMass(MassProperties properties, double mass) {
    properties.inertia = scaled(properties.inertia, mass / properties.mass);
    properties.mass = mass;
    return properties;
}

}  // namespace rigor::scenario
