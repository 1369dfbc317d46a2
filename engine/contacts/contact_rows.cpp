// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact rows. At a point with normal n (A to B), separation s, arms rA, rB from the centres of mass and
// relative velocity u = vB + wB x rB - vA - wA x rA:
//     normal    0 <= lambda_n _|_ n . u + b >= 0
//     tangents  Coulomb's law with limit mu lambda_n for t . (u + s), s the relative velocity of the surfaces over
//               their bodies there (conveyor belts)
//     moments   rolling and torsional friction, moment_rows.hpp; s has its angular velocity in them, too
// and the bias b is one of
//     e n . u_0         impact: s <= 0, n . u_0 < -threshold; u_0 from before this step's forces, so that the
//                       rebound is e times the approach and not e times (approach + g h)
//     s / h             a gap wider than gapSlop, or an impact: the point may just close it in this step
//     overlap           what the bias rule makes of it (Baumgarte, soft), else 0
// A gap with e > 0 gets no rows where it is closing faster than the threshold, or is wider than gravity alone
// closes in a step: closing it would take the speed that the impact has to reverse, or pass on a blow that
// has not reached it. The bodies then collide with an overlap of at most one step's motion, unless they bounce at their own
// time within the step (pipeline/step_bounces.cpp).
#include "engine/contacts/contact_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/contacts/moment_rows.hpp"
#include "engine/contacts/row_lag.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kRowGrain = 16;  ///< least number of contacts for a task: some microseconds of work

/// Rows of the contact block of a point.
template <class S>
std::size_t contactRows(const Contact<S>& contact) {
    const PairCoefficients<S>& pair = contact.coefficients;
    return std::max(pair.friction, pair.staticFriction) > 0 ? 1 + S::tangents : 1;
}
/// Rows and blocks of a point in all.
template <class S>
std::size_t rowsPerPoint(const Contact<S>& contact) {
    return contactRows(contact) + static_cast<std::size_t>(momentRows<S>(contact.coefficients));
}
template <class S>
std::uint32_t blocksPerPoint(const Contact<S>& contact) {
    return 1 + static_cast<std::uint32_t>(momentBlocks<S>(contact.coefficients));
}

/// A row along a direction at a point: its geometry.
template <class S>
Row<S> pointRow(const typename Contact<S>::Point& point, const typename S::Vec& direction) {
    Row<S> row;
    row.lin = direction;
    row.angA = -cross(point.rA, direction);
    row.angB = cross(point.rB, direction);
    return row;
}

}  // namespace

template <class S>
std::array<typename S::Vec, S::tangents> tangentBasis(const typename S::Vec& n) {
    if constexpr (S::dim == 2) {
        return {typename S::Vec(-n.y(), n.x())};
    } else {
        using Vec = typename S::Vec;
        const Vec axis = std::abs(n.x()) < typename S::Real(0.7) ? Vec::Unit(0) : Vec::Unit(1);
        const Vec t1 = axis.cross(n).normalized();
        return {t1, Vec(n.cross(t1))};
    }
}

