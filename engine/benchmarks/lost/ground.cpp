// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/benchmarks/lost/ground.hpp"

#include <algorithm>
#include <cmath>

#include "engine/shapes/surface.hpp"

namespace rigor::engine::lost {
namespace {

constexpr double kBody = 0.3;     ///< mean size of the bodies [m]
constexpr double kRimFrom = 0.8;  ///< start of the rim in half extents

int verticesOver(double extent, double spacing) {
    return 1 + std::max(2, static_cast<int>(std::lround(extent / spacing)));
}

}  // namespace

Heights::Heights(const Case& what, double half, std::mt19937& random) {
    const double side = what.squares * kBody;
    const double stretch = what.form == Form::Slivers ? std::sqrt(20.0) : 1;
    columns_ = verticesOver(2 * half, side * (what.ground == Ground::Chain ? 1 / stretch : stretch));
    dx_ = 2 * half / (columns_ - 1);
    if (what.ground != Ground::Chain) {
        rows_ = verticesOver(2 * half, side / stretch);
        dz_ = 2 * half / (rows_ - 1);
    }
    heights_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (int k = 0; k < rows_; ++k)
        for (int i = 0; i < columns_; ++i) heights_[k * columns_ + i] = form(what, i, k, random);
}

double Heights::form(const Case& what, int i, int k, std::mt19937& random) const {
    const double x = i * dx_ - halfX(), z = k * dz_ - halfZ();
    const double out = std::max(std::abs(x) / halfX(), rows_ > 1 ? std::abs(z) / halfZ() : 0.0);
    const double rim = what.ground == Ground::Plate ? 0 : std::max(0.0, out - kRimFrom) * halfX();
    std::uniform_real_distribution<double> any(-1, 1);
    switch (what.form) {
        case Form::Flat:
            return rim;
        case Form::Rough:
        case Form::Slivers:
            return rim + 0.15 * (what.form == Form::Rough ? dx_ : std::min(dx_, dz_)) * any(random);
        case Form::Slope:
            return rim + x * std::tan(20 * M_PI / 180);
        case Form::Ridges:
            return rim + (i % 2 == 0 ? 0.5 : -0.5) * dx_;
    }
    return rim;
}

/// A box of 1 mm whose top has the slope of the heights.
template <class S>
Shape<S> Heights::plate(Pose<S>& pose) const {
    using R = typename S::Real;
    using V = typename S::Vec;
    constexpr double kHalf = 0.5e-3;
    double slopeX = 0, slopeZ = 0;
    at(0, 0, slopeX, slopeZ);
    const double angle = std::atan(slopeX);
    pose.q = typename S::Rot(Eigen::AngleAxis<R>(static_cast<R>(angle), V::UnitZ()));
    pose.p = rotate(pose.q, V(static_cast<R>(-kHalf) * V::UnitY()));
    return Box<S>{
        V(static_cast<R>(halfX() / std::cos(angle)), static_cast<R>(kHalf), static_cast<R>(halfZ()))};
}

template <class S>
Shape<S> Heights::shape(Ground kind, Pose<S>& pose) const {
    using R = typename S::Real;
    if constexpr (S::dim == 3)
        if (kind == Ground::Plate) return plate<S>(pose);
    const auto point = [this](int i, int k) {
        typename S::Vec p = S::Vec::Zero();
        p[0] = static_cast<R>(i * dx_ - halfX());
        p[1] = static_cast<R>(vertex(i, k));
        if constexpr (S::dim == 3) p[2] = static_cast<R>(k * dz_ - halfZ());
        return p;
    };
    if constexpr (S::dim == 2) {
        std::vector<typename S::Vec> line;
        for (int i = 0; i < columns_; ++i) line.push_back(point(i, 0));
        return makeChain<S>(line, false);
    } else {
        if (kind == Ground::Field) {
            const std::vector<R> heights(heights_.begin(), heights_.end());
            return makeHeightField<S>(columns_, rows_, static_cast<R>(dx_), static_cast<R>(dz_), heights,
                                      R(1));
        }
        std::vector<typename S::Vec> vertices;
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (int k = 0; k < rows_; ++k)
            for (int i = 0; i < columns_; ++i) vertices.push_back(point(i, k));
        const auto n = static_cast<std::uint32_t>(columns_);
        for (std::uint32_t k = 0; k + 1 < static_cast<std::uint32_t>(rows_); ++k)
            for (std::uint32_t a = n * k; a + 1 < n * (k + 1); ++a) {
                triangles.push_back({a, a + n, a + 1});
                triangles.push_back({a + 1, a + n, a + n + 1});
            }
        return makeTriangleMesh<S>(vertices, triangles);
    }
}

double Heights::depth(double x, double y, double z) const {
    double slopeX = 0, slopeZ = 0;
    const double height = at(x, z, slopeX, slopeZ);
    return (height - y) / std::sqrt(1 + slopeX * slopeX + slopeZ * slopeZ);
}

double Heights::at(double x, double z, double& slopeX, double& slopeZ) const {
    const auto place = [](double t, int vertices, int& cell) {
        cell = std::clamp(static_cast<int>(std::floor(t)), 0, std::max(0, vertices - 2));
        return std::clamp(t - cell, 0.0, 1.0);
    };
    int i = 0, k = 0;
    const double u = place((x + halfX()) / dx_, columns_, i);
    slopeZ = 0;
    if (rows_ == 1) {
        slopeX = (vertex(i + 1, 0) - vertex(i, 0)) / dx_;
        return vertex(i, 0) + u * dx_ * slopeX;
    }
    const double w = place((z + halfZ()) / dz_, rows_, k);
    // Squares are split from (i + 1, k) to (i, k + 1): from the corner that the triangle has to itself.
    const bool low = u + w <= 1;
    const int a = low ? i : i + 1, b = low ? k : k + 1;
    slopeX = (vertex(i + 1, b) - vertex(i, b)) / dx_;
    slopeZ = (vertex(a, k + 1) - vertex(a, k)) / dz_;
    return vertex(a, b) + (low ? u : u - 1) * dx_ * slopeX + (low ? w : w - 1) * dz_ * slopeZ;
}

template Shape<Space2f> Heights::shape<Space2f>(Ground, Pose<Space2f>&) const;
template Shape<Space2d> Heights::shape<Space2d>(Ground, Pose<Space2d>&) const;
template Shape<Space3f> Heights::shape<Space3f>(Ground, Pose<Space3f>&) const;
template Shape<Space3d> Heights::shape<Space3d>(Ground, Pose<Space3d>&) const;

}  // namespace rigor::engine::lost
