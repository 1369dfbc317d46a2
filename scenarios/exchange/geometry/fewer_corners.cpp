// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Hulls of fewer corners. The distance of a point from the hull of the chosen corners only falls while corners are
// added, so that old distances are upper bounds: only the point with the largest bound is measured again.
#include <algorithm>
#include <queue>

#include "scenarios/exchange/common/text.hpp"
#include "scenarios/exchange/geometry/hull.hpp"

namespace rigor::models {
namespace {

using scenario::Vec3;

constexpr std::size_t kMostHullVertices = 64;

/// Distance of a point from a segment [m].
double distanceToEdge(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double length2 = dot(along, along);
    const double t = length2 > 0.0 ? std::clamp(dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
    return norm(p - (a + t * along));
}

/// Distance of a point from a triangle [m]: from its plane where the point is above its inside, else from an edge.
double distanceToTriangle(const Vec3& p, const Triangle& t) {
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
    const double size = norm(normal);
    bool isAbove = size > 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 edge = t[(k + 1) % 3] - t[k];
        isAbove = isAbove && dot(cross(edge, p - t[k]), normal) >= 0.0;
    }
    if (isAbove) return std::abs(dot(p - t[0], normal)) / size;
    return std::min(
        {distanceToEdge(p, t[0], t[1]), distanceToEdge(p, t[1], t[2]), distanceToEdge(p, t[2], t[0])});
}

double distanceToSurface(const Vec3& p, const std::vector<Triangle>& surface) {
    double nearest = 1e300;
    for (const Triangle& t : surface) nearest = std::min(nearest, distanceToTriangle(p, t));
    return nearest;
}

/// Index of the corner of the largest value.
template <class Value>
std::size_t farthestBy(const std::vector<Vec3>& corners, Value value) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < corners.size(); ++i)
        if (value(corners[i]) > value(corners[best])) best = i;
    return best;
}

/// Four corners of a tetrahedron: the lowest along x, the farthest from it, from their line, and from their plane.
std::vector<std::size_t> firstFour(const std::vector<Vec3>& corners) {
    const std::size_t a = farthestBy(corners, [](const Vec3& p) { return -p.x; });
    const Vec3 atA = corners[a];
    const std::size_t b = farthestBy(corners, [&](const Vec3& p) { return norm(p - atA); });
    const Vec3 line = corners[b] - atA;
    const std::size_t c = farthestBy(corners, [&](const Vec3& p) { return norm(cross(p - atA, line)); });
    const Vec3 normal = cross(line, corners[c] - atA);
    const std::size_t d = farthestBy(corners, [&](const Vec3& p) { return std::abs(dot(p - atA, normal)); });
    return {a, b, c, d};
}

}  // namespace

FewerCorners fewerCorners(const std::vector<Vec3>& corners, std::size_t count, const Place& place) {
    if (corners.size() <= count) return {corners, 0.0};
    FewerCorners out;
    std::vector<bool> isTaken(corners.size(), false);
    const auto take = [&](std::size_t i) {
        isTaken[i] = true;
        out.corners.push_back(corners[i]);
    };
    for (const std::size_t i : firstFour(corners)) take(i);
    std::vector<Triangle> surface = hullTriangles(out.corners, place);
    std::priority_queue<std::pair<double, std::size_t>> bounds;
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (!isTaken[i]) bounds.emplace(1e300, i);
    while (true) {
        const std::size_t next = bounds.top().second;
        bounds.pop();
        const double distance = distanceToSurface(corners[next], surface);
        if (!bounds.empty() && distance < bounds.top().first) {
            bounds.emplace(distance, next);
            continue;
        }
        if (out.corners.size() == count) {
            out.farthest = distance;
            return out;
        }
        take(next);
        surface = hullTriangles(out.corners, place);
    }
}

void addHull(SceneBuilder& builder, Report& report, int body, const std::vector<Vec3>& corners,
             const scenario::Pose& pose, const Surface& surface, int kind, int mostCorners,
             const std::string& element, const std::string& which, const Place& place) {
    const std::string count = std::to_string(corners.size());
    const std::size_t most = mostCorners > 0 ? static_cast<std::size_t>(mostCorners) : kMostHullVertices;
    if (corners.size() <= most)
        return builder.addShape(body, scenario::ConvexHull{corners}, pose, surface, kind);
    if (mostCorners <= 0)
        return report.refuse(element, place,
                             "the convex hull of " + which + " has " + count +
                                 " corners; a scenario's has up to 64: --hull-corners 64 takes 64 of them");
    const FewerCorners fewer = fewerCorners(corners, most, place);
    const double more = hullOf(corners, place).volume / hullOf(fewer.corners, place).volume - 1.0;
    report.changed(element, place,
                   std::to_string(most) + " of the " + count + " corners of the convex hull of " + which +
                       ", which stands out of theirs by at most " + digits({fewer.farthest}) + " m and has " +
                       digits({100.0 * more}) + " % more volume");
    builder.addShape(body, scenario::ConvexHull{fewer.corners}, pose, surface, kind);
}

}  // namespace rigor::models