namespace {

/// Prepares a point for this step. False: the point is speculative and gets no rows.
template <class S>
bool preparePoint(const BodyArrays<S>& bodies, const ContactStep<S>& step, Contact<S>& contact,
                  std::size_t index) {
    using Real = typename S::Real;
    typename Contact<S>::Point& point = contact.points[index];
    const Row<S> normal = pointRow<S>(point, contact.manifold.normal);
    const Real s = point.separation;
    point.approach = rowVelocity<S>(normal, bodies.velocity[contact.bodyA], bodies.velocity[contact.bodyB]);
    const Real restitution = step.bounces ? contact.coefficients.restitution : Real(0);
    const bool bounces = restitution > 0 && point.approach < -step.restitutionThreshold;
    // The blow of an impact in the last sub-step is not what the contact carries from now on.
    if (point.impact) contact.impulses[index] = {};
    point.impact = point.approach < -step.impactSpeed;
    contact.impacts = contact.impacts || point.impact;
    point.rebound =
        contact.speculative && bounces && s > kTouching<Real> ? restitution * point.approach : Real(0);
    const bool mayBounce = restitution > 0 && s > std::max(kTouching<Real>, step.restingGap);
    if (contact.speculative || !((bounces && s > kTouching<Real>) || mayBounce)) return true;
    if (bouncesAhead<S>(bodies, step, contact, point)) return true;
    contact.impulses[index] = {};
    return false;
}

/// Decides which points get rows. `lags`: none in steps whose rows are not those of a midpoint.
template <class S>
void prepareRows(const BodyArrays<S>& bodies, const ContactStep<S>& step, bool stepBegins,
                 Contact<S>& contact, RowLags<S>* lags) {
    contact.asleep = isAsleep(bodies, contact);
    contact.blocks = 0;
    if (!contact.placed) {
        if (lags != nullptr && !contact.lastNormal.isZero(0))
            placeWithLags<S>(bodies, contact, *lags);
        else
            placePoints(bodies, contact);
    }
    if (lags != nullptr) contact.lastNormal = contact.manifold.normal;
    if (stepBegins && !contact.asleep) {
        contact.totals.fill({});
        if (contact.coefficients.hasMoments()) contact.momentTotal = zeroAng<S>();
    }
    for (std::size_t i = 0; i < contact.block.size(); ++i) {
        const bool has = i < static_cast<std::size_t>(contact.manifold.count) && !contact.asleep &&
                         !contact.vetoed && !contact.parted && preparePoint(bodies, step, contact, i);
        contact.block[i] = has ? 0 : kNullIndex;
        contact.blocks += has;
    }
}

/// Sets the bias of a penetrating point by the bias rule.
template <class S>
void setPenetrationBias(const ContactStep<S>& step, const Block<S>& block, typename S::Real s,
                        Row<S>& normal) {
    using Real = typename S::Real;
    const Real overlap = std::min(Real(0), s + step.slop);
    if (!step.bias.soft) {
        normal.bias = step.bias.baumgarte * overlap / step.h;
        return;
    }
    if (s > 0) return;
    const SoftTerms<Real> terms = softTerms(step.bias.contact, rowCoupling<S>(normal, normal, block), step.h);
    normal.bias = std::max(terms.biasRate * overlap, -step.bias.maxBiasVelocity);
    normal.softness = terms.gamma;
    normal.invK = Real(1) / rowK<S>(normal, block);
}

/// The row's velocity is that of the surfaces.
template <class S>
void driveRow(const Contact<S>& contact, Row<S>& row) {
    row.bias = row.relaxedBias = rowVelocity<S>(row, contact.surfaceA, contact.surfaceB);
}

/// Fraction of the contact's last normal impulse that was at a point; its share of the contact's moment.
template <class S>
typename S::Real loadShare(const Contact<S>& contact, std::size_t index) {
    using Real = typename S::Real;
    Real sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i)
        sum += contact.impulses[i].normal;
    return sum > 0 ? contact.impulses[index].normal / sum : Real(0);
}

/// Fills the moment blocks of a point, which follow its contact block, and their rows.
template <class S>
void makePointMoments(const BodyArrays<S>& bodies, const ContactStep<S>& step, const Contact<S>& contact,
                      std::size_t index, Block<S>* point, Row<S>* rows) {
    const typename S::Vec& n = contact.manifold.normal;
    const auto blocks = static_cast<std::size_t>(momentBlocks<S>(contact.coefficients));
    makeMomentBlocks<S>(point[0], contact.coefficients, n, tangentBasis<S>(n), bodies.invInertia,
                        point->first + point->rows, point + 1, rows);
    const typename S::Ang last = typename S::Ang(step.warmStart * loadShare(contact, index) * contact.moment);
    for (std::size_t k = 1; k <= blocks; ++k)
        for (std::uint8_t i = 0; i < point[k].rows; ++i) {
            Row<S>& row = rows[point[k].first - point[1].first + i];
            row.impulse = dotAng(row.angB, last);
            if (contact.driven) driveRow(contact, row);
        }
}

