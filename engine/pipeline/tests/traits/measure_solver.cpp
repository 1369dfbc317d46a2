// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/pipeline/tests/scene.hpp"
#include "engine/pipeline/tests/traits/measure.hpp"
#include "engine/pipeline/tests/traits/slide.hpp"

namespace rigor::engine::test {
namespace {

using S = Space3d;
constexpr double kSolverStep = 1.0 / 120;

WorldDef<S> earthWith(const std::string& solver) {
    WorldDef<S> def = earth<S>();
    def.integrator = "symplectic_euler";  // its error in a fall shows the length of steps
    def.solver = solver;
    def.positionCorrection = "none";
    def.slop = 0;
    return def;
}

void runSolver(World<S>& world, int steps, double h = kSolverStep) {
    for (int i = 0; i < steps; ++i) world.step(h);
}

/// Number of sub-steps. The fall of one step by symplectic Euler in n sub-steps is y = g h^2 (1 + 1 / n) / 2.
int substeps(const std::string& solver) {
    World<S> world(earthWith(solver));
    const BodyId ball = addBall<S>(world, 0, 100, 0.5, 1, 0);
    const double h = 0.1;
    world.step(h);
    const double fallen = (100 - world.pose(ball).p[1]) / (kGravity * h * h);
    return static_cast<int>(std::lround(1 / (2 * fallen - 1)));
}

/// Frequency f of a spring by its deflection g / (2 pi f)^2 under its own mass. 0: hardly any deflection.
/// Where the bias velocity is relaxed out again, reaching the deflection takes 1 / (h (2 pi f)^2) of time.
constexpr double kSpringStep = 1.0 / 60;
double frequencyOf(double sag) {
    return sag > 1e-4 ? std::sqrt(kGravity / sag) / (2 * std::numbers::pi) : 0.0;
}

double contactSpring(const std::string& solver) {
    WorldDef<S> def = earthWith(solver);
    def.contactFrequency = kSetContactFrequency;
    def.contactDampingRatio = 1;
    World<S> world(def);
    addGround<S>(world, 0);
    const BodyId ball = addBall<S>(world, 0, 0.5, 0.5, 1, 0);
    runSolver(world, 180, kSpringStep);
    return frequencyOf(0.5 - world.pose(ball).p[1]);
}

/// Hung up at its centre, so that the joint's rows have the mass alone.
double jointSpring(const std::string& solver, bool curved) {
    WorldDef<S> def = earthWith(solver);
    def.jointFrequency = kSetJointFrequency;
    def.jointDampingRatio = 1;
    def.relinearizedJoints = curved;
    World<S> world(def);
    const BodyId ball = addBall<S>(world, 0, 0, 0.5, 1, 0);
    JointDef<S> joint;
    joint.bodyB = ball;
    world.addJoint(joint);
    runSolver(world, 180, kSpringStep);
    return frequencyOf(-world.pose(ball).p[1]);
}

/// Position and velocity of a sphere that has begun with a penetration of 1 cm.
Eigen::Vector2d afterOverlap(const std::string& solver, const std::string& correction, double gravity) {
    WorldDef<S> def = earthWith(solver);
    def.gravity[1] = -gravity;
    def.positionCorrection = correction;
    World<S> world(def);
    addGround<S>(world, 0);
    const BodyId ball = addBall<S>(world, 0, 0.49, 0.5, 1, 0);
    runSolver(world, 60);
    return {world.pose(ball).p[1], world.velocity(ball)[1]};
}

ErrorHandling errors(const std::string& solver, bool springs) {
    if (springs) return ErrorHandling::Springs;
    return afterOverlap(solver, "none", kGravity)[0] > 0.4999 ? ErrorHandling::Positions
                                                              : ErrorHandling::Correction;
}

bool ownsCorrection(const std::string& solver) {
    const Eigen::Vector2d without = afterOverlap(solver, "none", kGravity);
    const auto corrections = positionCorrectionTable<S>();
    return std::all_of(corrections.begin(), corrections.end(), [&](const auto& correction) {
        return afterOverlap(solver, correction.name, kGravity) == without;
    });
}

/// Spheres one on the other, exactly touching.
std::vector<BodyId> addColumn(World<S>& world, int count) {
    addGround<S>(world, 0);
    std::vector<BodyId> balls;
    for (int i = 0; i < count; ++i) balls.push_back(addBall<S>(world, 0, 0.5 + i, 0.5, 1, 0));
    return balls;
}

bool isDirect(const std::string& solver) {
    WorldDef<S> def = earthWith(solver);
    def.velocityIterations = def.firstStepIterations = 1;
    def.velocityTolerance = 0;
    World<S> world(def);
    const auto balls = addColumn(world, 8);
    world.step(kSolverStep);
    double fastest = 0;
    for (const BodyId ball : balls) fastest = std::max(fastest, std::abs(world.velocity(ball)[1]));
    return fastest < 1e-4 * kGravity * kSolverStep;
}

int iterationsOf(WorldDef<S> def, double change, double residual) {
    def.velocityTolerance = change;
    def.residualTolerance = residual;
    def.relinearizedJoints = false;
    World<S> world(def);
    addColumn(world, 6);
    const BodyId bob = addBall<S>(world, 11, 5, 0.2, 1, 0);
    JointDef<S> joint;
    joint.bodyB = bob;
    joint.anchorA = at<S>(10, 5);
    joint.anchorB = at<S>(-1, 0);
    world.addJoint(joint);
    runSolver(world, 2);
    return world.lastStep().iterations;
}

StopRule stopRule(const std::string& solver) {
    WorldDef<S> def = earthWith(solver);
    def.warmStarting = false;
    def.velocityIterations = def.firstStepIterations = 200;
    const int most = iterationsOf(def, 0, 0);
    if (iterationsOf(def, 0, 0.05) < most) return StopRule::Residual;
    return iterationsOf(def, 0.1, 0) < most ? StopRule::Change : StopRule::Never;
}

bool warmStarts(const std::string& solver) {
    const auto speeds = [&](bool warm) {
        WorldDef<S> def = earthWith(solver);
        def.warmStarting = warm;
        def.velocityIterations = def.firstStepIterations = 2;
        def.velocityTolerance = 0;
        World<S> world(def);
        const auto balls = addColumn(world, 5);
        runSolver(world, 5);
        std::vector<double> v;
        for (const BodyId ball : balls) v.push_back(world.velocity(ball)[1]);
        return v;
    };
    return speeds(true) != speeds(false);
}

/// Numbers that f32 can not hold, in a central impact of which the end is known.
bool contactsInSingle(const std::string& solver) {
    WorldDef<S> def = euler<S>();
    def.solver = solver;
    def.restitutionThreshold = 0;
    World<S> world(def);
    const double e = 0.7, m1 = 1.3, m2 = 2.9, v1 = 0.37, v2 = -0.81;
    const auto rubber = world.addMaterial(0, e);
    const BodyId a = addBall<S>(world, -0.6, 0, 0.5, m1, rubber, v1),
                 b = addBall<S>(world, 0.6, 0, 0.4, m2, rubber, v2);
    runSolver(world, 120);
    const double mean = (m1 * v1 + m2 * v2) / (m1 + m2);
    const double errorA = world.velocity(a)[0] - (mean - e * (v1 - v2) * m2 / (m1 + m2));
    const double errorB = world.velocity(b)[0] - (mean + e * (v1 - v2) * m1 / (m1 + m2));
    return std::max(std::abs(errorA), std::abs(errorB)) > 1e-11;
}

}  // namespace

MeasuredSolver measureSolver(const std::string& name) {
    MeasuredSolver m;
    SolverTraits& t = m.traits;
    t.substeps = substeps(name);
    m.contactSpring = contactSpring(name);
    m.jointSpring = jointSpring(name, true);
    t.errors = errors(name, m.contactSpring > 0);
    if (m.jointSpring > 0 && jointSpring(name, false) == 0) t.linearJointBaumgarte = 0.0;
    m.ownsCorrection = ownsCorrection(name);
    t.relaxIterations = std::abs(afterOverlap(name, "none", 0)[1]) < 1e-3 ? 1 : 0;
    t.friction = ownFriction(name, t.substeps);
    t.frictionOfPatches =
        t.friction.value_or(FrictionShape::Cone) == FrictionShape::Cone && rubsInPatches(name);
    t.contactsInSingle = contactsInSingle(name);
    t.direct = isDirect(name);
    t.stops = stopRule(name);
    t.warmStarts = warmStarts(name);
    m.countsIterations = t.stops != StopRule::Residual && t.errors != ErrorHandling::Positions;
    if (m.countsIterations) t.iterations = iterationsOf(earthWith(name), 0, 0) / t.substeps;
    return m;
}

std::vector<std::string> liesOfSolver(const std::string& name) {
    const SolverTraits& declared = solverTraits(name);
    const MeasuredSolver measured = measureSolver(name);
    const SolverTraits& t = measured.traits;
    std::vector<std::string> lies;
    const auto check = [&](const char* trait, bool same) {
        if (!same) lies.emplace_back(trait);
    };
    const bool springs = declared.errors == ErrorHandling::Springs;
    const auto near = [](double frequency, double requested) {
        return std::abs(frequency - requested) < 0.02 * requested;
    };
    check("substeps", t.substeps == declared.substeps);
    check("iterations", !measured.countsIterations ||
                            t.iterations == declared.iterations.value_or(50) + declared.relaxIterations);
    check("errors", t.errors == declared.errors);
    check("contact_frequency", !springs || near(measured.contactSpring, kSetContactFrequency));
    check("joint_frequency",
          springs ? near(measured.jointSpring, kSetJointFrequency) : measured.jointSpring == 0);
    check("linear_joint_share",
          t.linearJointBaumgarte.has_value() == declared.linearJointBaumgarte.has_value());
    check("correction", measured.ownsCorrection == (declared.errors != ErrorHandling::Correction));
    check("relax_iterations", !springs || (t.relaxIterations > 0) == (declared.relaxIterations > 0));
    check("friction", t.friction == declared.friction);
    check("friction_of_patches", t.frictionOfPatches == declared.frictionOfPatches);
    check("contacts_in_single", t.contactsInSingle == declared.contactsInSingle);
    check("direct", t.direct == declared.direct);
    check("stops", t.stops == declared.stops);
    check("warm_starts", t.warmStarts == declared.warmStarts);
    return lies;
}

bool correctionKeepsVelocity(const std::string& name) {
    const WorldDef<S> usual;
    return std::abs(afterOverlap(usual.solver, name, 0)[1]) > 1e-3;
}

}  // namespace rigor::engine::test
