// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/contact_patches.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "engine/core/prefetch.hpp"
#include "engine/solvers/wide/patch_solver.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kPatchGrain = 64;  ///< least number of contacts for a task: some microseconds of work

template <class R>
void put(Lanes<PatchReal>& to, std::size_t lane, R x) {
    to[lane] = static_cast<PatchReal>(x);
}
template <class V>
void putVector(Lanes<PatchReal>* to, std::size_t lane, const V& v) {
    for (int k = 0; k < v.size(); ++k) put(to[k], lane, v[k]);
}
template <class S>
void putAng(Lanes<PatchReal>* to, std::size_t lane, const typename S::Ang& w) {
    if constexpr (S::dim == 2)
        put(to[0], lane, w);
    else
        putVector(to, lane, w);
}
template <class S>
typename S::Vec takeVector(const Lanes<PatchReal>* from, std::size_t lane) {
    typename S::Vec v;
    for (int k = 0; k < S::dim; ++k) v[k] = from[k][lane];
    return v;
}

/// Contact of a lane; null for an empty lane.
template <class S>
const Contact<S>* contactAt(const Patches<S>& patches, const ContactList<S>& contacts, std::size_t b,
                            std::size_t lane) {
    if (b == patches.blocks() || patches.sourceAt(b, lane) == kNullIndex) return nullptr;
    return &contacts[patches.sourceAt(b, lane)];
}

/// One lane of a block, its cold data and the friction of its points.
template <class S>
struct PatchLane {
    using Real = typename S::Real;
    using F = PatchSpace<S>;
    PatchBlock<F>& block;
    PatchColdData<F>& cold;
    PatchFriction<F>& friction;
    std::size_t lane;

    void setPoint(std::size_t i, bool is, Real separation, const typename S::Vec& armB, Real warmStart,
                  const typename Contact<S>::Impulse& impulse) const {
        PatchPoint<F>& point = block.point[i];
        point.invK[lane] = is ? PatchReal(1) : PatchReal(0);
        put(point.separation, lane, separation);
        put(point.impulse, lane, warmStart * impulse.normal);
        putVector(cold.armB[i], lane, armB);
        putVector(friction.last[i], lane, typename S::Vec(warmStart * impulse.friction));
    }
};

/// Fills what a lane has in a block with moving surfaces or moments; a null contact has neither.
template <class S>
void fillSurface(const PatchLane<S>& to, const BodyArrays<S>& bodies, const ContactStep<S>& step,
                 const Contact<S>* contact) {
    using Vec = typename S::Vec;
    using Ang = typename S::Ang;
    const std::size_t lane = to.lane;
    Velocity<S> surface{Vec::Zero(), zeroAng<S>()};
    if (contact && contact->driven) {
        const Velocity<S>&A = contact->surfaceA, &B = contact->surfaceB;
        const Vec offset = bodies.pose[contact->bodyB].p - bodies.pose[contact->bodyA].p;
        surface = {Vec(B.v - A.v - cross(A.w, offset)), Ang(B.w - A.w)};
    }
    const PairCoefficients<S> pair = contact ? contact->coefficients : PairCoefficients<S>{};
    const Ang last = contact ? Ang(step.warmStart * contact->moment) : zeroAng<S>();
    putVector(to.cold.surfaceV, lane, surface.v);
    putAng<S>(to.cold.surfaceW, lane, surface.w);
    put(to.cold.rollingFriction, lane, pair.rollingFriction);
    put(to.cold.torsionalFriction, lane, pair.torsionalFriction);
    putAng<S>(to.cold.moment, lane, last);
}

