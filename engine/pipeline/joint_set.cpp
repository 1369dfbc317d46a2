// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/joint_set.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace rigor::engine {
namespace {

// An anchor that swings by up to 0.4 rad in a step gets all of the term beyond the linear one, from 0.6 rad
// on none: the predicted end of the step gives an ever poorer direction, and the iteration may diverge.
// Chosen among 0.2..1 on whipping chains of ten links, where 0.9..1 gained energy.
constexpr double kFullSwing = 0.4, kNoSwing = 0.6;

template <class S>
typename S::Real swingFraction(typename S::Real h, const typename S::Ang& w, const typename S::Vec& arm) {
    using Real = typename S::Real;
    const Real length = arm.norm();
    if (!(length > 0)) return Real(1);
    const Real swing = h * cross(w, arm).norm() / length;
    return std::clamp((Real(kNoSwing) - swing) / Real(kNoSwing - kFullSwing), Real(0), Real(1));
}

/// Inverse K of the block without softness: soft rows are satisfied as hard ones are, only later, and the
/// degrees of freedom left do not depend on the step size, which softness does.
template <class S>
BlockMatrix<S> invertHard(const Row<S>* equalities, const Block<S>& block) {
    std::array<Row<S>, kMaxJointRows> hard;
    for (int i = 0; i < block.rows; ++i) {
        const auto k = static_cast<std::size_t>(i);
        hard[k] = equalities[i];
        hard[k].softness = 0;
    }
    BlockMatrix<S> inverse;
    invertBlock<S>(hard.data(), block, inverse);
    return inverse;
}

/// Spring of stiffness k and damping c on a row of mobility `K`; `velocities` are those before forces.
template <class S>
void setMidpointSpring(const Block<S>& block, typename S::Real k, typename S::Real c, typename S::Real K,
                       typename S::Real h, std::span<const Velocity<S>> velocities, Row<S>& row) {
    const MidpointTerms<typename S::Real> terms = midpointSpringTerms(k, c, K, h);
    const typename S::Real u = rowVelocity<S>(row, velocities[block.a], velocities[block.b]);
    row.bias = row.relaxedBias = terms.biasRate * row.error + terms.velocityRate * u;
    row.softness = row.relaxedSoftness = terms.gamma;
}

/// A spring given by its frequency acts on the effective mass left by the joint: for a door that is its
/// inertia about the hinge, not about its centre of mass. With the equality rows Jh, c = J M^-1 Jh^T and Kh =
/// Jh M^-1 Jh^T,
///     1/m = K - c Kh^-1 c^T   (the Schur complement of the equality rows).
template <class S>
void setSpringFrequency(const Row<S>* equalities, const Block<S>& block,
                        const Softness<typename S::Real>& spring, const JointStep<S>& step,
                        std::span<const Velocity<S>> velocities, Row<S>& row) {
    using Real = typename S::Real;
    const BlockMatrix<S> inverse = invertHard<S>(equalities, block);
    const Real K = rowCoupling<S>(row, row, block);
    Real taken = 0;
    for (int i = 0; i < block.rows; ++i) {
        const Real ci = rowCoupling<S>(row, equalities[i], block);
        for (int j = 0; j < block.rows; ++j)
            taken += ci * inverse(i, j) * rowCoupling<S>(row, equalities[j], block);
    }
    // A coordinate whose mobility is below the rounding of K cannot move, and the spring has no effect.
    const Real left = K - taken;
    if (!(left > Real(16) * std::numeric_limits<Real>::epsilon() * K)) return;
    if (step.atMidpoint) {
        const Real omega = Real(6.283185307179586) * spring.frequency;
        setMidpointSpring<S>(block, omega * omega / left, Real(2) * spring.dampingRatio * omega / left, left,
                             step.h, velocities, row);
    } else {
        const SoftTerms<Real> terms = softTerms(spring, left, step.h);
        row.bias = row.relaxedBias = terms.biasRate * row.error;
        row.softness = row.relaxedSoftness = terms.gamma;
    }
    row.invK = Real(1) / (K + row.softness);
}

// A joint that pulls with F on an arm r turns its body back like a spring of stiffness F r per radian (the
// geometric stiffness of [Andrews2017]), of circular frequency w^2 = F r / I, with I about the joint.
// Re-linearised at the end of the step the scheme conserves the energy of that swing, and like every explicit
// scheme of second order it is unstable where w h > 2; linearised at the start it damps it. Full up to (w
// h)^2 = 1/2, none from 3/2: chains of light links under a heavy load, whose swing a step this long cannot
// follow.
constexpr double kFullStiffness = 0.5, kNoStiffness = 1.5;

template <class S>
typename S::Real traceOf(const typename S::Inertia& I) {
    if constexpr (S::dim == 3)
        return I.trace();
    else
        return I;
}

/// `impulse`: that of the joint in this step [N s].
template <class S>
typename S::Real stiffnessFraction(typename S::Real h, typename S::Real impulse, const typename S::Vec& arm,
                                   typename S::Real invMass, const typename S::Inertia& invInertia) {
    using Real = typename S::Real;
    if (!(invMass > 0)) return Real(1);
    const Real squared = arm.squaredNorm(), spin = traceOf<S>(invInertia);
    const Real inertia = squared / invMass + (spin > 0 ? Real(1) / spin : Real(0));
    if (!(inertia > 0)) return Real(1);
    const Real stiffness = h * impulse * std::sqrt(squared) / inertia;
    return std::clamp((Real(kNoStiffness) - stiffness) / Real(kNoStiffness - kFullStiffness), Real(0),
                      Real(1));
}

/// True for joints with an angle over several turns.
constexpr bool countsTurns(JointType type) {
    return type == JointType::ConeTwist || type == JointType::Hinge || type == JointType::SixDof ||
           type == JointType::Wheel;
}

}  // namespace

