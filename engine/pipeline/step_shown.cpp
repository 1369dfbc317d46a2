// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts that a world shows of a step from midpoint to midpoint. They were found in the middle of the step, and
// their laws hold for the velocities at its end: they are shown there, at the poses that the world shows, to second order
// in the step. Arms and normals go on from the middle as they came to it (contacts/row_lag.hpp). world_contacts.cpp finds
// those of convex shapes again when they are read.
#include "engine/narrowphase/distance.hpp"
#include "engine/pipeline/small_turn.hpp"
#include "engine/pipeline/step.hpp"

namespace rigor::engine {
namespace {

/// Turn of a contact's normal from where it was found to the end of the step. All points have the same, but for those
/// that are new.
template <class S>
typename S::Vec normalTurn(const Contact<S>& contact, const RowLags<S>& lags) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i)
        if (!lags[i].normalTurn.isZero(0)) return lags[i].normalTurn;
    return S::Vec::Zero();
}

}  // namespace

template <class S>
void Step<S>::showContacts() {
    ContactList<S>& contacts = contacts_.list();
    tasks_.forEach(contacts.size(), kBodyGrain, [&](std::size_t k) {
        Contact<S>& contact = contacts[k];
        if (contact.asleep) {  // shown where it fell asleep
            contact.placed = false;
            return;
        }
        if (contact.islands != IslandKind::Usual) {
            const Real found = state_.searchTime[contact.islands];
            RowLags<S> lags{};
            const typename S::Vec turn = contact.manifold.normal - contact.lastNormal;
            if (turn.squaredNorm() < kMostTurn<Real> * kMostTurn<Real>)
                lags[0].normalTurn = (Real(1) - found / state_.size) * turn;
            contact.lastNormal = contact.manifold.normal;
            if (found > halfOf(contact.islands))
                contact.lastNormal.setZero();  // another time than that of the next step
            return showAtEnd(contact, lags);
        }
        const RowLags<S>* lags = state_.any.usual ? contactModel_.lagsOf(k) : nullptr;
        showAtEnd(contact, lags != nullptr ? *lags : RowLags<S>{});
    });
}

/// Motion of a body from where a contact of it was found to where the step ends: translation [m], rotation vector [rad].
template <class S>
Velocity<S> Step<S>::motionToEnd(const Contact<S>& contact, std::uint32_t body) const {
    const Lead<S>& lead = state_.leads[body];
    const Pose<S>& end = bodies_.pose[body];
    if (contact.islands == IslandKind::Usual || bodies_.constants[body].type != BodyType::Kinematic)
        return {typename S::Vec(end.p - lead.middle.p), smallTurn(lead.middle.q, end.q)};
    const Real share = state_.searchTime[contact.islands] / halfOf(IslandKind::Usual);
    return {typename S::Vec(end.p - lead.start.p - share * lead.motion.v),
            Ang(smallTurn(lead.start.q, end.q) - share * lead.motion.w)};
}

/// Separations change by the relative motion of the two bodies at the point, along the mean normal of the way.
template <class S>
void Step<S>::showAtEnd(Contact<S>& contact, const RowLags<S>& lags) const {
    using Vec = typename S::Vec;
    const std::uint32_t bodyA = contact.bodyA, bodyB = contact.bodyB;
    const bool movesA = bodies_.invMass[bodyA] > 0, movesB = bodies_.invMass[bodyB] > 0;
    const Velocity<S> a = motionToEnd(contact, bodyA), b = motionToEnd(contact, bodyB);
    const Vec found = contact.manifold.normal, turn = normalTurn<S>(contact, lags);
    const Vec mean = found + Real(0.5) * turn, shown = Vec(found + turn).normalized();
    const Real shareB = movesA && movesB ? Real(0.5) : movesA ? Real(1) : Real(0);
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        ManifoldPoint<S>& point = contact.manifold.points[i];
        const RowLag<S>& lag = lags[i];
        const Vec at = impulsePoint<S>(point, movesA, movesB);
        const Vec armA = at - (bodies_.pose[bodyA].p - a.v), armB = at - (bodies_.pose[bodyB].p - b.v);
        point.separation += mean.dot(b.v + cross(b.w, Vec(armB + Real(0.5) * lag.armB)) - a.v -
                                     cross(a.w, Vec(armA + Real(0.5) * lag.armA)));
        const Vec wayA = a.v + lag.armA, wayB = b.v + lag.armB;
        const Vec end = at + (movesA && movesB ? Vec(Real(0.5) * (wayA + wayB)) : movesB ? wayB : wayA);
        const Vec across = point.pointB - point.pointA;
        const Vec between = across - found.dot(across) * found + point.separation * shown;
        point.pointA = end - (Real(1) - shareB) * between;
        point.pointB = end + shareB * between;
        if (!turn.isZero(0)) contact.totals[i].friction = turnedInto<S>(shown, contact.totals[i].friction);
    }
    contact.manifold.normal = shown;
    contact.placed = false;
}

/// A contact that has not acted is shown by the closest points where the step ends, unless it is cached.
template <class S>
void Step<S>::showGap(Contact<S>& contact) const {
    const ShapeRecord<S>&a = contacts_.shapes()[contact.shapeA], &b = contacts_.shapes()[contact.shapeB];
    if (contact.cache.count > 0 || isComposite<S>(a.shape) || isComposite<S>(b.shape)) return;
    const ClosestPoints<S> closest =
        closestPoints<S>(a.shape, compose<S>(bodies_.pose[contact.bodyA], a.local), b.shape,
                         compose<S>(bodies_.pose[contact.bodyB], b.local));
    setToClosest<S>(closest, contact.manifold);
}

#define RIGOR_INSTANTIATE(S)               \
    template void Step<S>::showContacts(); \
    template void Step<S>::showGap(Contact<S>&) const;
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
