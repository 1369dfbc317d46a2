// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/ode/contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "adapters/ode/convert.hpp"

namespace rigor::ode {
namespace {

/// More than any pair of geoms finds: with fewer, dCollide drops points in no particular order.
constexpr int kMostPoints = 64;
/// Points of a prism's two edges agree to rounding; other corners are apart by more than this [m].
constexpr double kSamePoint = 1e-9;

void bringIntoPlane(std::vector<FoundPoint>& points) {
    std::vector<FoundPoint> flat;
    for (FoundPoint p : points) {
        p.position.z = p.normal.z = 0.0;
        const double length = norm(p.normal);
        if (length < 0.5) continue;  // the normal is out of the plane: deeper than the prisms are thick
        p.normal = p.normal / length;
        const auto same = std::find_if(flat.begin(), flat.end(), [&](const FoundPoint& q) {
            return norm(q.position - p.position) < kSamePoint && dot(q.normal, p.normal) > 1.0 - 1e-9;
        });
        if (same == flat.end())
            flat.push_back(p);
        else
            same->depth = std::max(same->depth, p.depth);
    }
    points.swap(flat);
}

/// A hull collides with both sides of a mesh, and from the side that it is not on ODE gives it normals
/// through the surface: what pushes the hull's middle towards the surface is dropped.
void keepHullsOwnSide(dGeomID a, dGeomID b, std::vector<FoundPoint>& points) {
    const int kindA = dGeomGetClass(a), kindB = dGeomGetClass(b);
    const bool hullIsA = kindA == dConvexClass && kindB == dTriMeshClass;
    if (!hullIsA && !(kindB == dConvexClass && kindA == dTriMeshClass)) return;
    const Vec3 middle = fromOde(dGeomGetPosition(hullIsA ? a : b));
    std::erase_if(points, [&](const FoundPoint& p) {
        const double away = dot(p.normal, middle - p.position);
        return hullIsA ? away > 0.0 : away < 0.0;
    });
}

}  // namespace

void collideGeoms(dGeomID a, dGeomID b, bool planar, std::vector<FoundPoint>& points) {
    std::array<dContactGeom, kMostPoints> found;
    const int count = dCollide(a, b, kMostPoints, found.data(), sizeof(dContactGeom));
    points.clear();
    for (int i = 0; i < count; ++i) {
        const dContactGeom& c = found[i];
        const Vec3 normal = -fromOde(c.normal);
        // Centers that coincide leave some pairs without a direction.
        if (!(std::abs(norm(normal) - 1.0) < 1e-6)) continue;
        points.push_back({fromOde(c.pos), normal, c.depth});
    }
    keepHullsOwnSide(a, b, points);
    if (planar) bringIntoPlane(points);
}

void reducePoints(std::size_t count, std::vector<FoundPoint>& points) {
    if (points.size() <= count) return;
    const auto deepest =
        std::max_element(points.begin(), points.end(),
                         [](const FoundPoint& p, const FoundPoint& q) { return p.depth < q.depth; });
    std::iter_swap(points.begin(), deepest);
    std::vector<double> distance(points.size(), INFINITY);
    for (std::size_t kept = 1; kept < count; ++kept) {
        std::size_t farthest = kept;
        for (std::size_t i = kept; i < points.size(); ++i) {
            distance[i] = std::min(distance[i], norm(points[i].position - points[kept - 1].position));
            if (distance[i] > distance[farthest] + kSamePoint) farthest = i;
        }
        std::swap(points[kept], points[farthest]);
        std::swap(distance[kept], distance[farthest]);
    }
    points.resize(count);
}

void mergeNormals(double cosine, std::vector<FoundPoint>& points) {
    std::stable_sort(points.begin(), points.end(),
                     [](const FoundPoint& p, const FoundPoint& q) { return p.depth > q.depth; });
    std::vector<FoundPoint> kept;
    for (const FoundPoint& p : points)
        if (std::none_of(kept.begin(), kept.end(),
                         [&](const FoundPoint& q) { return dot(p.normal, q.normal) >= cosine; }))
            kept.push_back(p);
    points.swap(kept);
}

dSurfaceParameters surfaceFor(const scenario::PairCoefficients& pair, double bounceThreshold, double cfm) {
    dSurfaceParameters surface{};
    // If the approximation were off, mu would be a force and not a coefficient.
    surface.mode = dContactApprox1;
    surface.mu = pair.friction;
    if (pair.restitution > 0.0) {
        surface.mode |= dContactBounce;
        surface.bounce = pair.restitution;
        surface.bounce_vel = bounceThreshold;
    } else if (cfm > 0.0) {
        surface.mode |= dContactSoftCFM;
        surface.soft_cfm = cfm;
    }
    if (pair.rollingFriction > 0.0 || pair.torsionalFriction > 0.0) {
        // Axis by axis: else rho stands for all three, and mu2 and rho2 are not read.
        surface.mode |= dContactRolling | dContactAxisDep;
        surface.mu2 = pair.friction;
        surface.rho = surface.rho2 = pair.rollingFriction;
        surface.rhoN = pair.torsionalFriction;
    }
    return surface;
}

}  // namespace rigor::ode
