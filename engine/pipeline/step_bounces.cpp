// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bounces within a step of bodies that flight_impacts.hpp does not take, as those of a ball onto a block that rests. With rows
// at the gap in the step's middle q_M alone, they would bounce a step late, in each other by up to the way of a step. Instead
//     tau                               fraction of the step until the shapes touch on their ways (timeOfImpact)
//     n, r_A, r_B                       normal and arms there, about the centres of mass as they are then
//     n . u_1 >= -e n . u_0             the law of impact, solved with all other rows of the step
//     q_M1 = q_M + h v_1 - h sum_i tau_i M^-1 J_i^T p_i                     each impulse p_i moves its bodies from tau_i on
// Two bodies that meet no third one keep their angular momentum: at tau both are where the impulse acts on them. Of bodies that
// bounce twice within a step it is kept but for h (tau_2 - tau_1) p_1 x p_2 / m. Contacts with pieces of surfaces have rows at
// the gap, with the time at which that closes.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/contacts/contact_rows.hpp"
#include "engine/contacts/row_lag.hpp"
#include "engine/contacts/time_of_impact.hpp"
#include "engine/pipeline/point_speed.hpp"
#include "engine/pipeline/step.hpp"

namespace rigor::engine {
namespace {

/// Some point is apart, none overlaps, and one closes its gap within the step.
template <class S>
bool closes(const BodyArrays<S>& bodies, const Contact<S>& contact, typename S::Real h) {
    bool any = false;
    for (int i = 0; i < contact.manifold.count; ++i) {
        const ManifoldPoint<S>& point = contact.manifold.points[i];
        if (point.separation <= kTouching<typename S::Real>) return false;
        any = any || point.separation < -h * normalSpeed<S>(bodies, contact, point);
    }
    return any;
}

template <class S>
bool overlapsAndApproaches(const BodyArrays<S>& bodies, const Contact<S>& contact, typename S::Real slowest) {
    for (int i = 0; i < contact.manifold.count; ++i) {
        const ManifoldPoint<S>& point = contact.manifold.points[i];
        if (point.separation <= kTouching<typename S::Real> &&
            normalSpeed<S>(bodies, contact, point) < -slowest)
            return true;
    }
    return false;
}

/// The manifold where the shapes touch, `time` [s] later.
template <class S>
void findThere(const MovingShape<S>& a, const MovingShape<S>& b, typename S::Real time,
               const NarrowPhase<S>& narrowPhase, Manifold<S>& manifold) {
    Manifold<S> there;
    there.memory = manifold.memory;
    narrowPhase.collide(*a.shape, a.at(time), *b.shape, b.at(time), 2 * touchingGap<S>(a, b), there);
    if (there.count == 0)
        setToClosest<S>(closestPoints<S>(*a.shape, a.at(time), *b.shape, b.at(time)), there);
    manifold = there;
}

/// Moves the points of a manifold that was found `time` [s] later by what their bodies move until then, and places them:
/// with the arms that the impulse has then. A gap is what its closing speed covers.
template <class S>
void bringBack(const BodyArrays<S>& bodies, typename S::Real time, Contact<S>& contact) {
    using Vec = typename S::Vec;
    using Real = typename S::Real;
    const std::uint32_t a = contact.bodyA, b = contact.bodyB;
    const Velocity<S>&A = bodies.velocity[a], &B = bodies.velocity[b];
    const Vec &pA = bodies.pose[a].p, &pB = bodies.pose[b].p;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        ManifoldPoint<S>& where = contact.manifold.points[i];
        typename Contact<S>::Point& point = contact.points[i];
        const Vec at = impulsePoint<S>(where, bodies.invMass[a] > 0, bodies.invMass[b] > 0);
        point.rA = at - (pA + time * A.v);
        point.rB = at - (pB + time * B.v);
        const Vec& n = contact.manifold.normal;
        const Vec u = relativeVelocity<S>({point.rA, point.rB, n}, A, B);
        point.separation = std::max(-time * n.dot(u), Real(2) * kTouching<Real>);
        where.pointA -= time * A.v;
        where.pointB -= time * B.v;
        where.separation = point.separation;
    }
    contact.placed = true;
}

/// The body that acts on each: one of no index if none does, kNullIndex if several do.
template <class S>
void findPartners(const ConstraintRows<S>& rows, std::size_t bodies, std::vector<std::uint32_t>& partners) {
    constexpr std::uint32_t none = kNullIndex - 1;
    partners.assign(bodies, none);
    const auto join = [&](std::uint32_t body, std::uint32_t other) {
        partners[body] = partners[body] == none || partners[body] == other ? other : kNullIndex;
    };
    for (const Block<S>& block : rows.blocks) {
        const Row<S>* first = rows.rows.data() + block.first;
        if (std::all_of(first, first + block.rows, [](const Row<S>& row) { return row.impulse == 0; }))
            continue;
        join(block.a, block.b);
        join(block.b, block.a);
    }
}

template <class S>
Velocity<S> sum(const Velocity<S>& a, const Velocity<S>& b, typename S::Real share) {
    return {typename S::Vec(a.v + share * b.v), typename S::Ang(a.w + share * b.w)};
}

}  // namespace