template <class S>
void JointSet<S>::countRows(const BodyArrays<S>& bodies, Record& record) {
    const Joint<S>& joint = record.joint;
    const bool always = joint.type == JointType::Distance || joint.type == JointType::SixDof;
    const AxisRowCount axes = joint.hasLimitOrMotor || always ? countAxisRows(joint) : AxisRowCount{};
    if (record.ownRows < 0) {
        record.evaluateHere(bodies, made_);
        record.ownRows = made_.count - axes.rows;
        record.ownEqualities = made_.equalities - axes.equalities;
    }
    record.rows = static_cast<std::uint32_t>(record.ownRows + axes.rows);
    record.equalities = static_cast<std::uint32_t>(record.ownEqualities + axes.equalities);
}

/// Calls work(record, scratch) for every record, shared by the threads.
template <class S>
template <class Work>
void JointSet<S>::forRecords(const Tasks& tasks, const Work& work) {
    if (tasks.threads() == 1) {
        for (Record& record : records_) work(record, made_);
        return;
    }
    tasks.forRanges(records_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        JointRows<S> made;
        for (std::size_t i = begin; i < end; ++i) work(records_[i], made);
    });
}

template <class S>
void JointSet<S>::addRows(const BodyArrays<S>& bodies, const JointStep<S>& step, ConstraintRows<S>& rows,
                          const Tasks& tasks) {
    recordOf_.clear();
    for (Record& record : records_) {
        const std::uint32_t a = record.joint.a, b = record.joint.b;
        record.solved = record.islands == step.islands;
        record.updates = 0;
        record.linear = false;
        if (!record.solved) continue;
        record.firstRow = static_cast<std::uint32_t>(rows.rows.size());
        if (bodies.invMass[a] == 0 && bodies.invMass[b] == 0) {  // asleep
            record.rows = record.equalities = 0;
            continue;
        }
        countRows(bodies, record);
        record.block = static_cast<std::uint32_t>(rows.blocks.size());
        rows.rows.resize(record.firstRow + record.rows);
        rows.blocks.resize(record.block + record.rows - record.equalities + (record.equalities > 0));
        recordOf_.resize(rows.blocks.size(), kNullIndex);
        if (record.rows > 0) recordOf_[record.block] = static_cast<std::uint32_t>(&record - records_.data());
    }
    forRecords(tasks, [&](Record& record, JointRows<S>& made) {
        if (record.solved && (record.rows > 0 || countsTurns(record.joint.type)))
            fillRows(bodies, step, record, made, rows);
    });
    startBias_.resize(rows.rows.size());
    for (std::size_t i = 0; i < startBias_.size(); ++i) startBias_[i] = rows.rows[i].bias;
}