/// Fills a lane with the result of the narrow phase; Patches::prepare derives the other numbers in SIMD. A
/// null contact leaves an empty lane: zeros that refer to the body `other`. All lanes are read, and no other
/// block of the colour moves `other`.
template <class S>
void fillLane(const PatchLane<S>& to, const BodyArrays<S>& bodies, const ContactStep<S>& step,
              const Contact<S>* contact, std::uint32_t other) {
    PatchBlock<PatchSpace<S>>& block = to.block;
    const std::size_t lane = to.lane;
    using Vec = typename S::Vec;
    using Real = typename S::Real;
    const std::uint32_t a = contact ? contact->bodyA : other, b = contact ? contact->bodyB : other;
    const PairCoefficients<S> pair = contact ? contact->coefficients : PairCoefficients<S>{};
    const auto count = static_cast<std::size_t>(contact ? contact->manifold.count : 0);
    block.a[lane] = a;
    block.b[lane] = b;
    const auto lanes = [&](bool x) { return static_cast<std::uint32_t>(x && contact) << lane; };
    const bool movesA = bodies.invMass[a] > 0, movesB = bodies.invMass[b] > 0;
    block.movesA |= lanes(movesA);
    block.movesB |= lanes(movesB);
    putVector(block.normal, lane, contact ? contact->manifold.normal : Vec(Vec::Zero()));
    putVector(block.offset, lane, Vec(bodies.pose[b].p - bodies.pose[a].p));
    put(block.invMassA, lane, contact ? bodies.invMass[a] : Real(0));
    put(block.invMassB, lane, contact ? bodies.invMass[b] : Real(0));
    put(block.friction, lane, pair.friction);
    put(block.staticFriction, lane, std::max(pair.friction, pair.staticFriction));
    put(to.cold.restitution, lane, step.bounces ? pair.restitution : Real(0));
    block.bounces |= lanes(to.cold.restitution[lane] > 0);
    block.driven |= lanes(contact && contact->driven);
    block.moments |= lanes(pair.hasMoments());
    for (std::size_t i = 0; i < count; ++i) {
        const ManifoldPoint<S>& where = contact->manifold.points[i];
        // Speculative points found by continuous collision keep their arms at the time of impact.
        const Vec arm = contact->speculative ? contact->points[i].rB
                                             : Vec(impulsePoint<S>(where, movesA, movesB) - bodies.pose[b].p);
        to.setPoint(i, true, where.separation, arm, step.warmStart, contact->impulses[i]);
    }
    for (std::size_t i = count; i < static_cast<std::size_t>(block.points); ++i)
        to.setPoint(i, false, Real(0), Vec::Zero(), Real(0), {});
}

/// Impulses since the patches were prepared; `continues`: the totals of the contact are from before.
template <class S>
void readLane(const PatchBlock<PatchSpace<S>>& block, const PatchFriction<PatchSpace<S>>& friction,
              std::size_t lane, bool continues, Contact<S>& contact) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        typename Contact<S>::Impulse& total = contact.totals[i];
        if (!continues) total = {};
        contact.impulses[i] = {block.point[i].impulse[lane], takeVector<S>(friction.last[i], lane)};
        total.normal += block.point[i].total[lane];
        total.friction += takeVector<S>(friction.total[i], lane);
        contact.touching = contact.touching || total.normal > 0;
    }
}

/// An angular impulse from its components along the tangents and the normal.
template <class S>
typename S::Ang takeMoment(const PatchBlock<PatchSpace<S>>& block, const Lanes<PatchReal>* from,
                           std::size_t lane) {
    using Real = typename S::Real;
    if constexpr (S::dim == 2) {
        return Real(from[0][lane]);
    } else {
        const typename S::Vec t = takeVector<S>(block.tangent, lane), n = takeVector<S>(block.normal, lane);
        return Real(from[0][lane]) * t + Real(from[1][lane]) * n.cross(t) + Real(from[2][lane]) * n;
    }
}

template <class S>
PatchPass passOf(const ContactStep<S>& step) {
    using Real = typename S::Real;
    const auto number = [](Real x) { return static_cast<PatchReal>(x); };
    const SoftTerms<Real> terms = softTerms(step.bias.contact, Real(1), step.h);  // soft constraint of
                                                                                  // effective mass 1
    PatchPass pass;
    pass.invH = number(Real(1) / step.h);
    pass.biasRate = number(terms.biasRate);
    pass.massScale = number(Real(1) / (Real(1) + terms.gamma));
    pass.impulseScale = number(terms.gamma / (Real(1) + terms.gamma));
    pass.slop = number(step.slop);
    pass.maxBiasVelocity = softBiasRule<PatchReal>().maxBiasVelocity;
    pass.threshold = number(step.restitutionThreshold);
    pass.touching = PatchReal(64) * std::numeric_limits<PatchReal>::epsilon();
    pass.restingGap = std::max(pass.touching, number(step.restingGap));
    return pass;
}

}  // namespace

