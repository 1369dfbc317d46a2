// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cylinders and cones at rest and rolling; bodies on chains, meshes and height fields: no bumps at inner
// edges, rest in hollows, and what is refused.
#include <gtest/gtest.h>

#include <numbers>

#include "engine/narrowphase/narrowphases.hpp"
#include "engine/pipeline/tests/scene.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine::test {
namespace {

constexpr double kPi = std::numbers::pi;

template <class S>
BodyId addSolid(World<S>& world, const Shape<S>& shape, const typename S::Vec& p, const typename S::Rot& q,
                double mass, std::uint32_t material, const typename S::Vec& v = S::Vec::Zero()) {
    using R = typename S::Real;
    MassProperties<S> m = massProperties<S>(shape, R(1));
    const R scale = static_cast<R>(mass) / m.mass;
    BodyDef<S> def;
    def.mass = static_cast<R>(mass);
    def.centerOfMass = m.center;
    def.inertia = m.inertia * scale;
    def.pose.p = p;
    def.pose.q = q;
    def.velocity = v;
    const BodyId id = world.addBody(def);
    attach<S>(world, id, shape, material);
    return id;
}
template <class S>
BodyId addSurface(World<S>& world, const Shape<S>& shape, std::uint32_t material) {
    BodyDef<S> def;
    def.type = BodyType::Static;
    const BodyId id = world.addBody(def);
    attach<S>(world, id, shape, material);
    return id;
}
template <class S>
typename S::Rot turned(double angle) {
    using R = typename S::Real;
    if constexpr (S::dim == 2)
        return S::Rot::fromAngle(static_cast<R>(angle));
    else
        return typename S::Rot(Eigen::AngleAxis<R>(static_cast<R>(angle), S::Vec::UnitZ()));
}

/// y = 0 in pieces of about 0.3 m, from x = -2 on.
template <class S>
std::vector<Shape<S>> flatFloors() {
    using R = typename S::Real;
    if constexpr (S::dim == 2) {
        std::vector<typename S::Vec> v;
        for (int i = 0; i <= 40; ++i) v.push_back(at<S>(-2 + 0.31 * i, 0));
        return {makeChain<S>(v, false)};
    } else {
        std::vector<typename S::Vec> v;
        std::vector<std::array<std::uint32_t, 3>> t;
        for (int k = 0; k <= 8; ++k)
            for (int i = 0; i <= 40; ++i)
                v.push_back({R(-2 + 0.31 * i + 0.05 * (k % 3)), R(0), R(0.29 * (k - 4) + 0.04 * (i % 2))});
        for (std::uint32_t k = 0; k < 8; ++k)
            for (std::uint32_t i = 0; i < 40; ++i) {
                const std::uint32_t a = 41 * k + i;
                t.push_back({a, a + 41, a + 1});
                t.push_back({a + 1, a + 41, a + 42});
            }
        return {makeTriangleMesh<S>(v, t),
                makeHeightField<S>(81, 9, R(0.31), R(0.29), std::vector<R>(81 * 9, R(0)), R(1))};
    }
}

double energyOf(const World<Space3d>& world, const std::vector<BodyId>& bodies) {
    double energy = 0;
    for (const BodyId b : bodies) {
        const auto& c = world.constants(b);
        const auto R = toMatrix(world.pose(b).q);
        const Eigen::Vector3d w = R.transpose() * world.angularVelocity(b);
        energy += 0.5 * c.mass * world.velocity(b).squaredNorm() + 0.5 * w.dot(c.inertia * w);
        energy += c.mass * kGravity * toWorld<Space3d>(world.pose(b), c.centerOfMass).y();
    }
    return energy;
}

/// Five seconds on a floor, a table, and a cylinder, whichever algorithm finds the contacts: nothing moves,
/// nothing gains energy.
class RoundShapesAtRest : public testing::TestWithParam<const char*> {};
TEST_P(RoundShapesAtRest, StandAndLieStill) {
    using S = Space3d;
    const Shape<S> cylinder = Cylinder<S>{0.25, 0.3}, cone = Cone<S>{0.3, 0.3};
    const double half = std::atan(0.5);
    struct Case {
        const char* name;
        Shape<S> shape;
        double height, angle;
    };
    const Case cases[] = {{"standing cylinder", cylinder, 0.3, 0},
                          {"lying cylinder", cylinder, 0.25, kPi / 2},
                          {"cone on its base", cone, 0.3, 0},
                          {"cone on its side", cone, 0.15 * std::cos(half), kPi / 2 + half}};
    for (const Case& c : cases)
        for (const std::string ground : {"half-space", "box", "cylinder", "mesh"}) {
            SCOPED_TRACE(std::string(c.name) + " on " + ground);
            WorldDef<S> settings = earth<S>();
            settings.narrowPhase = GetParam();
            World<S> world(settings);
            const std::uint32_t material = world.addMaterial(0.5, 0);
            if (ground == "half-space") addGround<S>(world, material);
            if (ground == "mesh") addSurface<S>(world, flatFloors<S>()[0], material);
            if (ground == "box" || ground == "cylinder") {
                BodyDef<S> def;
                def.type = BodyType::Static;
                def.pose.p.y() = -1;
                const BodyId id = world.addBody(def);
                const Shape<S> top =
                    ground == "box" ? Shape<S>(Box<S>{{2, 1, 2}}) : Shape<S>(Cylinder<S>{2, 1});
                attach<S>(world, id, top, material);
            }
            const auto body =
                addSolid<S>(world, c.shape, {0.1, c.height - 1e-5, 0.05}, turned<S>(c.angle), 1, material);
            const Eigen::Vector3d start = world.pose(body).p;
            const double before = energyOf(world, {body});
            for (int i = 0; i < 300; ++i) world.step(1.0 / 60);
            EXPECT_LE((world.pose(body).p - start).norm(), 2e-5);
            EXPECT_LE(world.velocity(body).norm(), 1e-6);
            EXPECT_LE(energyOf(world, {body}), before + 2e-4 * kGravity);
        }
}

/// A tower of four cylinders.
TEST_P(RoundShapesAtRest, CylindersStack) {
    using S = Space3d;
    WorldDef<S> settings = earth<S>();
    settings.narrowPhase = GetParam();
    World<S> world(settings);
    const std::uint32_t material = world.addMaterial(0.5, 0);
    addGround<S>(world, material);
    std::vector<BodyId> bodies;
    for (int i = 0; i < 4; ++i)
        bodies.push_back(addSolid<S>(world, Cylinder<S>{0.25, 0.2}, {0.03 * (i % 2), 0.2 + 0.4 * i, 0},
                                     Pose<S>::identityRot(), 1, material));
    for (int i = 0; i < 600; ++i) world.step(1.0 / 60);
    for (int i = 0; i < 4; ++i) {
        const Pose<S> X = world.pose(bodies[i]);
        EXPECT_NEAR(X.p.x(), 0.03 * (i % 2), 1e-3);
        EXPECT_NEAR(X.p.y(), 0.2 + 0.4 * i, 5e-4);
        EXPECT_GT(rotate(X.q, Eigen::Vector3d(Eigen::Vector3d::UnitY())).y(), 1 - 1e-6);
    }
}

std::vector<const char*> narrowPhaseNames() {
    std::vector<const char*> names;
    for (const NarrowPhaseEntry& entry : narrowPhases()) names.push_back(entry.name);
    return names;
}
INSTANTIATE_TEST_SUITE_P(NarrowPhases, RoundShapesAtRest, testing::ValuesIn(narrowPhaseNames()),
                         [](const auto& name) { return std::string(name.param); });

/// v = v0 without slip for ever; from sliding, 2/3 v0 (I = m r^2 / 2).
TEST(RoundShapes, LyingCylinderRolls) {
    using S = Space3d;
    const Eigen::Quaterniond lying(Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitX()));
    for (const bool onMesh : {false, true}) {
        World<S> world(earth<S>());
        const std::uint32_t material = world.addMaterial(0.4, 0);
        if (onMesh)
            addSurface<S>(world, flatFloors<S>()[0], material);
        else
            addGround<S>(world, material);
        const auto body =
            addSolid<S>(world, Cylinder<S>{0.25, 0.3}, {-1, 0.25, 0}, lying, 1, material, {1.5, 0, 0});
        for (int i = 0; i < 480; ++i) world.step(1.0 / 240);
        EXPECT_NEAR(world.velocity(body).x(), 1.0, 5e-3) << onMesh;
        EXPECT_NEAR(world.angularVelocity(body).z(), -4.0, 2e-2);
        EXPECT_NEAR(world.velocity(body).y(), 0, 1e-3);
        EXPECT_NEAR(world.pose(body).p.y(), 0.25, 1e-4);
        EXPECT_NEAR(world.pose(body).p.z(), 0, 1e-3);
    }
}

