// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts found: boxes and pairs, then the manifolds of pairs that may touch, which threads share; what a
// contact of the last step knew goes over to the one of this step. Rows: contact_rows.cpp.
#include "engine/pipeline/contact_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/narrowphase/surface_contact.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kShapeGrain = 64, kPairGrain = 16;  ///< worth sharing: some microseconds of work

}  // namespace

template <class S>
PairCoefficients<S> ContactSet<S>::combine(const PairCoefficients<S>& a, const PairCoefficients<S>& b) const {
    PairCoefficients<S> both{combineFriction_(a.friction, b.friction),
                             combineRestitution_(a.restitution, b.restitution), Real(0)};
    if (a.staticFriction > 0 || b.staticFriction > 0)
        both.staticFriction = std::max(
            both.friction,
            combineFriction_(std::max(a.friction, a.staticFriction), std::max(b.friction, b.staticFriction)));
    return both;
}

template <class S>
std::uint32_t ContactSet<S>::addMaterial(const PairCoefficients<S>& own) {
    const std::uint32_t added = materialCount_++;
    materials_.push_back(own);
    std::vector<PairCoefficients<S>> table(materialCount_ * materialCount_);
    for (std::uint32_t a = 0; a < materialCount_; ++a)
        for (std::uint32_t b = 0; b < materialCount_; ++b) {
            if (a < added && b < added)
                table[a * materialCount_ + b] = pairs_[a * added + b];
            else
                table[a * materialCount_ + b] = combine(materials_[a], materials_[b]);
        }
    pairs_ = std::move(table);
    return added;
}

template <class S>
void ContactSet<S>::setPair(std::uint32_t a, std::uint32_t b, const PairCoefficients<S>& coefficients) {
    pairs_[a * materialCount_ + b] = pairs_[b * materialCount_ + a] = coefficients;
}

template <class S>
void ContactSet<S>::structureChanged(bool indicesChanged) {
    boxesValid_ = false;
    if (indicesChanged) contacts_.clear(), previous_.clear();
}

template <class S>
bool ContactSet<S>::mayCollide(const BodyArrays<S>& bodies, std::uint32_t a, std::uint32_t b) const {
    if (a == b) return false;
    const BodyConstants<S>&A = bodies.constants[a], &B = bodies.constants[b];
    if (!A.collides || !B.collides) return false;
    if (A.type != BodyType::Dynamic && B.type != BodyType::Dynamic) return false;
    return excluded_.empty() || !std::binary_search(excluded_.begin(), excluded_.end(), pairKey(a, b));
}

template <class S>
void ContactSet<S>::findPairs(const BodyArrays<S>& bodies, BroadPhase<S>& broadPhase,
                              Real speculativeDistance, const ContinuousCollision<S>& ccd,
                              const Tasks& tasks) {
    const std::size_t n = shapes_.size();
    shapePoses_.resize(n);
    boxes_.resize(n);
    movable_.resize(n);
    const Vec margin = Vec::Constant(speculativeDistance);
    tasks.forEach(n, kShapeGrain, [&](std::size_t i) {
        const ShapeRecord<S>& record = shapes_[i];
        const bool isStatic = bodies.constants[record.body].type == BodyType::Static;
        if (isStatic && boxesValid_) return;
        shapePoses_[i] = compose<S>(bodies.pose[record.body], record.local);
        boxes_[i] = boundingBox<S>(record.shape, shapePoses_[i]);
        movable_[i] = bodies.constants[record.body].type == BodyType::Dynamic;
        if (movable_[i]) boxes_[i].min -= margin, boxes_[i].max += margin;
        if (!isStatic && ccd.looksAhead()) ccd.growBox(static_cast<std::uint32_t>(i), boxes_[i]);
    });
    boxesValid_ = true;
    broadPhase.update(boxes_, movable_, proxyPairs_, tasks);
}

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