/// Fills a contact block, but for its first row, and its rows.
template <class S>
void makePointRows(const BodyArrays<S>& bodies, const ContactStep<S>& step, const Contact<S>& contact,
                   std::size_t index, Block<S>& block, Row<S>* rows) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    const typename Contact<S>::Point& point = contact.points[index];
    const Vec& n = contact.manifold.normal;
    const std::uint32_t a = contact.bodyA, b = contact.bodyB;
    block.kind = BlockKind::Contact;
    block.a = a;
    block.b = b;
    block.friction = contact.coefficients.friction;
    block.staticFriction = contact.coefficients.staticFriction;
    block.invMassA = bodies.invMass[a];
    block.invMassB = bodies.invMass[b];
    block.rows = static_cast<std::uint8_t>(contactRows(contact));
    const auto makeRow = [&](const Vec& direction) {
        Row<S> row = pointRow<S>(point, direction);
        completeRow<S>(row, block, bodies.invInertia);
        row.invK = Real(1) / rowCoupling<S>(row, row, block);
        return row;
    };
    Row<S>& normal = rows[0];
    normal = makeRow(n);
    normal.error = point.separation;
    const Real restitution = step.bounces ? contact.coefficients.restitution : Real(0);
    const bool bounces = restitution > 0 && point.approach < -step.restitutionThreshold;
    // A bounce that is still ahead is continuous collision's.
    block.restitution = bounces && point.rebound == 0 ? restitution : Real(0);
    if (bounces && point.rebound == 0)
        normal.bias = restitution * point.approach;
    else if (point.separation > (point.impact ? Real(0) : step.gapSlop))
        normal.bias = point.separation / step.h;
    normal.relaxedBias = normal.bias;
    if (normal.bias == 0) setPenetrationBias(step, block, point.separation, normal);
    normal.impulse = step.warmStart * contact.impulses[index].normal;
    if (block.rows == 1) return;

    const std::array<Vec, S::tangents> basis = tangentBasis<S>(n);
    for (std::size_t i = 0; i < basis.size(); ++i) {
        rows[1 + i] = makeRow(basis[i]);
        rows[1 + i].impulse = step.warmStart * basis[i].dot(contact.impulses[index].friction);
        if (contact.driven) driveRow(contact, rows[1 + i]);
    }
    const Row<S>* t = rows + 1;
    block.k11 = rowCoupling<S>(t[0], t[0], block);
    block.k12 = S::tangents > 1 ? rowCoupling<S>(t[0], t[S::tangents - 1], block) : Real(0);
    block.k22 = S::tangents > 1 ? rowCoupling<S>(t[S::tangents - 1], t[S::tangents - 1], block) : Real(1);
}

}  // namespace

/// Totals start at zero with the rows of the first sub-step.
template <class S>
void RowContacts<S>::prepare(ContactList<S>&, const BodyArrays<S>&, const ContactStep<S>& step,
                             const Tasks&) {
    stepBegins_ = !step.continues;
    islands_ = step.islands;
}

template <class S>
void RowContacts<S>::findOwn(const ContactList<S>& contacts) {
    own_.clear();
    for (std::size_t k = 0; k < contacts.size(); ++k)
        if (contacts[k].islands == islands_) own_.push_back(static_cast<std::uint32_t>(k));
}

/// Three passes, so that threads can share the work: which points get rows, where the rows go, the rows.
template <class S>
void RowContacts<S>::beginSubstep(ContactList<S>& contacts, BodyArrays<S>& bodies, const ContactStep<S>& step,
                                  ConstraintRows<S>& rows, const Tasks& tasks) {
    findOwn(contacts);
    lags_.resize(step.rowsLag ? contacts.size() : 0);
    tasks.forEach(own_.size(), kRowGrain, [&](std::size_t i) {
        const std::uint32_t k = own_[i];
        if (step.rowsLag) lags_[k] = {};
        prepareRows<S>(bodies, step, stepBegins_, contacts[k], step.rowsLag ? &lags_[k] : nullptr);
    });
    std::size_t firstRow = rows.rows.size(), firstBlock = rows.blocks.size(), points = 0;
    for (const std::uint32_t k : own_) {
        Contact<S>& contact = contacts[k];
        contact.firstRow = static_cast<std::uint32_t>(firstRow);
        for (std::size_t i = 0; contact.blocks > 0 && i < contact.block.size(); ++i)
            if (contact.block[i] != kNullIndex) {
                contact.block[i] = static_cast<std::uint32_t>(firstBlock);
                firstBlock += blocksPerPoint(contact);
            }
        firstRow += contact.blocks * rowsPerPoint(contact);
        points += contact.blocks;
    }
    counts_ = {points, firstRow - rows.rows.size()};
    stepBegins_ = false;
    rows.rows.resize(firstRow);
    rows.blocks.resize(firstBlock);
    tasks.forEach(own_.size(), kRowGrain, [&](std::size_t at) {
        const std::uint32_t k = own_[at];
        const Contact<S>& contact = contacts[k];
        std::uint32_t row = contact.firstRow;
        for (std::size_t i = 0; contact.blocks > 0 && i < contact.block.size(); ++i) {
            if (contact.block[i] == kNullIndex) continue;
            Block<S>& block = rows.blocks[contact.block[i]];
            block.first = row;
            makePointRows<S>(bodies, step, contact, i, block, rows.rows.data() + row);
            if (!lags_.empty())
                addLag<S>(bodies, step, contact, i, lags_[k][i], block, rows.rows.data() + row);
            if (contact.coefficients.hasMoments())
                makePointMoments<S>(bodies, step, contact, i, &block, rows.rows.data() + row + block.rows);
            row += static_cast<std::uint32_t>(rowsPerPoint(contact));
        }
    });
    findSlips(contacts, bodies, step, rows);
    findLandings<S>(contacts, own_, lags_, landings_);
}