template <class S>
void Step<S>::placeBounces() {
    findBounces();
    leaveSecondBounces();
    const NarrowPhase<S>& narrowPhase = *algorithms_.narrowPhase;
    const Tasks& those = narrowPhase.manyThreads() ? tasks_ : Tasks::one();
    those.forEach(state_.bouncing.size(), 1, [&](std::size_t i) {
        Contact<S>& contact = contacts_.list()[state_.bouncing[i]];
        if (contact.bounceTime == 0 || contact.piece != kNullIndex) return;
        findThere<S>(movingShapeOf(contact.shapeA), movingShapeOf(contact.shapeB), contact.bounceTime,
                     narrowPhase, contact.manifold);
        bringBack<S>(bodies_, contact.bounceTime, contact);
        contact.lastNormal.setZero();
    });
}

template <class S>
MovingShape<S> Step<S>::movingShapeOf(std::uint32_t shape) const {
    const ShapeRecord<S>& record = contacts_.shapes()[shape];
    return movingShape<S>(record, bodies_.pose[record.body], bodies_.velocity[record.body]);
}

/// The times at which shapes that are apart touch and bounce within the step.
template <class S>
void Step<S>::findBounces() {
    ContactList<S>& contacts = contacts_.list();
    state_.bouncing.clear();
    if (!algorithms_.restitution->bounces()) return;
    const Real h = state_.size;
    tasks_.forEach(contacts.size(), kBodyGrain, [&](std::size_t k) {
        Contact<S>& contact = contacts[k];
        contact.bounceTime = 0;
        if (contact.islands != IslandKind::Usual || contact.asleep || contact.speculative) return;
        if (contact.vetoed || !(contact.coefficients.restitution > 0) || contact.manifold.count == 0) return;
        if (!closes<S>(bodies_, contact, h)) return;
        if (contact.piece != kNullIndex) {  // the gap as it is: surfaces mostly take no momentum
            contact.bounceTime = h;
            return;
        }
        const TimeOfImpact<S> impact =
            timeOfImpact<S>(movingShapeOf(contact.shapeA), movingShapeOf(contact.shapeB), h);
        if (impact.hit && impact.converged)
            contact.bounceTime = std::min(std::max(impact.exact, impact.time), h);
    });
    for (std::uint32_t k = 0; k < contacts.size(); ++k)
        if (contacts[k].bounceTime > 0) state_.bouncing.push_back(k);
}

