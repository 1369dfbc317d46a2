// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Convex polyhedron of a point set: quickhull, then neighbouring triangles in one plane are merged into one
// polygon each, vertices inside faces or on straight edges are dropped, and edges are paired.
#include <algorithm>
#include <map>
#include <stdexcept>

#include "engine/shapes/3d/quickhull.hpp"
#include "engine/shapes/hull.hpp"

namespace rigor::engine {
namespace {

using V = Eigen::Vector3d;
using Loop = std::vector<int>;

/// Group number of each triangle. Groups grow from the largest triangle without a group, over neighbours
/// whose vertices all lie in its plane.
std::vector<int> groupCoplanar(const std::vector<HullTriangle>& triangles, const std::vector<V>& points,
                               double tolerance) {
    std::map<std::pair<int, int>, std::size_t> owner;
    std::vector<std::size_t> bySize(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        bySize[t] = t;
        for (std::size_t i = 0; i < 3; ++i) owner[{triangles[t].v[i], triangles[t].v[(i + 1) % 3]}] = t;
    }
    std::stable_sort(bySize.begin(), bySize.end(),
                     [&](std::size_t a, std::size_t b) { return triangles[a].area > triangles[b].area; });
    std::vector<int> group(triangles.size(), -1);
    int count = 0;
    for (std::size_t seed : bySize) {
        if (group[seed] >= 0) continue;
        const HullTriangle& plane = triangles[seed];
        const auto inPlane = [&](const HullTriangle& t) {
            return t.normal.dot(plane.normal) > -0.5 && std::all_of(t.v.begin(), t.v.end(), [&](int v) {
                       return std::abs(plane.normal.dot(points[static_cast<std::size_t>(v)]) -
                                       plane.offset) <= tolerance;
                   });
        };
        std::vector<std::size_t> stack{seed};
        group[seed] = count;
        while (!stack.empty()) {
            const HullTriangle& t = triangles[stack.back()];
            stack.pop_back();
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t n = owner.at({t.v[(i + 1) % 3], t.v[i]});
                if (group[n] >= 0 || !inPlane(triangles[n])) continue;
                group[n] = count;
                stack.push_back(n);
            }
        }
        ++count;
    }
    return group;
}

/// Boundary of each group as one counter-clockwise loop.
std::vector<Loop> boundaryLoops(const std::vector<HullTriangle>& triangles, const std::vector<int>& group) {
    std::map<std::pair<int, int>, int> owner;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            owner[{triangles[t].v[i], triangles[t].v[(i + 1) % 3]}] = group[t];
    std::map<int, std::map<int, int>> next;  // group -> from -> to
    for (const auto& [edge, g] : owner)
        if (owner.at({edge.second, edge.first}) != g) next[g][edge.first] = edge.second;
    std::vector<Loop> loops;
    for (const auto& [g, links] : next) {
        Loop loop{links.begin()->first};
        for (int v = links.at(loop.back()); v != loop.front() && loop.size() <= links.size(); v = links.at(v))
            loop.push_back(v);
        if (loop.size() != links.size()) throw std::invalid_argument("hull: the points are degenerate");
        loops.push_back(std::move(loop));
    }
    return loops;
}

/// Vertices on straight edges belong to two faces only: dropped from all loops.
void dropStraightVertices(std::vector<Loop>& loops) {
    std::map<int, int> degree;
    for (const Loop& loop : loops)
        for (int v : loop) ++degree[v];
    for (Loop& loop : loops) std::erase_if(loop, [&](int v) { return degree[v] < 3; });
    std::erase_if(loops, [](const Loop& loop) { return loop.size() < 3; });
}

template <class R>
HullData<Space<R, 3>> assemble(const std::vector<Loop>& loops, const std::vector<V>& points) {
    HullData<Space<R, 3>> data;
    std::map<int, int> index;
    for (const Loop& loop : loops)
        for (int v : loop) index.try_emplace(v, 0);
    V center = V::Zero();
    for (auto& [v, i] : index) {
        i = static_cast<int>(data.vertices.size());
        data.vertices.push_back(points[static_cast<std::size_t>(v)].cast<R>());
        center += points[static_cast<std::size_t>(v)] / static_cast<double>(index.size());
    }
    data.center = center.cast<R>();
    std::map<std::pair<int, int>, int> faceOfEdge;
    for (const Loop& loop : loops) {
        const int face = static_cast<int>(data.faces.size()), n = static_cast<int>(loop.size());
        V area = V::Zero();  // Newell: the plane's normal from all vertices
        double offset = -1e300;
        const V origin = points[static_cast<std::size_t>(loop[0])];
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const V& a = points[static_cast<std::size_t>(loop[i])];
            const V& b = points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
            area += (a - origin).cross(b - origin);
        }
        const V normal = area.normalized();
        for (int v : loop) offset = std::max(offset, normal.dot(points[static_cast<std::size_t>(v)]));
        HullFace<R> f;
        f.normal = normal.cast<R>();
        f.offset = static_cast<R>(offset);
        f.first = static_cast<int>(data.loops.size());
        f.count = n;
        data.faces.push_back(f);
        for (int i = 0; i < n; ++i) {
            const int a = index[loop[static_cast<std::size_t>(i)]];
            const int b = index[loop[static_cast<std::size_t>((i + 1) % n)]];
            data.loops.push_back(a);
            faceOfEdge[{a, b}] = face;
        }
    }
    for (const auto& [edge, left] : faceOfEdge) {
        const auto other = faceOfEdge.find({edge.second, edge.first});
        if (other == faceOfEdge.end()) throw std::invalid_argument("hull: the points are degenerate");
        if (edge.first < edge.second) data.edges.push_back({edge.first, edge.second, left, other->second});
    }
    return data;
}

}  // namespace

template <class R>
HullData<Space<R, 3>> buildHull(std::span<const Eigen::Matrix<R, 3, 1>> points) {
    std::vector<V> distinct;
    for (const Eigen::Matrix<R, 3, 1>& p : points) {
        if (!p.allFinite()) throw std::invalid_argument("hull: a point is not finite");
        distinct.push_back(p.template cast<double>());
    }
    if (distinct.size() < 4) throw std::invalid_argument("hull: fewer than four points");
    V low = distinct.front(), high = distinct.front();
    for (const V& p : distinct) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double tolerance = kHullTolerance<R> * (high - low).norm();
    const std::vector<HullTriangle> triangles = quickhull(distinct, tolerance);
    // Twice: a vertex may lie out of the seed's plane by the tolerance of its own triangle and of the seed.
    std::vector<Loop> loops = boundaryLoops(triangles, groupCoplanar(triangles, distinct, 2.0 * tolerance));
    dropStraightVertices(loops);
    return assemble<R>(loops, distinct);
}

template HullData<Space3f> buildHull(std::span<const Space3f::Vec>);
template HullData<Space3d> buildHull(std::span<const Space3d::Vec>);

}  // namespace rigor::engine
