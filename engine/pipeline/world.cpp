// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/world.hpp"

#include <cmath>

#include "engine/pipeline/pose_check.hpp"
#include "engine/pipeline/require.hpp"
#include "engine/pipeline/shape_def.hpp"
#include "engine/state/sleep.hpp"

namespace rigor::engine {
namespace {

template <class S>
void checkCoefficients(const PairCoefficients<S>& c) {
    require(c.friction >= 0 && std::isfinite(c.friction), "material_friction",
            "friction must not be negative");
    require(c.restitution >= 0 && c.restitution <= 1, "material_restitution",
            "restitution must be in [0, 1]");
    require(c.staticFriction == 0 || (c.staticFriction >= c.friction && std::isfinite(c.staticFriction)),
            "material_static_friction", "static friction must be 0 (the same) or at least the friction");
    require(c.rollingFriction >= 0 && c.torsionalFriction >= 0 && std::isfinite(c.rollingFriction) &&
                std::isfinite(c.torsionalFriction),
            "material_moments", "rolling and torsional friction are lengths and must not be negative");
}

}  // namespace

template <class S>
World<S>::World(const WorldDef<S>& def) : parts_(def) {}

// --- building

template <class S>
BodyId World<S>::addBody(const BodyDef<S>& def) {
    requireBetweenSteps();
    islands();  // finds the islands of the last step
    const BodyId id = parts_.bodies.add(def);
    parts_.setContinuous(parts_.bodies.dense(id), def.continuous);
    return id;
}

template <class S>
void World<S>::removeBody(BodyId body) {
    requireBetweenSteps();
    parts_.removeBody(body);
}

template <class S>
ShapeId World<S>::addShape(BodyId body, const ShapeDef<S>& def) {
    requireBetweenSteps();
    const std::uint32_t dense = parts_.bodies.dense(body);
    const BodyArrays<S>& bodies = parts_.bodies.arrays();
    requireMaterial(def.material, parts_.contacts.materials().size());
    const ShapeId id = parts_.contacts.shapes().add(makeShapeRecord<S>(def, bodies.constants[dense], dense));
    parts_.addShapeMass(dense);
    if (!def.sensor) parts_.wakeReachOf(dense);
    parts_.contacts.structureChanged();
    return id;
}

template <class S>
void World<S>::setFilter(ShapeId shape, const ShapeFilter& filter) {
    requireBetweenSteps();
    const ShapeSet<S>& shapes = parts_.contacts.shapes();
    const std::uint32_t dense = shapes.ids().dense(shape);
    parts_.wakeNeighboursOf(shapes[dense].body);
    parts_.wakeReachOf(shapes[dense].body);
    parts_.contacts.setShapeFilter(dense, filter);
}

template <class S>
std::uint32_t World<S>::addMaterial(Real friction, Real restitution, Real staticFriction) {
    return addMaterial(PairCoefficients<S>{friction, restitution, staticFriction});
}

template <class S>
std::uint32_t World<S>::addMaterial(const PairCoefficients<S>& own) {
    checkCoefficients<S>(own);
    return parts_.contacts.materials().add(own);
}

template <class S>
void World<S>::setPair(std::uint32_t materialA, std::uint32_t materialB,
                       const PairCoefficients<S>& coefficients) {
    MaterialTable<S>& materials = parts_.contacts.materials();
    require(materialA < materials.size() && materialB < materials.size(), "pair_material",
            "unknown material");
    checkCoefficients<S>(coefficients);
    materials.setPair(materialA, materialB, coefficients);
}

template <class S>
const PairCoefficients<S>& World<S>::pairCoefficients(std::uint32_t a, std::uint32_t b) const {
    const MaterialTable<S>& materials = parts_.contacts.materials();
    require(a < materials.size() && b < materials.size(), "pair_material", "unknown material");
    return materials.pair(a, b);
}

template <class S>
JointId World<S>::addJoint(const JointDef<S>& def) {
    requireBetweenSteps();
    const std::uint32_t a = parts_.bodies.denseOrWorld(def.bodyA), b = parts_.bodies.denseOrWorld(def.bodyB);
    require(a != b, "joint_bodies", "a joint needs two bodies");
    const BodyArrays<S>& bodies = parts_.bodies.arrays();
    const auto isDynamic = [&](std::uint32_t i) { return bodies.constants[i].type == BodyType::Dynamic; };
    require(isDynamic(a) || isDynamic(b), "joint_bodies", "a joint needs a dynamic body");
    islands();  // finds the islands of the last step
    const JointId id = parts_.joints.add(def, bodies, a, b);
    parts_.wakeIslandOf(a);
    parts_.wakeIslandOf(b);
    parts_.jointsChanged();
    return id;
}

template <class S>
void World<S>::removeJoint(JointId joint) {
    requireBetweenSteps();
    parts_.removeJoint(joint);
}

template <class S>
ForceId World<S>::addForce(const ForceDef<S>& def) {
    requireBetweenSteps();
    const ForceId id = parts_.forces.add(def, parts_.bodies.arrays(), parts_.bodies.ids());
    parts_.wakeIslandOf(parts_.forces.place(id).a);
    parts_.wakeIslandOf(parts_.forces.place(id).b);
    return id;
}

template <class S>
void World<S>::removeForce(ForceId force) {
    requireBetweenSteps();
    parts_.wakeIslandOf(parts_.forces.place(force).a);
    parts_.wakeIslandOf(parts_.forces.place(force).b);
    parts_.forces.remove(force);
}

// --- running

template <class S>
const StepResult<S>& World<S>::step(Real h) {
    Step<S> step(parts_, step_);
    step.begin(h);
    step.runAll();
    return step_.result;
}

template <class S>
void World<S>::beginStep(Real h) {
    Step<S>(parts_, step_).begin(h);
}

template <class S>
void World<S>::runPhase() {
    Step<S>(parts_, step_).runNext();
}

template <class S>
void World<S>::applyForce(BodyId body, const Vec& force, const Ang& torque) {
    require(force.allFinite() && finiteAng(torque), "force", "forces must be finite");
    const std::uint32_t i = parts_.bodies.dense(body);
    if (!force.isZero(0) || dotAng(torque, torque) > Real(0)) parts_.wakeIslandOf(i);
    Wrench<S>& wrench = parts_.bodies.arrays().wrench[i];
    wrench.force += force;
    wrench.torque += torque;
}

template <class S>
void World<S>::applyImpulse(BodyId body, const Vec& impulse, const Ang& angularImpulse) {
    require(impulse.allFinite() && finiteAng(angularImpulse), "impulse", "impulses must be finite");
    const std::uint32_t i = parts_.bodies.dense(body);
    require(parts_.bodies.constants(body).type == BodyType::Dynamic, "impulse",
            "an impulse needs a dynamic body");
    parts_.wakeIslandOf(i);
    parts_.bodies.applyImpulse(i, impulse, angularImpulse);
}

template <class S>
void World<S>::applyForceAt(BodyId body, const Vec& force, const Vec& point) {
    const Vec& center = parts_.bodies.arrays().pose[parts_.bodies.dense(body)].p;
    applyForce(body, force, cross(Vec(point - center), force));
}

template <class S>
void World<S>::applyImpulseAt(BodyId body, const Vec& impulse, const Vec& point) {
    const Vec& center = parts_.bodies.arrays().pose[parts_.bodies.dense(body)].p;
    applyImpulse(body, impulse, cross(Vec(point - center), impulse));
}

template <class S>
typename S::Vec World<S>::velocityAt(BodyId body, const Vec& point) const {
    const std::uint32_t i = parts_.bodies.dense(body);
    const Velocity<S>& velocity = parts_.bodies.arrays().velocity[i];
    return velocity.v + cross(velocity.w, Vec(point - parts_.bodies.arrays().pose[i].p));
}

template <class S>
void World<S>::setVelocity(BodyId body, const Vec& velocity, const Ang& angularVelocity) {
    require(velocity.allFinite() && finiteAng(angularVelocity), "body_velocity", "velocities must be finite");
    const std::uint32_t i = parts_.bodies.dense(body);
    require(parts_.bodies.constants(body).type != BodyType::Static, "static_body",
            "a static body has no velocity");
    parts_.wakeIslandOf(i);
    parts_.bodies.arrays().velocity[i] = {velocity, angularVelocity};
    parts_.bodies.arrays().leaveMidpoint(i);
}

template <class S>
void World<S>::setSurfaceVelocity(ShapeId shape, const Velocity<S>& surface) {
    requireBetweenSteps();
    ShapeSet<S>& shapes = parts_.contacts.shapes();
    ShapeRecord<S>& record = shapes.records()[shapes.ids().dense(shape)];
    rigor::engine::setSurfaceVelocity<S>(record, surface, parts_.bodies.arrays().constants[record.body]);
    parts_.contacts.materials().touch();
    parts_.wakeNeighboursOf(record.body);
}

template <class S>
Velocity<S> World<S>::surfaceVelocity(ShapeId shape) const {
    const ShapeSet<S>& shapes = parts_.contacts.shapes();
    const ShapeRecord<S>& record = shapes[shapes.ids().dense(shape)];
    const Vec& center = parts_.bodies.arrays().constants[record.body].centerOfMass;
    return {Vec(record.surface.v - cross(record.surface.w, center)), record.surface.w};
}

template <class S>
void World<S>::setPreSolve(PreSolve<S> callback) {
    parts_.contacts.setPreSolve(PreSolveCall<S>(std::move(callback)));
}

template <class S>
void World<S>::setPose(BodyId body, const Pose<S>& pose) {
    requireBetweenSteps();
    require(validPose<S>(pose), "body_pose", "position must be finite, orientation a unit rotation");
    const std::uint32_t i = parts_.bodies.dense(body);
    parts_.wakeNeighboursOf(i);
    BodyArrays<S>& bodies = parts_.bodies.arrays();
    const Pose<S> unit{pose.p, normalizedRot(pose.q)};
    bodies.pose[i] = {toWorld<S>(unit, bodies.constants[i].centerOfMass), unit.q};
    bodies.stillTime[i] = 0;
    bodies.leaveMidpoint(i);
    parts_.contacts.forgetImpulses(i);
    if (bodies.constants[i].type == BodyType::Static) parts_.contacts.structureChanged();
}

template <class S>
void World<S>::wake(BodyId body) {
    parts_.wakeIslandOf(parts_.bodies.dense(body));
}

template <class S>
void World<S>::putToSleep(BodyId body) {
    requireBetweenSteps();
    if (parts_.algorithms.sleeping.wake == nullptr)
        throw EngineError("sleeping", "found sleeping=" + parts_.def.sleeping +
                                          ", expected sleeping=islands, which wakes what sleeps");
    const Islands& islands = parts_.currentIslands();
    const std::uint32_t island = islands.islandOf(parts_.bodies.dense(body));
    if (island == kNullIndex) return;
    for (const std::uint32_t i : islands.members(island))
        rigor::engine::putToSleep(parts_.bodies.arrays(), i);
}

template <class S>
void World<S>::setJointAxis(JointId joint, int axis, const JointAxis<Real>& control) {
    requireBetweenSteps();
    parts_.joints.setAxis(joint, axis, control);
    parts_.wakeIslandOf(parts_.joints.joint(joint).a);
    parts_.wakeIslandOf(parts_.joints.joint(joint).b);
}

template <class S>
void World<S>::setJointMotor(JointId joint, int axis, Real speed, Real maxForce) {
    JointAxis<Real> control = jointAxis(joint, axis);
    control.motorSpeed = speed;
    control.motorMaxForce = maxForce;
    setJointAxis(joint, axis, control);
}

template <class S>
void World<S>::setJointTarget(JointId joint, int axis, Real target) {
    JointAxis<Real> control = jointAxis(joint, axis);
    control.target = target;
    setJointAxis(joint, axis, control);
}

// --- reading

template <class S>
void World<S>::readJoints(std::vector<JointPlace<S>>& out) const {
    const BodyArrays<S>& bodies = parts_.bodies.arrays();
    out.clear();
    for (const auto& record : parts_.joints.records()) {
        const Joint<S>& joint = record.joint;
        out.push_back({joint.id, joint.type, bodies.id[joint.a], bodies.id[joint.b],
                       toWorld<S>(bodies.pose[joint.a], joint.anchorA),
                       toWorld<S>(bodies.pose[joint.b], joint.anchorB)});
    }
}

RIGOR_INSTANTIATE_CLASS(World)

}  // namespace rigor::engine