/// By feature; points whose feature is new (a face that has become the other body's reference) take the
/// impulses of the nearest point left over, if it is near compared with its arm.
template <class S>
void ContactSet<S>::takeOver(const BodyArrays<S>& bodies, const Contact<S>& old, Contact<S>& contact) const {
    std::array<bool, S::maxManifoldPoints> used{}, done{};
    const auto take = [&](std::size_t from, std::size_t to) {
        used[from] = done[to] = true;
        if (old.points[from].impact) return;
        contact.points[to].normalImpulse = old.points[from].normalImpulse;
        contact.points[to].frictionImpulse = old.points[from].frictionImpulse;
    };
    const auto n = static_cast<std::size_t>(contact.manifold.count),
               m = static_cast<std::size_t>(old.manifold.count);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < m && !done[i]; ++j)
            if (!used[j] && contact.manifold.points[i].feature == old.manifold.points[j].feature) take(j, i);
    const std::uint32_t arm = bodies.invMass[contact.bodyB] > 0 ? contact.bodyB : contact.bodyA;
    for (std::size_t i = 0; i < n; ++i) {
        if (done[i]) continue;
        const Vec& at = contact.manifold.points[i].pointB;
        Real nearest = Real(0.04) * (at - bodies.pose[arm].p).squaredNorm();
        std::size_t best = m;
        for (std::size_t j = 0; j < m; ++j) {
            const Real distance = (old.manifold.points[j].pointB - at).squaredNorm();
            if (!used[j] && distance < nearest) nearest = distance, best = j;
        }
        if (best < m) take(best, i);
    }
}

template <class S>
void ContactSet<S>::findManifolds(const BodyArrays<S>& bodies, const NarrowPhase<S>& narrowPhase,
                                  ManifoldFunction<S> makeManifold, Real speculativeDistance,
                                  const ContinuousCollision<S>& ccd, const Tasks& tasks) {
    std::swap(contacts_, previous_);
    findCandidates(bodies, speculativeDistance);
    contacts_.resize(candidates_.size());
    const Search search{bodies, narrowPhase, makeManifold, speculativeDistance, ccd};
    const Tasks& those = narrowPhase.manyThreads() ? tasks : Tasks::one();
    those.forEach(candidates_.size(), kPairGrain,
                  [&](std::size_t k) { findContact(search, candidates_[k], contacts_[k]); });
    std::erase_if(contacts_, [](const Contact<S>& contact) { return contact.manifold.count == 0; });
}

/// In the order of contacts: by shape pair and piece.
template <class S>
void ContactSet<S>::findCandidates(const BodyArrays<S>& bodies, Real speculativeDistance) {
    candidates_.clear();
    std::uint32_t old = 0;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t piece) {
        const auto key = std::pair(pairKey(a, b), piece);
        const auto oldKey = [&] {
            return std::pair(pairKey(previous_[old].shapeA, previous_[old].shapeB), previous_[old].piece);
        };
        while (old < previous_.size() && oldKey() < key) ++old;
        candidates_.push_back({a, b, piece, old < previous_.size() && oldKey() == key ? old : kNone});
    };
    for (const ProxyPair& p : proxyPairs_) {
        if (!mayCollide(bodies, shapes_[p.a].body, shapes_[p.b].body)) continue;
        const bool ordered = shapes_[p.a].body < shapes_[p.b].body;
        const std::uint32_t a = ordered ? p.a : p.b, b = ordered ? p.b : p.a;
        const bool surfaceA = isComposite<S>(shapes_[a].shape);
        if (!surfaceA && !isComposite<S>(shapes_[b].shape)) {
            add(a, b, kNone);
            continue;
        }
        findPieces(surfaceA ? a : b, surfaceA ? b : a, speculativeDistance);
        for (const std::uint32_t piece : pieces_) add(a, b, piece);
    }
}