template <class S>
void RowContacts<S>::solve(Solver<S>& solver, const SolverInput<S>& input, const Tasks& tasks) {
    solver.useThreads(tasks);
    solver.solve(input);
}

template <class S>
bool RowContacts<S>::applySpeculativeRestitution(const ContactList<S>& contacts,
                                                 ConstraintRows<S>& rows) const {
    bool any = false;
    for (const std::uint32_t own : own_) {
        const Contact<S>& contact = contacts[own];
        for (int i = 0; contact.speculative && i < contact.manifold.count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            if (contact.points[k].rebound == 0 || contact.block[k] == kNullIndex) continue;
            Row<S>& normal = rows.rows[rows.blocks[contact.block[k]].first];
            if (!(normal.impulse > 0)) continue;
            normal.relaxedBias = contact.points[k].rebound;
            any = true;
        }
    }
    return any;
}

template <class S>
void RowContacts<S>::advance(ContactList<S>& contacts, std::span<const Velocity<S>> velocities, Real h,
                             const Tasks& tasks) {
    tasks.forEach(own_.size(), kRowGrain, [&](std::size_t at) {
        Contact<S>& contact = contacts[own_[at]];
        const Velocity<S>&A = velocities[contact.bodyA], &B = velocities[contact.bodyB];
        const typename S::Vec dA = h * A.v, dB = h * B.v;
        const typename S::Ang aA = h * A.w, aB = h * B.w;
        for (int i = 0; i < contact.manifold.count; ++i) {
            typename Contact<S>::Point& point = contact.points[i];
            const typename S::Vec moved = dB + cross(aB, point.rB) - dA - cross(aA, point.rA);
            point.separation += contact.manifold.normal.dot(moved);
        }
    });
}

template <class S>
void RowContacts<S>::store(ContactList<S>& contacts, const ConstraintRows<S>& rows, bool,
                           const Tasks& tasks) {
    tasks.forEach(own_.size(), kRowGrain, [&](std::size_t at) {
        Contact<S>& contact = contacts[own_[at]];
        const bool moments = contact.coefficients.hasMoments();
        if (moments) contact.moment = zeroAng<S>();
        for (int i = 0; i < contact.manifold.count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            if (contact.block[k] == kNullIndex) continue;
            const Block<S>& block = rows.blocks[contact.block[k]];
            typename Contact<S>::Impulse &now = contact.impulses[k], &total = contact.totals[k];
            now.normal = rows.rows[block.first].impulse;
            now.friction.setZero();
            for (std::uint32_t r = 1; r < block.rows; ++r)
                now.friction += rows.rows[block.first + r].impulse * rows.rows[block.first + r].lin;
            total.normal += now.normal;
            contact.touching = contact.touching || total.normal > 0;
            total.friction += now.friction;
            for (std::uint32_t m = 1; moments && m < blocksPerPoint(contact); ++m) {
                const Block<S>& moment = rows.blocks[contact.block[k] + m];
                for (std::uint32_t r = moment.first; r < moment.first + moment.rows; ++r)
                    contact.moment += rows.rows[r].impulse * rows.rows[r].angB;
            }
        }
        if (moments) contact.momentTotal += contact.moment;
    });
}

#define RIGOR_INSTANTIATE(S) template std::array<S::Vec, S::tangents> tangentBasis<S>(const S::Vec&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE
RIGOR_INSTANTIATE_CLASS(RowContacts)

}  // namespace rigor::engine
