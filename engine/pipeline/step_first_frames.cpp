// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Steps from midpoint to midpoint extrapolate their rows from the midpoint before (contacts/row_lag.hpp). A contact that
// has none, because it is new or its bodies have found their midpoints anew, is looked for where the step began as well: its
// points and normal there, mirrored in those of the midpoint, stand for the midpoint before.
#include <algorithm>
#include <cmath>

#include "engine/pipeline/step.hpp"

namespace rigor::engine {
namespace {

/// Arms of the points of `contact` at its midpoint, from those of `before` at the start: zero without one of that feature.
template <class S>
void mirrorPoints(const BodyArrays<S>& bodies, const std::vector<Lead<S>>& leads, const Manifold<S>& before,
                  Contact<S>& contact) {
    using Vec = typename S::Vec;
    using Real = typename S::Real;
    const std::uint32_t a = contact.bodyA, b = contact.bodyB;
    const bool movesA = bodies.invMass[a] > 0, movesB = bodies.invMass[b] > 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        const ManifoldPoint<S>& now = contact.manifold.points[i];
        typename Contact<S>::Point& point = contact.points[i];
        point.rA = point.rB = Vec::Zero();
        for (std::size_t j = 0; j < static_cast<std::size_t>(before.count); ++j) {
            const ManifoldPoint<S>& then = before.points[j];
            if (then.feature != now.feature) continue;
            const Vec at = impulsePoint<S>(now, movesA, movesB), was = impulsePoint<S>(then, movesA, movesB);
            point.rA = Real(2) * (was - leads[a].start.p) - (at - bodies.pose[a].p);
            point.rB = Real(2) * (was - leads[b].start.p) - (at - bodies.pose[b].p);
        }
    }
}

/// The most that a point of a shape moves [m].
template <class S>
typename S::Real moved(const ShapeRecord<S>& shape, const Velocity<S>& motion) {
    const typename S::Real turn = std::sqrt(dotAng(motion.w, motion.w));
    return motion.v.norm() +
           (turn > 0 ? turn * shape.radius : 0);  // half-spaces have no radius, and do not turn
}

}  // namespace

/// Bodies that do not begin at the midpoint which the last step has led to.
template <class S>
void Step<S>::findRenewed(bool same) {
    const std::vector<std::uint8_t>& valid = bodies_.midpoints.valid;
    state_.renewed.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const bool moves = bodies_.constants[i].type != BodyType::Static && !bodies_.asleep[i];
        state_.renewed[i] = moves && !(same && i < valid.size() && valid[i]);
    }
}

template <class S>
void Step<S>::findFirstFrames() {
    const NarrowPhase<S>& narrowPhase = *algorithms_.narrowPhase;
    const Tasks& those = narrowPhase.manyThreads() ? tasks_ : Tasks::one();
    ContactList<S>& contacts = contacts_.list();
    those.forEach(contacts.size(), kBodyGrain, [&](std::size_t k) {
        Contact<S>& contact = contacts[k];
        const std::uint32_t a = contact.bodyA, b = contact.bodyB;
        const bool known = !contact.lastNormal.isZero(0) && !state_.renewed[a] && !state_.renewed[b];
        if (known || contact.islands != IslandKind::Usual || contact.asleep || contact.bounceTime > 0) return;
        contact.lastNormal.setZero();
        if (contact.piece != kNullIndex || contact.speculative || contact.placed) return;
        Real distance = def_.speculativeDistance;
        for (int i = 0; i < contact.manifold.count; ++i)
            distance = std::max(distance, contact.manifold.points[i].separation);
        const ShapeRecord<S>&A = contacts_.shapes()[contact.shapeA], &B = contacts_.shapes()[contact.shapeB];
        const Lead<S>&leadA = state_.leads[a], &leadB = state_.leads[b];
        distance += moved(A, leadA.motion) + moved(B, leadB.motion);
        Manifold<S> before;
        before.memory = contact.manifold.memory;
        narrowPhase.collide(A.shape, compose<S>(leadA.start, A.local), B.shape,
                            compose<S>(leadB.start, B.local), distance, before);
        if (before.count == 0) return;
        contact.lastNormal = Real(2) * before.normal - contact.manifold.normal;
        mirrorPoints<S>(bodies_, state_.leads, before, contact);
    });
}

#define RIGOR_INSTANTIATE(S)                  \
    template void Step<S>::findRenewed(bool); \
    template void Step<S>::findFirstFrames();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