template <class S>
void JointSet<S>::fillRows(const BodyArrays<S>& bodies, const JointStep<S>& step, Record& record,
                           JointRows<S>& made, ConstraintRows<S>& rows) const {
    Joint<S>& joint = record.joint;
    // After a sub-step the coordinates are read here, at the end of a step by storeImpulses().
    made.reading = !step.begins && countsTurns(joint.type);
    record.evaluateHere(bodies, made);
    if (made.reading) std::copy_n(made.value.begin(), made.axes, joint.lastCoordinate.begin());
    made.reading = false;
    // A forged snapshot may say otherwise than the joint's axes do.
    while (made.count < static_cast<int>(record.rows)) made.add(Real(0));
    record.armB = rotate(bodies.pose[joint.b].q, joint.anchorB);
    Block<S> block;
    block.a = joint.a;
    block.b = joint.b;
    block.invMassA = bodies.invMass[joint.a];
    block.invMassB = bodies.invMass[joint.b];
    Block<S>* next = rows.blocks.data() + record.block;
    Row<S>* const own = rows.rows.data() + record.firstRow;
    for (std::uint32_t i = 0; i < record.rows; ++i) {
        if (i == 0 || i >= record.equalities) {
            block.kind = i < record.equalities ? BlockKind::Joint : BlockKind::Bounded;
            block.rows = static_cast<std::uint8_t>(i < record.equalities ? record.equalities : 1);
            block.first = record.firstRow + i;
            *next++ = block;
        }
        Row<S>& row = own[i];
        row.lin = made.row[i].lin;
        row.angA = made.row[i].angA;
        row.angB = made.row[i].angB;
        addRow(bodies, step, made.law[i], made.error[i], block, row);
        row.impulse = step.warmStart * record.impulse[i];
        if (i >= record.equalities) row.impulse = std::clamp(row.impulse, row.lower, row.upper);
    }
    for (std::uint32_t i = record.equalities; i < record.rows && record.equalities > 0; ++i)
        if (made.law[i].role == RowRole::Spring && made.law[i].softness.frequency > 0)
            setSpringFrequency<S>(own, rows.blocks[record.block], made.law[i].softness, step, bodies.velocity,
                                  own[i]);
}

/// Completes a row whose Jacobian is set: effective mass, bias, softness, bounds.
template <class S>
void JointSet<S>::addRow(const BodyArrays<S>& bodies, const JointStep<S>& step, const RowLaw<S>& law,
                         Real error, const Block<S>& block, Row<S>& row) const {
    completeRow<S>(row, block, bodies.invInertia);
    const Real K = rowCoupling<S>(row, row, block);
    row.error = error;
    switch (law.role) {
        case RowRole::Motor:
            row.bias = row.relaxedBias = -law.speed;
            row.lower = -step.h * law.maxForce;
            row.upper = step.h * law.maxForce;
            break;
        case RowRole::Spring: {
            if (step.atMidpoint && law.softness.frequency <= 0) {
                setMidpointSpring<S>(block, law.stiffness, law.damping, K, step.h, bodies.velocity, row);
                break;
            }
            const SoftTerms<Real> terms = law.softness.frequency > 0
                                              ? softTerms(law.softness, K, step.h)
                                              : springTerms(law.stiffness, law.damping, step.h);
            row.bias = row.relaxedBias = terms.biasRate * error;
            row.softness = row.relaxedSoftness = terms.gamma;
            break;
        }
        case RowRole::Limit:
            row.lower = 0;
            if (error > 0) {
                row.bias = row.relaxedBias = error / step.h;
                break;
            }
            [[fallthrough]];
        case RowRole::Equality:
            if (step.bias.soft) {
                const SoftTerms<Real> terms = softTerms(step.bias.joint, K, step.h);
                row.bias = terms.biasRate * error;
                row.softness = terms.gamma;
            } else {
                row.bias = step.bias.baumgarte * error / step.h;
            }
            break;
    }
    const Real whole = K + row.softness;
    row.invK = whole > 0 ? Real(1) / whole : Real(0);
}

template <class S>
template <class Use>
void JointSet<S>::forBlocks(std::span<const std::uint32_t> blocks, const Use& use) {
    for (const std::uint32_t block : blocks)
        if (block < recordOf_.size() && recordOf_[block] != kNullIndex) use(records_[recordOf_[block]]);
}

template <class S>
void JointSet<S>::updateBiases(const BodyArrays<S>& bodies, const JointStep<S>& step,
                               std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows) {
    if (!step.relinearized) return;
    for (Record& record : records_)
        if (record.solved && record.rows > 0) updateBias(bodies, step, velocities, record, rows);
}

template <class S>
void JointSet<S>::updateBiases(const BodyArrays<S>& bodies, const JointStep<S>& step,
                               std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows,
                               std::span<const std::uint32_t> blocks) {
    if (!step.relinearized) return;
    forBlocks(blocks, [&](Record& record) { updateBias(bodies, step, velocities, record, rows); });
}

template <class S>
void JointSet<S>::updateChanging(const BodyArrays<S>& bodies, const JointStep<S>& step,
                                 std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows,
                                 Real still) {
    for (Record& record : records_)
        if (record.solved && record.isIterated() && record.change.step > still)
            updateBias(bodies, step, velocities, record, rows);
}

template <class S>
void JointSet<S>::linearise(const BodyArrays<S>& bodies, const JointStep<S>& step,
                            std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows,
                            std::span<const std::uint32_t> blocks) {
    forBlocks(blocks, [&](Record& record) {
        renewBias(bodies, step, velocities, record, Real(0), rows);
        record.linear = true;
    });
}