template <class S>
class OnSurfaces : public testing::Test {};
using OnSurfacesSpaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(OnSurfaces, OnSurfacesSpaces);

/// A box slides to rest over a dozen inner edges exactly as over a half-space: v^2 / (2 mu g), no bump.
TYPED_TEST(OnSurfaces, BoxSlidesOverInnerEdges) {
    using S = TypeParam;
    using R = typename S::Real;
    const auto run = [](const Shape<S>* surface) {
        World<S> world(earth<S>());
        const std::uint32_t material = world.addMaterial(R(0.3), 0);
        if (surface)
            addSurface<S>(world, *surface, material);
        else
            addGround<S>(world, material);
        typename S::Vec half = S::Vec::Constant(R(0.25));
        half.y() = R(0.1);
        const auto body = addSolid<S>(world, Box<S>{half}, at<S>(-1, 0.1), Pose<S>::identityRot(), 2,
                                      material, at<S>(4, 0));
        double highest = 0, tilt = 0;
        for (int i = 0; i < 480; ++i) {
            world.step(R(1) / 240);
            highest = std::max(highest, std::abs(static_cast<double>(world.pose(body).p.y()) - 0.1));
            tilt = std::max(tilt, std::abs(spinOf<S>(world.angularVelocity(body))));
        }
        return std::array<double, 4>{static_cast<double>(world.pose(body).p.x()), highest, tilt,
                                     static_cast<double>(world.velocity(body).norm())};
    };
    const auto smooth = run(nullptr);
    EXPECT_NEAR(smooth[0], -1 + 16 / (2 * 0.3 * kGravity), 0.02);
    for (const Shape<S>& surface : flatFloors<S>()) {
        SCOPED_TRACE(shapeName<S>(surface));
        const auto pieces = run(&surface);
        EXPECT_NEAR(pieces[0], smooth[0], tol<S>(2e-3, 1e-2));
        EXPECT_LE(pieces[1], 1e-4) << "lifted";
        EXPECT_LE(pieces[2], tol<S>(1e-2, 5e-2)) << "tipped";
        EXPECT_LE(pieces[3], tol<S>(1e-6, 1e-3)) << "still moving";
    }
}

