// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The instant that contacts belong to: the start of the step or its end, as the world says. Bodies move by a good part of
// their size in a step, so that points and normals show the poses they belong to.
#include <algorithm>
#include <cmath>

#include "adapters/conformance/kit.hpp"

namespace rigor::conformance {
namespace {

constexpr double kStep = 1.0 / 60.0;

/// Distance of a point from the surface of a shape at the origin of its body [m].
double surfaceDistance(const Geometry& geometry, const Pose& pose, const Vec3& point, bool planar) {
    const Vec3 p = inverse(pose) * point;
    if (const auto* ball = std::get_if<scenario::Sphere>(&geometry)) return std::abs(norm(p) - ball->radius);
    const Vec3& half = std::get<scenario::Box>(geometry).halfExtents;
    const double outside =
        std::max({std::abs(p.x) - half.x, std::abs(p.y) - half.y, planar ? -1.0 : std::abs(p.z) - half.z});
    return std::abs(outside);
}

double normalAngle(const Vec3& a, const Vec3& b) {
    return std::atan2(norm(cross(a, b)), dot(a, b));
}

Pose poseOf(const BodyState& state) {
    return {state.position, state.orientation};
}

class ContactInstant : public DynamicsTest {
  protected:
    void SetUp() override {
        if (!hasShape("box") || !hasShape(is2d() ? "circle" : "sphere"))
            GTEST_SKIP() << "no boxes and balls to touch";
    }

    struct Seen {
        std::size_t contacts = 0;
        double surface = 0.0;  ///< largest distance of a point from its surface, at the contacts' instant [m]
        double surfaceElsewhere = 0.0;  ///< the same at the other end of the step
        double normal = 0.0;            ///< largest angle to the nearest of what `normals` gives [rad]
        double apart = 0.0;  ///< distance of the two bodies' origins at the instant of the last step [m]
    };
    using Normals = std::vector<Vec3> (*)(const Pose& a, const Pose& b);

