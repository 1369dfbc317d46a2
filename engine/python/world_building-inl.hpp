// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// TypedWorld: adding to a world. Part of typed_world.cpp.
#pragma once

#include <algorithm>

#include "engine/python/typed_world.hpp"

namespace rigor::engine::python {

inline BodyType typeOf(const std::string& name) {
    if (name == "dynamic") return BodyType::Dynamic;
    if (name == "static") return BodyType::Static;
    if (name == "kinematic") return BodyType::Kinematic;
    throw EngineError("body_type", "no body type '" + name + "', expected dynamic, static or kinematic");
}

template <class S>
typename S::Inertia toInertia(const MaybeNumbers& inertia) {
    using R = typename S::Real;
    if (!inertia) return zeroInertia<S>();
    if constexpr (S::dim == 2) {
        requireSize(*inertia, 1, "inertia");
        return static_cast<R>(*inertia->data());
    } else {
        typename S::Inertia I = zeroInertia<S>();
        if (inertia->size() != 3) requireSize(*inertia, 9, "inertia");
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                if (inertia->size() == 9) I(i, j) = static_cast<R>(inertia->data()[3 * i + j]);
                if (inertia->size() == 3 && i == j) I(i, i) = static_cast<R>(inertia->data()[i]);
            }
        return I;
    }
}

template <class S>
PairCoefficients<S> toCoefficients(const MaterialArgs& m) {
    using R = typename S::Real;
    return {static_cast<R>(m.friction), static_cast<R>(m.restitution), static_cast<R>(m.staticFriction),
            static_cast<R>(m.rollingFriction), static_cast<R>(m.torsionalFriction)};
}

template <class S>
TypedWorld<S>::TypedWorld(BuiltWorld<S> built)
    : world_(std::move(built.world)),
      bodyIds_(std::move(built.bodies)),
      jointIds_(std::move(built.joints)),
      materialIds_(std::move(built.materials)),
      beforeStep_(std::move(built.beforeStep)) {
    setTimeStep(built.timeStep);
    for (const std::string& name : built.bodyNames) bodies_.add(name);
    for (const std::string& name : built.jointNames) joints_.add(name);
    for (const std::string& name : built.materialNames) materials_.add(name);
    for (std::size_t i = 0; i < bodyIds_.size(); ++i) {
        bodyNumbers_.resize(bodyIds_[i].index + 1, -1);
        bodyNumbers_[bodyIds_[i].index] = static_cast<std::int32_t>(i);
    }
    for (const ShapeRecord<S>& shape : world_.shapes()) {
        shapeNumbers_.resize(std::max<std::size_t>(shapeNumbers_.size(), shape.id.index + 1), -1);
        shapeNumbers_[shape.id.index] = shapes_++;
    }
    resizeStates();
}

template <class S>
TypedWorld<S>::TypedWorld(const TypedWorld& other)
    : AnyWorld(other),
      world_(other.world_),
      bodyIds_(other.bodyIds_),
      jointIds_(other.jointIds_),
      materialIds_(other.materialIds_),
      bodyNumbers_(other.bodyNumbers_),
      shapeNumbers_(other.shapeNumbers_),
      shapes_(other.shapes_),
      beforeStep_(other.beforeStep_) {
    resizeStates();
}

template <class S>
py::dict TypedWorld<S>::settings() const {
    const WorldDef<S>& def = world_.def();
    py::dict result;
#define CHOICE(member, name, byDefault, help) result[name] = def.member;
#define INTEGER(member, name, byDefault, min, max, help) result[name] = def.member;
#define REAL(member, name, byDefault, min, max, help) result[name] = static_cast<double>(def.member);
#define SWITCH(member, name, byDefault, help) result[name] = def.member;
#include "engine/state/settings.def"
    return result;
}

template <class S>
std::size_t TypedWorld<S>::addMaterial(const MaterialArgs& args, const std::string& name) {
    const Turn turn(taken_);
    materials_.add(name);
    materialIds_.push_back(world_.addMaterial(toCoefficients<S>(args)));
    return materialIds_.size() - 1;
}

template <class S>
void TypedWorld<S>::setPair(const Key& a, const Key& b, const MaterialArgs& args) {
    const Turn turn(taken_);
    world_.setPair(material(a), material(b), toCoefficients<S>(args));
}