/// Bodies that come near nothing fixed keep their angular momentum, so that they have one impact in a step: that of shapes which
/// overlap already, or their first bounce.
template <class S>
void Step<S>::leaveSecondBounces() {
    if (state_.bouncing.empty()) return;
    ContactList<S>& contacts = contacts_.list();
    std::stable_sort(state_.bouncing.begin(), state_.bouncing.end(), [&](std::uint32_t i, std::uint32_t j) {
        return contacts[i].bounceTime < contacts[j].bounceTime;
    });
    constexpr Real none = -1, fixed = 0, overlaps = std::numeric_limits<Real>::min();
    std::vector<Real>& first = state_.firstBounce;
    first.assign(bodies_.size(), none);
    for (const Contact<S>& contact : contacts) {
        const std::uint32_t a = contact.bodyA, b = contact.bodyB;
        if (contact.manifold.count == 0) continue;
        if (bodies_.invMass[a] == 0 || bodies_.invMass[b] == 0)
            first[a] = first[b] = fixed;
        else if (overlapsAndApproaches<S>(bodies_, contact, def_.restitutionThreshold))
            for (const std::uint32_t body : {a, b})
                if (first[body] == none) first[body] = overlaps;
    }
    for (const std::uint32_t k : state_.bouncing) {
        Contact<S>& contact = contacts[k];
        Real &a = first[contact.bodyA], &b = first[contact.bodyB];
        const Real t = contact.bounceTime;
        if (a == fixed || b == fixed) continue;
        if ((a > 0 && a != t) || (b > 0 && b != t))
            contact.bounceTime = 0;
        else
            a = b = t;
    }
}

/// Bounces pass on to the contacts of their bodies at their time: to those that have held, not to other impacts.
template <class S>
void Step<S>::spreadBounces() {
    std::vector<Real>& times = state_.firstBounce;  // 0: none
    times.assign(bodies_.size(), Real(0));
    const auto take = [&](std::uint32_t body, Real time) {
        if (bodies_.invMass[body] > 0 && (times[body] == 0 || time < times[body])) times[body] = time;
    };
    state_.passedOn.clear();
    for (const LandingPoint<Real>& point : state_.bounces)
        for (const std::uint32_t body : {rows_.blocks[point.block].a, rows_.blocks[point.block].b})
            take(body, point.time);
    std::vector<std::uint8_t>& used = state_.bounceBlocks;
    used.assign(rows_.blocks.size(), 0);
    for (const LandingPoint<Real>& point : state_.bounces) used[point.block] = 1;
    const auto may = [&](std::uint32_t body) {
        return bodies_.invMass[body] == 0 || (state_.mayLand[body] & kMayBounce) != 0;
    };
    const Real slow = contactStep().impactSpeed;
    const auto held = [&](const Block<S>& block) {
        const Row<S>* first = rows_.rows.data() + block.first;
        return std::all_of(first, first + block.rows, [&](const Row<S>& row) {
            return std::abs(rowVelocity<S>(row, state_.before[block.a], state_.before[block.b])) <= slow;
        });
    };
    std::vector<std::pair<std::uint32_t, Real>>& next = state_.passedOn;
    std::size_t known = 0;
    do {
        known = next.size();
        for (std::uint32_t k = 0; k < rows_.blocks.size(); ++k) {
            const Block<S>& block = rows_.blocks[k];
            if (used[k] || block.kind != BlockKind::Contact || !may(block.a) || !may(block.b)) continue;
            const Real a = times[block.a], b = times[block.b];
            if ((a == 0 && b == 0) || rows_.rows[block.first].impulse == 0 || !held(block)) continue;
            used[k] = 1;
            next.emplace_back(k, a == 0 ? b : b == 0 ? a : std::min(a, b));
        }
        for (std::size_t i = known; i < next.size(); ++i)
            for (const std::uint32_t body : {rows_.blocks[next[i].first].a, rows_.blocks[next[i].first].b})
                if (times[body] == 0) take(body, next[i].second);
    } while (next.size() > known);
}

