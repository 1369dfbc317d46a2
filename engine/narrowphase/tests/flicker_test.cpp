// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies that rest and rock on each other with noise in every frame, each frame given the memory of the one
// before: the normal moves with the noise but does not alternate between ways out that are equally deep, the
// points keep their number and their names. A remembered choice is worse than the best by kKeep at most.
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

struct Rest {
    const char* name;
    double x, y, z;           ///< position of the upper box [m]
    double yaw, pitch, roll;  ///< orientation of the upper box [rad]
    double lower = 0;         ///< roll of the lower box [rad]
    double gain = 4;          ///< largest turn of the normal over the noise
    double nameNoise = 1;     ///< names stay the same up to this noise
};
constexpr double kEdgeOn = std::numbers::pi / 4, kOverEdges = 2 * 0.70710678118654752 - 1e-3;
constexpr Rest kRests[] = {
    {"face on face", 0.1, 0.999, 0.05, 0, 0, 0},
    {"rocking by a thousandth", 0.1, 0.9992, 0.05, 0.2, 1e-3, 1e-3},
    {"rocking by a hundredth", 0.1, 0.9995, 0.05, 0.2, 1e-2, 0, 0, 2 / 0.2},
    // The accuracy of the normal across two edges (here too) depends on their angle.
    {"crossing edges", 0, kOverEdges, 0, 1.5707963, 0, kEdgeOn, kEdgeOn},
    {"near-parallel edges", 0, kOverEdges, 0, 0.02, 0, kEdgeOn, kEdgeOn, 4 / 0.02},
    // Eight corners are equally good for four places; the deepest is kept where it is by more than kKeep.
    {"face on turned face", 0.1, 0.999, 0.05, 0.3, 0, 0, 0, 4, 2e-5},
    {"face on face turned by 45 degrees", 0, 0.999, 0, kEdgeOn, 0, 0, 0, 4, 2e-5},
    // The order in which two coincident lines cut each other depends on every bit.
    {"face on the same face", 0, 0.9999, 0, 0, 0, 0, 0, 4, 0},
};

template <class S>
typename S::Rot attitude(double yaw, double pitch, double roll) {
    using R = typename S::Real;
    using Turn = Eigen::AngleAxis<R>;
    using V = typename S::Vec;
    return typename S::Rot(Turn(static_cast<R>(yaw), V::UnitY()) * Turn(static_cast<R>(pitch), V::UnitX()) *
                           Turn(static_cast<R>(roll), V::UnitZ()));
}

template <class S>
std::set<std::uint32_t> namesOf(const Manifold<S>& m) {
    std::set<std::uint32_t> names;
    for (int i = 0; i < m.count; ++i) names.insert(m.points[i].feature);
    return names;
}

template <class S>
class Flicker : public testing::Test {};
using FlickerSpaces = testing::Types<Space3f, Space3d>;
TYPED_TEST_SUITE(Flicker, FlickerSpaces);

TYPED_TEST(Flicker, TheNormalMovesWithTheNoiseAndNoFurther) {
    using S = TypeParam;
    using R = typename S::Real;
    const Shape<S> box = Box<S>{vec<S>(0.5, 0.5, 0.5)}, hull = boxHull<S>(vec<S>(0.5, 0.5, 0.5));
    for (const char* algorithm : {"sat", "gjk_epa"})
        for (const Rest& rest : kRests)
            for (const Shape<S>& upper : {box, hull})
                for (const double noise : {1e-5, 1e-4}) {
                    SCOPED_TRACE(std::string(algorithm) + ", " + rest.name + ", noise " +
                                 std::to_string(noise));
                    Random<S> random{std::mt19937(3)};
                    const Pose<S> Xa = pose<S>(vec<S>(0, 0, 0), attitude<S>(0, 0, rest.lower));
                    const typename S::Rot settled = attitude<S>(rest.yaw, rest.pitch, rest.roll);
                    Manifold<S> last, m;
                    int renamed = 0;
                    for (int frame = 0; frame < 300; ++frame) {
                        Pose<S> Xb = pose<S>(vec<S>(rest.x, rest.y, rest.z));
                        Xb.p += static_cast<R>(0.1 * noise) * random.direction();
                        const R angle = static_cast<R>(noise * random.uniform(-1, 1));
                        const Eigen::AngleAxis<R> shake(angle, random.direction());
                        Xb.q = compose(typename S::Rot(shake), settled);
                        findNarrowPhase<S>(algorithm)(box, Xa, upper, Xb, R(1e-3), m);
                        ASSERT_GT(m.count, 0);
                        if (frame > 0) {
                            ASSERT_EQ(m.count, last.count);
                            ASSERT_LE(static_cast<double>((m.normal - last.normal).norm()),
                                      rest.gain * (noise + tol<S>(0, 1e-5)));
                            renamed += namesOf(m) != namesOf(last);
                        }
                        last = m;
                    }
                    if (noise <= rest.nameNoise) {
                        EXPECT_EQ(renamed, 0);
                    }
                }
}

