// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The joints of a world: adding, reading, driving and breaking them.
#include <algorithm>

#include "engine/pipeline/world.hpp"

namespace rigor::engine {
namespace {

void require(bool ok, const char* id, const char* message) {
    if (!ok) throw EngineError(id, message);
}

std::size_t axisIndex(int axis, int count) {
    require(axis >= 0 && axis < count, "joint_axes", "the joint has no such coordinate");
    return static_cast<std::size_t>(axis);
}

}  // namespace

template <class S>
JointId World<S>::addJoint(const JointDef<S>& def) {
    const std::uint32_t a = bodyOrWorld(def.bodyA), b = bodyOrWorld(def.bodyB);
    require(a != b, "joint_bodies", "a joint needs two bodies");
    islands();  // of the last step
    wakeIslandOf(a);
    wakeIslandOf(b);
    require(bodies_.invMass[a] > 0 || bodies_.invMass[b] > 0, "joint_bodies", "a joint needs a dynamic body");
    typename JointSet<S>::Record record;
    record.joint = makeJoint<S>(def, bodies_.pose[a], bodies_.constants[a].centerOfMass, bodies_.pose[b],
                                bodies_.constants[b].centerOfMass);
    record.joint.a = a;
    record.joint.b = b;
    record.evaluate = findJoint<S>(def.type).evaluate;
    record.joint.id = jointIds_.add(static_cast<std::uint32_t>(joints_.records().size()));
    joints_.records().push_back(record);
    rebuildExclusions();
    return record.joint.id;
}

template <class S>
void World<S>::removeJoint(JointId joint) {
    require(!stepping(), "step_in_progress", "joints cannot be removed between the phases of a step");
    islands();  // of the last step
    auto& records = joints_.records();
    const std::uint32_t gone = jointIds_.dense(joint);
    wakeIslandOf(records[gone].joint.a);
    wakeIslandOf(records[gone].joint.b);
    jointIds_.remove(joint);
    records.erase(records.begin() + gone);
    for (std::uint32_t i = gone; i < records.size(); ++i) jointIds_.move(records[i].joint.id, i);
    rebuildExclusions();
}

template <class S>
void World<S>::rebuildExclusions() {
    std::vector<std::uint64_t> excluded;
    for (const typename JointSet<S>::Record& record : joints_.records())
        if (!record.joint.collideConnected) excluded.push_back(pairKey(record.joint.a, record.joint.b));
    std::sort(excluded.begin(), excluded.end());
    contacts_.setExcluded(std::move(excluded));
}

/// Removes the joints whose mean force or torque over the step was too large for them.
template <class S>
void World<S>::breakJoints() {
    broken_.clear();
    for (const auto& record : joints_.records()) {
        const Joint<S>& joint = record.joint;
        if (!std::isfinite(joint.breakForce) && !std::isfinite(joint.breakTorque)) continue;
        const Real force = jointForce(joint.id).norm();
        const Ang torque = jointTorque(joint.id);
        if (force > joint.breakForce || std::sqrt(dotAng(torque, torque)) > joint.breakTorque)
            broken_.push_back(joint.id);
    }
    for (const JointId joint : broken_) removeJoint(joint);
    result_.broken = broken_;
}

template <class S>
typename S::Vec World<S>::jointForce(JointId joint) const {
    const auto& record = joints_.records()[jointIds_.dense(joint)];
    if (stepCount_ == 0) return Vec::Zero();
    return record.reactionImpulse / (lastStepSize_ * Real(substeps()));
}

template <class S>
typename S::Ang World<S>::jointTorque(JointId joint) const {
    const auto& record = joints_.records()[jointIds_.dense(joint)];
    if (stepCount_ == 0) return zeroAng<S>();
    return record.reactionAngularImpulse / (lastStepSize_ * Real(substeps()));
}

template <class S>
typename S::Real World<S>::jointCoordinate(JointId joint, int axis) const {
    std::array<Real, kMaxJointAxes> value{}, rate{};
    const auto& record = joints_.records()[jointIds_.dense(joint)];
    return value[axisIndex(axis, joints_.readCoordinates(bodies_, record, value, rate))];
}

template <class S>
typename S::Real World<S>::jointSpeed(JointId joint, int axis) const {
    std::array<Real, kMaxJointAxes> value{}, rate{};
    const auto& record = joints_.records()[jointIds_.dense(joint)];
    return rate[axisIndex(axis, joints_.readCoordinates(bodies_, record, value, rate))];
}

template <class S>
void World<S>::setJointAxis(JointId joint, int axis, const JointAxis<Real>& control) {
    require(!stepping(), "step_in_progress", "joints cannot change between the phases of a step");
    auto& record = joints_.records()[jointIds_.dense(joint)];
    const std::size_t k = axisIndex(axis, record.joint.axisCount);
    Joint<S> changed = record.joint;
    changed.axes[k] = control;
    checkJointAxis<S>(changed.type, k, control);
    resolveJointAxes<S>(changed);
    // Impulses to start from belong to rows: with other rows they are no one's.
    const auto rows = [k](const Joint<S>& j) {
        const JointAxis<Real>& a = j.axes[k];
        return std::array{static_cast<int>(a.mode), static_cast<int>(std::isfinite(a.lower)),
                          static_cast<int>(std::isfinite(a.upper)), static_cast<int>(a.hasMotor()),
                          static_cast<int>(a.hasSpring())};
    };
    wakeIslandOf(changed.a);
    wakeIslandOf(changed.b);
    if (rows(changed) != rows(record.joint)) record.impulse.fill(0);
    record.joint = changed;
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

template <class S>
const JointAxis<typename S::Real>& World<S>::jointAxis(JointId joint, int axis) const {
    const Joint<S>& j = joint_(joint);
    return j.axes[axisIndex(axis, j.axisCount)];
}

template <class S>
std::span<const typename S::Real> World<S>::jointImpulses(JointId joint) const {
    const auto& record = joints_.records()[jointIds_.dense(joint)];
    return {record.total.data(), record.rows};
}

template <class S>
std::pair<std::uint32_t, std::uint32_t> World<S>::jointRows(JointId joint) const {
    const auto& record = joints_.records()[jointIds_.dense(joint)];
    return {record.firstRow, record.rows};
}

#define RIGOR_INSTANTIATE(S)                                                           \
    template JointId World<S>::addJoint(const JointDef<S>&);                           \
    template void World<S>::removeJoint(JointId);                                      \
    template void World<S>::rebuildExclusions();                                       \
    template void World<S>::breakJoints();                                             \
    template World<S>::Vec World<S>::jointForce(JointId) const;                        \
    template World<S>::Ang World<S>::jointTorque(JointId) const;                       \
    template World<S>::Real World<S>::jointCoordinate(JointId, int) const;             \
    template World<S>::Real World<S>::jointSpeed(JointId, int) const;                  \
    template void World<S>::setJointAxis(JointId, int, const JointAxis<Real>&);        \
    template void World<S>::setJointMotor(JointId, int, Real, Real);                   \
    template void World<S>::setJointTarget(JointId, int, Real);                        \
    template const JointAxis<World<S>::Real>& World<S>::jointAxis(JointId, int) const; \
    template std::span<const World<S>::Real> World<S>::jointImpulses(JointId) const;   \
    template std::pair<std::uint32_t, std::uint32_t> World<S>::jointRows(JointId) const;
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
