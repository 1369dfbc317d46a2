// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Update of one contact: manifold from the poses of two shapes, and impulses from the points of the last
// step.
#include "engine/contacts/contact_set.hpp"

#include <algorithm>
#include <utility>

#include "engine/narrowphase/surface_contact.hpp"

namespace rigor::engine {

/// True when neither body takes impulses and neither moves: sleeping, static or resting kinematic bodies.
template <class S>
bool ContactSet<S>::isAsleep(const BodyArrays<S>& bodies, const Contact<S>& contact) {
    if (bodies.invMass[contact.bodyA] > 0 || bodies.invMass[contact.bodyB] > 0) return false;
    const auto still = [&](std::uint32_t i) {
        return bodies.asleep[i] || bodies.constants[i].type == BodyType::Static ||
               (bodies.constants[i].type == BodyType::Kinematic && bodies.velocity[i].v.isZero(0) &&
                dotAng(bodies.velocity[i].w, bodies.velocity[i].w) == Real(0));
    };
    return still(contact.bodyA) && still(contact.bodyB);
}

template <class S>
bool ContactSet<S>::updateContact(const Search& search, Candidate& candidate, Contact<S>& contact) const {
    contact.touched = contact.touching;
    if (isAsleep(search.bodies, contact)) return true;
    if (isCacheValid(candidate)) {
        moveCachedManifold(candidate, contact);
        clearStep(contact);
        return completeContact(search, candidate, contact);
    }
    OldPoints old;
    old.count = static_cast<std::size_t>(contact.manifold.count);
    for (std::size_t i = 0; i < old.count; ++i) {
        old.feature[i] = contact.manifold.points[i].feature;
        old.pointB[i] = contact.manifold.points[i].pointB;
    }
    if (candidate.cached)
        contact.manifold.memory.normal = contact.manifold.normal;  // turned with its body since
    contact.manifold.normal.setZero();
    contact.manifold.count = 0;
    queryNarrowPhase(search, candidate, contact.manifold);
    if (contact.manifold.count == 0) contact.cache.count = 0;
    makePoints(search, candidate, contact);
    if (!completeContact(search, candidate, contact)) return false;
    transferImpulses(search.bodies, old, contact);
    return true;
}

template <class S>
std::optional<Contact<S>> ContactSet<S>::findContact(const Search& search, Candidate& candidate) const {
    Manifold<S> manifold;
    if (!isCacheValid(candidate)) {
        queryNarrowPhase(search, candidate, manifold);
    }
    if (manifold.count == 0 && !search.ccd.looksAhead()) return std::nullopt;
    std::optional<Contact<S>> found(std::in_place);
    Contact<S>& contact = *found;
    contact.manifold = manifold;
    contact.shapeA = candidate.a;
    contact.shapeB = candidate.b;
    contact.piece = candidate.piece;
    contact.bodyA = shapes_[candidate.a].body;
    contact.bodyB = shapes_[candidate.b].body;
    if (manifold.count > 0) makePoints(search, candidate, contact);
    if (!completeContact(search, candidate, contact)) found.reset();
    return found;
}

/// Reduces the points to the manifold that the solver gets, and caches it.
template <class S>
void ContactSet<S>::makePoints(const Search& search, Candidate& candidate, Contact<S>& contact) const {
    const std::uint32_t a = candidate.a, b = candidate.b;
    if (contact.manifold.count > 0 && search.makeManifold != nullptr) {
        const Real size =
            std::min((boxes_[a].max - boxes_[a].min).norm(), (boxes_[b].max - boxes_[b].min).norm());
        search.makeManifold({shapePoses_[a], shapePoses_[b], size, queryDistance(candidate)}, contact.cache,
                            contact.manifold);
    }
    cacheManifold(candidate, contact);
}

/// Completes a contact for the solver: speculative points, coefficients, touching. False: it has no points.
template <class S>
bool ContactSet<S>::completeContact(const Search& search, Candidate& candidate, Contact<S>& contact) const {
    contact.asleep = contact.speculative = contact.placed = false;
    // Continuous collision does not predict contacts with pieces of a chain, mesh or height field.
    if (candidate.piece == kNullIndex && search.ccd.looksAhead()) {
        placePoints(search.bodies, contact);
        const bool here = contact.manifold.count > 0;
        search.ccd.findAhead(contact, search.bodies, *this, search.narrowPhase);
        if (!here && contact.manifold.count > 0) candidate.cached = false;
    }
    if (!(candidate.contact != kNullIndex && coefficientsValid_))
        contact.coefficients = pair(shapes_[candidate.a].material, shapes_[candidate.b].material);
    contact.touching = false;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i)
        contact.touching = contact.touching || contact.manifold.points[i].separation < 0;
    return contact.manifold.count > 0;
}

