// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The joints of a world by their handles: adding, removing, reading and driving them. Their rows: JointSet.
//
// Invariant: ids() leads from a record's joint.id back to its index; records keep the order in which they were
// added.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/ids.hpp"
#include "engine/pipeline/joint_set.hpp"

namespace rigor::engine {

template <class S>
class Joints {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    using Ang = typename S::Ang;
    using Record = typename JointSet<S>::Record;

    JointSet<S>& set() { return set_; }
    const std::vector<Record>& records() const { return set_.records(); }
    std::vector<Record>& records() { return set_.records(); }
    IdTable<JointTag>& ids() { return ids_; }
    const IdTable<JointTag>& ids() const { return ids_; }
    const Record& record(JointId joint) const { return set_.records()[ids_.dense(joint)]; }
    const Joint<S>& joint(JointId joint) const { return record(joint).joint; }

    /// Adds a joint between the bodies of dense indices a and b. Throws EngineError for values out of range.
    JointId add(const JointDef<S>& def, const BodyArrays<S>& bodies, std::uint32_t a, std::uint32_t b);
    void remove(JointId joint);
    /// Removes the joints of body `gone`, whose dense index body `last` takes.
    void bodyRemoved(std::uint32_t gone, std::uint32_t last);
    /// The centre of mass of a body has moved by `way`, body axes [m]: anchors are relative to it.
    void centerMoved(std::uint32_t body, const Vec& way);
    /// Pairs of bodies that joints keep from colliding: sorted keys (pairKey).
    std::vector<std::uint64_t> exclusions() const;
    /// Replaces `broken` by the joints whose mean force or torque over `duration` [s] was too large for them.
    void findOverloaded(Real duration, std::vector<JointId>& broken) const;

    // --- reading. `duration`: of the last step [s]; 0: there was none.
    /// Mean force of A on B at B's anchor [N], torque about it [N m].
    Vec force(JointId joint, Real duration) const;
    Ang torque(JointId joint, Real duration) const;
    Real coordinate(JointId joint, int axis, const BodyArrays<S>& bodies) const;
    Real speed(JointId joint, int axis, const BodyArrays<S>& bodies) const;
    const JointAxis<Real>& axis(JointId joint, int axis) const;
    /// Impulses of its rows in the last step.
    std::span<const Real> impulses(JointId joint) const;
    /// The first of its rows in the last sub-step, and how many.
    std::pair<std::uint32_t, std::uint32_t> rows(JointId joint) const;

    /// Replaces the limits, motor and spring of a coordinate. Throws EngineError as add() does.
    void setAxis(JointId joint, int axis, const JointAxis<Real>& control);

  private:
    JointSet<S> set_;
    IdTable<JointTag> ids_;
};

}  // namespace rigor::engine
