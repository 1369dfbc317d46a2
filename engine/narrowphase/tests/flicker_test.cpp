// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Boxes that rest and rock on each other with noise in every frame: the normal may move with the noise, but
// not alternate between kinds of axes, and the points keep their number and, where the faces' corners are
// well apart, their names. (Where two ways out are equally deep the shortest one does jump: that is
// geometry.)
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

struct Rest {
    const char* name;
    double x, y, z;           ///< of the upper box [m]
    double yaw, pitch, roll;  ///< of the upper box [rad]
    double lower = 0;         ///< roll of the lower box [rad]
    double gain = 4;          ///< largest turn of the normal over the noise
    bool sameNames = true;
};
constexpr double kEdgeOn = std::numbers::pi / 4, kOverEdges = 2 * 0.70710678118654752 - 1e-3;
constexpr Rest kRests[] = {
    {"face on face", 0.1, 0.999, 0.05, 0, 0, 0},
    {"rocking by a thousandth", 0.1, 0.9992, 0.05, 0.2, 1e-3, 1e-3},
    {"rocking by a hundredth", 0.1, 0.9995, 0.05, 0.2, 1e-2, 0, 0, 6},
    // The normal across two edges is as well known as their angle allows.
    {"crossing edges", 0, kOverEdges, 0, 1.5707963, 0, kEdgeOn, kEdgeOn},
    {"near-parallel edges", 0, kOverEdges, 0, 0.02, 0, kEdgeOn, kEdgeOn, 4 / 0.02},
    // Eight corners are equally good for four places.
    {"face on turned face", 0.1, 0.999, 0.05, 0.3, 0, 0, 0, 4, false},
    {"face on the same face", 0, 0.9999, 0, 0, 0, 0, 0, 4, false},
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
    for (int i = 0; i < m.count; ++i) names.insert(m.points[static_cast<std::size_t>(i)].feature);
    return names;
}

template <class S>
class Flicker : public testing::Test {};
using Spaces = testing::Types<Space3f, Space3d>;
TYPED_TEST_SUITE(Flicker, Spaces);

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
                    Manifold<S> last;
                    int renamed = 0;
                    for (int frame = 0; frame < 300; ++frame) {
                        Pose<S> Xb = pose<S>(vec<S>(rest.x, rest.y, rest.z));
                        Xb.p += static_cast<R>(0.1 * noise) * random.direction();
                        const R angle = static_cast<R>(noise * random.uniform(-1, 1));
                        const Eigen::AngleAxis<R> shake(angle, random.direction());
                        Xb.q = compose(typename S::Rot(shake), settled);
                        Manifold<S> m;
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
                    if (rest.sameNames) {
                        EXPECT_EQ(renamed, 0);
                    }
                }
}

}  // namespace
}  // namespace rigor::engine::test
