// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/model/hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace rigor::scenario {
namespace {

// Points nearer than this fraction of the extent to a plane lie on it: far above rounding (1e-16), far below
// any shape's detail.
constexpr double kCoplanar = 1e-10;

double extent(const std::vector<Vec3>& points) {
    double largest = 0.0;
    for (const Vec3& p : points) largest = std::max(largest, norm(p - points.front()));
    return largest;
}

std::vector<Vec3> withoutDuplicates(const std::vector<Vec3>& points, double tolerance) {
    std::vector<Vec3> distinct;
    for (const Vec3& p : points)
        if (std::none_of(distinct.begin(), distinct.end(),
                         [&](const Vec3& q) { return norm(p - q) <= tolerance; }))
            distinct.push_back(p);
    return distinct;
}

/// Indices of the corners of the polygon that `members` span in the plane of normal n, counter-clockwise
/// about n.
std::vector<int> orderedCorners(const std::vector<Vec3>& points, const std::vector<int>& members, Vec3 n) {
    const Vec3 helper = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 u = cross(n, helper) / norm(cross(n, helper));
    const Vec3 v = cross(n, u);
    std::vector<Vec3> flat;
    const Vec3 origin = points[members.front()];
    for (const int i : members) {
        const Vec3 d = points[i] - origin;
        flat.push_back({dot(d, u), dot(d, v), 0.0});
    }
    std::vector<int> loop;
    for (const Vec3& corner : convexHull2d(flat)) {
        const auto it = std::min_element(flat.begin(), flat.end(),
                                         [&](Vec3 a, Vec3 b) { return norm(a - corner) < norm(b - corner); });
        loop.push_back(members[it - flat.begin()]);
    }
    return loop;
}

/// The points in the plane through i, j, k when all others lie behind it; empty otherwise. `n` becomes the
/// outward normal.
std::vector<int> supportingFace(const std::vector<Vec3>& points, std::size_t i, std::size_t j, std::size_t k,
                                double size, Vec3& n) {
    n = cross(points[j] - points[i], points[k] - points[i]);
    const double area = norm(n);
    if (area <= kCoplanar * size * size) return {};
    n = n / area;
    bool above = false, below = false;
    std::vector<int> members;
    for (std::size_t m = 0; m < points.size(); ++m) {
        const double height = dot(n, points[m] - points[i]);
        if (std::abs(height) <= kCoplanar * size * 10.0)
            members.push_back(static_cast<int>(m));
        else
            (height > 0.0 ? above : below) = true;
        if (above && below) return {};
    }
    if (!above && !below) throw std::invalid_argument("the points have no volume");
    if (above) n = -n;
    return members;
}

/// Drops the points that no face uses and renumbers the loops.
HullMesh compacted(const std::vector<Vec3>& points, std::vector<std::vector<int>> faces) {
    HullMesh mesh;
    std::vector<int> number(points.size(), -1);
    for (auto& face : faces)
        for (int& index : face) {
            int& own = number[index];
            if (own < 0) {
                own = static_cast<int>(mesh.vertices.size());
                mesh.vertices.push_back(points[index]);
            }
            index = own;
        }
    mesh.faces = std::move(faces);
    return mesh;
}

}  // namespace

HullMesh convexHull3d(const std::vector<Vec3>& given) {
    if (given.size() < 4) throw std::invalid_argument("a polyhedron has at least 4 points");
    const double size = extent(given);
    const auto points = withoutDuplicates(given, kCoplanar * size);
    std::vector<std::vector<int>> faces, planes;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j)
            for (std::size_t k = j + 1; k < points.size(); ++k) {
                const auto known = [&](const std::vector<int>& plane) {
                    const auto has = [&](std::size_t p) {
                        return std::binary_search(plane.begin(), plane.end(), static_cast<int>(p));
                    };
                    return has(i) && has(j) && has(k);
                };
                if (std::any_of(planes.begin(), planes.end(), known)) continue;
                Vec3 n;
                auto members = supportingFace(points, i, j, k, size, n);
                if (members.size() < 3) continue;
                faces.push_back(orderedCorners(points, members, n));
                planes.push_back(std::move(members));
            }
    if (faces.size() < 4) throw std::invalid_argument("the points have no volume");
    return compacted(points, std::move(faces));
}

std::vector<Vec3> convexHull2d(const std::vector<Vec3>& given) {
    if (given.size() < 3) throw std::invalid_argument("a polygon has at least 3 points");
    const double size = extent(given);
    auto points = withoutDuplicates(given, kCoplanar * size);
    std::sort(points.begin(), points.end(),
              [](Vec3 a, Vec3 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    const auto turn = [](Vec3 a, Vec3 b, Vec3 c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    std::vector<Vec3> loop;
    const auto extend = [&](const Vec3& p, std::size_t keep) {
        while (loop.size() >= keep + 2 &&
               turn(loop[loop.size() - 2], loop.back(), p) <= kCoplanar * size * size)
            loop.pop_back();
        loop.push_back(p);
    };
    for (const Vec3& p : points) extend(p, 0);
    const std::size_t lower = loop.size() - 1;
    for (auto it = points.rbegin() + 1; it != points.rend(); ++it) extend(*it, lower);
    loop.pop_back();
    if (loop.size() < 3) throw std::invalid_argument("the points have no area");
    return loop;
}

}  // namespace rigor::scenario
