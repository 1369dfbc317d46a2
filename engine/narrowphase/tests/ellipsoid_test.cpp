// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ellipsoids: against half-spaces and points in closed form, as spheres where the half axes are equal, and against
// every convex kind by what makes a contact exact: the gap of the supporting planes along the normal is the
// distance, and the points lie on both shapes.
#include <gtest/gtest.h>

#include "engine/narrowphase/distance.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Ellipsoids : public testing::Test {
  protected:
    using Scalar = typename S::Real;
    Random<S> random{std::mt19937(11)};
    Ellipsoid<S> any() {
        return {vec<S>(random.uniform(0.15, 1), random.uniform(0.15, 1), random.uniform(0.15, 1))};
    }
    Pose<S> anywhere(double reach) {
        return pose<S>(typename S::Vec(static_cast<Scalar>(random.uniform(0, reach)) * random.direction()),
                       random.rotation());
    }
};
using Spaces3 = testing::Types<Space3f, Space3d>;
TYPED_TEST_SUITE(Ellipsoids, Spaces3);

/// The nearest point of an ellipsoid to x outside: y = (I + t E^-2)^-1 x with |E^-1 y| = 1, t by bisection.
Eigen::Vector3d nearestTo(const Eigen::Vector3d& x, const Eigen::Vector3d& h) {
    const auto at = [&](double t) {
        return Eigen::Vector3d(x.array() * h.array().square() / (h.array().square() + t));
    };
    double low = 0, high = x.norm() * h.maxCoeff() + h.maxCoeff() * h.maxCoeff();
    for (int i = 0; i < 200; ++i) {
        const double t = 0.5 * (low + high);
        (at(t).cwiseQuotient(h).squaredNorm() > 1 ? low : high) = t;
    }
    return at(low);
}

TYPED_TEST(Ellipsoids, RestOnAHalfSpaceAtTheSupportOfTheirNormal) {
    using S = TypeParam;
    using V = typename S::Vec;
    const HalfSpace<S> floor{vec<S>(0, 1, 0), 0};
    for (int k = 0; k < 200; ++k) {
        const Ellipsoid<S> shape = this->any();
        const Pose<S> X =
            pose<S>(vec<S>(0.3, this->random.uniform(-0.5, 0.9), -0.2), this->random.rotation());
        const V n = rotateInverse<typename S::Real>(X.q, vec<S>(0, 1, 0));
        const double reach = static_cast<double>(shape.halfAxes.cwiseProduct(n).norm());
        for (const NarrowPhaseEntry& entry : narrowPhases()) {
            Manifold<S> m;
            findNarrowPhase<S>(entry.name)(Shape<S>(shape), X, Shape<S>(floor), Pose<S>{}, 10, m);
            ASSERT_EQ(m.count, 1) << entry.name;
            EXPECT_NEAR(static_cast<double>(m.points[0].separation), static_cast<double>(X.p.y()) - reach,
                        tol<S>(1e-14, 1e-6));
            EXPECT_NEAR(static_cast<double>((m.normal + vec<S>(0, 1, 0)).norm()), 0, tol<S>(1e-15, 1e-6));
            const V onShape = toLocal<S>(X, m.points[0].pointA).cwiseQuotient(shape.halfAxes);
            EXPECT_NEAR(static_cast<double>(onShape.norm()), 1, tol<S>(1e-14, 1e-5));
        }
    }
}

TYPED_TEST(Ellipsoids, AreAtTheDistanceOfTheirNearestPointFromABall) {
    using S = TypeParam;
    using R = typename S::Real;
    for (int k = 0; k < 500; ++k) {
        const Ellipsoid<S> shape = this->any();
        const Eigen::Vector3d h = shape.halfAxes.template cast<double>();
        // The point is close over the surface, and far from it.
        const double over = std::pow(10.0, this->random.uniform(-4, 0.5));
        const Eigen::Vector3d n0 = this->random.direction().template cast<double>();
        const Eigen::Vector3d foot = h.cwiseProduct(h.cwiseProduct(n0)) / h.cwiseProduct(n0).norm();
        const typename S::Vec x = (foot + over * n0).template cast<R>();
        const Eigen::Vector3d nearest = nearestTo(x.template cast<double>(), h);
        const double distance = (x.template cast<double>() - nearest).norm();
        const Sphere<S> ball{R(0.2)};
        const ClosestPoints<S> c = closestPoints<S>(Shape<S>(shape), Pose<S>{}, Shape<S>(ball), pose<S>(x));
        EXPECT_NEAR(static_cast<double>(c.distance), distance - static_cast<double>(ball.radius),
                    tol<S>(1e-13, 2e-6));
        const Eigen::Vector3d normal = (x.template cast<double>() - nearest) / distance;
        EXPECT_NEAR((c.normal.template cast<double>() - normal).norm(), 0, tol<S>(1e-10, 1e-2));
        EXPECT_NEAR((c.pointA.template cast<double>() - nearest).norm(), 0, tol<S>(1e-11, 1e-3)) << over;
    }
}

