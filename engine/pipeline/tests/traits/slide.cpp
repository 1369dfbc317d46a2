// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/tests/traits/slide.hpp"

#include <cmath>
#include <numbers>

#include "engine/pipeline/tests/scene.hpp"
#include "engine/pipeline/tests/traits/measure.hpp"

namespace rigor::engine::test {
namespace {

using S = Space3d;
using Vec2 = Eigen::Vector2d;
constexpr double kSlideStep = 1.0 / 120, kMu = 0.2;
constexpr std::uint32_t kFloorMaterial = kUsualMaterial + 1;  ///< the first that a program adds

World<S> onFloor(const std::string& solver, const std::string& friction, double mu) {
    WorldDef<S> def = earth<S>();
    def.integrator = "symplectic_euler";
    def.solver = solver;
    def.friction = friction;
    World<S> world(def);
    addGround<S>(world, world.addMaterial(mu, 0));
    return world;
}

void runSlide(World<S>& world, int steps, double h = kSlideStep) {
    for (int i = 0; i < steps; ++i) world.step(h);
}

Vec2 level(const S::Vec& v) {
    return {v[0], v[2]};
}

/// Effect of friction on a sphere that slides in one direction.
struct Braking {
    double share;  ///< deceleration in units of mu g
    double askew;  ///< angle to the direction against the slip [rad]
};
Braking brakingOf(const std::string& solver, const std::string& friction, double direction) {
    World<S> world = onFloor(solver, friction, kMu);
    const BodyId ball = addBall<S>(world, 0, 0.5, 0.5, 1, kFloorMaterial);
    runSlide(world, 120);
    world.setVelocity(ball, S::Vec(4 * std::cos(direction), 0, 4 * std::sin(direction)), S::Vec::Zero());
    runSlide(world, 3);
    const Vec2 before = level(world.velocity(ball));
    const int steps = 8;
    runSlide(world, steps);
    const Vec2 change = level(world.velocity(ball)) - before;
    const double cross = change[0] * before[1] - change[1] * before[0];
    return {change.norm() / (kMu * kGravity * steps * kSlideStep),
            std::atan2(std::abs(cross), -change.dot(before))};
}

/// Coulomb's friction in one step: the impulse of at most `limit` that leaves the slip u + K f against
/// itself.
Vec2 coneImpulse(const Vec2& K, const Vec2& u, double limit) {
    const auto impulse = [&](double a) { return Vec2(-u[0] / (K[0] + a), -u[1] / (K[1] + a)); };
    if (impulse(0).norm() <= limit) return impulse(0);
    double low = 0, high = u.norm() / limit;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (impulse(middle).norm() > limit ? low : high) = middle;
    }
    return impulse(high);
}

/// The angle between the friction of a step that nearly stops the slip and that of the cone. The body turns
/// more easily about one axis, so that the slip's direction changes in the step.
double errorWhereSlipTurns(const std::string& solver, const std::string& friction, int substeps) {
    const double mu = 0.5, radius = 0.5;
    const S::Vec inertia(0.5, 0.1, 0.02);
    World<S> world = onFloor(solver, friction, mu);
    BodyDef<S> def;
    def.mass = 1;
    def.inertia = inertia.asDiagonal();
    def.pose.p = at<S>(0, radius);
    const BodyId ball = world.addBody(def);
    attach<S>(world, ball, Sphere<S>{radius}, kFloorMaterial);
    runSlide(world, 120);
    const Vec2 slip(0.7, 0.1);
    world.setVelocity(ball, S::Vec(slip[0], 0, slip[1]), S::Vec::Zero());
    runSlide(world, 1);
    const Vec2 found = level(world.velocity(ball)) - slip;
    const Vec2 K(1 + radius * radius / inertia[2], 1 + radius * radius / inertia[0]);
    Vec2 u = slip, sum = Vec2::Zero();
    for (int i = 0; i < substeps; ++i) {
        const Vec2 f = coneImpulse(K, u, mu * kGravity * kSlideStep / substeps);
        u += K.cwiseProduct(f);
        sum += f;
    }
    return std::abs(std::atan2(found[0] * sum[1] - found[1] * sum[0], found.dot(sum)));
}

}  // namespace

FrictionShape frictionShapeOf(const std::string& solver, const std::string& friction, int substeps) {
    double most = 0, askew = 0;
    for (int i = 0; i < 8; ++i) {
        const Braking braking = brakingOf(solver, friction, 0.1 + i * std::numbers::pi / 8);
        most = std::max(most, braking.share);
        if (braking.share > 0.01) askew = std::max(askew, braking.askew);
    }
    if (most < 0.01) return FrictionShape::None;
    if (most > 1.1) return FrictionShape::Box;
    if (askew > 0.05) return FrictionShape::Polygon;
    return errorWhereSlipTurns(solver, friction, substeps) > 0.1 ? FrictionShape::Line : FrictionShape::Cone;
}

std::optional<FrictionShape> ownFriction(const std::string& solver, int substeps) {
    const FrictionShape first = frictionShapeOf(solver, "cone", substeps);
    for (const auto& law : frictionTable<S>()) {
        if (frictionShape(law.name) != FrictionShape::Box) continue;
        try {
            if (frictionShapeOf(solver, law.name, substeps) == FrictionShape::Box &&
                first == FrictionShape::Cone)
                return std::nullopt;
        } catch (const EngineError&) {  // the solver refuses any law but its own
        }
    }
    return first;
}

bool rubsInPatches(const std::string& solver) {
    const double h = 1.0 / 480, radius = 0.5;
    std::vector<S::Vec> feet, corners;
    for (int i = 0; i < 3; ++i) {
        const double angle = 2 * std::numbers::pi * i / 3;
        feet.emplace_back(radius * std::cos(angle), 0, radius * std::sin(angle));
        for (const double y : {-0.01, 0.01}) corners.push_back(feet.back() + S::Vec(0, y, 0));
    }
    double worst = 0;
    for (const double direction : {0.0, 0.5, 1.0, 1.5}) {
        World<S> world = onFloor(solver, "cone", kMu);
        BodyDef<S> def;
        def.mass = 1;
        def.inertia = S::Vec(0.1, 0.1, 0.1).asDiagonal();
        def.pose.p = at<S>(0, 0.01);
        const BodyId plate = world.addBody(def);
        attach<S>(world, plate, makeHull<S>(corners), kFloorMaterial);
        runSlide(world, 480, h);
        world.setVelocity(plate, S::Vec(std::cos(direction), 0, std::sin(direction)), S::Vec(0, 3, 0));
        runSlide(world, 3, h);
        const Pose<S> X = world.pose(plate);
        const S::Vec v = world.velocity(plate), w = world.angularVelocity(plate);
        runSlide(world, 1, h);
        S::Vec force = S::Vec::Zero();  // friction of all feet, as a fraction of mu m g
        for (const S::Vec& foot : feet) {
            const S::Vec slip = v + w.cross(rotate(X.q, foot));
            force -= S::Vec(slip[0], 0, slip[2]).normalized() / 3;
        }
        const S::Vec found = (world.velocity(plate) - v) / (kMu * kGravity * h);
        worst = std::max(worst, (level(found) - level(force)).norm());
    }
    return worst > 0.03;
}

FrictionTraits measureFriction(const std::string& name) {
    return {frictionShapeOf(WorldDef<S>().solver, name, 1)};
}

std::vector<std::string> liesOfFriction(const std::string& name) {
    if (measureFriction(name).shape == frictionShape(name)) return {};
    return {"shape"};
}

}  // namespace rigor::engine::test
