// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/bullet/effective_mass.hpp"

#include "adapters/bullet/principal_axes.hpp"

namespace rigor::bullet {

using adapter::Mat3;
using adapter::Vec3;

CoordinateRow travelRow(const Vec3& t, const Vec3& anchor, const Vec3& centerA, const Vec3& centerB) {
    return {t, -1.0 * cross(anchor - centerA, t), cross(anchor - centerB, t)};
}
CoordinateRow turnRow(const Vec3& n) {
    return {{}, -1.0 * n, n};
}

InverseInertia::InverseInertia(const scenario::Body& body) {
    if (body.type != scenario::BodyType::Dynamic) return;
    mass = 1.0 / body.massProperties.mass;
    const PrincipalAxes principal = principalAxes(body.massProperties.inertia);
    const Mat3 axes = toMatrix(body.pose.orientation * principal.axes);
    const Vec3 m = principal.moments;
    inertia = axes * Mat3::diagonal(1.0 / m.x, 1.0 / m.y, 1.0 / m.z) * transpose(axes);
}

namespace {

CoordinateRow combined(const CoordinateRow& row, double scale, const CoordinateRow& other) {
    return {row.lin + scale * other.lin, row.angA + scale * other.angA, row.angB + scale * other.angB};
}

}  // namespace

double effectiveMass(const CoordinateRow& coordinate, const std::vector<CoordinateRow>& held,
                     const InverseInertia& a, const InverseInertia& b) {
    const auto product = [&](const CoordinateRow& p, const CoordinateRow& q) {
        return (a.mass + b.mass) * dot(p.lin, q.lin) + dot(p.angA, a.inertia * q.angA) +
               dot(p.angB, b.inertia * q.angB);
    };
    std::vector<CoordinateRow> basis;  // orthogonal in the product
    const auto reduced = [&](CoordinateRow row) {
        for (int pass = 0; pass < 2; ++pass)
            for (const CoordinateRow& known : basis)
                row = combined(row, -product(row, known) / product(known, known), known);
        return row;
    };
    for (const CoordinateRow& row : held) {
        const CoordinateRow rest = reduced(row);
        if (product(rest, rest) > 1e-12 * product(row, row)) basis.push_back(rest);
    }
    const CoordinateRow rest = reduced(coordinate);
    const double mobility = product(rest, rest);
    return mobility > 1e-12 * product(coordinate, coordinate) ? 1.0 / mobility : 0.0;
}

}  // namespace rigor::bullet
