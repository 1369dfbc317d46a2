// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Lines and points of a world: they lie on the shapes, and say what the world says.
#include "engine/embedding/debug_lines.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <regex>

#include "engine/embedding/svg_lines.hpp"
#include "engine/pipeline/tests/scene.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class DebugLinesTest : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(DebugLinesTest, Spaces);

template <class S>
struct Collected final : LineSink<S> {
    using Vec = typename S::Vec;
    struct Line {
        Vec from, to;
        BodyId body;
    };
    std::map<DebugKind, std::vector<Line>> lines;
    std::map<DebugKind, std::vector<Vec>> points;
    void line(const Vec& from, const Vec& to, DebugKind kind, BodyId body) override {
        lines[kind].push_back({from, to, body});
    }
    void point(const Vec& at, DebugKind kind, BodyId) override { points[kind].push_back(at); }
};

template <class S>
Collected<S> outlineOf(const Shape<S>& shape, const Pose<S>& pose = {}) {
    Collected<S> sink;
    drawShape<S>(shape, pose, BodyId{3, 0}, DebugOptions<S>{}, sink);
    return sink;
}

/// All ends of lines lie on the surface: the support along the way out of the shape's middle is no nearer.
template <class S>
void expectOnSurface(const Shape<S>& shape, double tolerance) {
    Pose<S> pose;
    pose.p = at<S>(2, -1);
    pose.q = rotatedBy(pose.q, spin<S>(0.4));
    const Aabb<S> box = boundingBox<S>(shape, pose);
    typename S::Vec low = S::Vec::Constant(100), high = S::Vec::Constant(-100);
    Collected<S> drawn = outlineOf<S>(shape, pose);
    for (const auto& line : drawn.lines[DebugKind::Outline]) {
        EXPECT_EQ(line.body, (BodyId{3, 0}));
        for (const auto& end : {line.from, line.to}) {
            low = low.cwiseMin(end);
            high = high.cwiseMax(end);
        }
    }
    const auto off = static_cast<typename S::Real>(tolerance);
    EXPECT_TRUE((low.array() >= box.min.array() - off).all() && (high.array() <= box.max.array() + off).all())
        << shapeName<S>(shape) << ": nothing is outside";
    // Circles of 24 pieces miss a box by up to 1 - cos(pi / 24) of their radius.
    EXPECT_LT((low - box.min).norm() + (high - box.max).norm(), typename S::Real(0.05))
        << shapeName<S>(shape);
}

TYPED_TEST(DebugLinesTest, OutlinesFillTheBoundsOfTheirShapes) {
    using S = TypeParam;
    using R = typename S::Real;
    expectOnSurface<S>(Sphere<S>{R(0.5)}, 1e-5);
    expectOnSurface<S>(Box<S>{S::Vec::Constant(R(0.3))}, 1e-5);
    expectOnSurface<S>(Capsule<S>{R(0.2), R(0.4)}, 1e-5);
    std::vector<typename S::Vec> points;
    for (int i = 0; i < 12; ++i) {
        typename S::Vec p = S::Vec::Zero();
        for (int k = 0; k < S::dim; ++k) p[k] = R(0.5) * R(std::sin(1.0 + 2.1 * i + 1.7 * k * i));
        points.push_back(p);
    }
    expectOnSurface<S>(makeHull<S>(points), 1e-5);
    if constexpr (S::dim == 3) {
        expectOnSurface<S>(Cylinder<S>{R(0.3), R(0.5)}, 1e-5);
        expectOnSurface<S>(Cone<S>{R(0.3), R(0.5)}, 1e-5);
        expectOnSurface<S>(Ellipsoid<S>{{R(0.5), R(0.2), R(0.3)}}, 1e-5);
    }
}

TYPED_TEST(DebugLinesTest, EdgesAreDrawnOnce) {
    using S = TypeParam;
    using R = typename S::Real;
    auto lines = outlineOf<S>(Box<S>{S::Vec::Constant(R(0.5))}).lines[DebugKind::Outline];
    EXPECT_EQ(lines.size(), S::dim == 2 ? 4u : 12u);
    for (const auto& line : lines) EXPECT_NEAR((line.to - line.from).norm(), R(1), R(1e-6));
    if constexpr (S::dim == 3) {
        const std::vector<typename S::Vec> corners{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}};
        const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 2, 1}, {1, 2, 3}};
        const auto mesh = makeTriangleMesh<S>(corners, triangles);
        EXPECT_EQ(outlineOf<S>(mesh).lines[DebugKind::Outline].size(), 5u) << "four sides and a diagonal";
    }
}

