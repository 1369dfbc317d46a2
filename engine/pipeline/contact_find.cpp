// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One contact: from the poses of two shapes to points, and what it knew in the last step goes over to them.
#include "engine/pipeline/contact_set.hpp"

#include <algorithm>

#include "engine/narrowphase/surface_contact.hpp"

namespace rigor::engine {

/// Both bodies at rest and at least one of them asleep: walls, and bodies asleep, do not move.
template <class S>
bool ContactSet<S>::isAsleep(const BodyArrays<S>& bodies, const Contact<S>& contact) {
    const auto still = [&](std::uint32_t i) {
        return bodies.asleep[i] || bodies.constants[i].type == BodyType::Static ||
               (bodies.constants[i].type == BodyType::Kinematic && bodies.velocity[i].v.isZero(0) &&
                dotAng(bodies.velocity[i].w, bodies.velocity[i].w) == Real(0));
    };
    return still(contact.bodyA) && still(contact.bodyB);
}

template <class S>
bool ContactSet<S>::renewContact(const Search& search, const Candidate& candidate,
                                 Contact<S>& contact) const {
    const bool touched = contact.touching;
    contact.touched = touched;
    if (isAsleep(search.bodies, contact)) return true;
    OldPoints old;
    old.count = static_cast<std::size_t>(contact.manifold.count);
    for (std::size_t i = 0; i < old.count; ++i) {
        old.feature[i] = contact.manifold.points[i].feature;
        old.pointB[i] = contact.manifold.points[i].pointB;
    }
    contact.manifold.normal.setZero();
    contact.manifold.count = 0;
    collide(search, candidate, contact.manifold);
    if (contact.manifold.count == 0) contact.cache.count = 0;
    if (!completeContact(search, candidate, contact)) return false;
    contact.touching = false;
    takeOver(search.bodies, old, contact);
    return true;
}

template <class S>
bool ContactSet<S>::findContact(const Search& search, const Candidate& candidate, Contact<S>& contact) const {
    Manifold<S> manifold;
    collide(search, candidate, manifold);
    if (manifold.count == 0 && !search.ccd.looksAhead()) return false;
    contact = {};
    contact.manifold = manifold;
    contact.shapeA = candidate.a, contact.shapeB = candidate.b, contact.piece = candidate.piece;
    contact.bodyA = shapes_[candidate.a].body, contact.bodyB = shapes_[candidate.b].body;
    return completeContact(search, candidate, contact);
}

/// From what the narrow phase has found to what the solver gets. False: nothing.
template <class S>
bool ContactSet<S>::completeContact(const Search& search, const Candidate& candidate,
                                    Contact<S>& contact) const {
    const std::uint32_t a = candidate.a, b = candidate.b;
    if (contact.manifold.count > 0 && search.makeManifold != nullptr) {
        const Real size =
            std::min((boxes_[a].max - boxes_[a].min).norm(), (boxes_[b].max - boxes_[b].min).norm());
        search.makeManifold({shapePoses_[a], shapePoses_[b], size, search.speculativeDistance}, contact.cache,
                            contact.manifold);
    }
    placePoints(search.bodies, contact);
    contact.asleep = contact.ahead = false;
    // Pieces of a chain, mesh or field are found where they are, not ahead.
    if (candidate.piece == kNone && search.ccd.looksAhead())
        search.ccd.findAhead(contact, search.bodies, *this, search.narrowPhase);
    contact.coefficients = pair(shapes_[a].material, shapes_[b].material);
    return contact.manifold.count > 0;
}

/// The impulses that points start with, in place of those of the last step; what else that step left is
/// cleared.
template <class S>
void ContactSet<S>::takeOver(const BodyArrays<S>& bodies, const OldPoints& old, Contact<S>& contact) {
    const auto n = static_cast<std::size_t>(contact.manifold.count);
    for (std::size_t i = 0; i < old.count; ++i)
        if (contact.points[i].impact)
            contact.points[i].normalImpulse = 0, contact.points[i].frictionImpulse.setZero();
    bool same = n == old.count;
    for (std::size_t i = 0; i < n && same; ++i) same = contact.manifold.points[i].feature == old.feature[i];
    if (!same) matchPoints(bodies, old, contact);
    for (std::size_t i = 0; i < n; ++i) {
        typename Contact<S>::Point& point = contact.points[i];
        point.normalTotal = point.rebound = point.approach = 0;
        point.frictionTotal.setZero();
        point.block = Contact<S>::kNoBlock;
        point.impact = false;
    }
}

/// By feature; points whose feature is new (a face that has become the other body's reference) take the
/// impulses of the nearest point left over, if it is near compared with its arm.
template <class S>
void ContactSet<S>::matchPoints(const BodyArrays<S>& bodies, const OldPoints& old, Contact<S>& contact) {
    std::array<Real, S::maxManifoldPoints> normal{};
    std::array<Vec, S::maxManifoldPoints> friction;
    for (std::size_t j = 0; j < old.count; ++j)
        normal[j] = contact.points[j].normalImpulse, friction[j] = contact.points[j].frictionImpulse;
    std::array<bool, S::maxManifoldPoints> used{}, done{};
    const auto take = [&](std::size_t from, std::size_t to) {
        used[from] = done[to] = true;
        contact.points[to].normalImpulse = normal[from];
        contact.points[to].frictionImpulse = friction[from];
    };
    const auto n = static_cast<std::size_t>(contact.manifold.count);
    for (std::size_t i = 0; i < n; ++i) {
        contact.points[i].normalImpulse = 0, contact.points[i].frictionImpulse.setZero();
        for (std::size_t j = 0; j < old.count && !done[i]; ++j)
            if (!used[j] && contact.manifold.points[i].feature == old.feature[j]) take(j, i);
    }
    const std::uint32_t arm = bodies.invMass[contact.bodyB] > 0 ? contact.bodyB : contact.bodyA;
    for (std::size_t i = 0; i < n; ++i) {
        if (done[i]) continue;
        const Vec& at = contact.manifold.points[i].pointB;
        Real nearest = Real(0.04) * (at - bodies.pose[arm].p).squaredNorm();
        std::size_t best = old.count;
        for (std::size_t j = 0; j < old.count; ++j) {
            const Real distance = (old.pointB[j] - at).squaredNorm();
            if (!used[j] && distance < nearest) nearest = distance, best = j;
        }
        if (best < old.count) take(best, i);
    }
}

template <class S>
void ContactSet<S>::collide(const Search& search, const Candidate& candidate, Manifold<S>& manifold) const {
    const std::uint32_t a = candidate.a, b = candidate.b;
    if (candidate.piece == kNone) {
        search.narrowPhase.collide(shapes_[a].shape, shapePoses_[a], shapes_[b].shape, shapePoses_[b],
                                   search.speculativeDistance, manifold);
        return;
    }
    const bool surfaceA = isComposite<S>(shapes_[a].shape);
    const std::uint32_t surface = surfaceA ? a : b, other = surfaceA ? b : a;
    if (!surfaceA) flipManifold(manifold);  // its memory
    collidePiece<S>(search.narrowPhase, shapes_[surface].shape, candidate.piece, shapePoses_[surface],
                    shapes_[other].shape, shapePoses_[other], search.speculativeDistance, manifold);
    if (!surfaceA) flipManifold(manifold);
}

/// One point for both bodies, or equal and opposite impulses would make a couple; against a body that takes
/// no momentum the other's own surface, so that its arm does not depend on the overlap.
template <class S>
void ContactSet<S>::placePoints(const BodyArrays<S>& bodies, Contact<S>& contact) const {
    const std::uint32_t a = contact.bodyA, b = contact.bodyB;
    for (int i = 0; i < contact.manifold.count; ++i) {
        const ManifoldPoint<S>& where = contact.manifold.points[static_cast<std::size_t>(i)];
        Vec at = Real(0.5) * (where.pointA + where.pointB);
        if (bodies.invMass[a] == 0) at = where.pointB;
        if (bodies.invMass[b] == 0) at = where.pointA;
        typename Contact<S>::Point& point = contact.points[static_cast<std::size_t>(i)];
        point.rA = at - bodies.pose[a].p, point.rB = at - bodies.pose[b].p;
        point.separation = where.separation;
    }
}

template class ContactSet<Space2f>;
template class ContactSet<Space2d>;
template class ContactSet<Space3f>;
template class ContactSet<Space3d>;

}  // namespace rigor::engine
