// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Convex polygon of a point set: the monotone chain [Andrew1979], in double. Points closer to an edge than a
// tolerance relative to the size of the set are dropped, so that no three vertices are collinear.
// Cost O(n log n).
#include <algorithm>
#include <stdexcept>

#include "engine/shapes/hull.hpp"

namespace rigor::engine {
namespace {

using V = Eigen::Vector2d;

/// Twice the area of a, b, c over the distance of a and c: height of b above the line from a to c, > 0 when
/// b is to its right (the chain turns left at b).
double height(const V& a, const V& b, const V& c) {
    const V ab = b - a, ac = c - a;
    const double length = ac.norm();
    const double area = ab.x() * ac.y() - ab.y() * ac.x();
    return length > 0 ? area / length : 0.0;
}

/// One half of the hull over sorted points, without its last point.
template <class Iterator>
std::vector<V> chain(Iterator begin, Iterator end, double tolerance) {
    std::vector<V> hull;
    for (Iterator p = begin; p != end; ++p) {
        while (hull.size() >= 2 && height(hull[hull.size() - 2], hull.back(), *p) <= tolerance)
            hull.pop_back();
        hull.push_back(*p);
    }
    hull.pop_back();
    return hull;
}

/// Drops vertices that are less than the tolerance off the line between their neighbours (the two ends of the
/// chains are not tested against each other while they are built).
void dropCollinear(std::vector<V>& hull, double tolerance) {
    for (std::size_t i = 0; i < hull.size() && hull.size() >= 3;) {
        const std::size_t n = hull.size();
        if (height(hull[(i + n - 1) % n], hull[i], hull[(i + 1) % n]) <= tolerance)
            hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(i));
        else
            ++i;
    }
}

}  // namespace

template <class R>
HullData<Space<R, 2>> buildHull(std::span<const Eigen::Matrix<R, 2, 1>> points) {
    std::vector<V> sorted;
    for (const Eigen::Matrix<R, 2, 1>& p : points) {
        if (!p.allFinite()) throw std::invalid_argument("hull: a point is not finite");
        sorted.push_back(p.template cast<double>());
    }
    std::sort(sorted.begin(), sorted.end(),
              [](const V& a, const V& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    if (sorted.size() < 3) throw std::invalid_argument("hull: fewer than three distinct points");
    V low = sorted.front(), high = sorted.front();
    for (const V& p : sorted) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double tolerance = kHullTolerance<R> * (high - low).norm();

    std::vector<V> hull = chain(sorted.begin(), sorted.end(), tolerance);
    const std::vector<V> upper = chain(sorted.rbegin(), sorted.rend(), tolerance);
    hull.insert(hull.end(), upper.begin(), upper.end());
    dropCollinear(hull, tolerance);
    if (hull.size() < 3) throw std::invalid_argument("hull: the points have no area");

    HullData<Space<R, 2>> data;
    V center = V::Zero();
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const V e = hull[(i + 1) % hull.size()] - hull[i];
        data.vertices.push_back(hull[i].cast<R>());
        data.normals.push_back(V(e.y(), -e.x()).normalized().cast<R>());
        center += hull[i] / static_cast<double>(hull.size());
    }
    data.center = center.cast<R>();
    return data;
}

template HullData<Space2f> buildHull(std::span<const Space2f::Vec>);
template HullData<Space2d> buildHull(std::span<const Space2d::Vec>);

}  // namespace rigor::engine
