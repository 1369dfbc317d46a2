// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Mass properties against sampled points and against other decompositions of the same solid; support mapping
// and bounding boxes against all points of a sample.
#include "engine/shapes/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "engine/shapes/hull.hpp"

namespace rigor::engine {
namespace {

template <class S>
constexpr double shapeTolerance() {
    return sizeof(typename S::Real) == 4 ? 2e-6 : 1e-13;
}

template <class S>
typename S::Vec vec(double x, double y, double z = 0) {
    using R = typename S::Real;
    if constexpr (S::dim == 2) {
        (void)z;
        return {static_cast<R>(x), static_cast<R>(y)};
    } else {
        return {static_cast<R>(x), static_cast<R>(y), static_cast<R>(z)};
    }
}

/// True if the point is in the shape. Written from the definition of each shape, apart from the code under
/// test.
template <class S>
bool contains(const Shape<S>& shape, const typename S::Vec& x) {
    if (const auto* s = std::get_if<Sphere<S>>(&shape)) return x.norm() <= s->radius;
    if (const auto* b = std::get_if<Box<S>>(&shape))
        return (x.cwiseAbs().array() <= b->halfExtents.array()).all();
    if (const auto* c = std::get_if<Capsule<S>>(&shape)) {
        typename S::Vec core = S::Vec::Zero();
        core.y() = std::clamp(x.y(), -c->halfLength, c->halfLength);
        return (x - core).norm() <= c->radius;
    }
    if constexpr (S::dim == 3) {
        const double across = std::hypot(static_cast<double>(x.x()), static_cast<double>(x.z()));
        if (const auto* c = std::get_if<Cylinder<S>>(&shape))
            return across <= c->radius && std::abs(x.y()) <= c->halfLength;
        if (const auto* e = std::get_if<Ellipsoid<S>>(&shape))
            return x.cwiseQuotient(e->halfAxes).norm() <= 1;
        if (const auto* c = std::get_if<Cone<S>>(&shape))
            return std::abs(x.y()) <= c->halfLength &&
                   across <= c->radius * (c->halfLength - x.y()) / (2 * c->halfLength);
    }
    const auto& h = *std::get<Hull<S>>(shape).data;
    if constexpr (S::dim == 2) {
        for (std::size_t i = 0; i < h.vertices.size(); ++i)
            if (h.normals[i].dot(x - h.vertices[i]) > 0) return false;
    } else {
        for (const auto& f : h.faces)
            if (f.normal.dot(x) > f.offset) return false;
    }
    return true;
}

template <class S>
Hull<S> irregularHull() {
    std::vector<typename S::Vec> points;
    std::mt19937 generator(21);
    std::uniform_real_distribution<double> u(-0.6, 0.6);
    for (int i = 0; i < 14; ++i)
        points.push_back(vec<S>(0.3 + u(generator), u(generator), 0.2 + u(generator)));
    return makeHull<S>(points);
}

template <class S>
std::vector<Shape<S>> solids() {
    using R = typename S::Real;
    std::vector<Shape<S>> all{Sphere<S>{R(0.7)}, Box<S>{vec<S>(0.5, 0.3, 0.8)}, Capsule<S>{R(0.4), R(0.5)},
                              irregularHull<S>()};
    if constexpr (S::dim == 3) {
        all.push_back(Cylinder<S>{R(0.6), R(0.4)});
        all.push_back(Cone<S>{R(0.7), R(0.6)});
        all.push_back(Ellipsoid<S>{vec<S>(0.7, 0.3, 0.5)});
    }
    std::size_t solid = 0;  // every kind with a volume is in the list
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        ((solid += !kStaticOnly<std::variant_alternative_t<I, Shape<S>>>), ...);
    }
    (std::make_index_sequence<std::variant_size_v<Shape<S>>>());
    EXPECT_EQ(all.size(), solid);
    return all;
}

template <class S>
class Solids : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Solids, Spaces);

/// Entry of an inertia tensor; the one number of 2D for all indices.
template <class I>
double inertiaEntry(const I& inertia, int r, int c) {
    if constexpr (std::is_arithmetic_v<I>)
        return static_cast<double>(inertia);
    else
        return static_cast<double>(inertia(r, c));
}

