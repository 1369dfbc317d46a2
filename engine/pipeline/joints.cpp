// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/joints.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/contacts/contact.hpp"
#include "engine/pipeline/require.hpp"

namespace rigor::engine {
namespace {

std::size_t axisIndex(int axis, int count) {
    require(axis >= 0 && axis < count, "joint_axes", "the joint has no such coordinate");
    return static_cast<std::size_t>(axis);
}

}  // namespace

template <class S>
JointId Joints<S>::add(const JointDef<S>& def, const BodyArrays<S>& bodies, std::uint32_t a,
                       std::uint32_t b) {
    Record record;
    record.joint = makeJoint<S>(def, bodies.pose[a], bodies.constants[a].centerOfMass, bodies.pose[b],
                                bodies.constants[b].centerOfMass);
    record.joint.a = a;
    record.joint.b = b;
    record.evaluate = findJoint<S>(def.type).evaluate;
    record.joint.id = ids_.add(static_cast<std::uint32_t>(records().size()));
    records().push_back(record);
    return record.joint.id;
}

template <class S>
void Joints<S>::remove(JointId joint) {
    const std::uint32_t gone = ids_.dense(joint);
    ids_.remove(joint);
    records().erase(records().begin() + gone);
    for (std::uint32_t i = gone; i < records().size(); ++i) ids_.move(records()[i].joint.id, i);
}

template <class S>
void Joints<S>::bodyRemoved(std::uint32_t gone, std::uint32_t last) {
    std::vector<Record>& all = records();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        Joint<S>& joint = all[i].joint;
        if (joint.a == gone || joint.b == gone) {
            ids_.remove(joint.id);
            continue;
        }
        if (joint.a == last) joint.a = gone;
        if (joint.b == last) joint.b = gone;
        ids_.move(joint.id, static_cast<std::uint32_t>(kept));
        if (kept != i) all[kept] = all[i];
        ++kept;
    }
    all.resize(kept);
}

template <class S>
void Joints<S>::centerMoved(std::uint32_t body, const Vec& way) {
    for (Record& record : records()) {
        if (record.joint.a == body) record.joint.anchorA -= way;
        if (record.joint.b == body) record.joint.anchorB -= way;
    }
}

template <class S>
std::vector<std::uint64_t> Joints<S>::exclusions() const {
    std::vector<std::uint64_t> pairs;
    for (const Record& record : records())
        if (!record.joint.collideConnected) pairs.push_back(pairKey(record.joint.a, record.joint.b));
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

template <class S>
void Joints<S>::findOverloaded(Real duration, std::vector<JointId>& broken) const {
    broken.clear();
    for (const Record& record : records()) {
        const Joint<S>& joint = record.joint;
        if (!std::isfinite(joint.breakForce) && !std::isfinite(joint.breakTorque)) continue;
        const Ang mean = torque(joint.id, duration);
        if (force(joint.id, duration).norm() > joint.breakForce ||
            std::sqrt(dotAng(mean, mean)) > joint.breakTorque)
            broken.push_back(joint.id);
    }
}

template <class S>
typename S::Vec Joints<S>::force(JointId joint, Real duration) const {
    const Record& record = this->record(joint);
    if (duration == 0) return Vec::Zero();
    return record.reactionImpulse / duration;
}

template <class S>
typename S::Ang Joints<S>::torque(JointId joint, Real duration) const {
    const Record& record = this->record(joint);
    if (duration == 0) return zeroAng<S>();
    return record.reactionAngularImpulse / duration;
}

template <class S>
typename S::Real Joints<S>::coordinate(JointId joint, int axis, const BodyArrays<S>& bodies) const {
    std::array<Real, kMaxJointAxes> value{}, rate{};
    return value[axisIndex(axis, set_.readCoordinates(bodies, record(joint), value, rate))];
}

template <class S>
typename S::Real Joints<S>::speed(JointId joint, int axis, const BodyArrays<S>& bodies) const {
    std::array<Real, kMaxJointAxes> value{}, rate{};
    return rate[axisIndex(axis, set_.readCoordinates(bodies, record(joint), value, rate))];
}

template <class S>
const JointAxis<typename S::Real>& Joints<S>::axis(JointId joint, int axis) const {
    const Joint<S>& j = record(joint).joint;
    return j.axes[axisIndex(axis, j.axisCount)];
}

template <class S>
std::span<const typename S::Real> Joints<S>::impulses(JointId joint) const {
    const Record& record = this->record(joint);
    return {record.total.data(), record.rows};
}

template <class S>
std::pair<std::uint32_t, std::uint32_t> Joints<S>::rows(JointId joint) const {
    const Record& record = this->record(joint);
    return {record.firstRow, record.solved ? record.rows : 0};
}

template <class S>
void Joints<S>::setAxis(JointId joint, int axis, const JointAxis<Real>& control) {
    Record& record = records()[ids_.dense(joint)];
    const std::size_t k = axisIndex(axis, record.joint.axisCount);
    Joint<S> changed = record.joint;
    changed.axes[k] = control;
    checkJointAxis<S>(changed.type, k, control);
    resolveJointAxes<S>(changed);
    // Impulses to start from belong to rows: with other rows they are no one's.
    const auto rowsOf = [k](const Joint<S>& j) {
        const JointAxis<Real>& a = j.axes[k];
        return std::array{static_cast<int>(a.mode), static_cast<int>(std::isfinite(a.lower)),
                          static_cast<int>(std::isfinite(a.upper)), static_cast<int>(a.hasMotor()),
                          static_cast<int>(a.hasSpring())};
    };
    if (rowsOf(changed) != rowsOf(record.joint)) record.impulse.fill(0);
    record.joint = changed;
}

RIGOR_INSTANTIATE_CLASS(Joints)

}  // namespace rigor::engine
