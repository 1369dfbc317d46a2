// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Known wrong results of the libraries as shipped (Bullet 3.24, ODE 0.16.2, FCL 0.7.0, Box2D 2.4.1) are found
// by `rigor collide`, and only they: a library that changes in either direction is reported here.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cstdlib>
#include <set>

#include "validation/collide/collide.hpp"
#include "validation/collide/random_pairs.hpp"

namespace rigor::validation {
namespace {

using V = CollideVerdict;

constexpr const char *kBullet = "bullet", *kBulletMatched = "bullet:preset=matched",
                     *kBulletGjk = "bullet:box_margin=0,cylinder_margin=0,hull_margin=0,sat=off",
                     *kOde = "ode", *kBulletPairTest = "bullet:query_path=contact_pair_test",
                     *kFcl = "fcl:narrow_phase=libccd", *kFclCollide = "fcl:narrow_phase=libccd_collide",
                     *kFclIndep = "fcl:narrow_phase=indep", *kBox2d = "box2d";
constexpr const char* kSpecs[] = {kBullet,
                                  kBulletPairTest,
                                  kBulletMatched,
                                  kBulletGjk,
                                  kOde,
                                  kFcl,
                                  kFclCollide,
                                  kFclIndep,
                                  kBox2d,
                                  "rigor:narrow_phase=sat",
                                  "rigor:narrow_phase=gjk_epa",
                                  "rigor:narrow_phase=mpr"};

constexpr const char
    *kMargin = "the default margin of 0.04 m grows hulls and cones and rounds the corners of boxes",
    *kFudge = "the box-box test gives an edge contact 2e-4 of its depth more",
    *kEpa = "without margins and SAT, GJK and EPA end at a facet that is none where shapes are aligned",
    *kClip = "SAT clips edge against edge as if they were faces, and the clipped points lie too deep",
    *kPortal = "libccd's portal refinement takes the first way out it meets",
    *kSign = "FCL's own solver gives depths of the wrong sign, and often along another direction",
    *kZeroNormal = "FCL gives coinciding centres a normal of length zero";

struct Known {
    const char *name, *spec;
    V verdict;
    double signedDistance, angle;  ///< [m], [rad] from the nearest minimiser; as measured
    const char* reason;
};
const Known kKnown[] = {
    {"cubes_edge_edge", kBullet, V::WrongDepth, -0.10002, 0, kFudge},
    {"cubes_edge_edge", kBulletMatched, V::WrongDepth, -0.10002, 0, kFudge},
    {"cubes_edge_edge", kBulletPairTest, V::WrongDepth, -0.06686292, 5.976e-15, kMargin},
    {"cubes_edge_edge", kBulletGjk, V::WrongDepth, -0.10002, 0, kFudge},
    {"sphere_on_box_corner", kBullet, V::WrongDepth, -0.07071797, 7.85e-17, kMargin},
    {"sphere_on_box_corner", kBulletPairTest, V::WrongDepth, -0.07071797, 7.85e-17, kMargin},
    {"hull_cubes_aligned", kBullet, V::WrongDepth, -0.18, 1.395e-13, kMargin},
    {"hull_cubes_aligned", kBulletPairTest, V::WrongDepth, -0.18, 1.395e-13, kMargin},
    {"hull_cubes_aligned", kFclIndep, V::WrongDepth, 0.07071068, 0.7854, kSign},
    {"hull_cubes_aligned_mixed", kBullet, V::WrongDepth, -0.18, 2.647e-13, kMargin},
    {"hull_cubes_aligned_mixed", kBulletPairTest, V::WrongDepth, -0.18, 2.647e-13, kMargin},
    {"hull_cubes_aligned_mixed", kBulletGjk, V::WrongDepth, -0.05345225, 1.007, kEpa},
    {"hull_cubes_aligned_mixed", kFclIndep, V::WrongDepth, 0.07071068, 0.7854, kSign},
    {"hull_cubes_edge_on_face", kBullet, V::WrongDepth, -0.18, 6.095e-14, kMargin},
    {"hull_cubes_edge_on_face", kBulletPairTest, V::WrongDepth, -0.18, 6.095e-14, kMargin},
    {"hull_cubes_edge_on_face", kFclIndep, V::WrongDepth, 0.1, 0, kSign},
    {"hull_cubes_concentric", kBullet, V::WrongDepth, -1.08, 1.221e-13, kMargin},
    {"hull_cubes_concentric", kBulletPairTest, V::WrongDepth, -1.08, 1.221e-13, kMargin},
    {"hull_cubes_concentric", kBulletGjk, V::WrongDepth, -0.8164966, 0.6155, kEpa},
    {"hull_cubes_concentric", kFclIndep, V::WrongDepth, 0.5345225, 0.6405, kSign},
    {"cube_edge_on_cube", kBulletPairTest, V::WrongDepth, -0.08343146, 1.496e-12, kMargin},
    {"hull_on_plane", kBullet, V::WrongDepth, -0.14, 0, kMargin},
    {"hull_on_plane", kBulletPairTest, V::WrongDepth, -0.14, 0, kMargin},
    {"hull_on_box", kBullet, V::WrongDepth, -0.14, 1.402e-16, kMargin},
    {"hull_on_box", kBulletPairTest, V::WrongDepth, -0.14, 1.402e-16, kMargin},
    {"hull_on_box", kFclIndep, V::WrongDepth, 0.1, 0, kSign},
    {"capsule_lying_on_box", kFclIndep, V::WrongDepth, 0.2035903, 3.107, kSign},
    {"capsules_crossed", kFclIndep, V::WrongDepth, 0.1437018, 1.557, kSign},
    {"capsule_upright_on_box", kFclIndep, V::WrongDepth, 0.09999996, 5.38e-08, kSign},
    {"cylinders_side_by_side", kBulletGjk, V::WrongDepth, -0.0959683, 0.2849, kEpa},
    {"cylinders_side_by_side", kFclIndep, V::WrongDepth, 0.09999992, 0.001281, kSign},
    {"cylinder_upright_on_box", kFclIndep, V::WrongDepth, 0.1, 1.292e-16, kSign},
    {"cylinder_in_box", kFcl, V::WrongDepth, -1.067708, 0.7238, kPortal},
    {"cylinder_in_box", kFclCollide, V::WrongDepth, -1.067708, 0.7238, kPortal},
    {"cylinder_in_box", kFclIndep, V::WrongDepth, 0.8, 9.754e-09, kSign},
    {"cone_on_box", kBullet, V::WrongDepth, -0.14, 0, kMargin},
    {"cone_on_box", kBulletPairTest, V::WrongDepth, -0.14, 0, kMargin},
    {"cone_on_box", kFclIndep, V::WrongDepth, 0.1, 1.292e-16, kSign},
    {"spheres_concentric", kFcl, V::NoNormal, -1, 0, kZeroNormal},
    {"spheres_concentric", kFclCollide, V::NoNormal, -1, 0, kZeroNormal},
    {"spheres_concentric", kFclIndep, V::NoNormal, -1, 0, kZeroNormal},
    {"circles_concentric_2d", kFcl, V::NoNormal, -1, 0, kZeroNormal},
    {"circles_concentric_2d", kFclCollide, V::NoNormal, -1, 0, kZeroNormal},
    {"circles_concentric_2d", kFclIndep, V::NoNormal, -1, 0, kZeroNormal},
    {"hulls_portal_refinement", kBullet, V::WrongDepth, -0.5977623, 5.495e-16, kMargin},
    {"hulls_portal_refinement", kBulletMatched, V::WrongDepth, -0.5177376, 0.0002312, kClip},
    {"hulls_portal_refinement", kBulletPairTest, V::WrongDepth, -0.5977623, 5.495e-16, kMargin},
    {"hulls_portal_refinement", kOde, V::WrongDepth, -0.9645865, 1.162, kPortal},
    {"hulls_portal_refinement", kFclCollide, V::WrongDepth, -0.9645865, 1.162, kPortal},
    {"hulls_portal_refinement", kFclIndep, V::WrongDepth, 0.5177623, 0.7375, kSign},
    {"hulls_clipped_too_deep", kBullet, V::WrongDepth, -0.3245923, 8.567e-13, kMargin},
    {"hulls_clipped_too_deep", kBulletMatched, V::WrongDepth, -0.2665907, 0.0001761, kClip},
    {"hulls_clipped_too_deep", kBulletPairTest, V::WrongDepth, -0.3245923, 8.567e-13, kMargin},
    {"hulls_clipped_too_deep", kOde, V::WrongDepth, -0.2529779, 0.2605, kPortal},
    {"hulls_clipped_too_deep", kFclCollide, V::WrongDepth, -0.2529779, 0.2605, kPortal},
    {"hulls_clipped_too_deep", kFclIndep, V::WrongDepth, 0.1784548, 0.6243, kSign},
};

/// Fewer contacts than a flat face or a line needs to rest: not wrong by itself, so not in the verdict.
struct Contacts {
    const char *name, *spec;
    int count;
};
const Contacts kContacts[] = {
    {"cube_on_plane", kBullet, 1},
    {"cube_on_plane", kBulletMatched, 1},
    {"cube_on_plane", kBulletPairTest, 1},
    {"cube_on_plane", kBulletGjk, 1},
    {"cube_on_plane", kOde, 4},
    {"cube_on_plane", kFcl, 1},
    {"cube_on_plane", kFclCollide, 1},
    {"cube_on_plane", kFclIndep, 1},
    {"hull_on_box", kBullet, 1},
    {"hull_on_box", kBulletMatched, 4},
    {"hull_on_box", kBulletPairTest, 1},
    {"hull_on_box", kBulletGjk, 1},
    {"hull_on_box", kOde, 1},
    {"hull_on_box", kFcl, 1},
    {"hull_on_box", kFclCollide, 1},
    {"hull_on_box", kFclIndep, 1},
    {"capsule_lying_on_box", kBullet, 1},
    {"capsule_lying_on_box", kBulletMatched, 1},
    {"capsule_lying_on_box", kBulletPairTest, 1},
    {"capsule_lying_on_box", kBulletGjk, 1},
    {"capsule_lying_on_box", kOde, 1},
    {"capsule_lying_on_box", kFcl, 1},
    {"capsule_lying_on_box", kFclCollide, 1},
    {"capsule_lying_on_box", kFclIndep, 1},
};

/// The in-house narrow phases on pairs of every kind and shape.
TEST(InHouse, IsRightOnRandomPairs) {
    setenv("RIGOR_ADAPTER_PATH", (std::string(RIGOR_BINARY_DIR) + "/bin/adapters").c_str(), 1);
    CollideOptions options;
    options.binary = std::string(RIGOR_BINARY_DIR) + "/bin/rigor";
    const std::atomic<bool> never{false};
    for (int dimension : {2, 3}) {
        const auto file = makeRandomPairs({660, 17, dimension, {}, {}, {}});
        const auto run =
            runCollide({file}, adapter::parseSpecList("rigor:narrow_phase=sat,rigor:narrow_phase=gjk_epa"),
                       options, {}, never);
        for (const CollideCase& c : run.cases)
            for (const CollideAnswer& a : c.answers)
                EXPECT_EQ(a.verdict, V::Ok) << collideVerdictName(a.verdict) << " " << c.query.text;
    }
}

class KnownWrongAnswers : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Specs, KnownWrongAnswers, testing::ValuesIn(kSpecs), [](const auto& instance) {
    std::string name = instance.param;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
});

TEST_P(KnownWrongAnswers, AreFoundAndNoOthers) {
    setenv("RIGOR_ADAPTER_PATH", (std::string(RIGOR_BINARY_DIR) + "/bin/adapters").c_str(), 1);
    const auto spec = adapter::parseSpec(GetParam());
    const auto built = adapter::availableEngines();
    if (std::find(built.begin(), built.end(), spec.engine) == built.end())
        GTEST_SKIP() << spec.engine << " is not built";
    CollideOptions options;
    options.binary = std::string(RIGOR_BINARY_DIR) + "/bin/rigor";
    const auto file = scenario::loadCollisionFile(scenario::findCollisionFile("known_wrong_answers"));
    const std::atomic<bool> never{false};
    const auto run = runCollide({file}, {spec}, options, {}, never);
    std::set<std::string> met;
    for (const CollideCase& c : run.cases) {
        SCOPED_TRACE(c.query.name + ", " + GetParam());
        EXPECT_EQ(c.truth.conflict, "");
        const CollideAnswer& a = c.answers.front();
        const auto isThis = [&](const auto& row) {
            return c.query.name == row.name && spec.text() == row.spec;
        };
        const auto known = std::find_if(std::begin(kKnown), std::end(kKnown), isThis);
        if (known == std::end(kKnown)) {
            EXPECT_TRUE(a.verdict == V::Ok || a.verdict == V::Unsupported)
                << "a new wrong result: " << collideVerdictName(a.verdict) << ", "
                << a.signedDistance.value_or(0) << " m";
        } else {
            EXPECT_EQ(a.verdict, known->verdict)
                << "the library has changed; it was known that " << known->reason;
            EXPECT_NEAR(a.signedDistance.value_or(1e300), known->signedDistance, 1e-5) << known->reason;
            EXPECT_NEAR(a.normalAngle.value_or(0), known->angle, 1e-3) << known->reason;
        }
        const auto contacts = std::find_if(std::begin(kContacts), std::end(kContacts), isThis);
        if (contacts != std::end(kContacts)) {
            EXPECT_EQ(a.contacts, contacts->count);
        }
        if (spec.engine == "rigor" && c.query.tags.front() == "contacts") {
            EXPECT_GE(a.contacts, c.query.name == "capsule_lying_on_box" ? 2 : 4);
        }
        met.insert(c.query.name);
    }
    for (const Known& k : kKnown) EXPECT_EQ(met.count(k.name), 1u) << k.name;
    for (const Contacts& k : kContacts) EXPECT_EQ(met.count(k.name), 1u) << k.name;
}

}  // namespace
}  // namespace rigor::validation
