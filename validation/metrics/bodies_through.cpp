// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies that have got through a chain, a triangle mesh or a height field. The way of a body's centre of mass
// is followed from frame to frame, in the frame of the surface. Each piece that it passes changes the side;
// a body that ends on the other side has got through. One that leaves over the border has not, and one that a
// straight way between two frames takes through a ridge and out again has not either.
// A way through a side that two pieces share would count twice. So each way is followed a little beside itself, by a
// shift of 1e-9 of the surface along each axis, the same in all frames.
#include <algorithm>
#include <array>

#include "scenarios/model/surfaces.hpp"
#include "validation/metrics/mechanics.hpp"
#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

/// A segment (two corners) or a triangle.
struct Piece {
    std::array<Vec3, 3> corners;
    int count = 3;
};

struct Sheet {
    int body = 0;
    Pose local;
    ContactFilter filter;
    std::vector<Piece> pieces;
    Vec3 low, high;  ///< box around the pieces
    Vec3 shift() const {
        const Vec3 size = high - low;
        return 1e-9 * Vec3{0.318 * size.x, 0.717 * size.y, 0.564 * size.z};
    }
};

Vec3 least(const Vec3& a, const Vec3& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 greatest(const Vec3& a, const Vec3& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
bool apart(const Vec3& lowA, const Vec3& highA, const Vec3& lowB, const Vec3& highB) {
    return highA.x < lowB.x || highB.x < lowA.x || highA.y < lowB.y || highB.y < lowA.y || highA.z < lowB.z ||
           highB.z < lowA.z;
}

struct Pieces {
    std::vector<Piece> operator()(const Chain& chain) const {
        std::vector<Piece> all;
        const std::size_t n = chain.vertices.size();
        for (std::size_t i = 0; i + 1 < n + (chain.loop ? 1 : 0); ++i)
            all.push_back({{chain.vertices[i], chain.vertices[(i + 1) % n], {}}, 2});
        return all;
    }
    std::vector<Piece> operator()(const TriangleMesh& mesh) const {
        std::vector<Piece> all;
        for (const std::array<int, 3>& t : mesh.triangles)
            all.push_back({{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, 3});
        return all;
    }
    std::vector<Piece> operator()(const HeightField& field) const {
        std::vector<Piece> all;
        const std::vector<Vec3> v = surfaceVertices(field);
        for (int k = 0; k + 1 < field.rows; ++k)
            for (int a = k * field.columns; a + 1 < (k + 1) * field.columns; ++a) {
                const int b = a + field.columns;
                all.push_back({{v[a], v[b], v[a + 1]}, 3});
                all.push_back({{v[a + 1], v[b], v[b + 1]}, 3});
            }
        return all;
    }
    template <class Other>
    std::vector<Piece> operator()(const Other&) const {
        return {};
    }
};

std::vector<Sheet> sheetsOf(const Scenario& scenario) {
    std::vector<Sheet> sheets;
    for (int body = 0; body < static_cast<int>(scenario.bodies.size()); ++body)
        for (const Shape& shape : scenario.bodies[body].shapes) {
            Sheet sheet{body, shape.pose, shape.filter, std::visit(Pieces{}, shape.geometry), {}, {}};
            if (sheet.pieces.empty()) continue;
            sheet.low = sheet.high = sheet.pieces[0].corners[0];
            for (const Piece& piece : sheet.pieces)
                for (int i = 0; i < piece.count; ++i) {
                    sheet.low = least(sheet.low, piece.corners[i]);
                    sheet.high = greatest(sheet.high, piece.corners[i]);
                }
            sheets.push_back(std::move(sheet));
        }
    return sheets;
}

/// True where the way from p to q passes the piece.
bool passes(const Piece& piece, const Vec3& p, const Vec3& q) {
    const Vec3 d = q - p, a = piece.corners[0] - p, b = piece.corners[1] - p, c = piece.corners[2] - p;
    if (piece.count == 2) {
        const auto side = [](const Vec3& v, const Vec3& w) { return v.x * w.y - v.y * w.x; };
        if ((side(d, a) < 0.0) == (side(d, b) < 0.0)) return false;
        const Vec3 e = b - a;
        return (side(e, a) > 0.0) != (side(e, a) - side(e, d) > 0.0);
    }
    const bool u = dot(d, cross(a, b)) < 0.0, v = dot(d, cross(b, c)) < 0.0, w = dot(d, cross(c, a)) < 0.0;
    if (u != v || v != w) return false;
    const Vec3 n = cross(b - a, c - a);
    return (dot(n, a) > 0.0) != (dot(n, a) - dot(n, d) > 0.0);
}

int timesPassed(const Sheet& sheet, const Vec3& p, const Vec3& q) {
    const Vec3 low = least(p, q), high = greatest(p, q);
    if (apart(low, high, sheet.low, sheet.high)) return 0;
    int times = 0;
    for (const Piece& piece : sheet.pieces) {
        Vec3 from = least(piece.corners[0], piece.corners[1]),
             to = greatest(piece.corners[0], piece.corners[1]);
        if (piece.count == 3) {
            from = least(from, piece.corners[2]);
            to = greatest(to, piece.corners[2]);
        }
        if (!apart(low, high, from, to) && passes(piece, p, q)) ++times;
    }
    return times;
}

/// The time at which the body changes to the side of the sheet that it ends on, or -1: it ends where it began.
double timeThrough(const MetricInput& input, const Sheet& sheet, int body) {
    const Trajectory& run = input.trajectory;
    const auto place = [&](std::size_t frame) {
        const BodyState& surface = run.state(frame, sheet.body);
        const Pose X = Pose{surface.position, surface.orientation} * sheet.local;
        const Vec3 x = centerOfMassOf(input.scenario.bodies[body], run.state(frame, body)) - X.position;
        return rotateInverse(X.orientation, x) + sheet.shift();
    };
    double since = -1.0;
    Vec3 before = place(0);
    for (std::size_t k = 1; k < run.frames(); ++k) {
        const Vec3 now = place(k);
        if (timesPassed(sheet, before, now) % 2 == 1) since = since < 0.0 ? run.times[k] : -1.0;
        before = now;
    }
    return since;
}

bool holds(const Sheet& sheet, const Body& body) {
    return std::all_of(body.shapes.begin(), body.shapes.end(),
                       [&](const Shape& shape) { return mayTouch(sheet.filter, shape.filter); });
}

}  // namespace

std::vector<MetricValue> bodiesThrough(const MetricInput& input) {
    const std::vector<Sheet> sheets = sheetsOf(input.scenario);
    if (sheets.empty() || input.trajectory.frames() < 2) return {};
    double count = 0.0, first = -1.0;
    for (int body = 0; body < static_cast<int>(input.scenario.bodies.size()); ++body) {
        if (!isDynamic(input.scenario, body)) continue;
        double since = -1.0;
        for (const Sheet& sheet : sheets)
            if (mayCollide(input.scenario, sheet.body, body) && holds(sheet, input.scenario.bodies[body]))
                since = std::max(since, timeThrough(input, sheet, body));
        if (since < 0.0) continue;
        count += 1.0;
        first = first < 0.0 ? since : std::min(first, since);
    }
    return {{"", count, first}};
}

}  // namespace rigor::validation
