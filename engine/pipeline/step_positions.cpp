// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/step_positions.hpp"

namespace rigor::engine {

template <class S>
StepPositions<S>::StepPositions(BodyArrays<S>& bodies, const JointSet<S>& joints,
                                const ConstraintRows<S>& rows, std::span<const Velocity<S>> used, Real h,
                                Real separating, PositionScratch<S>& scratch)
    : bodies_(bodies), joints_(joints), rows_(rows), scratch_(scratch), h_(h) {
    const std::size_t n = bodies.size();
    scratch.motion.resize(n);
    scratch.turn.assign(n, zeroAng<S>());
    scratch.turned.clear();
    scratch.turned.reserve(2 * n);
    for (std::size_t i = 0; i < n; ++i) {
        scratch.motion[i].v = h * used[i].v;
        scratch.motion[i].w = h * used[i].w;
    }
    scratch.contacts.clear();
    for (std::uint32_t i = 0; i < rows.blocks.size(); ++i) {
        const Block<S>& block = rows.blocks[i];
        if (block.kind != BlockKind::Contact) continue;
        const Row<S>& normal = rows.rows[block.first];
        Real speed = rowVelocity<S>(normal, bodies.velocity[block.a], bodies.velocity[block.b]);
        // A curve lifts the body by as much as its row lags (contacts/row_lag.hpp): it does not separate.
        if (block.restitution == 0 && normal.bias < 0) speed += normal.bias;
        if (speed <= separating) scratch.contacts.push_back(i);
    }
}

template <class S>
void StepPositions<S>::evaluateJoint(std::size_t index, JointPositions<S>& out) const {
    const typename JointSet<S>::Record& record = joints_.records()[index];
    JointRows<S>& made = scratch_.made;
    const std::uint32_t a = record.joint.a, b = record.joint.b;
    out.block.rows = 0;
    out.count = 0;
    if (bodies_.invMass[a] == 0 && bodies_.invMass[b] == 0) return;  // asleep
    if (record.islands == IslandKind::Large) return;                 // their joints are linearised
    if (!only_.empty() && !only_[a] && !only_[b]) return;
    record.evaluateHere(bodies_, made);
    const auto count = static_cast<std::size_t>(made.count);
    if (out.row.size() < count) out.row.resize(count);
    out.block.kind = BlockKind::Joint;
    out.block.a = a;
    out.block.b = b;
    out.block.invMassA = bodies_.invMass[a];
    out.block.invMassB = bodies_.invMass[b];
    const auto isHeld = [&](std::size_t i) {
        if (made.law[i].role == RowRole::Equality) return true;
        return holdsMotors_ && made.law[i].role == RowRole::Motor && out.count < kMaxJointRows &&
               std::abs(record.impulse[i]) < h_ * made.law[i].maxForce;
    };
    const auto inertiaOf = [&](std::uint32_t body) {
        return bodies_.invMass[body] > 0
                   ? worldInertia<S>(bodies_.pose[body].q, bodies_.invInertiaLocal[body])
                   : zeroInertia<S>();
    };
    const typename S::Inertia inertiaA = inertiaOf(a), inertiaB = inertiaOf(b);
    const auto add = [&](std::size_t i) {
        const auto place = static_cast<std::size_t>(out.count++);
        Row<S>& row = out.row[place];
        row = made.row[i];
        row.error = made.law[i].role == RowRole::Motor ? Real(0) : made.error[i];
        row.invIAngA = inertiaA * row.angA;
        row.invIAngB = inertiaB * row.angB;
        row.softness = 0;
        const Real K = rowK<S>(row, out.block);
        row.invK = K > 0 ? Real(1) / K : Real(0);
        out.unilateral[place] = made.law[i].role == RowRole::Limit;
        out.driven[place] = made.law[i].role == RowRole::Motor;
        out.velocityRow[place] = record.firstRow + static_cast<std::uint32_t>(i);
    };
    for (std::size_t i = 0; i < count; ++i)
        if (isHeld(i)) add(i);
    out.block.rows = static_cast<std::uint8_t>(out.count);
    for (std::size_t i = 0; i < count; ++i)
        if (made.law[i].role == RowRole::Limit) add(i);
}

template <class S>
void StepPositions<S>::moveBody(std::uint32_t body, const typename S::Vec& by, const typename S::Ang& turn) {
    bodies_.pose[body].p += by;
    scratch_.motion[body].v += by;
    scratch_.motion[body].w += turn;
    const bool first = dotAng(scratch_.turn[body], scratch_.turn[body]) == Real(0);
    scratch_.turn[body] += turn;
    if (first) scratch_.turned.push_back(body);
}

template <class S>
void StepPositions<S>::move(const Block<S>& block, const Row<S>& row, Real lambda) {
    if (lambda == Real(0)) return;
    if (block.invMassA > 0) moveBody(block.a, -(block.invMassA * lambda) * row.lin, lambda * row.invIAngA);
    if (block.invMassB > 0) moveBody(block.b, (block.invMassB * lambda) * row.lin, lambda * row.invIAngB);
}

template <class S>
void StepPositions<S>::push(const JointPositions<S>& joint, const Real* impulses, Real factor) {
    typename S::Vec force = S::Vec::Zero();
    typename S::Ang momentA = zeroAng<S>(), momentB = zeroAng<S>();
    for (std::size_t r = 0; r < joint.block.rows; ++r) {
        const Real impulse = factor * impulses[r];
        force += impulse * joint.row[r].lin;
        momentA += impulse * joint.row[r].angA;
        momentB += impulse * joint.row[r].angB;
    }
    const auto change = [this](std::uint32_t body, const typename S::Vec& by, const typename S::Ang& moment) {
        if (!(bodies_.invMass[body] > 0)) return;
        bodies_.velocity[body].v += bodies_.invMass[body] * by;
        bodies_.velocity[body].w +=
            worldInertia<S>(bodies_.pose[body].q, bodies_.invInertiaLocal[body]) * moment;
    };
    change(joint.block.a, -force, momentA);
    change(joint.block.b, force, momentB);
}

template <class S>
void StepPositions<S>::applyRotations() {
    for (const std::uint32_t i : scratch_.turned) {
        bodies_.pose[i].q = rotatedBy(bodies_.pose[i].q, scratch_.turn[i]);
        scratch_.turn[i] = zeroAng<S>();
    }
    scratch_.turned.clear();
}

RIGOR_INSTANTIATE_CLASS(StepPositions)

}  // namespace rigor::engine
