// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Laws of restitution and manifolds, measured.
#include <cmath>

#include "engine/narrowphase/manifolds.hpp"
#include "engine/pipeline/tests/scene.hpp"
#include "engine/pipeline/tests/traits/measure.hpp"

namespace rigor::engine::test {
namespace {

using Plane = Space2d;
using S = Space3d;
constexpr double kRestitution = 0.5;

/// Normal velocity of the touching point of a sphere after an impact at 1 m/s, without friction.
double reboundOfBall(const std::string& law) {
    WorldDef<Plane> def = euler<Plane>();
    def.restitution = law;
    World<Plane> world(def);
    const std::uint32_t rubber = world.addMaterial(0, kRestitution);
    addGround<Plane>(world, rubber);
    const BodyId ball = addBall<Plane>(world, 0, 0.5, 0.5, 1, rubber, 0, -1);
    for (int i = 0; i < 3; ++i) world.step(1.0 / 240);
    return world.velocity(ball)[1];
}

/// The same of the corner of a square that falls obliquely, with friction: the impact of a body whose centre
/// of mass is not above the point. Newton's law keeps it at e times the approach, laws of impulses do not
/// [KaneLevinson1985].
double reboundOfCorner(const std::string& law) {
    WorldDef<Plane> def = euler<Plane>();
    def.restitution = law;
    World<Plane> world(def);
    const std::uint32_t rubber = world.addMaterial(1, kRestitution);
    addGround<Plane>(world, rubber);
    const double half = 0.5, angle = 0.4;
    // Vector from the centre to the lowest corner, (-half, -half) in the body.
    const double rx = -half * std::cos(angle) + half * std::sin(angle);
    const double ry = -half * std::sin(angle) - half * std::cos(angle);
    BodyDef<Plane> body;
    body.mass = 1;
    body.inertia = 2.0 / 3.0 * half * half;
    body.pose.p = at<Plane>(0, -ry);
    body.pose.q = Plane::Rot::fromAngle(angle);
    body.velocity = at<Plane>(0.3, -1);
    const BodyId square = world.addBody(body);
    attach<Plane>(world, square, Box<Plane>{Plane::Vec::Constant(half)}, rubber);
    world.step(1e-6);
    return world.velocity(square)[1] + world.angularVelocity(square) * rx;
}

Manifold<S> pointAt(double x) {
    Manifold<S> manifold;
    manifold.normal = S::Vec::Unit(1);
    manifold.count = 1;
    manifold.points[0].pointA = manifold.points[0].pointB = {x, 0, 0};
    return manifold;
}

}  // namespace

MeasuredRestitution measureRestitution(const std::string& name) {
    MeasuredRestitution measured;
    measured.bounces = reboundOfBall(name) > 0.5 * kRestitution;
    measured.solvesImpacts =
        measured.bounces && std::abs(reboundOfCorner(name) - kRestitution) > 1e-3 * kRestitution;
    return measured;
}

std::vector<std::string> liesOfRestitution(const std::string& name) {
    const auto law = findAlgorithm(restitutionTable<S>(), "restitution", name).make();
    const MeasuredRestitution measured = measureRestitution(name);
    std::vector<std::string> lies;
    if (measured.bounces != law->bounces()) lies.emplace_back("bounces");
    if (measured.solvesImpacts != law->solvesImpacts()) lies.emplace_back("solves_impacts");
    return lies;
}

/// A manifold that remembers gives other points for the same pair once it has seen a first one.
ManifoldTraits measureManifold(const std::string& name) {
    const auto function = findAlgorithm(manifoldTable<S>(), "manifold", name).make;
    const Pose<S> pose;
    const ManifoldPair<S> pair{pose, pose, 1, 0.01};
    ManifoldCache<S> fresh, used;
    Manifold<S> first = pointAt(0), second = pointAt(0.5), alone = pointAt(0.5);
    function(pair, used, first);
    function(pair, used, second);
    function(pair, fresh, alone);
    return {.remembers = second.count != alone.count};
}

std::vector<std::string> liesOfManifold(const std::string& name) {
    if (measureManifold(name).remembers == manifoldTraits(name).remembers) return {};
    return {"remembers"};
}

}  // namespace rigor::engine::test
