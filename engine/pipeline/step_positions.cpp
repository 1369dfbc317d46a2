// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/step_positions.hpp"

namespace rigor::engine {

template <class S>
StepPositions<S>::StepPositions(BodyArrays<S>& bodies, const JointSet<S>& joints,
                                const ContactSet<S>& contacts, const ConstraintRows<S>& rows,
                                std::span<const Velocity<S>> used, Real h, Real separating,
                                PositionScratch<S>& scratch)
    : bodies_(bodies), joints_(joints), contacts_(contacts), rows_(rows), scratch_(scratch) {
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
    scratch.places.clear();
    std::uint32_t place = 0;
    for (std::uint32_t i = 0; i < rows.blocks.size(); ++i) {
        const Block<S>& block = rows.blocks[i];
        if (block.kind != BlockKind::Contact) continue;
        const Real speed =
            rowVelocity<S>(rows.rows[block.first], bodies.velocity[block.a], bodies.velocity[block.b]);
        if (speed <= separating) {
            scratch.contacts.push_back(i);
            scratch.places.push_back(place);
        }
        ++place;
    }
}

template <class S>
void StepPositions<S>::evaluateJoint(std::size_t index, Block<S>& block, std::span<Row<S>> rows,
                                     BlockVector<S>& error, BlockMatrix<S>& inverseK) const {
    const typename JointSet<S>::Record& record = joints_.records()[index];
    JointRows<S> made;
    block = rows_.blocks[record.block];
    record.evaluate(record.joint, bodies_.pose[block.a], bodies_.pose[block.b], made);
    error.resize(made.count);
    for (std::size_t i = 0; i < static_cast<std::size_t>(made.count); ++i) {
        rows[i] = made.row[i];
        rows[i].invIAngA =
            bodies_.invMass[block.a] > 0
                ? typename S::Ang(worldInertia<S>(bodies_.pose[block.a].q, bodies_.invInertiaLocal[block.a]) *
                                  rows[i].angA)
                : zeroAng<S>();
        rows[i].invIAngB =
            bodies_.invMass[block.b] > 0
                ? typename S::Ang(worldInertia<S>(bodies_.pose[block.b].q, bodies_.invInertiaLocal[block.b]) *
                                  rows[i].angB)
                : zeroAng<S>();
        error[static_cast<Eigen::Index>(i)] = made.error[i];
    }
    invertBlock<S>(rows.data(), block, inverseK);
}

template <class S>
void StepPositions<S>::moveBody(std::uint32_t body, const typename S::Vec& d, const typename S::Ang& turn) {
    bodies_.pose[body].p += d;
    scratch_.motion[body].v += d;
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
void StepPositions<S>::applyRotations() {
    for (const std::uint32_t i : scratch_.turned) {
        bodies_.pose[i].q = rotatedBy(bodies_.pose[i].q, scratch_.turn[i]);
        scratch_.turn[i] = zeroAng<S>();
    }
    scratch_.turned.clear();
}

template class StepPositions<Space2f>;
template class StepPositions<Space2d>;
template class StepPositions<Space3f>;
template class StepPositions<Space3d>;

}  // namespace rigor::engine