template <class S>
std::size_t TypedWorld<S>::addBody(const BodyArgs& args) {
    const Turn turn(taken_);
    BodyDef<S> def;
    def.type = typeOf(args.type);
    def.pose = toPose<S>(args.position, args.orientation);
    def.velocity = toVec<S>(args.velocity, "velocity", def.velocity);
    def.angularVelocity = toAng<S>(args.angularVelocity, "angular_velocity");
    def.centerOfMass = toVec<S>(args.centerOfMass, "center_of_mass", def.centerOfMass);
    def.mass = static_cast<R>(args.mass);
    def.inertia = toInertia<S>(args.inertia);
    def.linearVelocityKept = static_cast<R>(args.linearVelocityKept);
    def.angularVelocityKept = static_cast<R>(args.angularVelocityKept);
    def.gravityScale = static_cast<R>(args.gravityScale);
    def.collides = args.collides;
    if (args.continuous) def.continuous = *args.continuous ? ContinuousMode::On : ContinuousMode::Off;
    bodies_.check(args.name);
    const BodyId added = world_.addBody(def);
    bodies_.add(args.name);
    bodyNumbers_.resize(std::max<std::size_t>(bodyNumbers_.size(), added.index + 1), -1);
    bodyNumbers_[added.index] = static_cast<std::int32_t>(bodyIds_.size());
    bodyIds_.push_back(added);
    resizeStates();
    return bodyIds_.size() - 1;
}

template <class S>
std::size_t TypedWorld<S>::addShape(const Key& body, const ShapeArgs& shape, const ShapePlace& place) {
    const Turn turn(taken_);
    ShapeDef<S> def;
    def.shape = toShape<S>(shape);
    def.pose = toPose<S>(place.position, place.orientation);
    def.material = material(place.material);
    def.density = static_cast<R>(place.density);
    def.sensor = place.sensor;
    def.surfaceVelocity = {toVec<S>(place.surfaceVelocity, "surface_velocity", S::Vec::Zero()),
                           toAng<S>(place.surfaceAngularVelocity, "surface_angular_velocity")};
    def.filter = {place.layers, place.mask, place.group};
    const ShapeId added = world_.addShape(id(body), def);
    shapeNumbers_.resize(std::max<std::size_t>(shapeNumbers_.size(), added.index + 1), -1);
    shapeNumbers_[added.index] = shapes_;
    changed();
    return static_cast<std::size_t>(shapes_++);
}

template <class S>
std::size_t TypedWorld<S>::addJoint(const JointArgs& args, const MaybeKey& a, const MaybeKey& b,
                                    const std::string& name) {
    const Turn turn(taken_);
    JointDef<S> def = toJointDef<S>(args);
    def.bodyA = id(a);
    def.bodyB = id(b);
    joints_.check(name);
    jointIds_.push_back(world_.addJoint(def));
    joints_.add(name);
    return jointIds_.size() - 1;
}

template <class S>
void TypedWorld<S>::addConstantForce(const Key& body, const Numbers& force, const MaybeNumbers& torque,
                                     double start, double end) {
    const Turn turn(taken_);
    world_.addForce(
        ConstantForce<S>{id(body), toVec<S>(force, "force"), toAng<S>(torque, "torque"), start, end});
}

template <class S>
void TypedWorld<S>::addDrag(const Key& body, double linear, double quadratic) {
    const Turn turn(taken_);
    const BodyId of = id(body);
    if (linear != 0) world_.addForce(LinearDrag<S>{of, static_cast<R>(linear)});
    if (quadratic != 0) world_.addForce(QuadraticDrag<S>{of, static_cast<R>(quadratic)});
}

template <class S>
void TypedWorld<S>::addSpring(const MaybeKey& a, const MaybeKey& b, const MaybeNumbers& anchorA,
                              const MaybeNumbers& anchorB, double stiffness, double damping, double length) {
    const Turn turn(taken_);
    LinearSpring<S> spring;
    spring.bodyA = id(a);
    spring.bodyB = id(b);
    spring.anchorA = toVec<S>(anchorA, "anchor_a", S::Vec::Zero());
    spring.anchorB = toVec<S>(anchorB, "anchor_b", S::Vec::Zero());
    spring.stiffness = static_cast<R>(stiffness);
    spring.damping = static_cast<R>(damping);
    spring.restLength = static_cast<R>(length);
    world_.addForce(spring);
}

}  // namespace rigor::engine::python
