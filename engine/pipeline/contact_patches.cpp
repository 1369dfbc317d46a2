// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts as patches for the solver `wide`, and their impulses back.
#include <algorithm>

#include "engine/pipeline/contact_set.hpp"
#include "engine/solvers/wide/patches.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kContactGrain = 64;  ///< worth sharing: some microseconds of work

template <class V, class R>
void putVector(Lanes<R>* to, std::size_t lane, const V& v) {
    for (int k = 0; k < v.size(); ++k) to[k][lane] = v[k];
}
template <class S>
typename S::Vec takeVector(const Lanes<typename S::Real>* from, std::size_t lane) {
    typename S::Vec v;
    for (int k = 0; k < S::dim; ++k) v[k] = from[k][lane];
    return v;
}

template <class S>
void fillPoint(PatchPoint<S>& point, typename PatchRest<S>::Point& rest, std::size_t lane,
               typename S::Real warmStart, const typename Contact<S>::Point* from) {
    using Vec = typename S::Vec;
    using Real = typename S::Real;
    point.invK[lane] = from ? Real(1) : Real(0);
    point.separation[lane] = from ? from->separation : Real(0);
    point.impulse[lane] = from ? warmStart * from->normalImpulse : Real(0);
    putVector(rest.armB, lane, from ? from->rB : Vec(Vec::Zero()));
    putVector(rest.rub, lane, from ? Vec(warmStart * from->frictionImpulse) : Vec(Vec::Zero()));
}

/// What the narrow phase knows of a contact; the rest is made of it in SIMD (Patches::prepare). Null: zeros.
template <class S>
void fillLane(PatchBlock<S>& block, PatchRest<S>& rest, std::size_t lane, const BodyArrays<S>& bodies,
              const ContactStep<S>& step, Contact<S>* contact) {
    using Vec = typename S::Vec;
    using Real = typename S::Real;
    const std::uint32_t a = contact ? contact->bodyA : 0, b = contact ? contact->bodyB : 0;
    const PairCoefficients<S> pair = contact ? contact->coefficients : PairCoefficients<S>{};
    const auto count = static_cast<std::size_t>(contact ? contact->manifold.count : 0);
    block.a[lane] = a, block.b[lane] = b;
    const auto lanes = [&](bool x) { return static_cast<std::uint32_t>(x && contact) << lane; };
    block.movesA |= lanes(bodies.invMass[a] > 0), block.movesB |= lanes(bodies.invMass[b] > 0);
    block.points = std::max(block.points, static_cast<std::int32_t>(count));
    putVector(block.normal, lane, contact ? contact->manifold.normal : Vec(Vec::Zero()));
    putVector(block.offset, lane, Vec(bodies.pose[b].p - bodies.pose[a].p));
    block.invMassA[lane] = bodies.invMass[a], block.invMassB[lane] = bodies.invMass[b];
    block.friction[lane] = pair.friction;
    block.staticFriction[lane] = std::max(pair.friction, pair.staticFriction);
    rest.restitution[lane] = step.bounces ? pair.restitution : Real(0);
    block.bounces |= lanes(rest.restitution[lane] > 0);
    for (std::size_t i = 0; i < PatchSize<S>::points; ++i)
        fillPoint<S>(block.point[i], rest.point[i], lane, step.warmStart,
                     i < count ? &contact->points[i] : nullptr);
    for (std::size_t i = 0; i < count; ++i) contact->points[i].block = 0;
}

template <class S>
void readLane(const PatchBlock<S>& block, const PatchRest<S>& rest, std::size_t lane, Contact<S>& contact) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        typename Contact<S>::Point& point = contact.points[i];
        point.normalImpulse = block.point[i].impulse[lane];
        point.normalTotal = block.point[i].total[lane];
        contact.touching = contact.touching || point.normalTotal > 0;
        point.frictionImpulse = takeVector<S>(rest.point[i].rub, lane);
        point.frictionTotal = takeVector<S>(rest.point[i].rubTotal, lane);
    }
}

}  // namespace

template <class S>
void ContactSet<S>::addPatches(const BodyArrays<S>& bodies, const ContactStep<S>& step, Patches<S>& patches,
                               const Tasks& tasks) {
    const std::span<PatchPlan> plans = patches.plan(contacts_.size());
    tasks.forEach(contacts_.size(), kContactGrain, [&](std::size_t k) {
        Contact<S>& contact = contacts_[k];
        contact.asleep = isAsleep(bodies, contact);
        const bool movesA = bodies.invMass[contact.bodyA] > 0, movesB = bodies.invMass[contact.bodyB] > 0;
        const bool solved = !contact.asleep && (movesA || movesB);
        plans[k] = {contact.bodyA, contact.bodyB, movesA, movesB,
                    static_cast<std::uint8_t>(solved ? contact.manifold.count : 0)};
    });
    patches.place(bodies, tasks);
    patches.forBlocks(tasks, [&](std::size_t b) {
        PatchBlock<S>& block = patches.block(b);
        block.movesA = block.movesB = block.bounces = 0, block.points = 0;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const std::uint32_t source = patches.sourceAt(b, lane);
            fillLane(block, patches.rest(b), lane, bodies, step,
                     source == Patches<S>::kNobody ? nullptr : &contacts_[source]);
        }
        patches.prepare(b);
    });
}

template <class S>
void ContactSet<S>::storePatches(Patches<S>& patches, const Tasks& tasks) {
    patches.forBlocks(tasks, [&](std::size_t b) {
        patches.share(b);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            if (const std::uint32_t source = patches.sourceAt(b, lane); source != Patches<S>::kNobody)
                readLane(patches.block(b), patches.rest(b), lane, contacts_[source]);
    });
}

#define RIGOR_INSTANTIATE(S)                                                                          \
    template void ContactSet<S>::addPatches(const BodyArrays<S>&, const ContactStep<S>&, Patches<S>&, \
                                            const Tasks&);                                            \
    template void ContactSet<S>::storePatches(Patches<S>&, const Tasks&);
RIGOR_INSTANTIATE(Space2f)
RIGOR_INSTANTIATE(Space2d)
RIGOR_INSTANTIATE(Space3f)
RIGOR_INSTANTIATE(Space3d)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