/// A box at rest on another: its contacts carry it, and lines show so.
TYPED_TEST(DebugLinesTest, ContactsImpulsesAndVelocitiesAreThoseOfTheWorld) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    const std::uint32_t stone = world.addMaterial(R(0.5), R(0));
    addGround<S>(world, stone);
    const BodyId box = addCube<S>(world, 0, 0.5, 0.5, 2, stone);
    const BodyId ball = addBall<S>(world, 5, 5, 0.25, 1, stone);
    JointDef<S> rod;
    rod.bodyB = ball;
    rod.anchorA = at<S>(5, 6);
    rod.anchorB = at<S>(0, 1);
    world.addJoint(rod);
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    world.setVelocity(ball, at<S>(4, 0), spin<S>(0));

    DebugOptions<S> options;
    options.boxes = options.impulses = options.velocities = options.islands = true;
    options.impulseScale = 10;
    Collected<S> sink;
    drawWorld<S>(world, options, sink);
    std::vector<ContactView<S>> contacts;
    world.readContacts(contacts);
    ASSERT_FALSE(contacts.empty());
    EXPECT_EQ(sink.points[DebugKind::Contact].size(), contacts.size());
    EXPECT_EQ(sink.lines[DebugKind::Normal].size(), contacts.size());
    for (const auto& line : sink.lines[DebugKind::Normal])
        EXPECT_LT((line.to - line.from - at<S>(0, 0.2)).norm(), R(1e-5)) << "up, out of the ground";
    R load = 0;
    for (const auto& line : sink.lines[DebugKind::Impulse]) load += line.to[1] - line.from[1];
    EXPECT_NEAR(load, R(10 * 2 * kGravity / 60), R(2e-3));
    const auto& fast = sink.lines[DebugKind::Velocity];
    ASSERT_FALSE(fast.empty());
    EXPECT_EQ(fast.back().body, ball);
    EXPECT_LT((fast.back().to - fast.back().from - at<S>(0.4, 0)).norm(), R(1e-5));
    ASSERT_GE(sink.lines[DebugKind::Joint].size(), 1u);
    EXPECT_LT((sink.lines[DebugKind::Joint][0].to - at<S>(5, 6)).norm(), R(1e-3));
    for (std::size_t i = 1; i < sink.lines[DebugKind::Joint].size(); ++i)
        EXPECT_LT((sink.lines[DebugKind::Joint][i].to - at<S>(5, 6)).norm(), R(1e-3)) << "the drift";
    EXPECT_EQ(sink.lines[DebugKind::Box].size(), S::dim == 2 ? 8u : 24u) << "the box and the ball";
    for (const auto& line : sink.lines[DebugKind::Island])
        EXPECT_LT((line.to - line.from).norm(), R(1e-5)) << "islands of one body";
    EXPECT_EQ(sink.lines[DebugKind::Island].size(), 2u);
    EXPECT_EQ(sink.lines[DebugKind::Outline].front().body, world.bodies().front());
    (void)box;

    options = {};
    options.outlines = options.contacts = options.normals = options.joints = false;
    Collected<S> nothing;
    drawWorld<S>(world, options, nothing);
    EXPECT_TRUE(nothing.lines.empty() && nothing.points.empty());
}

/// A rope is seen: the line between the anchors of its joint.
TYPED_TEST(DebugLinesTest, ADistanceJointIsALineBetweenItsAnchors) {
    using S = TypeParam;
    World<S> world(earth<S>());
    JointDef<S> rope;
    rope.type = JointType::Distance;
    rope.bodyB = addBall<S>(world, 5, 5, 0.25, 1, 0);
    rope.anchorA = at<S>(5, 8);
    rope.length = 3;
    world.addJoint(rope);
    Collected<S> sink;
    drawWorld<S>(world, {}, sink);
    const auto& lines = sink.lines[DebugKind::Joint];
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[1].from, at<S>(5, 8));
    EXPECT_EQ(lines[1].to, at<S>(5, 5));
    ASSERT_EQ(sink.points[DebugKind::Joint].size(), 1u);
}

/// The picture has all of it, inside its frame.
TYPED_TEST(DebugLinesTest, APictureHoldsAllLines) {
    using S = TypeParam;
    using R = typename S::Real;
    SvgLines<S> picture;
    EXPECT_NE(picture.text().find("</svg>"), std::string::npos) << "nothing drawn is a picture too";
    drawShape<S>(Box<S>{S::Vec::Constant(R(0.5))}, {}, {}, DebugOptions<S>{}, picture);
    picture.point(at<S>(3, 0), DebugKind::Contact, {});
    const std::string text = picture.text(400);
    const std::regex place(" (x1|x2|cx)=\"([-0-9.]+)\""), tag("<line |<circle ");
    int strokes = 0;
    for (std::sregex_iterator i(text.begin(), text.end(), tag), end; i != end; ++i) ++strokes;
    EXPECT_EQ(strokes, S::dim == 2 ? 5 : 13);
    double least = 1e9, most = -1e9;
    for (std::sregex_iterator i(text.begin(), text.end(), place), end; i != end; ++i) {
        least = std::min(least, std::stod((*i)[2]));
        most = std::max(most, std::stod((*i)[2]));
    }
    EXPECT_NEAR(least, 12, 0.02);
    EXPECT_NEAR(most, 388, 0.02);
    EXPECT_NE(text.find("class=\"contact\""), std::string::npos);
}

}  // namespace
}  // namespace rigor::engine::test
