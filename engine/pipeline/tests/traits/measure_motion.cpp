// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <cmath>

#include "engine/pipeline/tests/scene.hpp"
#include "engine/pipeline/tests/traits/measure.hpp"

namespace rigor::engine::test {
namespace {

using S = Space3d;
using Vec = S::Vec;

void run(World<S>& world, int steps, double h) {
    for (int i = 0; i < steps; ++i) world.step(h);
}

// --- integrators
// ----------------------------------------------------------------------------------------------
/// Displacement of one step of free fall, as a fraction of g h^2.
double fallOfOneStep(const std::string& integrator) {
    WorldDef<S> def = earth<S>();
    def.integrator = integrator;
    World<S> world(def);
    const BodyId ball = addBall<S>(world, 0, 0, 0.5, 1, 0);
    world.step(0.125);
    return -world.pose(ball).p[1] / (kGravity * 0.125 * 0.125);
}

/// A unit mass on a spring of 1 N/m, from rest at x = 1, after `steps` steps of `h`.
Eigen::Vector2d oscillator(const std::string& integrator, int steps, double h, double x = 1, double v = 0) {
    WorldDef<S> def;
    def.integrator = integrator;
    World<S> world(def);
    const BodyId ball = addBall<S>(world, x, 0, 0.1, 1, 0, v);
    LinearSpring<S> spring;
    spring.bodyB = ball;
    spring.stiffness = 1;
    world.addForce(spring);
    run(world, steps, h);
    return {world.pose(ball).p[0], world.velocity(ball)[0]};
}

int oscillatorOrder(const std::string& integrator) {
    const double time = 1.6;
    const Eigen::Vector2d exact(std::cos(time), -std::sin(time));
    const auto error = [&](int steps) {
        return (oscillator(integrator, steps, time / steps) - exact).norm();
    };
    return static_cast<int>(std::lround(std::log2(error(32) / error(64))));
}

/// The velocity from rest at x = 1 after one step is -h (1 - c h^2) with c = 0 where the force is that of the
/// start or the middle, 1/4 where it is the mean of both ends, 1/6 with the classical stages; from x = 0, v
/// = 1 it stays 1 where the force is that of the start.
ForceTimes forceTimes(const std::string& integrator) {
    const double h = 0.1;
    const double c = (1 + oscillator(integrator, 1, h)[1] / h) / (h * h);
    if (std::abs(c) < 1e-3)
        return oscillator(integrator, 1, h, 0, 1)[1] == 1 ? ForceTimes::Start : ForceTimes::Middle;
    return std::abs(c - 0.25) < 1e-3 ? ForceTimes::StartAndEnd : ForceTimes::Stages;
}

FlightScheme flightScheme(double fall, int order, ForceTimes forces) {
    const auto is = [&](double share, int n) { return std::abs(fall - share) < 1e-9 && order == n; };
    if (is(1, 1)) return FlightScheme::SymplecticEuler;
    if (is(0, 1)) return FlightScheme::ExplicitEuler;
    if (is(0.5, 2) && forces == ForceTimes::Middle) return FlightScheme::MoreauMidpoint;
    if (is(0.5, 2)) return FlightScheme::VelocityVerlet;
    if (is(0.5, 4)) return FlightScheme::RungeKutta4;
    return FlightScheme::Other;
}

// --- rotation
// -------------------------------------------------------------------------------------------------
const Vec kInertia(0.7, 1.1, 1.9), kSpin(0.4, 2.5, 0.3);

struct Top {
    World<S> world;
    BodyId body;
};
Top makeTop(const WorldDef<S>& def, double size = 1) {
    World<S> world(def);
    BodyDef<S> body;
    body.mass = 1;
    body.inertia = kInertia.asDiagonal();
    body.angularVelocity = size * kSpin;
    const BodyId id = world.addBody(body);
    return {std::move(world), id};
}
Eigen::Quaterniond topAfter(const WorldDef<S>& def, double time, int steps) {
    Top top = makeTop(def);
    run(top.world, steps, time / steps);
    return top.world.pose(top.body).q;
}
struct Invariants {
    Vec momentum;
    double energy;
};
Invariants invariantsOf(const Top& top) {
    const Eigen::Quaterniond q = top.world.pose(top.body).q;
    const Vec w = q.conjugate() * top.world.angularVelocity(top.body);
    const Vec L = kInertia.cwiseProduct(w);
    return {q * L, 0.5 * w.dot(L)};
}

bool ownsRotation(const std::string& integrator) {
    std::vector<Eigen::Quaterniond> ends;
    for (const auto& scheme : rotationTable<S>()) {
        if (!scheme.make().gyroscopic) continue;
        WorldDef<S> def = euler<S>();
        def.integrator = integrator;
        def.rotation = scheme.name;
        ends.push_back(topAfter(def, 1, 30));
    }
    return std::all_of(ends.begin(), ends.end(),
                       [&](const auto& q) { return q.coeffs() == ends.front().coeffs(); });
}

/// True if free flight is the same with a solver that moves bodies in blocks, where these traits allow it, as
/// with the usual one.
bool isTheSameInBlocks(WorldDef<S> def) {
    def.gravity = Vec(0, -kGravity, 0);
    def.substeps = 1;
    const auto end = [&](const std::string& solver) {
        WorldDef<S> with = def;
        with.solver = solver;
        Top top = makeTop(with);
        run(top.world, 30, 1.0 / 60);
        const Pose<S> X = top.world.pose(top.body);
        Eigen::Matrix<double, 7, 1> all;
        all << X.p, X.q.coeffs();
        return all;
    };
    const auto usual = end(def.solver);
    for (const auto& solver : solverTable<S>())
        if (solverTraits(solver.name).contacts == ContactForm::Patches &&
            (end(solver.name) - usual).norm() > 1e-9)
            return false;
    return true;
}

template <class Traits>
void checkBlocks(const Traits& declared, const WorldDef<S>& def, std::vector<std::string>& lies) {
    if (declared.inBlocks && !isTheSameInBlocks(def)) lies.emplace_back("in_blocks");
}

}  // namespace

IntegratorTraits measureIntegrator(const std::string& name) {
    IntegratorTraits t;
    t.order = oscillatorOrder(name);
    t.forces = forceTimes(name);
    t.scheme = flightScheme(fallOfOneStep(name), t.order, t.forces);
    t.ownsRotation = ownsRotation(name);
    return t;
}

RotationTraits measureRotation(const std::string& name) {
    WorldDef<S> def = euler<S>();
    def.rotation = name;
    Top top = makeTop(def);
    const Invariants before = invariantsOf(top);
    run(top.world, 1000, 1.0 / 60);
    const Invariants after = invariantsOf(top);
    RotationTraits t;
    t.keepsMomentum = (after.momentum - before.momentum).norm() < 1e-9 * before.momentum.norm();
    t.keepsEnergy = std::abs(after.energy - before.energy) < 1e-9 * before.energy;
    const auto coarse = topAfter(def, 2, 512), middle = topAfter(def, 2, 1024), fine = topAfter(def, 2, 2048);
    const double first = coarse.angularDistance(middle), second = middle.angularDistance(fine);
    // A velocity that stays is no law of free rotation, exactly as it is followed.
    t.order = first < 1e-7 ? 0 : static_cast<int>(std::lround(std::log2(first / second)));
    return t;
}

OrientationTraits measureOrientation(const std::string& name) {
    WorldDef<S> def = euler<S>();
    def.orientationUpdate = name;
    World<S> world(def);
    const BodyId ball = addBall<S>(world, 0, 0, 0.5, 1, 0, 0, 0, 10);
    world.step(0.1);
    const double turned = 2 * std::atan2(world.pose(ball).q.z(), world.pose(ball).q.w());
    return {.exact = std::abs(turned - 1) < 1e-12};
}

ContinuousCollisionTraits measureContinuousCollision(const std::string& name) {
    WorldDef<S> def = euler<S>();
    def.continuousCollision = name;
    def.restitutionThreshold = 0;
    World<S> world(def);
    const auto rubber = world.addMaterial(0, 1);
    BodyDef<S> wall;
    wall.type = BodyType::Static;
    attach<S>(world, world.addBody(wall), Box<S>{Vec(0.01, 5, 5)}, rubber);
    const double speed = 100, h = 1.0 / 60, radius = 0.1, start = -1;
    const BodyId ball = addBall<S>(world, start, 0, radius, 1, rubber, speed);
    run(world, 1, h);
    const double touch = -0.01 - radius, reflected = touch - (speed * h - (touch - start));
    const double first = world.pose(ball).p[0];
    ContinuousCollisionTraits t;
    t.givesContacts = world.lastStep().rows > 0;  // 0.9 m from the wall where the step began
    run(world, 3, h);
    t.acts = world.pose(ball).p[0] < 0;
    t.losesRest = t.acts && std::abs(first - reflected) > 0.05;
    return t;
}

std::vector<std::string> liesOfIntegrator(const std::string& name) {
    const IntegratorTraits& declared = integratorTraits(name);
    const IntegratorTraits t = measureIntegrator(name);
    std::vector<std::string> lies;
    if (t.order != declared.order) lies.emplace_back("order");
    if (t.scheme != declared.scheme) lies.emplace_back("scheme");
    if (t.forces != declared.forces) lies.emplace_back("forces");
    if (t.ownsRotation != declared.ownsRotation) lies.emplace_back("owns_rotation");
    WorldDef<S> def = euler<S>();
    def.integrator = name;
    checkBlocks(declared, def, lies);
    return lies;
}

std::vector<std::string> liesOfRotation(const std::string& name) {
    const RotationTraits& declared = rotationTraits(name);
    const RotationTraits t = measureRotation(name);
    std::vector<std::string> lies;
    if (t.order != declared.order) lies.emplace_back("order");
    if (t.keepsMomentum != declared.keepsMomentum) lies.emplace_back("keeps_momentum");
    if (t.keepsEnergy != declared.keepsEnergy) lies.emplace_back("keeps_energy");
    WorldDef<S> def = euler<S>();
    def.rotation = name;
    checkBlocks(declared, def, lies);
    return lies;
}

std::vector<std::string> liesOfOrientation(const std::string& name) {
    const OrientationTraits& declared = orientationTraits(name);
    std::vector<std::string> lies;
    if (measureOrientation(name).exact != declared.exact) lies.emplace_back("exact");
    WorldDef<S> def = euler<S>();
    def.orientationUpdate = name;
    checkBlocks(declared, def, lies);
    return lies;
}

std::vector<std::string> liesOfContinuousCollision(const std::string& name) {
    const ContinuousCollisionTraits& declared = continuousCollisionTraits(name);
    const ContinuousCollisionTraits t = measureContinuousCollision(name);
    std::vector<std::string> lies;
    if (t.acts != declared.acts) lies.emplace_back("acts");
    if (t.givesContacts != declared.givesContacts) lies.emplace_back("gives_contacts");
    if (t.losesRest != declared.losesRest) lies.emplace_back("loses_rest");
    return lies;
}

}  // namespace rigor::engine::test