/// Midpoint sums over a fine grid: error of order grid / surface.
TYPED_TEST(Solids, MassPropertiesMatchASampledGrid) {
    using S = TypeParam;
    constexpr int kGrid = S::dim == 2 ? 800 : 150;
    // Turned, so that no face runs along the grid.
    Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    if (S::dim == 3) turn = turn * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX());
    const double step = 2.8 / kGrid, cell = std::pow(step, S::dim), rho = 3.0;
    for (const Shape<S>& shape : solids<S>()) {
        double mass = 0;
        Eigen::Vector3d first = Eigen::Vector3d::Zero();
        Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
        for (int i = 0; i < kGrid; ++i)
            for (int j = 0; j < kGrid; ++j)
                for (int k = 0; k < (S::dim == 2 ? 1 : kGrid); ++k) {
                    const Eigen::Vector3d grid(-1.4 + (i + 0.5) * step, -1.4 + (j + 0.5) * step,
                                               S::dim == 2 ? 0.0 : -1.4 + (k + 0.5) * step);
                    const Eigen::Vector3d x = turn * grid;
                    if (!contains<S>(shape, vec<S>(x.x(), x.y(), x.z()))) continue;
                    mass += rho * cell;
                    first += rho * cell * x;
                    second += rho * cell * x * x.transpose();
                }
        const MassProperties<S> m = massProperties<S>(shape, static_cast<typename S::Real>(rho));
        const Eigen::Vector3d center = first / mass;
        second -= mass * center * center.transpose();
        EXPECT_NEAR(m.mass, mass, 4e-3 * mass) << shape.index();
        for (int i = 0; i < S::dim; ++i) EXPECT_NEAR(m.center[i], center[i], 2e-3) << shape.index();
        const Eigen::Matrix3d inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
        if (S::dim == 2) {
            EXPECT_NEAR(inertiaEntry(m.inertia, 0, 0), inertia(2, 2), 8e-3 * inertia(2, 2)) << shape.index();
        } else {
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(inertiaEntry(m.inertia, r, c), inertia(r, c), 8e-3 * inertia.trace())
                        << shape.index();
        }
    }
}

TYPED_TEST(Solids, SupportIsTheFurthestPoint) {
    using S = TypeParam;
    std::mt19937 generator(4);
    std::normal_distribution<double> normal;
    for (const Shape<S>& shape : solids<S>())
        for (int i = 0; i < 200; ++i) {
            const typename S::Vec d = vec<S>(normal(generator), normal(generator), normal(generator));
            const typename S::Vec p = support<S>(shape, d);
            EXPECT_TRUE(contains<S>(shape, typename S::Vec(p * typename S::Real(1 - 1e-5)))) << shape.index();
            for (int k = 0; k < 50; ++k) {
                const typename S::Vec x = vec<S>(normal(generator), normal(generator), normal(generator));
                if (!contains<S>(shape, x)) continue;
                EXPECT_LE(d.dot(x), d.dot(p) + 1e-5) << shape.index();
            }
        }
}

/// The box touches the posed shape on every side: its faces are at the support points.
TYPED_TEST(Solids, BoundingBoxIsTight) {
    using S = TypeParam;
    Pose<S> X;
    X.p = vec<S>(2.0, -3.0, 0.5);
    if constexpr (S::dim == 2)
        X.q = S::Rot::fromAngle(typename S::Real(0.7));
    else
        X.q = typename S::Rot(typename S::Real(0.8), typename S::Real(0.2), typename S::Real(-0.4),
                              typename S::Real(0.3))
                  .normalized();
    for (const Shape<S>& shape : solids<S>()) {
        const Aabb<S> box = boundingBox<S>(shape, X);
        for (int axis = 0; axis < S::dim; ++axis) {
            const typename S::Vec e = S::Vec::Unit(axis);
            const auto reach = [&](const typename S::Vec& d) {
                return toWorld<S>(X, support<S>(shape, rotateInverse<typename S::Real>(X.q, d)))[axis];
            };
            EXPECT_NEAR(box.max[axis], reach(e), 10 * shapeTolerance<S>()) << shape.index();
            EXPECT_NEAR(box.min[axis], reach(-e), 10 * shapeTolerance<S>()) << shape.index();
        }
    }
}

TYPED_TEST(Solids, HalfSpaceIsBoundedOnlyAlongItsNormal) {
    using S = TypeParam;
    Pose<S> X;
    X.p = vec<S>(1, 2, 3);
    const Shape<S> up = HalfSpace<S>{vec<S>(0, 1, 0), typename S::Real(0.5)};
    const Aabb<S> box = boundingBox<S>(up, X);
    EXPECT_EQ(box.max.y(), 2.5);
    EXPECT_GT(box.max.x(), 1e30);
    EXPECT_LT(box.min.y(), -1e30);
    const Shape<S> slanted = HalfSpace<S>{vec<S>(0.6, 0.8, 0), typename S::Real(0.5)};
    EXPECT_GT(boundingBox<S>(slanted, X).max.minCoeff(), 1e30);
    EXPECT_THROW(massProperties<S>(up, 1), std::invalid_argument);
}

template <class S>
class Exact : public testing::Test {};
TYPED_TEST_SUITE(Exact, Spaces);

TYPED_TEST(Exact, BoxAsHull) {
    using S = TypeParam;
    const Shape<S> box = Box<S>{vec<S>(0.5, 0.25, 2.0)};
    std::vector<typename S::Vec> corners;
    for (unsigned i = 0; i < (1u << S::dim); ++i)
        corners.push_back(vec<S>(i & 1 ? 0.5 : -0.5, i & 2 ? 0.25 : -0.25, i & 4 ? 2.0 : -2.0));
    const Shape<S> hull = makeHull<S>(corners);
    const auto a = massProperties<S>(box, 7), b = massProperties<S>(hull, 7);
    EXPECT_NEAR(a.mass, b.mass, shapeTolerance<S>() * a.mass);
    EXPECT_LE((a.center - b.center).norm(), shapeTolerance<S>());
    for (int r = 0; r < (S::dim == 2 ? 1 : 3); ++r)
        for (int c = 0; c < (S::dim == 2 ? 1 : 3); ++c)
            EXPECT_NEAR(inertiaEntry(a.inertia, r, c), inertiaEntry(b.inertia, r, c),
                        shapeTolerance<S>() * inertiaEntry(a.inertia, 0, 0));
    if constexpr (S::dim == 3) {
        const double m = 7 * 8 * 0.5 * 0.25 * 2.0;  // m (b^2 + c^2) / 12 over full sides
        EXPECT_NEAR(inertiaEntry(a.inertia, 0, 0), m * (0.25 + 16.0) / 12, 1e-5 * m);
    }
}

