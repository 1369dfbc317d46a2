// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every narrow phase of the engine against the exact oracle on the hard cases of convex pairs, hulls of 8 to
// 20 vertices in both precisions, and on the published and generated cases of RIGOR_DATA. "sat" and "gjk_epa"
// give the exact depth and a minimising normal; "mpr" gives the exact verdict, a direction that separates the
// shapes by the depth that it reports, and the least depth where the overlap is shallow.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "adapters/rigor/convert_shape.hpp"
#include "engine/narrowphase/distance.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "scenarios/loader/collision_cases.hpp"
#include "validation/oracle/oracle.hpp"

namespace rigor::adapter {
namespace {

using scenario::norm;

struct Posed {
    Geometry geometry;
    Pose pose;
};

/// Tolerance as a fraction of the size: verdict, depth and support along the normal.
template <class S>
inline constexpr double kExact = sizeof(typename S::Real) == 8 ? 1e-13 : 2e-5;
/// Tolerances of mpr for overlaps below 1/20 of the size, and for any overlap.
template <class S>
inline constexpr double kShallow = sizeof(typename S::Real) == 8 ? 1e-8 : 1e-3;
constexpr double kDeep = 0.15;

/// One pair through every narrow phase, against the truth `d`.
template <class S>
void checkPair(const Posed& a, const Posed& b, double d, double size, double tolerance) {
    using R = typename S::Real;
    const auto shapeA = toEngineShape<S>(a.geometry), shapeB = toEngineShape<S>(b.geometry);
    const auto Xa = toEnginePose<S>(a.pose), Xb = toEnginePose<S>(b.pose);
    const auto along = [&](const typename S::Vec& n) {
        return *validation::separationAlong(a.geometry, a.pose, b.geometry, b.pose, S::dim, fromEngineVec(n));
    };
    const auto closest = engine::closestPoints<S>(shapeA, Xa, shapeB, Xb);
    const auto curved = [](const scenario::Geometry& g) {
        return std::holds_alternative<scenario::Cylinder>(g) || std::holds_alternative<scenario::Cone>(g);
    };
    // A ring of penetration vectors leaves EPA unfinished, and its flag says so; the result is tested all the
    // same.
    EXPECT_TRUE(closest.converged || curved(a.geometry) || curved(b.geometry));
    EXPECT_NEAR(static_cast<double>(closest.distance), d, tolerance);
    EXPECT_GE(along(closest.normal), d - tolerance);
    for (const engine::NarrowPhaseEntry& entry : engine::narrowPhases()) {
        SCOPED_TRACE(entry.name);
        engine::Manifold<S> m;
        engine::findNarrowPhase<S>(entry.name)(shapeA, Xa, shapeB, Xb, R(0), m);
        if (std::abs(d) > tolerance) {
            EXPECT_EQ(m.count > 0, d < 0) << "signed distance " << d;
        }
        if (m.count == 0) continue;
        double found = 1e300;
        for (int i = 0; i < m.count; ++i)
            found = std::min(found, static_cast<double>(m.points[i].separation));
        EXPECT_NEAR(along(m.normal), found, tolerance);
        EXPECT_LE(found, d + tolerance);
        const bool exact = std::string(entry.name) != "mpr", shallow = d > -0.05 * size;
        EXPECT_GE(found, d - (exact ? tolerance : (shallow ? kShallow<S> : kDeep) * size));
    }
}

struct Kind {
    const char* name;
    double size = 1, thickness = 1;  ///< [m], fraction of the size
    double turned = -1;              ///< relative rotation [rad]; -1: any
    double reach = 1.5;              ///< distance of the centres over the size
    bool same = false;
    double place = 0;   ///< distance from the world's origin [m]
    double gap = -1e9;  ///< moved along the normal until the distance is this fraction of the size
};
constexpr Kind kKinds[] = {
    {"touching", 1, 1, -1, 1.5, false, 0, 0},
    {"grazing overlap", 1, 1, -1, 1.5, false, 0, -1e-4},
    {"grazing gap", 1, 1, -1, 1.5, false, 0, 1e-4},
    {"parallel", 1, 1, 0},
    {"nearly parallel", 1, 1, 1e-6},
    {"deep", 1, 1, -1, 0.3},
    {"thin", 1, 1e-3},
    {"tiny", 1e-3},
    {"huge", 1e3},
    {"far from the origin", 1, 1, -1, 1.5, false, 1e4},
    {"concentric", 1, 1, -1, 0},
    {"identical", 1, 1, 0, 0, true},
};

struct Maker {
    std::mt19937 generator;
    int dimension;
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(generator);
    }
    Vec3 direction() {
        std::normal_distribution<double> normal;
        const Vec3 v{normal(generator), normal(generator), dimension == 2 ? 0.0 : normal(generator)};
        return v / norm(v);
    }
    Quat rotation() {
        if (dimension == 2) return scenario::fromAxisAngle({0, 0, 1}, uniform(-3, 3));
        return scenario::fromAxisAngle(direction(), uniform(-3, 3));
    }
    /// A box or a hull of 8 to 20 points, coordinates exact in float.
    Geometry shape(const Kind& kind) {
        const auto whole = [](double x) { return static_cast<double>(static_cast<float>(x)); };
        const bool box = uniform(0, 1) < 0.3;
        const int n = 8 + static_cast<int>(uniform(0, 12.99));
        scenario::ConvexHull hull;
        for (int i = 0; i < n; ++i) {
            const Vec3 v = 0.5 * kind.size * direction();
            hull.vertices.push_back({whole(v.x), whole(kind.thickness * v.y), whole(v.z)});
        }
        if (!box) return hull;
        const auto half = [&] { return whole(0.5 * kind.size * uniform(0.3, 1)); };
        return scenario::Box{{half(), whole(kind.thickness * half()), dimension == 2 ? 0.0 : half()}};
    }
};

template <class S>
class ConvexPairs : public testing::Test {};
using Spaces = testing::Types<engine::Space2f, engine::Space2d, engine::Space3f, engine::Space3d>;
TYPED_TEST_SUITE(ConvexPairs, Spaces);

TYPED_TEST(ConvexPairs, HardCasesAgreeWithTheOracle) {
    using S = TypeParam;
    for (const Kind& kind : kKinds) {
        SCOPED_TRACE(kind.name);
        Maker make{std::mt19937(11), S::dim};
        int overlapping = 0;
        for (int i = 0; i < 30 && !this->HasFatalFailure(); ++i) {
            SCOPED_TRACE(i);
            Posed a{make.shape(kind), {kind.place * make.direction(), make.rotation()}};
            Posed b{kind.same ? a.geometry : make.shape(kind), a.pose};
            b.pose.position = a.pose.position + make.uniform(0, kind.reach) * kind.size * make.direction();
            if (kind.turned < 0)
                b.pose.orientation = make.rotation();
            else
                b.pose.orientation =
                    a.pose.orientation *
                    scenario::fromAxisAngle(S::dim == 2 ? Vec3{0, 0, 1} : make.direction(), kind.turned);
            auto exact = validation::exactContact(a.geometry, a.pose, b.geometry, b.pose, S::dim);
            ASSERT_TRUE(exact);
            if (kind.gap > -1e8) {
                b.pose.position =
                    b.pose.position + (kind.gap * kind.size - exact->signedDistance) * exact->normals.at(0);
                exact = validation::exactContact(a.geometry, a.pose, b.geometry, b.pose, S::dim);
            }
            overlapping += exact->signedDistance < 0;
            // Positions are rounded to the precision before they are subtracted.
            const double placed = kind.place * 4 * std::numeric_limits<typename S::Real>::epsilon();
            checkPair<S>(a, b, exact->signedDistance, kind.size, kExact<S> * kind.size + placed);
        }
        if (kind.gap < -1e8) {
            EXPECT_GE(overlapping, 3);
        }
    }
}

/// The lines that the oracle can judge, scaled tolerances; see the README beside the files.
TEST(PublishedPairs, AgreeWithTheOracle) {
    const char* data = std::getenv("RIGOR_DATA");
    if (data == nullptr) GTEST_SKIP() << "RIGOR_DATA is not set";
    int queries = 0;
    for (const char* name : {"cases.jsonl", "generated.jsonl"}) {
        const auto file = std::filesystem::path(data) / "collision-cases" / name;
        if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
        for (const scenario::CollisionCase& c : scenario::loadCollisionFile(file).cases) {
            if (!c.unsupported.empty() || c.dimension != 3) continue;
            const auto exact =
                validation::exactContact(c.a.geometry, c.a.pose, c.b.geometry, c.b.pose, c.dimension);
            if (!exact || !std::isfinite(exact->signedDistance)) continue;
            SCOPED_TRACE(c.name);
            double size = 0;
            bool skip = false;
            for (const auto* s : {&c.a, &c.b}) try {
                    const auto box = engine::boundingBox<engine::Space3d>(
                        toEngineShape<engine::Space3d>(s->geometry), engine::Pose<engine::Space3d>());
                    const double extent = (box.max - box.min).norm();
                    if (extent < 1e100) size = std::max(size, extent);
                } catch (const std::exception&) {
                    skip = true;  // a flat hull: no shape of the engine
                }
            if (skip) continue;
            ++queries;
            const double placed = 1e-15 * (norm(c.a.pose.position) + norm(c.b.pose.position));
            // "sat" keeps a face while another axis is better by less than this fraction of the depth.
            const double kept = 1e-7 * std::abs(exact->signedDistance);
            checkPair<engine::Space3d>({c.a.geometry, c.a.pose}, {c.b.geometry, c.b.pose},
                                       exact->signedDistance, size, 1e-12 * size + placed + kept);
        }
    }
    EXPECT_GT(queries, 500);
}

}  // namespace
}  // namespace rigor::adapter