/// The contact of a candidate; without points where there is none.
template <class S>
void ContactSet<S>::findContact(const Search& search, const Candidate& candidate, Contact<S>& contact) const {
    const BodyArrays<S>& bodies = search.bodies;
    const std::uint32_t a = candidate.a, b = candidate.b;
    const Contact<S>* old = candidate.old == kNone ? nullptr : &previous_[candidate.old];
    if (old && isAsleep(bodies, *old)) {
        contact = *old;
        return;
    }
    contact = {};
    if (old) contact.manifold.memory = old->manifold.memory;
    collide(search, candidate, contact.manifold);
    contact.shapeA = a, contact.shapeB = b, contact.piece = candidate.piece;
    contact.bodyA = shapes_[a].body, contact.bodyB = shapes_[b].body;
    if (contact.manifold.count > 0) {
        if (old) contact.cache = old->cache;
        const Real size =
            std::min((boxes_[a].max - boxes_[a].min).norm(), (boxes_[b].max - boxes_[b].min).norm());
        search.makeManifold({shapePoses_[a], shapePoses_[b], size, search.speculativeDistance}, contact.cache,
                            contact.manifold);
    }
    placePoints(bodies, contact);
    // Pieces of a chain, mesh or field are found where they are, not ahead.
    if (candidate.piece == kNone && search.ccd.looksAhead())
        search.ccd.findAhead(contact, bodies, *this, search.narrowPhase);
    if (contact.manifold.count == 0) return;
    contact.coefficients = pair(shapes_[a].material, shapes_[b].material);
    if (old) takeOver(bodies, *old, contact);
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

/// Pieces of a chain, mesh or height field near another shape, in ascending order.
template <class S>
void ContactSet<S>::findPieces(std::uint32_t surface, std::uint32_t other, Real speculativeDistance) {
    pieces_.clear();
    const Aabb<S> box =
        boxOnSurface<S>(shapePoses_[surface], shapes_[other].shape, shapePoses_[other], speculativeDistance);
    withSurface<S>(shapes_[surface].shape, [&](const auto& data) {
        data.query(box, [&](std::uint32_t piece) { pieces_.push_back(piece); });
    });
    std::sort(pieces_.begin(), pieces_.end());
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

template <class S>
bool ContactSet<S>::hasRows(std::uint32_t shapeA, std::uint32_t shapeB) const {
    const std::uint64_t key = pairKey(shapeA, shapeB);
    const auto found = std::lower_bound(
        contacts_.begin(), contacts_.end(), key,
        [](const Contact<S>& c, std::uint64_t k) { return pairKey(c.shapeA, c.shapeB) < k; });
    if (found == contacts_.end() || pairKey(found->shapeA, found->shapeB) != key) return false;
    return std::any_of(found->points.begin(), found->points.begin() + found->manifold.count,
                       [](const auto& point) { return point.block != Contact<S>::kNoBlock; });
}

template <class S>
void ContactSet<S>::noteEvents(const BodyArrays<S>& bodies, std::vector<Event<S>>& events) {
    const auto add = [&](EventKind kind, const Contact<S>& contact) {
        Event<S>& event = events.emplace_back();
        event.kind = kind;
        event.bodyA = bodies.id[contact.bodyA], event.bodyB = bodies.id[contact.bodyB];
        event.shapeA = shapes_[contact.shapeA].id, event.shapeB = shapes_[contact.shapeB].id;
        if (kind == EventKind::ContactEnds) return;
        event.normal = contact.manifold.normal;
        event.depth = -std::numeric_limits<Real>::infinity();
        for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
            event.depth = std::max(event.depth, -contact.manifold.points[i].separation);
            event.impulse += contact.points[i].normalTotal;
        }
    };
    const auto key = [](const Contact<S>& c) { return std::pair(pairKey(c.shapeA, c.shapeB), c.piece); };
    auto old = previous_.begin();
    const auto endOld = [&] {
        if (old->touching) add(EventKind::ContactEnds, *old);
        ++old;
    };
    for (Contact<S>& contact : contacts_) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i)
            contact.touching = contact.touching || contact.points[i].normalTotal > 0 ||
                               contact.manifold.points[i].separation < 0;
        while (old != previous_.end() && key(*old) < key(contact)) endOld();
        bool before = false;
        if (old != previous_.end() && key(*old) == key(contact)) before = old++->touching;
        if (before != contact.touching)
            add(before ? EventKind::ContactEnds : EventKind::ContactBegins, contact);
    }
    while (old != previous_.end()) endOld();
}

template class ContactSet<Space2f>;
template class ContactSet<Space2d>;
template class ContactSet<Space3f>;
template class ContactSet<Space3d>;

}  // namespace rigor::engine