template <class S>
void JointSet<S>::updateBias(const BodyArrays<S>& bodies, const JointStep<S>& step,
                             std::span<const Velocity<S>> velocities, Record& record,
                             ConstraintRows<S>& rows) {
    if (record.linear) return;
    ++record.updates;
    const Block<S>& block = rows.blocks[record.block];
    typename S::Vec force = S::Vec::Zero();
    for (std::uint32_t i = 0; i < record.rows; ++i)
        force += rows.rows[record.firstRow + i].impulse * rows.rows[record.firstRow + i].lin;
    const auto fractionOf = [&](std::uint32_t i, const typename S::Vec& anchor) {
        const typename S::Vec arm = rotate(bodies.pose[i].q, anchor);
        return std::min(
            swingFraction<S>(step.h, velocities[i].w, arm),
            stiffnessFraction<S>(step.h, force.norm(), arm, bodies.invMass[i], bodies.invInertia[i]));
    };
    renewBias(bodies, step, velocities, record,
              std::min(fractionOf(block.a, record.joint.anchorA), fractionOf(block.b, record.joint.anchorB)),
              rows);
}

/// `fraction`: of what the joint is off beyond its linearisation.
template <class S>
void JointSet<S>::renewBias(const BodyArrays<S>& bodies, const JointStep<S>& step,
                            std::span<const Velocity<S>> velocities, Record& record, Real fraction,
                            ConstraintRows<S>& rows) {
    const Block<S>& block = rows.blocks[record.block];
    const typename S::Vec from = bodies.pose[record.origin(bodies)].p;
    const auto moved = [&](std::uint32_t i) -> Pose<S> {
        return {(bodies.pose[i].p - from) + step.h * velocities[i].v,
                rotatedBy(bodies.pose[i].q, typename S::Ang(step.h * velocities[i].w))};
    };
    record.evaluate(record.joint, moved(block.a), moved(block.b), made_);
    record.change = {};
    for (std::uint32_t i = 0; i < record.rows; ++i) {
        if (made_.law[i].role != RowRole::Equality && made_.law[i].role != RowRole::Limit) continue;
        Row<S>& row = rows.rows[record.firstRow + i];
        const Real beyondLinear = (made_.error[i] - row.error) / step.h -
                                  rowVelocity<S>(row, velocities[block.a], velocities[block.b]);
        const Real bias = fraction * beyondLinear;
        record.change.step = std::max(record.change.step, std::abs(bias - row.relaxedBias));
        record.change.largest = std::max(record.change.largest, std::abs(bias));
        row.relaxedBias = bias;
        row.bias = row.relaxedBias + startBias_[record.firstRow + i];
    }
}

template <class S>
void JointSet<S>::storeImpulses(const BodyArrays<S>& bodies, const ConstraintRows<S>& rows, bool ends,
                                const Tasks& tasks) {
    const auto store = [&](Record& record, JointRows<S>& made) {
        Joint<S>& joint = record.joint;
        typename S::Vec force = S::Vec::Zero();
        typename S::Ang moment = zeroAng<S>();
        for (std::uint32_t i = 0; i < record.rows; ++i) {
            const Row<S>& row = rows.rows[record.firstRow + i];
            record.impulse[i] = row.impulse;
            record.total[i] += row.impulse;
            force += row.impulse * row.lin;
            moment += row.impulse * row.angB;
        }
        record.reactionImpulse += force;
        record.reactionAngularImpulse += moment - cross(record.armB, force);
        if (!ends || !countsTurns(joint.type)) return;
        made.reading = true;
        record.evaluateHere(bodies, made);
        made.reading = false;
        std::copy_n(made.value.begin(), made.axes, joint.lastCoordinate.begin());
    };
    forRecords(tasks, [&](Record& record, JointRows<S>& made) {
        if (record.solved) store(record, made);
    });
}

template <class S>
int JointSet<S>::readCoordinates(const BodyArrays<S>& bodies, const Record& record,
                                 std::array<Real, kMaxJointAxes>& value,
                                 std::array<Real, kMaxJointAxes>& rate) const {
    const Joint<S>& joint = record.joint;
    JointRows<S> made;
    made.reading = true;
    record.evaluateHere(bodies, made);
    for (std::size_t k = 0; k < static_cast<std::size_t>(made.axes); ++k) {
        value[k] = made.value[k];
        rate[k] = rowVelocity<S>(made.along[k], bodies.velocity[joint.a], bodies.velocity[joint.b]);
    }
    return made.axes;
}

template <class S>
void JointSet<S>::clearTotals() {
    for (Record& record : records_) {
        record.total.fill(0);
        record.reactionImpulse.setZero();
        record.reactionAngularImpulse = zeroAng<S>();
    }
}

RIGOR_INSTANTIATE_CLASS(JointSet)

}  // namespace rigor::engine
