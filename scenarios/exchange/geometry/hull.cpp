// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Convex hulls by Qhull (Barber, Dobkin, Huhdanpaa 1996), which merges coplanar facets: a vertex inside a face is no
// corner.
#include "scenarios/exchange/geometry/hull.hpp"

#include <algorithm>
#include <cstdio>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace rigor::models {
namespace {

using scenario::Vec3;

/// A run of Qhull and its memory.
class Qhull {
  public:
    Qhull(const std::vector<Vec3>& points, const char* options, const Place& place) {
        if (points.size() < 4) throw Refusal(place, kNoVolume);
        for (const auto& p : points) coordinates_.insert(coordinates_.end(), {p.x, p.y, p.z});
        silent_ = std::fopen("/dev/null", "w");
        qh_zero(&state, silent_);
        std::string words = options;
        const int code = qh_new_qhull(&state, 3, static_cast<int>(points.size()), coordinates_.data(), 0,
                                      words.data(), nullptr, silent_);
        if (code == 0) return;
        free();
        throw Refusal(place, kNoVolume);
    }
    ~Qhull() { free(); }
    Qhull(const Qhull&) = delete;
    Qhull& operator=(const Qhull&) = delete;

    static constexpr const char* kNoVolume = "a mesh without volume has no convex hull";
    qhT state;

  private:
    void free() {
        qh_freeqhull(&state, !qh_ALL);
        int current = 0, total = 0;
        qh_memfreeshort(&state, &current, &total);
        if (silent_) std::fclose(silent_);
    }
    std::vector<coordT> coordinates_;
    std::FILE* silent_ = nullptr;
};

}  // namespace

HullOfMesh hullOf(const std::vector<Vec3>& points, const Place& place) {
    Qhull run(points, "qhull Pp", place);
    qhT* qh = &run.state;
    HullOfMesh hull;
    vertexT* vertex;
    FORALLvertices hull.corners.push_back(points[static_cast<std::size_t>(qh_pointid(qh, vertex->point))]);
    qh_getarea(qh, qh->facet_list);
    hull.volume = qh->totvol;
    for (const auto& p : points) {
        double depth = 1e300;
        facetT* facet;
        FORALLfacets depth = std::min(depth, -(facet->normal[0] * p.x + facet->normal[1] * p.y +
                                               facet->normal[2] * p.z + facet->offset));
        hull.dent = std::max(hull.dent, depth);
    }
    if (!(hull.volume > 0.0)) throw Refusal(place, Qhull::kNoVolume);
    return hull;
}

std::vector<Triangle> hullTriangles(const std::vector<Vec3>& points, const Place& place) {
    Qhull run(points, "qhull Qt Pp", place);
    qhT* qh = &run.state;
    std::vector<Triangle> triangles;
    facetT* facet;
    FORALLfacets {
        Triangle triangle;
        std::size_t k = 0;
        vertexT *vertex, **vertexp;
        FOREACHvertex_(facet->vertices) {
            if (k < 3) triangle[k] = points[static_cast<std::size_t>(qh_pointid(qh, vertex->point))];
            ++k;
        }
        if (k == 3) triangles.push_back(triangle);
    }
    return triangles;
}

}  // namespace rigor::models
