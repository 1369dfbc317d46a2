// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts as patches for the solver `wide`, and their impulses back.
#include <algorithm>

#include "engine/pipeline/contact_set.hpp"
#include "engine/solvers/wide/patches.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kBlockGrain = 8;  ///< worth sharing: some microseconds of work

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

}  // namespace

template <class S>
void ContactSet<S>::addPatches(const BodyArrays<S>& bodies, const ContactStep<S>& step, Patches<S>& patches,
                               const Tasks& tasks) {
    patches.clear();
    for (std::uint32_t k = 0; k < contacts_.size(); ++k) {
        Contact<S>& contact = contacts_[k];
        contact.asleep = isAsleep(bodies, contact);
        const bool movesA = bodies.invMass[contact.bodyA] > 0, movesB = bodies.invMass[contact.bodyB] > 0;
        if (contact.asleep || contact.manifold.count == 0 || (!movesA && !movesB)) continue;
        const auto points = static_cast<std::uint8_t>(contact.manifold.count);
        patches.plan({contact.bodyA, contact.bodyB, movesA, movesB, points}, k);
    }
    patches.place(bodies.size());
    tasks.forEach(patches.blocks(), kBlockGrain, [&](std::size_t b) {
        PatchBlock<S>& block = patches.block(b);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            if (const std::uint32_t source = patches.sourceAt(b, lane); source != Patches<S>::kNobody)
                fillPatch(bodies, step, contacts_[source], block, lane);
            else
                patches.clearLane(b, lane);
    });
    patches.prepare(bodies, tasks);
}

/// What the narrow phase knows of a contact; the rest is made of it in SIMD (Patches::prepare).
template <class S>
void ContactSet<S>::fillPatch(const BodyArrays<S>& bodies, const ContactStep<S>& step, Contact<S>& contact,
                              PatchBlock<S>& block, std::size_t lane) {
    const std::uint32_t a = contact.bodyA, b = contact.bodyB;
    const PairCoefficients<S>& pair = contact.coefficients;
    putVector(block.normal, lane, contact.manifold.normal);
    block.a[lane] = a, block.b[lane] = b;
    block.movesA |= std::uint32_t(bodies.invMass[a] > 0) << lane;
    block.movesB |= std::uint32_t(bodies.invMass[b] > 0) << lane;
    block.points = std::max(block.points, contact.manifold.count);
    block.invMassA[lane] = bodies.invMass[a], block.invMassB[lane] = bodies.invMass[b];
    block.friction[lane] = pair.friction;
    block.staticFriction[lane] = std::max(pair.friction, pair.staticFriction);
    block.restitution[lane] = step.bounces ? pair.restitution : Real(0);
    block.bounces |= std::uint32_t(block.restitution[lane] > 0) << lane;
    for (std::size_t i = 0; i < contact.points.size(); ++i) {
        PatchPoint<S>& to = block.point[i];
        typename Contact<S>::Point& point = contact.points[i];
        const bool there = i < static_cast<std::size_t>(contact.manifold.count);
        to.invK[lane] = there ? Real(1) : Real(0);
        if (there) point.block = 0;
        if (there) {
            putVector(to.armA, lane, point.rA), putVector(to.armB, lane, point.rB);
            to.separation[lane] = point.separation;
            to.impulse[lane] = step.warmStart * point.normalImpulse;
            putVector(to.rub, lane, Vec(step.warmStart * point.frictionImpulse));
        } else {
            const Vec zero = Vec::Zero();
            putVector(to.armA, lane, zero), putVector(to.armB, lane, zero), putVector(to.rub, lane, zero);
            to.separation[lane] = to.impulse[lane] = 0;
        }
    }
}

template <class S>
void ContactSet<S>::storePatches(Patches<S>& patches, const Tasks& tasks) {
    patches.share(tasks);
    tasks.forEach(patches.blocks(), kBlockGrain, [&](std::size_t b) {
        const PatchBlock<S>& block = patches.block(b);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            if (const std::uint32_t source = patches.sourceAt(b, lane); source != Patches<S>::kNobody)
                storePatch(block, lane, contacts_[source]);
    });
}

template <class S>
void ContactSet<S>::storePatch(const PatchBlock<S>& block, std::size_t lane, Contact<S>& contact) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        const PatchPoint<S>& from = block.point[i];
        typename Contact<S>::Point& point = contact.points[i];
        point.normalImpulse = from.impulse[lane];
        point.normalTotal = from.total[lane];
        point.frictionImpulse = takeVector<S>(from.rub, lane);
        point.frictionTotal = takeVector<S>(from.rubTotal, lane);
    }
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