/// A sphere without friction keeps its speed over inner edges to rounding.
TYPED_TEST(OnSurfaces, BallKeepsItsSpeed) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const Shape<S>& surface : flatFloors<S>()) {
        World<S> world(earth<S>());
        const std::uint32_t material = world.addMaterial(0, 0);
        addSurface<S>(world, surface, material);
        const auto body = addBall<S>(world, -1, 0.2, 0.2, 1, material, 3);
        for (int i = 0; i < 480; ++i) {
            world.step(R(1) / 240);
            EXPECT_NEAR(static_cast<double>(world.velocity(body)[1]), 0, tol<S>(1e-4, 5e-3));
        }
        EXPECT_NEAR(static_cast<double>(world.velocity(body)[0]), 3, tol<S>(1e-9, 1e-4))
            << shapeName<S>(surface);
        EXPECT_NEAR(static_cast<double>(world.pose(body).p[1]), 0.2, 2e-5 + 1e-5);
    }
}

/// V-shaped hollow with slopes of 45 degrees: a sphere comes to rest sqrt(2) r over its bottom.
TYPED_TEST(OnSurfaces, BallRestsInAHollow) {
    using S = TypeParam;
    using R = typename S::Real;
    std::vector<Shape<S>> hollows;
    if constexpr (S::dim == 2) {
        const typename S::Vec v[] = {at<S>(-2, 2), at<S>(-1, 1), at<S>(0, 0), at<S>(1, 1), at<S>(2, 2)};
        hollows.push_back(makeChain<S>(v, false));
    } else {
        std::vector<R> heights;
        for (int k = 0; k < 3; ++k)
            for (const double h : {2, 1, 0, 1, 2}) heights.push_back(R(h));
        hollows.push_back(makeHeightField<S>(5, 3, R(1), R(1), heights, R(1)));
    }
    for (const Shape<S>& hollow : hollows) {
        World<S> world(earth<S>());
        const std::uint32_t material = world.addMaterial(R(0.4), 0);
        addSurface<S>(world, hollow, material);
        const auto body = addBall<S>(world, 0.1, 0.6, 0.3, 1, material);
        for (int i = 0; i < 2400; ++i) world.step(R(1) / 240);
        EXPECT_NEAR(static_cast<double>(world.pose(body).p[0]), 0, 2e-3);
        EXPECT_NEAR(static_cast<double>(world.pose(body).p[1]), 0.3 * std::sqrt(2.0), 2e-3);
        EXPECT_LE(world.velocity(body).norm(), 1e-3);
    }
}