TYPED_TEST(Ellipsoids, OfEqualHalfAxesAreSpheres) {
    using S = TypeParam;
    using R = typename S::Real;
    const Shape<S> sphere = Sphere<S>{R(0.45)}, ellipsoid = Ellipsoid<S>{vec<S>(0.45, 0.45, 0.45)};
    for (int kind = 0; kind < kKinds<S>; ++kind) {
        const Shape<S> other = shapeOfKind<S>(kind);
        if (!isConvexPair<S>(sphere, other)) continue;
        int met = 0;
        for (int k = 0; k < 300; ++k) {
            const Pose<S> X = this->anywhere(1.3), Y = this->anywhere(0.2);
            const ClosestPoints<S> a = closestPoints<S>(sphere, X, other, Y),
                                   b = closestPoints<S>(ellipsoid, X, other, Y);
            // Deep inside, the ways out of curved sides are as EPA finds them.
            if (a.distance < R(-0.4)) continue;
            ++met;
            EXPECT_NEAR(static_cast<double>(a.distance), static_cast<double>(b.distance), tol<S>(1e-11, 1e-5))
                << shapeName<S>(other) << " " << k;
        }
        EXPECT_GT(met, 50) << shapeName<S>(other);
    }
}

TYPED_TEST(Ellipsoids, MeetEveryConvexShapeExactly) {
    using S = TypeParam;
    using R = typename S::Real;
    using V = typename S::Vec;
    for (int kind = 0; kind < kKinds<S>; ++kind) {
        const Shape<S> other = shapeOfKind<S>(kind);
        const Shape<S> probe = Sphere<S>{R(0)};
        if (std::holds_alternative<HalfSpace<S>>(other) || isComposite<S>(other)) continue;
        int apart = 0, overlapping = 0;
        for (int k = 0; k < 600; ++k) {
            const Shape<S> shape = this->any();
            const Pose<S> X = this->anywhere(1.5), Y = this->anywhere(0.3);
            for (const bool swapped : {false, true}) {
                const ClosestPoints<S> c =
                    swapped ? closestPoints<S>(other, Y, shape, X) : closestPoints<S>(shape, X, other, Y);
                const Shape<S>&a = swapped ? other : shape, &b = swapped ? shape : other;
                const Pose<S>&Xa = swapped ? Y : X, &Xb = swapped ? X : Y;
                EXPECT_NEAR(separationAlong<S>(a, Xa, b, Xb, c.normal), static_cast<double>(c.distance),
                            tol<S>(1e-13, 3e-6));
                // The point on the other shape is on its surface: wrong by the radius of curvature times the
                // angle where the normal is.
                const V onOther = swapped ? c.pointA : c.pointB;
                const double off =
                    static_cast<double>(closestPoints<S>(probe, pose<S>(onOther), other, Y).distance);
                EXPECT_NEAR(off, 0, tol<S>(1e-10, 1e-3))
                    << shapeName<S>(other) << " " << k << " " << c.distance;
                (c.distance > 0 ? apart : overlapping)++;
            }
        }
        EXPECT_GT(apart, 100) << shapeName<S>(other);
        EXPECT_GT(overlapping, 100) << shapeName<S>(other);
    }
}

TYPED_TEST(Ellipsoids, HaveTheSameContactInEveryNarrowPhase) {
    using S = TypeParam;
    using R = typename S::Real;
    for (int kind = 0; kind < kKinds<S>; ++kind) {
        const Shape<S> other = shapeOfKind<S>(kind);
        if (isComposite<S>(other)) continue;
        for (int k = 0; k < 100; ++k) {
            const Shape<S> shape = this->any();
            const Pose<S> X = this->anywhere(1.2);
            const ClosestPoints<S> c = closestPoints<S>(shape, X, other, Pose<S>{});
            if (c.distance < R(-0.1) || c.distance > R(0.3)) continue;
            for (const NarrowPhaseEntry& entry : narrowPhases()) {
                Manifold<S> m;
                findNarrowPhase<S>(entry.name)(shape, X, other, Pose<S>{}, R(0.5), m);
                ASSERT_GE(m.count, 1) << entry.name << " " << shapeName<S>(other);
                EXPECT_NEAR(leastSeparation(m), static_cast<double>(c.distance), tol<S>(1e-9, 1e-4))
                    << entry.name << " " << shapeName<S>(other) << " " << k;
            }
        }
    }
}

}  // namespace
}  // namespace rigor::engine::test