/// Every impulse of a bounce moves its bodies from its own time on, and so does what other contacts pass on of it.
template <class S>
void Step<S>::delayBounces() {
    if (state_.bounces.empty()) return;
    state_.delay.assign(bodies_.size(), {});
    state_.delayAtEnd.assign(bodies_.size(), {});
    const auto delay = [&](const Block<S>& block, Real time, bool passedOn) {
        const Real atEnd = std::max(Real(0), Real(2) * time - Real(1));
        for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
            const Row<S>& row = rows_.rows[i];
            const Real impulse = row.impulse - (passedOn ? state_.startImpulses[i] : Real(0));
            applyRowImpulse<S>(row, block, -time * impulse, state_.delay[block.a], state_.delay[block.b]);
            applyRowImpulse<S>(row, block, -atEnd * impulse, state_.delayAtEnd[block.a],
                               state_.delayAtEnd[block.b]);
        }
    };
    spreadBounces();
    for (const LandingPoint<Real>& point : state_.bounces)
        delay(rows_.blocks[point.block], point.time, false);
    for (const auto& [block, time] : state_.passedOn) delay(rows_.blocks[block], time, true);
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
        if (state_.firstBounce[i] == 0) continue;
        motion_.carry(bodies_.pose[i], state_.delay[i], state_.substepSize);
        motion_.replaceUsed(i, sum<S>(motion_.used()[i], state_.delay[i], Real(1)));
    }
}

/// The way from the next midpoint back to the end of the step is that with the impulses before the end, and the share that the
/// others have of it.
template <class S>
void Step<S>::shortenBounces() {
    if (state_.bounces.empty()) return;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
        if (state_.firstBounce[i] == 0) continue;
        const Velocity<S> after = sum<S>(motion_.used()[i], state_.delay[i], Real(-1));
        motion_.replaceUsed(i, sum<S>(after, state_.delayAtEnd[i], Real(1)));
    }
}

/// Two bodies that bounce off each other between the end of the step and their midpoints, and touch no other, are shown as
/// they are before, unless they have gone their own ways in flight: with the impulse half a step early their angular momentum
/// would not be that of before. Of bodies that others act on, too, the impulses of a step belong together.
template <class S>
void Step<S>::showBounces() {
    if (state_.bounces.empty()) return;
    findPartners<S>(rows_, bodies_.size(), state_.partners);
    std::vector<Velocity<S>>& later = state_.delay;  // impulses [N s] and their moments [N m s] on bodies
    later.assign(bodies_.size(), {});
    std::vector<std::uint8_t>& valid = bodies_.midpoints.valid;
    for (const LandingPoint<Real>& point : state_.bounces) {
        const Block<S>& block = rows_.blocks[point.block];
        const std::uint32_t a = block.a, b = block.b;
        if (!(point.time > Real(0.5)) || state_.partners[a] != b || state_.partners[b] != a) continue;
        if (!valid[a] || !valid[b] || bodies_.invMass[a] == 0 || bodies_.invMass[b] == 0) continue;
        for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
            const Row<S>& row = rows_.rows[i];
            later[a].v -= row.impulse * row.lin;
            later[a].w += row.impulse * row.angA;
            later[b].v += row.impulse * row.lin;
            later[b].w += row.impulse * row.angB;
        }
        valid[a] = valid[b] = Midpoints<S>::kBounces;
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (valid[i] != Midpoints<S>::kBounces) continue;
        bodies_.velocity[i].v -= bodies_.invMass[i] * later[i].v;
        bodies_.velocity[i].w -=
            Ang(worldInertia<S>(bodies_.pose[i].q, bodies_.invInertiaLocal[i]) * later[i].w);
    }
    state_.bounces.clear();
}

#define RIGOR_INSTANTIATE(S)                                             \
    template void Step<S>::placeBounces();                               \
    template MovingShape<S> Step<S>::movingShapeOf(std::uint32_t) const; \
    template void Step<S>::findBounces();                                \
    template void Step<S>::leaveSecondBounces();                         \
    template void Step<S>::spreadBounces();                              \
    template void Step<S>::delayBounces();                               \
    template void Step<S>::shortenBounces();                             \
    template void Step<S>::showBounces();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
