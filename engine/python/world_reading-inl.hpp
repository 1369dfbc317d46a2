// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// TypedWorld: bodies, contacts, joints, what the last step did. Part of typed_world.cpp.
#pragma once

#include "engine/python/typed_world.hpp"

namespace rigor::engine::python {

template <class R, int N>
void copyVec(const Eigen::Matrix<R, N, 1>& from, double* to) {
    for (int i = 0; i < N; ++i) to[i] = static_cast<double>(from[i]);
}

inline const char* bodyTypeName(BodyType type) {
    return type == BodyType::Dynamic ? "dynamic" : type == BodyType::Static ? "static" : "kinematic";
}

template <class S>
std::int32_t TypedWorld<S>::number(BodyId body) const {
    return body && body.index < bodyNumbers_.size() ? bodyNumbers_[body.index] : -1;
}

template <class S>
py::dict TypedWorld<S>::body(const Key& body) const {
    const Turn turn(taken_);
    const BodyId of = id(body);
    const BodyConstants<S>& constants = world_.constants(of);
    py::dict result;
    result["name"] = bodies_.all()[bodies_.find(body)];
    result["type"] = bodyTypeName(constants.type);
    result["mass"] = static_cast<double>(constants.mass);
    result["center_of_mass"] = fromVec(constants.centerOfMass);
    if constexpr (S::dim == 2) {
        result["inertia"] = static_cast<double>(constants.inertia);
    } else {
        py::array_t<double> inertia({3, 3});
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                inertia.mutable_at(i, j) = static_cast<double>(constants.inertia(i, j));
        result["inertia"] = inertia;
    }
    result["gravity_scale"] = static_cast<double>(constants.gravityScale);
    result["asleep"] = world_.isAsleep(of);
    return result;
}

/// Kinetic energy, and potential energy of gravity with its zero at the origin.
template <class S>
double TypedWorld<S>::energy() const {
    const Turn turn(taken_);
    double sum = 0;
    for (const BodyId body : bodyIds_) {
        const BodyConstants<S>& c = world_.constants(body);
        if (c.type != BodyType::Dynamic) continue;
        const Pose<S> X = world_.pose(body);
        const auto mass = static_cast<double>(c.mass);
        const auto v = world_.velocity(body);
        const auto center = toWorld<S>(X, c.centerOfMass);
        sum += 0.5 * mass * static_cast<double>(v.squaredNorm());
        sum -= mass * static_cast<double>(c.gravityScale * world_.def().gravity.dot(center));
        if constexpr (S::dim == 2) {
            const R w = world_.angularVelocity(body);
            sum += 0.5 * static_cast<double>(c.inertia * w * w);
        } else {
            const auto w = rotateInverse(X.q, world_.angularVelocity(body));
            sum += 0.5 * static_cast<double>(w.dot(c.inertia * w));
        }
    }
    return sum;
}

template <class S>
py::array TypedWorld<S>::contacts() const {
    const Turn turn(taken_);
    std::vector<ContactView<S>> views;
    world_.readContacts(views);
    py::array_t<Row> rows(static_cast<py::ssize_t>(views.size()));
    Row* row = rows.mutable_data();
    for (const ContactView<S>& view : views) {
        row->bodyA = number(view.bodyA);
        row->bodyB = number(view.bodyB);
        row->shapeA = number(view.shapeA);
        row->shapeB = number(view.shapeB);
        copyVec(view.pointA, row->pointA);
        copyVec(view.pointB, row->pointB);
        copyVec(view.normal, row->normal);
        row->depth = -static_cast<double>(view.separation);
        row->normalImpulse = static_cast<double>(view.normalImpulse);
        copyVec(view.frictionImpulse, row->frictionImpulse);
        ++row;
    }
    return rows;
}

template <class S>
py::dict TypedWorld<S>::lastStep() const {
    const Turn turn(taken_);
    const StepResult<S>& last = world_.lastStep();
    py::dict result;
    result["pairs"] = last.pairs;
    result["contacts"] = last.contacts;
    result["rows"] = last.rows;
    result["iterations"] = last.iterations;
    result["sleeping"] = last.sleeping;
    result["non_finite"] = last.nonFinite;
    result["solver_gave_up"] = last.solverGaveUp;
    py::array_t<double> residuals(static_cast<py::ssize_t>(last.residuals.size()));
    for (std::size_t i = 0; i < last.residuals.size(); ++i)
        residuals.mutable_data()[i] = static_cast<double>(last.residuals[i]);
    result["residuals"] = residuals;
    py::list broken;
    for (const JointId joint : last.broken)
        for (std::size_t i = 0; i < jointIds_.size(); ++i)
            if (jointIds_[i] == joint) broken.append(i);
    result["broken"] = broken;
    py::dict seconds;
    for (std::size_t i = 0; i < kPhases; ++i) seconds[phaseName(static_cast<Phase>(i))] = last.seconds[i];
    result["seconds"] = seconds;
    return result;
}

template <class S>
py::list TypedWorld<S>::events() const {
    const Turn turn(taken_);
    py::list result;
    for (const Event<S>& event : world_.lastStep().events) {
        py::dict entry;
        entry["kind"] = eventName(event.kind);
        entry["body_a"] = number(event.bodyA);
        entry["body_b"] = number(event.bodyB);
        entry["normal"] = fromVec(event.normal);
        entry["depth"] = static_cast<double>(event.depth);
        entry["impulse"] = static_cast<double>(event.impulse);
        result.append(entry);
    }
    return result;
}

template <class S>
JointId TypedWorld<S>::jointId(const Key& joint) const {
    const std::size_t number = joints_.find(joint);
    if (!world_.contains(jointIds_[number]))
        throw EngineError("joint_broken", "joint '" + joints_.all()[number] + "' has broken or was removed");
    return jointIds_[number];
}

template <class S>
bool TypedWorld<S>::jointHolds(const Key& joint) const {
    const Turn turn(taken_);
    return world_.contains(jointIds_[joints_.find(joint)]);
}
template <class S>
double TypedWorld<S>::jointCoordinate(const Key& joint, int axis) const {
    const Turn turn(taken_);
    return static_cast<double>(world_.jointCoordinate(jointId(joint), axis));
}
template <class S>
double TypedWorld<S>::jointSpeed(const Key& joint, int axis) const {
    const Turn turn(taken_);
    return static_cast<double>(world_.jointSpeed(jointId(joint), axis));
}
template <class S>
py::object TypedWorld<S>::jointForce(const Key& joint) const {
    const Turn turn(taken_);
    return fromVec(world_.jointForce(jointId(joint)));
}
template <class S>
py::object TypedWorld<S>::jointTorque(const Key& joint) const {
    const Turn turn(taken_);
    return fromAng(world_.jointTorque(jointId(joint)));
}
template <class S>
void TypedWorld<S>::setJointAxis(const Key& joint, int axis, const AxisArgs& control) {
    const Turn turn(taken_);
    world_.setJointAxis(jointId(joint), axis, toJointAxis<R>(control));
}
template <class S>
void TypedWorld<S>::setJointMotor(const Key& joint, int axis, double speed, double maxForce) {
    const Turn turn(taken_);
    world_.setJointMotor(jointId(joint), axis, static_cast<R>(speed), static_cast<R>(maxForce));
}
template <class S>
void TypedWorld<S>::setJointTarget(const Key& joint, int axis, double target) {
    const Turn turn(taken_);
    world_.setJointTarget(jointId(joint), axis, static_cast<R>(target));
}
template <class S>
void TypedWorld<S>::removeJoint(const Key& joint) {
    const Turn turn(taken_);
    world_.removeJoint(jointId(joint));
}

}  // namespace rigor::engine::python