/// Two boxes and a sphere glued off centre: mass properties by the parallel axis theorem make it balance on
/// the point under its centre of mass, and all its shapes touch.
TYPED_TEST(OnSurfaces, CompoundStandsOnItsParts) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const Shape<S>& surface : flatFloors<S>()) {
        World<S> world(earth<S>());
        const std::uint32_t material = world.addMaterial(R(0.5), 0);
        addSurface<S>(world, surface, material);
        BodyDef<S> def;
        def.mass = 3;
        def.inertia = isotropic<S>(1.5);
        def.centerOfMass = at<S>(0.1, 0.2);
        def.pose.p = at<S>(0, 0);
        const BodyId id = world.addBody(def);
        ShapeDef<S> leg;
        leg.material = material;
        leg.shape = Box<S>{S::Vec::Constant(R(0.1))};
        for (const double x : {-0.5, 0.6}) {
            leg.pose.p = at<S>(x, 0.1);
            world.addShape(id, leg);
        }
        leg.shape = Sphere<S>{R(0.2)};
        leg.pose.p = at<S>(0.05, 0.2);
        world.addShape(id, leg);
        for (int i = 0; i < 240; ++i) world.step(R(1) / 240);
        EXPECT_NEAR(static_cast<double>(world.pose(id).p[1]), 0, 1e-4);
        EXPECT_LE(std::abs(spinOf<S>(world.angularVelocity(id))), tol<S>(1e-5, 1e-3));
        std::vector<ContactView<S>> contacts;
        world.readContacts(contacts);
        double weight = 0;
        std::vector<std::uint32_t> shapes;
        for (const auto& c : contacts) {
            weight += static_cast<double>(c.normalImpulse) * 240;
            EXPECT_NEAR(static_cast<double>(c.normal[1]), 1, tol<S>(1e-6, 1e-3));
        }
        EXPECT_NEAR(weight, 3 * kGravity, tol<S>(1e-3, 0.05));
    }
}

TYPED_TEST(OnSurfaces, CopiesAndRefusals) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    const std::uint32_t material = world.addMaterial(R(0.3), 0);
    const Shape<S> surface = flatFloors<S>()[0];
    addSurface<S>(world, surface, material);
    addBall<S>(world, 0, 0.2, 0.2, 1, material, 1, 0, 2);
    addCube<S>(world, 1, 0.31, 0.3, 1, material, -1);
    for (int i = 0; i < 60; ++i) world.step(R(1) / 60);
    World<S> copy = world;
    for (int i = 0; i < 60; ++i) {
        world.step(R(1) / 60);
        copy.step(R(1) / 60);
    }
    EXPECT_EQ(world.stateHash(), copy.stateHash());

    const BodyId dynamic = world.addBody(BodyDef<S>{});
    ShapeDef<S> def;
    def.shape = surface;
    try {
        world.addShape(dynamic, def);
        ADD_FAILURE() << "a surface on a moving body";
    } catch (const EngineError& error) {
        EXPECT_EQ(error.id(), "surface_body");
    }
}

}  // namespace
}  // namespace rigor::engine::test