/// Resets the results of the last step. Impulses stay as the warm start, but for those of an impact.
template <class S>
void ContactSet<S>::clearStep(Contact<S>& contact) {
    contact.block.fill(kNullIndex);
    for (std::size_t i = 0; contact.impacts && i < contact.points.size(); ++i)
        if (std::exchange(contact.points[i].impact, false)) contact.impulses[i] = {};
    contact.impacts = false;
}

/// Transfers the impulses of the last step to the points of this step.
template <class S>
void ContactSet<S>::transferImpulses(const BodyArrays<S>& bodies, const OldPoints& old, Contact<S>& contact) {
    clearStep(contact);
    const auto n = static_cast<std::size_t>(contact.manifold.count);
    bool same = n == old.count;
    for (std::size_t i = 0; i < n && same; ++i) same = contact.manifold.points[i].feature == old.feature[i];
    if (!same) matchPoints(bodies, old, contact);
}

/// Matches points by feature. A point with a new feature (the reference face has changed to the other body)
/// takes the impulses of the nearest unmatched point, if that is near compared with its arm.
template <class S>
void ContactSet<S>::matchPoints(const BodyArrays<S>& bodies, const OldPoints& old, Contact<S>& contact) {
    const auto impulses = contact.impulses;
    std::array<bool, S::maxManifoldPoints> used{}, done{};
    const auto take = [&](std::size_t from, std::size_t to) {
        used[from] = done[to] = true;
        contact.impulses[to] = impulses[from];
    };
    const auto n = static_cast<std::size_t>(contact.manifold.count);
    for (std::size_t i = 0; i < n; ++i) {
        contact.impulses[i] = {};
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
            if (!used[j] && distance < nearest) {
                nearest = distance;
                best = j;
            }
        }
        if (best < old.count) take(best, i);
    }
}

template <class S>
void ContactSet<S>::queryNarrowPhase(const Search& search, Candidate& candidate,
                                     Manifold<S>& manifold) const {
    candidate.queried = true;
    const std::uint32_t a = candidate.a, b = candidate.b;
    const Real distance = queryDistance(candidate);
    manifold.separationLowerBound = 0;
    if (candidate.piece == kNullIndex) {
        search.narrowPhase.collide(shapes_[a].shape, shapePoses_[a], shapes_[b].shape, shapePoses_[b],
                                   distance, manifold);
        candidate.separationBound = manifold.separationLowerBound;
    } else {
        const bool surfaceA = isComposite<S>(shapes_[a].shape);
        const std::uint32_t surface = surfaceA ? a : b, other = surfaceA ? b : a;
        if (!surfaceA) flipManifold(manifold);  // its memory
        collidePiece<S>(search.narrowPhase, shapes_[surface].shape, candidate.piece, candidate.ridge,
                        shapePoses_[surface], shapes_[other].shape, shapePoses_[other], distance, manifold);
        if (!surfaceA) flipManifold(manifold);
        candidate.separationBound = 0;  // a bound for this piece only
    }
    cacheResult(candidate);
}

template <class S>
void ContactSet<S>::placePoints(const BodyArrays<S>& bodies, Contact<S>& contact) {
    const std::uint32_t a = contact.bodyA, b = contact.bodyB;
    contact.placed = true;
    for (int i = 0; i < contact.manifold.count; ++i) {
        const ManifoldPoint<S>& where = contact.manifold.points[static_cast<std::size_t>(i)];
        const Vec at = impulsePoint<S>(where, bodies.invMass[a] > 0, bodies.invMass[b] > 0);
        typename Contact<S>::Point& point = contact.points[static_cast<std::size_t>(i)];
        point.rA = at - bodies.pose[a].p;
        point.rB = at - bodies.pose[b].p;
        point.separation = where.separation;
    }
}

RIGOR_INSTANTIATE_CLASS(ContactSet)

}  // namespace rigor::engine