/// Cutting a hull by the plane x = 0.2 into two hulls: mass, centre and inertia add up by the parallel axis
/// theorem.
TEST(HullMass, PartsAddUp) {
    using S = Space3d;
    using V = S::Vec;
    const Hull<S> whole = irregularHull<S>();
    std::vector<V> left, right;
    const double cut = 0.2;
    for (const V& v : whole.data->vertices) (v.x() < cut ? left : right).push_back(v);
    for (const HullEdge& e : whole.data->edges) {
        const V& a = whole.data->vertices[e.v0];
        const V& b = whole.data->vertices[e.v1];
        if ((a.x() < cut) == (b.x() < cut)) continue;
        const V p = a + (cut - a.x()) / (b.x() - a.x()) * (b - a);
        left.push_back(p);
        right.push_back(p);
    }
    const auto m = massProperties<S>(Shape<S>(whole), 2.0);
    const auto l = massProperties<S>(Shape<S>(makeHull<S>(left)), 2.0);
    const auto r = massProperties<S>(Shape<S>(makeHull<S>(right)), 2.0);
    EXPECT_NEAR(m.mass, l.mass + r.mass, 1e-13);
    EXPECT_LE((m.mass * m.center - l.mass * l.center - r.mass * r.center).norm(), 1e-13);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const auto& part : {l, r}) {
        const V d = part.center - m.center;
        sum += part.inertia + part.mass * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
    }
    EXPECT_LE((sum - m.inertia).norm(), 1e-13);
}

/// A capsule as a stack of thin discs, integrated by Simpson's rule.
TEST(CapsuleMass, MatchesAnIntegralOverDiscs) {
    const double r = 0.3, h = 0.6, pi = std::numbers::pi;
    double volume = 0, axial = 0, across = 0;
    const int n = 20000;
    for (int i = 0; i <= n; ++i) {
        const double y = -(h + r) + 2 * (h + r) * i / n, beyond = std::max(0.0, std::abs(y) - h);
        const double s2 = r * r - beyond * beyond;
        const double w = (i == 0 || i == n ? 1 : (i % 2 ? 4 : 2)) * 2 * (h + r) / n / 3;
        volume += w * pi * s2;
        axial += w * pi * s2 * s2 / 2;
        across += w * pi * s2 * (s2 / 4 + y * y);
    }
    const auto m = massProperties<Space3d>(Shape<Space3d>(Capsule<Space3d>{r, h}), 1.0);
    EXPECT_NEAR(m.mass, volume, 1e-9);
    EXPECT_NEAR(m.inertia(1, 1), axial, 1e-9);
    EXPECT_NEAR(m.inertia(0, 0), across, 1e-9);
    EXPECT_NEAR(m.inertia(2, 2), across, 1e-9);
}

/// Cylinder and cone as stacks of thin discs, integrated by Simpson's rule, which is exact for them.
TEST(RoundMass, MatchesAnIntegralOverDiscs) {
    const double r = 0.3, h = 0.6, pi = std::numbers::pi;
    for (const bool cone : {false, true}) {
        double volume = 0, first = 0, axial = 0, across = 0;
        const int n = 200;
        for (int i = 0; i <= n; ++i) {
            const double y = -h + 2 * h * i / n, s = cone ? r * (h - y) / (2 * h) : r;
            const double w = (i == 0 || i == n ? 1 : (i % 2 ? 4 : 2)) * 2 * h / n / 3;
            volume += w * pi * s * s;
            first += w * pi * s * s * y;
            axial += w * pi * s * s * s * s / 2;
            across += w * pi * s * s * (s * s / 4 + y * y);
        }
        const Shape<Space3d> shape =
            cone ? Shape<Space3d>(Cone<Space3d>{r, h}) : Shape<Space3d>(Cylinder<Space3d>{r, h});
        const auto m = massProperties<Space3d>(shape, 1.0);
        const double y = first / volume;
        EXPECT_NEAR(m.mass, volume, 1e-9);
        EXPECT_NEAR(m.center.y(), y, 1e-9);
        EXPECT_NEAR(m.inertia(1, 1), axial, 1e-9);
        EXPECT_NEAR(m.inertia(0, 0), across - volume * y * y, 1e-9);
        EXPECT_NEAR(m.inertia(2, 2), across - volume * y * y, 1e-9);
    }
}

}  // namespace
}  // namespace rigor::engine