/// Two axes of equal penetration: noise makes now the one and now the other the smaller.
template <class S>
struct EqualDepthPair {
    std::string name;
    Shape<S> a, b;
    Pose<S> Xb;
};
template <class S>
std::vector<EqualDepthPair<S>> equalDepthPairs() {
    using R = typename S::Real;
    const Shape<S> box = Box<S>{vec<S>(0.5, 0.5, 0.5)}, hull = boxHull<S>(vec<S>(0.5, 0.5, 0.5));
    // A lean is added in 3D so that the two axes are not those of the frame.
    std::vector<EqualDepthPair<S>> all{
        {"box in the corner of a box", box, box, pose<S>(vec<S>(0.8, 0.8, 0.1))},
        {"hull in the corner of a box", box, hull, pose<S>(vec<S>(0.8, 0.8, 0.1))},
        {"turned box in a box", box, box, pose<S>(vec<S>(0, 0, 0), turn<S>(kEdgeOn))},
        {"box in itself", box, box, pose<S>(vec<S>(0, 0, 0))},
        {"capsule in the corner of a box", box, Capsule<S>{R(0.1), R(0.2)},
         pose<S>(vec<S>(0.4, 0.2, 0), turn<S>(0.1))},
        {"capsule in the middle of a box", box, Capsule<S>{R(0.1), R(0.2)}, pose<S>(vec<S>(0, 0.1, 0.05))},
        {"ball in the corner of a hull", hull, Sphere<S>{R(0.2)}, pose<S>(vec<S>(0.3, 0.3, 0.1))},
        {"ball in the corner of a box", box, Sphere<S>{R(0.2)}, pose<S>(vec<S>(0.3, 0.3, 0.1))},
    };
    if constexpr (S::dim == 3) {
        all.push_back({"cylinder in the edge of a box", box, Cylinder<S>{R(0.3), R(0.4)},
                       pose<S>(vec<S>(0.6, 0.7, 0))});
        const auto lean = S::Rot::FromTwoVectors(S::Vec::UnitY(), vec<S>(1, -1, 1));
        for (const Shape<S>& cube : {box, hull})
            all.push_back({"capsule across two edges of a cube", cube, Capsule<S>{R(0.1), R(0.2)},
                           pose<S>(vec<S>(0.45, 0.45, 0.45), lean)});
    }
    // The other way round the narrow phase turns the pair about, and what it remembers with it.
    for (std::size_t i = 0, n = all.size(); i < n; ++i) {
        const EqualDepthPair<S> pair = all[i];
        const typename S::Vec back = -rotateInverse<R>(pair.Xb.q, pair.Xb.p);
        all.push_back({pair.name + ", turned about", pair.b, pair.a, pose<S>(back, inverse(pair.Xb.q))});
    }
    return all;
}

template <class S>
class Ties : public testing::Test {};
using AllSpaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Ties, AllSpaces);

/// Largest turn of the normal from frame to frame.
template <class S>
double largestTurn(const char* algorithm, const EqualDepthPair<S>& pair, bool remembers) {
    using R = typename S::Real;
    Random<S> random{std::mt19937(5)};
    Manifold<S> m;
    typename S::Vec last = S::Vec::Zero();
    double most = 0;
    for (int frame = 0; frame < 200; ++frame) {
        Pose<S> Xb = pair.Xb;
        Xb.p += R(5e-6) * random.direction();
        if (!remembers) m.memory = {};
        findNarrowPhase<S>(algorithm)(pair.a, pose<S>(vec<S>(0, 0, 0)), pair.b, Xb, R(0), m);
        EXPECT_GT(m.count, 0);
        if (frame > 0) most = std::max(most, static_cast<double>((m.normal - last).norm()));
        last = m.normal;
    }
    return most;
}

TYPED_TEST(Ties, OfEquallyDeepWaysOutTheLastStays) {
    using S = TypeParam;
    int jumping = 0;
    for (const NarrowPhaseEntry& algorithm : narrowPhases())
        for (const EqualDepthPair<S>& pair : equalDepthPairs<S>()) {
            SCOPED_TRACE(std::string(algorithm.name) + ", " + pair.name);
            EXPECT_LE((largestTurn<S>(algorithm.name, pair, true)), 1e-3);
            jumping += largestTurn<S>(algorithm.name, pair, false) > 0.1;
        }
    EXPECT_GT(jumping, 12) << "without a memory the normals should jump";
}

/// A body that wanders slowly: what the memory keeps is never deeper than the best by more than kKeep of the
/// smaller shape, and it is left where it is.
TYPED_TEST(Ties, TheMemoryCostsNoMoreThanItsTolerance) {
    using S = TypeParam;
    using R = typename S::Real;
    const double sharp = tol<S>(1e-12, 2e-5), size = 0.5;
    for (const NarrowPhaseEntry& algorithm : narrowPhases())
        for (const EqualDepthPair<S>& pair : equalDepthPairs<S>()) {
            SCOPED_TRACE(std::string(algorithm.name) + ", " + pair.name);
            Random<S> random{std::mt19937(8)};
            Manifold<S> m;
            Pose<S> Xb = pair.Xb;
            const typename S::Vec way = R(1e-4) * random.direction();
            double worst = 0;
            int left = 0;
            typename S::Vec last = S::Vec::Zero();
            for (int frame = 0; frame < 300; ++frame) {
                Xb.p += way + R(1e-5) * random.direction();
                Xb.q = compose(turn<S>(2e-4, 1e-4), Xb.q);
                Manifold<S> fresh;
                findNarrowPhase<S>(algorithm.name)(pair.a, pose<S>(vec<S>(0, 0, 0)), pair.b, Xb, R(0), m);
                findNarrowPhase<S>(algorithm.name)(pair.a, pose<S>(vec<S>(0, 0, 0)), pair.b, Xb, R(0), fresh);
                if (fresh.count == 0) break;
                ASSERT_GT(m.count, 0);
                worst = std::max(worst, leastSeparation(fresh) - leastSeparation(m));
                left += frame > 0 && (m.normal - last).norm() > 0.1;
                last = m.normal;
            }
            EXPECT_LE(worst, 1e-4 * size + sharp + curvedTolerance<S>(pair.a, pair.b));
            EXPECT_LE(left, 2);
        }
}

}  // namespace
}  // namespace rigor::engine::test