template <class S>
void PatchContacts<S>::prepare(ContactList<S>& contacts, const BodyArrays<S>& bodies,
                               const ContactStep<S>& step, const Tasks& tasks) {
    continues_ = step.continues;
    patches_.resize(contacts.size());
    tasks.forEach(contacts.size(), kPatchGrain, [&](std::size_t k) {
        Contact<S>& contact = contacts[k];
        if (contact.islands != step.islands)
            return patches_.setDescriptor(k, {contact.bodyA, contact.bodyB, false, false, 0});
        contact.asleep = isAsleep<S>(bodies, contact);
        const bool movesA = bodies.invMass[contact.bodyA] > 0, movesB = bodies.invMass[contact.bodyB] > 0;
        const bool solved = !contact.asleep && !contact.vetoed && (movesA || movesB);
        contact.block.fill(solved ? Contact<S>::kPatch : kNullIndex);
        const bool open = contact.parted && step.continues;
        if (!solved && !contact.asleep) contact.totals.fill({});
        patches_.setDescriptor(k, {contact.bodyA, contact.bodyB, movesA, movesB,
                                   static_cast<std::uint8_t>(solved && !open ? contact.manifold.count : 0)});
    });
    patches_.assignLanes(bodies, tasks);
    patches_.forBlocks(tasks, [&](std::size_t b) {
        auto& block = patches_.block(b);
        PatchFriction<PatchSpace<S>> friction;
        block.movesA = block.movesB = block.bounces = block.driven = block.moments = 0;
        block.points = 0;
        std::array<const Contact<S>*, kLanes> from;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            if (const Contact<S>* next = contactAt(patches_, contacts, b + 1, lane)) {
                prefetch(next, &next->manifold.memory);
                prefetch(&next->impulses, &next->totals);
            }
            from[lane] = contactAt(patches_, contacts, b, lane);
            if (from[lane]) block.points = std::max(block.points, from[lane]->manifold.count);
        }
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            fillLane<S>({block, patches_.coldData(b), friction, lane}, bodies, step, from[lane],
                        from[0]->bodyA);
        for (std::size_t lane = 0; (block.driven || block.moments) && lane < kLanes; ++lane)
            fillSurface<S>({block, patches_.coldData(b), friction, lane}, bodies, step, from[lane]);
        patches_.prepare(b, friction);
    });
}

template <class S>
void PatchContacts<S>::beginSubstep(ContactList<S>&, BodyArrays<S>& bodies, const ContactStep<S>& step,
                                    ConstraintRows<S>&, const Tasks& tasks) {
    pass_ = passOf<S>(step);
    patches_.beginSubstep(bodies.velocity, pass_, tasks);
}

template <class S>
void PatchContacts<S>::solve(Solver<S>& solver, const SolverInput<S>& input, const Tasks& tasks) {
    // Every solver whose traits declare patches is one; std::bad_cast is a mistake in its traits.
    dynamic_cast<PatchSolver<S>&>(solver).solvePatches(input, patches_, pass_, tasks);
}

template <class S>
void PatchContacts<S>::advance(ContactList<S>&, std::span<const Velocity<S>> velocities, Real h,
                               const Tasks& tasks) {
    patches_.advance(velocities, h, tasks);
}

template <class S>
void PatchContacts<S>::store(ContactList<S>& contacts, const ConstraintRows<S>&, bool last,
                             const Tasks& tasks) {
    if (!last) return;
    patches_.forBlocks(tasks, [&](std::size_t b) {
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            if (const Contact<S>* next = contactAt(patches_, contacts, b + 1, lane)) {
                prefetch(next, &next->manifold.separationLowerBound);
                prefetch(&next->impulses, &next->shapeA);
            }
        PatchFriction<PatchSpace<S>> friction;
        patches_.distribute(b, friction);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            if (const std::uint32_t source = patches_.sourceAt(b, lane); source != kNullIndex) {
                Contact<S>& contact = contacts[source];
                readLane(patches_.block(b), friction, lane, continues_, contact);
                if (!contact.coefficients.hasMoments()) continue;
                const auto& cold = patches_.coldData(b);
                contact.moment = takeMoment<S>(patches_.block(b), cold.moment, lane);
                if (!continues_) contact.momentTotal = zeroAng<S>();
                contact.momentTotal += takeMoment<S>(patches_.block(b), cold.momentTotal, lane);
            }
    });
}

RIGOR_INSTANTIATE_CLASS(PatchContacts)

}  // namespace rigor::engine
