// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/shapes/bounding_sphere.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "engine/math/portable.hpp"
#include "engine/shapes/hull.hpp"

namespace rigor::engine {
namespace {

constexpr double kTolerance = 1e-12;  ///< points this far outside, relative to the radius, count as inside

template <int Dim>
using Point = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using Points = std::vector<Point<Dim>>;
template <int Dim>
using Ball = BoundingSphere<Space<double, Dim>>;

template <int Dim>
bool contains(const Ball<Dim>& ball, const Point<Dim>& point) {
    return (point - ball.center).norm() <= ball.radius * (1 + kTolerance);
}

/// The smallest sphere with all points on it; nothing for points that depend on each other. Its centre is
/// p_0 + sum_j x_j q_j with q_j = p_j - p_0 and 2 q_i . sum_j x_j q_j = |q_i|^2.
template <int Dim>
std::optional<Ball<Dim>> sphereThrough(const Points<Dim>& points) {
    const auto n = static_cast<Eigen::Index>(points.size()) - 1;
    Ball<Dim> ball{points[0], 0};
    if (n == 0) return ball;
    Eigen::MatrixXd q(Dim, n);
    for (Eigen::Index i = 0; i < n; ++i) q.col(i) = points[static_cast<std::size_t>(i) + 1] - points[0];
    const Eigen::FullPivLU<Eigen::MatrixXd> gram(2 * q.transpose() * q);
    if (!gram.isInvertible()) return std::nullopt;
    const Point<Dim> offset = q * gram.solve(q.colwise().squaredNorm().transpose().eval());
    ball.center += offset;
    ball.radius = offset.norm();
    return ball;
}

/// The smallest sphere around at most dim + 2 points: that through one of their subsets. Replaces the points by that
/// subset.
template <int Dim>
Ball<Dim> smallestOfFew(Points<Dim>& points) {
    Ball<Dim> best;
    Points<Dim> bestSubset;
    for (unsigned subset = 1; subset < 1u << points.size(); ++subset) {
        Points<Dim> chosen;
        for (std::size_t i = 0; i < points.size(); ++i)
            if ((subset >> i & 1u) != 0) chosen.push_back(points[i]);
        if (chosen.size() > static_cast<std::size_t>(Dim) + 1) continue;
        const std::optional<Ball<Dim>> ball = sphereThrough<Dim>(chosen);
        if (!ball || !(ball->radius < best.radius)) continue;
        if (!std::all_of(points.begin(), points.end(),
                         [&](const auto& p) { return contains<Dim>(*ball, p); }))
            continue;
        best = *ball;
        bestSubset = chosen;
    }
    points = bestSubset;
    return best;
}

/// The smallest sphere around a cone: through its apex and rim, or around its base where the cone is flat.
template <class R>
BoundingSphere<Space<R, 3>> sphereOfCone(const Cone<Space<R, 3>>& cone) {
    const R height = 2 * cone.halfLength;
    const R radius =
        height > cone.radius ? (cone.radius * cone.radius + height * height) / (2 * height) : cone.radius;
    const R fromBase = height > cone.radius ? height - radius : R(0);
    return {{0, fromBase - cone.halfLength, 0}, radius};
}

template <class R, int Dim>
BoundingSphere<Space<R, Dim>> sphereOfHull(const HullData<Space<R, Dim>>& hull) {
    Points<Dim> points;
    for (const auto& vertex : hull.vertices) points.push_back(vertex.template cast<double>());
    const Ball<Dim> ball = smallestSphere<Dim>(points);
    return {ball.center.template cast<R>(), R(ball.radius)};
}

template <class S, class Kind>
BoundingSphere<S> exactSphere(const Kind& s) {
    using Vec = typename S::Vec;
    if constexpr (kStaticOnly<Kind>) {
        return {};
    } else if constexpr (std::is_same_v<Kind, Sphere<S>>) {
        return {Vec::Zero(), s.radius};
    } else if constexpr (std::is_same_v<Kind, Box<S>>) {
        return {Vec::Zero(), s.halfExtents.norm()};
    } else if constexpr (std::is_same_v<Kind, Capsule<S>>) {
        return {Vec::Zero(), s.halfLength + s.radius};
    } else if constexpr (std::is_same_v<Kind, Hull<S>>) {
        return sphereOfHull(*s.data);
    } else if constexpr (std::is_same_v<Kind, Ellipsoid<S>>) {
        return {S::Vec::Zero(), s.halfAxes.maxCoeff()};
    } else if constexpr (std::is_same_v<Kind, Cone<S>>) {
        return sphereOfCone(s);
    } else {
        static_assert(std::is_same_v<Kind, Cylinder<S>>);
        return {Vec::Zero(), portable::hypot(s.radius, s.halfLength)};
    }
}

}  // namespace

template <int Dim>
BoundingSphere<Space<double, Dim>> smallestSphere(std::span<const Eigen::Matrix<double, Dim, 1>> points) {
    Points<Dim> few{points.front()};
    Ball<Dim> ball{points.front(), 0};
    for (std::size_t added = 0; added < 100 + points.size(); ++added) {
        const auto furthest =
            std::max_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
                return (a - ball.center).squaredNorm() < (b - ball.center).squaredNorm();
            });
        if (contains<Dim>(ball, *furthest)) break;
        few.push_back(*furthest);
        const Ball<Dim> larger = smallestOfFew<Dim>(few);
        if (!(larger.radius > ball.radius)) break;  // rounding
        ball = larger;
    }
    for (const Point<Dim>& point : points) ball.radius = std::max(ball.radius, (point - ball.center).norm());
    return ball;
}
template BoundingSphere<Space<double, 2>> smallestSphere<2>(std::span<const Eigen::Vector2d>);
template BoundingSphere<Space<double, 3>> smallestSphere<3>(std::span<const Eigen::Vector3d>);

template <class S>
BoundingSphere<S> boundingSphere(const Shape<S>& shape) {
    using Real = typename S::Real;
    BoundingSphere<S> sphere =
        std::visit([]<class Kind>(const Kind& s) { return exactSphere<S, Kind>(s); }, shape);
    // Sums and roots are rounded, and so is a point that is turned with the body.
    sphere.radius *= 1 + 8 * std::numeric_limits<Real>::epsilon();
    return sphere;
}

#define RIGOR_INSTANTIATE(S) template BoundingSphere<S> boundingSphere<S>(const Shape<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
