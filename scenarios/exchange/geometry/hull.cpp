// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Convex hulls by Qhull (Barber, Dobkin, Huhdanpaa 1996), which merges coplanar facets: a vertex inside a face is no
// corner.
#include <algorithm>
#include <cstdio>

#include "scenarios/exchange/geometry/mesh_file.hpp"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace rigor::models {

HullOfMesh hullOf(const std::vector<scenario::Vec3>& points, const Place& place) {
    std::vector<coordT> coordinates;
    for (const auto& p : points) coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
    qhT state;
    qhT* qh = &state;
    std::FILE* silent = std::fopen("/dev/null", "w");
    qh_zero(qh, silent);
    char options[] = "qhull Pp";
    HullOfMesh hull;
    const int failed = points.size() < 4 ? 1
                                         : qh_new_qhull(qh, 3, static_cast<int>(points.size()),
                                                        coordinates.data(), 0, options, nullptr, silent);
    if (failed == 0) {
        vertexT* vertex;
        FORALLvertices hull.corners.push_back(
            points[static_cast<std::size_t>(qh_pointid(qh, vertex->point))]);
        qh_getarea(qh, qh->facet_list);
        hull.volume = qh->totvol;
        for (const auto& p : points) {
            double depth = 1e300;
            facetT* facet;
            FORALLfacets depth = std::min(depth, -(facet->normal[0] * p.x + facet->normal[1] * p.y +
                                                   facet->normal[2] * p.z + facet->offset));
            hull.dent = std::max(hull.dent, depth);
        }
    }
    if (points.size() >= 4) {
        qh_freeqhull(qh, !qh_ALL);
        int current = 0, total = 0;
        qh_memfreeshort(qh, &current, &total);
    }
    if (silent) std::fclose(silent);
    if (failed != 0 || !(hull.volume > 0.0)) throw Refusal(place, "a mesh without volume has no convex hull");
    return hull;
}

}  // namespace rigor::models
