// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Uneven ground as a triangle mesh, a height field or a chain, or a thin plate, and its height by itself: the engine's own
// surface of the same heights is not used.
#pragma once

#include <random>

#include "engine/benchmarks/lost/rain.hpp"
#include "engine/shapes/shape.hpp"

namespace rigor::engine::lost {

/// Heights over a grid of columns along x and rows along z (a chain has one row), in double. The rim rises at
/// 45 degrees, so that few bodies leave.
class Heights {
  public:
    /// `half`: from the middle to the border [m].
    Heights(const Case& what, double half, std::mt19937& random);

    /// `pose`: where the shape is to be.
    template <class S>
    Shape<S> shape(Ground kind, Pose<S>& pose) const;
    /// Height of the ground over (x, z) [m], clamped to the border; z is 0 in 2D.
    double at(double x, double z) const {
        double slopeX = 0, slopeZ = 0;
        return at(x, z, slopeX, slopeZ);
    }
    /// Depth of a point under the plane of the piece that is over or under it; < 0: above [m].
    double depth(double x, double y, double z) const;
    bool holds(double x, double z) const { return std::abs(x) < halfX() && std::abs(z) <= halfZ(); }
    double halfX() const { return 0.5 * (columns_ - 1) * dx_; }
    double halfZ() const { return 0.5 * (rows_ - 1) * dz_; }

  private:
    double at(double x, double z, double& slopeX, double& slopeZ) const;
    template <class S>
    Shape<S> plate(Pose<S>& pose) const;
    double form(const Case& what, int i, int k, std::mt19937& random) const;
    double vertex(int i, int k) const { return heights_[k * columns_ + i]; }
    int columns_ = 0, rows_ = 1;
    double dx_ = 1, dz_ = 1;
    std::vector<double> heights_;
};

}  // namespace rigor::engine::lost