    /// Steps a world, and holds every contact against the poses that it belongs to. Body 0 is A.
    Seen look(const Scenario& s, int steps, Normals normals) const {
        Seen seen;
        auto world = build(s, kStep);
        const bool atEnd = world->contactInstant() == adapter::ContactInstant::StepEnd;
        std::vector<BodyState> before(s.bodies.size()), after(s.bodies.size());
        world->readStates(after);
        for (int i = 0; i < steps; ++i) {
            before.swap(after);
            world->step();
            world->readStates(after);
            const std::vector<BodyState>&at = atEnd ? after : before, &other = atEnd ? before : after;
            const Pose a0 = poseOf(at[0]), b0 = poseOf(at[1]);
            seen.apart = norm(b0.position - a0.position);
            for (const ContactPoint& c : contactsOf(*world)) {
                ++seen.contacts;
                const auto off = [&](const Pose& a, const Pose& b) {
                    return std::max(surfaceDistance(s.bodies[0].shapes[0].geometry, a, c.pointA, is2d()),
                                    surfaceDistance(s.bodies[1].shapes[0].geometry, b, c.pointB, is2d()));
                };
                seen.surface = std::max(seen.surface, off(a0, b0));
                seen.surfaceElsewhere =
                    std::max(seen.surfaceElsewhere, off(poseOf(other[0]), poseOf(other[1])));
                double nearest = kPi;
                for (const Vec3& n : normals(a0, b0)) nearest = std::min(nearest, normalAngle(n, c.normal));
                seen.normal = std::max(seen.normal, nearest);
            }
        }
        return seen;
    }
};
INSTANTIATE_TEST_SUITE_P(Kit, ContactInstant, testing::ValuesIn(dynamicsArenas()), arenaName);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ContactInstant);

std::vector<Vec3> upOfA(const Pose& a, const Pose&) {
    return {rotate(a.orientation, {0, 1, 0})};
}
std::vector<Vec3> alongCenters(const Pose& a, const Pose& b) {
    const Vec3 apart = b.position - a.position;
    return {apart / norm(apart)};
}
/// Normals of the plank's top and of all faces of the box on it.
std::vector<Vec3> facesOfEither(const Pose& a, const Pose& b) {
    std::vector<Vec3> all = upOfA(a, b);
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
        for (const double sign : {-1.0, 1.0}) all.push_back(sign * rotate(b.orientation, axis));
    return all;
}

/// 0.33 m a step over a floor: two thirds of its radius.
TEST_P(ContactInstant, PointsOfABallThatSlidesLieWhereItIsThen) {
    Scenario s = scene();
    s.gravity = {0, -9.81, 0};
    addStatic(s, block({20, 1, 20}), {0, -1, 0});
    addBody(s, ball(0.5), {0, 0.499, 0}, 1.0, {0.1, 0.1, 0.1});
    s.bodies[1].velocity = {20, 0, 0};
    const Seen seen = look(s, 30, upOfA);
    EXPECT_GT(seen.contacts, 10u);
    within("instant_slide_points", seen.surface, 2e-3);
    within("instant_slide_normal", seen.normal, 1e-3);
    EXPECT_GT(std::max(seen.surface, seen.surfaceElsewhere), 0.05)
        << "this scene would not distinguish the instants";
}

/// The line between the centres turns by a third of a radian in the step. The balls overlap at its start; where contacts
/// belong to its end, one that has left by then need not be there.
TEST_P(ContactInstant, NormalsOfABallThatPassesAreThoseOfTheInstant) {
    for (const double ahead : {-0.2, 0.0, 0.2}) {
        SCOPED_TRACE("from x = " + std::to_string(ahead));
        Scenario s = scene();
        addStatic(s, ball(0.5), {});
        addBody(s, ball(0.25), {ahead, std::sqrt(0.745 * 0.745 - ahead * ahead), 0.0});
        s.bodies[1].velocity = {15, 0, 0};
        const Seen seen = look(s, 1, alongCenters);
        within("instant_pass_found", seen.contacts > 0u || seen.apart > 0.75 ? 0.0 : 1.0, 0.0);
        within("instant_pass_points", seen.surface, 2e-3);
        within("instant_pass_normal", seen.normal, 1e-3);
    }
}

/// A plank that turns by 0.05 rad a step under a ball, and under a box: there the points of a manifold that
/// is kept from step to step show whether their normal was kept as well.
TEST_P(ContactInstant, NormalsOnAPlankThatTurnsTurnWithIt) {
    if (!engine().capabilities().kinematicBodies) GTEST_SKIP() << "no kinematic bodies";
    for (const bool boxed : {false, true}) {
        SCOPED_TRACE(boxed ? "a box" : "a ball");
        Scenario s = scene(1.0);
        s.gravity = {0, -9.81, 0};
        addBody(s, block({3.0, 0.2, 3.0}), {});
        s.bodies[0].type = BodyType::Kinematic;
        s.bodies[0].angularVelocity = {0, 0, 3};
        addBody(s, boxed ? block({0.3, 0.3, 0.3}) : ball(0.3), {1.0, 0.499, 0.0}, 1.0, {0.04, 0.04, 0.04});
        const Seen seen = look(s, 12, boxed ? facesOfEither : upOfA);
        EXPECT_GT(seen.contacts, 4u);
        const std::string what = boxed ? "box" : "ball";
        within("instant_plank_points_" + what, seen.surface, 2e-3);
        within("instant_plank_normal_" + what, seen.normal, 2e-3);
    }
}

/// 1.2 m a step at a wall 0.4 m ahead: an engine that stops the sphere there has found the contact within the
/// step, and reports it as of its start or end.
TEST_P(ContactInstant, PointsOfAnImpactWithinAStepLieWhereTheBodiesAreThen) {
    Scenario s = scene();
    addStatic(s, block({0.05, 2, 2}), {0.5, 0, 0});
    addBody(s, ball(0.1), {0, 0, 0}, 1.0, {0.004, 0.004, 0.004});
    s.bodies[1].velocity = {72, 0, 0};
    const Seen seen = look(s, 6, [](const Pose&, const Pose&) {
        return std::vector<Vec3>{{-1, 0, 0}, {1, 0, 0}};
    });
    within("instant_impact_points", seen.surface, 5e-3);
    within("instant_impact_normal", seen.normal, 1e-3);
}

}  // namespace
}  // namespace rigor::conformance
