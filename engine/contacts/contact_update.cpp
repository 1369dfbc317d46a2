// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/contact_update.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/contacts/time_of_impact.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/surface_contact.hpp"

namespace rigor::engine {
namespace {

/// Points of a contact's manifold before it is found anew, for matching with those of the new one.
template <class S>
struct OldPoints {
    explicit OldPoints(const Contact<S>& contact) : count(static_cast<std::size_t>(contact.manifold.count)) {
        for (std::size_t i = 0; i < count; ++i) {
            feature[i] = contact.manifold.points[i].feature;
            pointB[i] = contact.manifold.points[i].pointB;
        }
    }
    std::size_t count;
    std::array<std::uint32_t, S::maxManifoldPoints> feature;
    std::array<typename S::Vec, S::maxManifoldPoints> pointB;
};

/// Resets the results of the last step. Impulses stay as the warm start, but for those of an impact.
template <class S>
void clearStep(Contact<S>& contact) {
    contact.block.fill(kNullIndex);
    for (std::size_t i = 0; contact.impacts && i < contact.points.size(); ++i)
        if (std::exchange(contact.points[i].impact, false)) contact.impulses[i] = {};
    contact.impacts = false;
}

/// Matches points by feature. A point with a new feature (the reference face has changed to the other body)
/// takes the impulses and the arms of the nearest unmatched point, if that is near compared with its arm. The first
/// point takes the totals of those that have gone within the step.
template <class S>
void matchPoints(const BodyArrays<S>& bodies, const OldPoints<S>& old, Contact<S>& contact) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    const auto impulses = contact.impulses, totals = contact.totals;
    const auto points = contact.points;
    const auto setArms = [](auto& point, const Vec& rA, const Vec& rB) {
        point.rA = rA;
        point.rB = rB;
    };
    std::array<bool, S::maxManifoldPoints> used{}, done{};
    const auto take = [&](std::size_t from, std::size_t to) {
        used[from] = done[to] = true;
        contact.impulses[to] = impulses[from];
        contact.totals[to] = totals[from];
        if (!contact.placed) setArms(contact.points[to], points[from].rA, points[from].rB);
    };
    const auto n = static_cast<std::size_t>(contact.manifold.count);
    for (std::size_t i = 0; i < n; ++i) {
        contact.impulses[i] = contact.totals[i] = {};
        // Patches do not write it, and the hash must not depend on points that the contact had earlier.
        if (i >= old.count && !contact.placed) contact.points[i].separation = 0;
        if (!contact.placed) setArms(contact.points[i], Vec::Zero(), Vec::Zero());
        for (std::size_t j = 0; j < old.count && !done[i]; ++j)
            if (!used[j] && contact.manifold.points[i].feature == old.feature[j]) take(j, i);
    }
    const std::uint32_t arm = bodies.invMass[contact.bodyB] > 0 ? contact.bodyB : contact.bodyA;
    for (std::size_t i = 0; i < n; ++i) {
        if (done[i]) continue;
        const typename S::Vec& at = contact.manifold.points[i].pointB;
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
    for (std::size_t j = 0; j < old.count; ++j) {
        if (used[j]) continue;
        contact.totals[0].normal += totals[j].normal;
        contact.totals[0].friction += totals[j].friction;
    }
}

/// True where there are points, and all are further apart than `near`.
template <class S>
bool isApart(const Manifold<S>& manifold, typename S::Real near) {
    for (int i = 0; i < manifold.count; ++i)
        if (manifold.points[i].separation <= near) return false;
    return manifold.count > 0;
}

template <class S>
bool overlaps(const Manifold<S>& manifold) {
    for (int i = 0; i < manifold.count; ++i)
        if (manifold.points[i].separation < 0) return true;
    return false;
}

/// Transfers the impulses of the last step to the points of this step.
template <class S>
void transferImpulses(const BodyArrays<S>& bodies, const OldPoints<S>& old, Contact<S>& contact) {
    clearStep(contact);
    const auto n = static_cast<std::size_t>(contact.manifold.count);
    bool same = n == old.count;
    for (std::size_t i = 0; i < n && same; ++i) same = contact.manifold.points[i].feature == old.feature[i];
    if (!same) matchPoints(bodies, old, contact);
}

}  // namespace

template <class S>
bool ContactUpdate<S>::update(Candidate<S>& candidate, Contact<S>& contact) const {
    contact.touched = contact.touching;
    if (isAsleep<S>(bodies, contact)) return true;
    if (cache.isValid(candidate)) {
        cache.moveManifold(candidate, contact);
        clearStep(contact);
        return complete(candidate, contact);
    }
    const OldPoints<S> old(contact);
    queryAgain(candidate, contact);
    if (contact.manifold.count == 0) contact.cache.count = 0;
    makePoints(candidate, contact);
    if (!complete(candidate, contact)) return false;
    transferImpulses<S>(bodies, old, contact);
    return true;
}

template <class S>
void ContactUpdate<S>::refresh(Candidate<S>& candidate, Contact<S>& contact) const {
    if (contact.islands != second.islands || contact.vetoed || isAsleep<S>(bodies, contact)) return;
    contact.lastNormal.setZero();  // it is of another time of the step
    contact.placed = false;
    if (candidate.cached && !isDisturbed(candidate)) return cache.moveManifold(candidate, contact);
    const OldPoints<S> old(contact);
    const Manifold<S> before = contact.manifold;
    queryAgain(candidate, contact);
    if (contact.manifold.count > 0) {
        makePoints(candidate, contact);
        contact.touching = contact.touching || overlaps(contact.manifold);
        return matchPoints(bodies, old, contact);
    }
    contact.manifold = before;  // the step shows where it has acted
    contact.parted = true;
    contact.impulses.fill({});
    contact.moment = zeroAng<S>();
    candidate.cached = false;
}

template <class S>
bool ContactUpdate<S>::isDisturbed(const Candidate<S>& candidate) const {
    return second.disturbed[shapes[candidate.a].body] || second.disturbed[shapes[candidate.b].body];
}

template <class S>
bool ContactUpdate<S>::mayBegin(const Candidate<S>& candidate) const {
    const auto takesPart = [&](std::uint32_t body) {
        return bodies.constants[body].type != BodyType::Dynamic || bodies.islands[body] == second.islands;
    };
    return isDisturbed(candidate) && takesPart(shapes[candidate.a].body) &&
           takesPart(shapes[candidate.b].body) && shapes.box(candidate.a).overlaps(shapes.box(candidate.b));
}

template <class S>
std::optional<Contact<S>> ContactUpdate<S>::find(Candidate<S>& candidate) const {
    Manifold<S> manifold;
    if (!cache.isValid(candidate)) {
        query(candidate, manifold);
    }
    if (manifold.count == 0 && !ahead.looksAhead()) return std::nullopt;
    std::optional<Contact<S>> found(std::in_place);
    Contact<S>& contact = *found;
    contact.manifold = manifold;
    contact.shapeA = candidate.a;
    contact.shapeB = candidate.b;
    contact.piece = candidate.piece;
    contact.bodyA = shapes[candidate.a].body;
    contact.bodyB = shapes[candidate.b].body;
    contact.islands = second.islands;
    if (manifold.count > 0) makePoints(candidate, contact);
    if (!complete(candidate, contact)) found.reset();
    return found;
}

/// Reduces the points to the manifold that the solver gets, and caches it.
template <class S>
void ContactUpdate<S>::makePoints(Candidate<S>& candidate, Contact<S>& contact) const {
    const std::uint32_t a = candidate.a, b = candidate.b;
    if (contact.manifold.count > 0 && makeManifold != nullptr) {
        const Real size = 2 * std::min(shapes[a].radius, shapes[b].radius);
        makeManifold({shapes.pose(a), shapes.pose(b), size, cache.queryDistance(candidate)}, contact.cache,
                     contact.manifold);
    }
    cache.storeManifold(candidate, contact);
}

/// Completes a contact for the solver: speculative points, coefficients, touching. False: it has no points.
template <class S>
bool ContactUpdate<S>::complete(Candidate<S>& candidate, Contact<S>& contact) const {
    contact.asleep = contact.speculative = contact.vetoed = contact.placed = contact.parted = false;
    // Continuous collision does not predict contacts with pieces of a chain, mesh or height field.
    if (candidate.piece == kNullIndex && ahead.looksAhead()) {
        placePoints<S>(bodies, contact);
        const bool here = contact.manifold.count > 0;
        ahead.findAhead(contact, shapes.records(), narrowPhase);
        if (!here && contact.manifold.count > 0) candidate.cached = false;
    }
    if (!(candidate.contact != kNullIndex && coefficientsHold)) {
        const ShapeRecord<S>&a = shapes[candidate.a], &b = shapes[candidate.b];
        contact.coefficients = materials.pair(a.material, b.material);
        contact.driven = a.hasSurfaceVelocity || b.hasSurfaceVelocity;
    }
    if (contact.driven) {
        contact.surfaceA = surfaceNow(bodies, shapes[candidate.a]);
        contact.surfaceB = surfaceNow(bodies, shapes[candidate.b]);
    }
    contact.touching = overlaps(contact.manifold);
    return contact.manifold.count > 0;
}

template <class S>
void ContactUpdate<S>::queryAgain(Candidate<S>& candidate, Contact<S>& contact) const {
    if (candidate.cached)
        contact.manifold.memory.normal = contact.manifold.normal;  // turned with its body since
    contact.manifold.normal.setZero();
    contact.manifold.count = 0;
    query(candidate, contact.manifold);
}

template <class S>
void ContactUpdate<S>::query(Candidate<S>& candidate, Manifold<S>& manifold) const {
    const std::uint32_t a = candidate.a, b = candidate.b;
    const Real motion = cache.motion(candidate), distance = cache.queryDistance(candidate) + motion;
    manifold.separationLowerBound = 0;
    if (const Real gap = shapes.gapOfSpheres(a, b); gap > distance) {
        candidate.separationBound = gap;
        cache.storeResult(candidate);
        return;
    }
    candidate.queried = true;
    if (candidate.piece == kNullIndex) {
        narrowPhase.collide(shapes[a].shape, shapes.pose(a), shapes[b].shape, shapes.pose(b), distance,
                            manifold);
        candidate.separationBound = manifold.separationLowerBound;
        if (motion > 0 && isApart(manifold, cache.queryDistance(candidate))) {
            // Separating axes bound the distance of shapes; ahead of an impact its direction counts.
            manifold = {};
            collideGjkEpa<S>(shapes[a].shape, shapes.pose(a), shapes[b].shape, shapes.pose(b), distance,
                             manifold);
        }
    } else {
        const bool surfaceA = isComposite<S>(shapes[a].shape);
        const std::uint32_t surface = surfaceA ? a : b, other = surfaceA ? b : a;
        if (!surfaceA) flipManifold(manifold);  // its memory
        collideFacet<S>(narrowPhase, shapes[surface].shape, candidate.piece, candidate.ridge,
                        shapes.pose(surface), shapes[other].shape, shapes.pose(other), distance, manifold);
        if (!surfaceA) flipManifold(manifold);
        candidate.separationBound = 0;  // a bound for this piece only
    }
    cache.storeResult(candidate);
    if (motion > 0) dropFarPoints(candidate, manifold);
}

/// Keeps of the points that were found ahead those that may close in this step.
template <class S>
void ContactUpdate<S>::dropFarPoints(Candidate<S>& candidate, Manifold<S>& manifold) const {
    using Vec = typename S::Vec;
    const std::uint32_t a = shapes[candidate.a].body, b = shapes[candidate.b].body;
    const Velocity<S>&A = bodies.velocity[a], &B = bodies.velocity[b];
    const Real near = cache.queryDistance(candidate);
    const bool mayBeAhead =
        bouncesAhead ||
        materials.pair(shapes[candidate.a].material, shapes[candidate.b].material).restitution == 0;
    int kept = 0;
    for (int i = 0; i < manifold.count; ++i) {
        const ManifoldPoint<S>& point = manifold.points[i];
        const Vec u = B.v + cross(B.w, Vec(point.pointB - bodies.pose[b].p)) - A.v -
                      cross(A.w, Vec(point.pointA - bodies.pose[a].p));
        const Real closes = -motionTime * manifold.normal.dot(u);
        if (point.separation <= near + (mayBeAhead ? std::max(closes, Real(0)) : Real(0)))
            manifold.points[kept++] = point;
    }
    if (kept < manifold.count) candidate.cached = false;
    manifold.count = kept;
    if (candidate.piece == kNullIndex && isApart(manifold, near) && !mayMeet(candidate)) {
        manifold.count = 0;
        candidate.cached = false;
    }
}

/// True unless two shapes that are apart are known not to meet in this step. The plane between them would stop what
/// passes beside it, so that the straight ways of bodies in flight are looked at. Bodies that touch others may be pushed
/// off theirs. Impacts of fast shapes are left to continuous collision, which has them at their times.
template <class S>
bool ContactUpdate<S>::mayMeet(const Candidate<S>& candidate) const {
    const auto moving = [&](const ShapeRecord<S>& shape) {
        return movingShape<S>(shape, bodies.pose[shape.body], bodies.velocity[shape.body]);
    };
    const ShapeRecord<S>&a = shapes[candidate.a], &b = shapes[candidate.b];
    const MovingShape<S> A = moving(a), B = moving(b);
    const bool continuous = bodies.constants[a.body].continuous || bodies.constants[b.body].continuous;
    if (continuous && mayPassUnseen<S>(A, B, motionTime)) return false;
    return touched[a.body] || touched[b.body] || timeOfImpact<S>(A, B, motionTime).hit;
}

#define RIGOR_INSTANTIATE(S) template struct ContactUpdate<S>;
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
