// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The separating axes of two boxes (box_axis.cpp). Private to this folder.
#pragma once

#include "engine/narrowphase/3d/polytope.hpp"

namespace rigor::engine {

template <class R>
struct BoxAxes {
    Vec3<R> halfA, halfB;
    Relative<R> X;                ///< B in the frame of A
    Eigen::Matrix<R, 3, 3> absC;  ///< |X.rotation|
    Vec3<R> tB;                   ///< X.translation in the frame of B
    R size;                       ///< largest coordinate [m], for tolerances
    Vec3<R> reachA, reachB;       ///< extents of A along B's axes and of B along A's; made by `find` [m]

    BoxAxes(const Vec3<R>& a, const Vec3<R>& b, const Relative<R>& relative);
    /// polytopeAxis (polytope.hpp) by the fifteen axes in closed form.
    /// False: best.separation alone is known, a bound from below.
    bool find(R speculative, PolytopeAxis<R>& best);
    /// keepAxis (polytope.hpp) after `find` was true.
    void keep(const ManifoldMemory<Space<R, 3>>& memory, PolytopeAxis<R>& best) const;
};

}  // namespace rigor::engine
