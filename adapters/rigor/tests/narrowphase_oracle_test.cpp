// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The engine's narrow phase against the exact oracle on random pairs of all kinds, in both dimensions and
// precisions: depth, normal (as good as the best one), points on both surfaces.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "adapters/rigor/convert_shape.hpp"
#include "engine/narrowphase/manifold.hpp"
#include "validation/oracle/oracle.hpp"

namespace rigor::adapter {
namespace {

using engine::Manifold;
using scenario::norm;

struct Random {
    std::mt19937 generator;
    int dimension;
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(generator);
    }
    Vec3 direction() {
        std::normal_distribution<double> normal;
        Vec3 v{normal(generator), normal(generator), dimension == 2 ? 0.0 : normal(generator)};
        return v / norm(v);
    }
    Quat rotation() {
        if (dimension == 2) return scenario::fromAxisAngle({0, 0, 1}, uniform(-3, 3));
        std::normal_distribution<double> n;
        return scenario::normalized(Quat{n(generator), n(generator), n(generator), n(generator)});
    }
    /// Coordinates exactly representable in float, so that both precisions see the same shape.
    Geometry shape(int kind) {
        const auto length = [&] { return static_cast<double>(static_cast<float>(uniform(0.3, 1.0))); };
        switch (kind) {
            case 0:
                return scenario::Sphere{length()};
            case 1:
                return scenario::Box{{length(), length(), dimension == 2 ? 0.0 : length()}};
            case 2:
                return scenario::Capsule{0.5 * length(), length()};
            case 3:
                return scenario::HalfSpace{direction(), 0.0};
            default: {
                scenario::ConvexHull hull;
                for (int i = 0; i < (dimension == 2 ? 7 : 12); ++i)
                    hull.vertices.push_back(length() * direction());
                return hull;
            }
        }
    }
};

constexpr const char* kShapeKinds[] = {"sphere", "box", "capsule", "half_space", "hull"};

struct Worst {
    double depth = 0, normal = 0, point = 0;
    int overlapping = 0, apart = 0;
};

/// Distance of a point outside its shape; 0 inside.
double outside(Vec3 x, const Geometry& g, const Pose& X, int dimension) {
    const Geometry dot = scenario::Sphere{0.0};
    return std::max(0.0, validation::exactContact(dot, {x, {}}, g, X, dimension)->signedDistance);
}

template <class S>
class NarrowPhaseAgainstOracle : public testing::Test {
  protected:
    static constexpr bool kSingle = std::is_same_v<typename S::Real, float>;
    // Measured: 2e-15 in double, 8e-7 in float, with head-room.
    static constexpr double kTolerance = kSingle ? 4e-6 : 1e-14;

    void check(const Geometry& a, const Pose& Xa, const Geometry& b, const Pose& Xb, Worst& worst) {
        const double reach = 0.05;
        const auto exact = validation::exactContact(a, Xa, b, Xb, S::dim);
        ASSERT_TRUE(exact);
        const double d = exact->signedDistance;
        Manifold<S> m;
        engine::findNarrowPhase<S>("sat")(toEngineShape<S>(a), toEnginePose<S>(Xa), toEngineShape<S>(b),
                                          toEnginePose<S>(Xb), static_cast<typename S::Real>(reach), m);
        const bool polytopes = (a.index() == 1 || a.index() == 5) && (b.index() == 1 || b.index() == 5);
        if (d > reach + kTolerance) {
            if (!polytopes) {
                EXPECT_EQ(m.count, 0);
            }
            return;
        }
        if (polytopes && d > 0 && m.count == 0) return;
        ASSERT_GT(m.count, 0) << "signed distance " << d;
        double least = 1e300;
        for (int i = 0; i < m.count; ++i) {
            const auto& p = m.points[i];
            const Vec3 pA = fromEngineVec(p.pointA), pB = fromEngineVec(p.pointB);
            const Vec3 n = fromEngineVec(m.normal);
            least = std::min(least, static_cast<double>(p.separation));
            EXPECT_NEAR(dot(pB - pA, n), p.separation, kTolerance);
            if (d < 0) {
                worst.point = std::max({worst.point, outside(pA, a, Xa, S::dim), outside(pB, b, Xb, S::dim)});
            }
        }
        const Vec3 n = fromEngineVec(m.normal);
        EXPECT_NEAR(norm(n), 1.0, kTolerance);
        if (polytopes && d > 0) {
            EXPECT_LE(least, d + kTolerance);
            return;
        }
        (d < 0 ? worst.overlapping : worst.apart)++;
        worst.depth = std::max(worst.depth, std::abs(least - d));
        if (a.index() != 6 && b.index() != 6) {
            const double along = *validation::separationAlong(a, Xa, b, Xb, S::dim, n);
            worst.normal = std::max(worst.normal, d - along);
        } else {
            double off = 10;
            for (const Vec3& e : exact->normals) off = std::min(off, norm(e - n));
            worst.normal = std::max(worst.normal, off);
        }
    }
};

using Spaces = testing::Types<engine::Space2f, engine::Space2d, engine::Space3f, engine::Space3d>;
struct SpaceNames {
    template <class S>
    static std::string GetName(int) {
        return std::to_string(S::dim) + (sizeof(typename S::Real) == 4 ? "f" : "d");
    }
};
TYPED_TEST_SUITE(NarrowPhaseAgainstOracle, Spaces, SpaceNames);

TYPED_TEST(NarrowPhaseAgainstOracle, EveryPairOfKinds) {
    using S = TypeParam;
    for (int ka = 0; ka < 5; ++ka)
        for (int kb = 0; kb < 5; ++kb) {
            if (ka == 3 && kb == 3) continue;
            Random random{std::mt19937(static_cast<unsigned>(17 + 5 * ka + kb)), S::dim};
            Worst worst;
            for (int i = 0; i < 150 && !this->HasFatalFailure(); ++i) {
                const Geometry a = random.shape(ka), b = random.shape(kb);
                const Pose Xa{0.5 * random.direction(), random.rotation()};
                const double far = ka == 3 || kb == 3 ? 1.2 : (i % 3 == 0 ? 0.6 : 1.6);
                const Pose Xb{Xa.position + random.uniform(0.0, far) * random.direction(), random.rotation()};
                // The oracle is queried with the values that the engine has after rounding to its precision.
                this->check(a, Xa, b, Xb, worst);
            }
            const std::string pair = std::string(kShapeKinds[ka]) + " " + kShapeKinds[kb];
            EXPECT_LE(worst.depth, this->kTolerance) << pair;
            EXPECT_LE(worst.normal, this->kTolerance) << pair;
            EXPECT_LE(worst.point, this->kTolerance) << pair;
            EXPECT_GT(worst.overlapping, 20) << pair;
            if (std::getenv("RIGOR_PRINT_RESIDUALS"))
                std::printf("%dD %zu %-24s depth %.2g normal %.2g point %.2g (%d overlapping, %d apart)\n",
                            S::dim, 8 * sizeof(typename S::Real), pair.c_str(), worst.depth, worst.normal,
                            worst.point, worst.overlapping, worst.apart);
        }
}

}  // namespace
}  // namespace rigor::adapter
