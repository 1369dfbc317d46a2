// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact rows. At a point with normal n (A to B), separation s, arms rA, rB from the centres of mass and
// relative velocity u = vB + wB x rB - vA - wA x rA:
//     normal    0 <= lambda_n _|_ n . u + b >= 0
//     tangents  Coulomb's law with limit mu lambda_n
// and the bias b is one of
//     e n . u_0         impact: s <= 0, n . u_0 < -threshold; u_0 from before this step's forces, so that the
//                       rebound is e times the approach and not e times (approach + g h)
//     s / h             a gap wider than gapSlop, or an impact: the point may just close it in this step
//     overlap           what the bias rule makes of it (Baumgarte, soft), else 0
// A gap with e > 0 gets no rows where it is closing faster than the threshold, or is wider than gravity alone
// closes in a step: closing it would take the speed that the impact has to reverse, or pass on a blow that
// has not reached it. The bodies then meet with an overlap of at most one step's motion.
#include "engine/pipeline/contact_set.hpp"

#include <algorithm>
#include <cmath>

#include "engine/narrowphase/surface_contact.hpp"

namespace rigor::engine {

template <class S>
std::array<typename S::Vec, S::tangents> tangentBasis(const typename S::Vec& n) {
    if constexpr (S::dim == 2) {
        return {typename S::Vec(-n.y(), n.x())};
    } else {
        using Vec = typename S::Vec;
        const Vec axis = std::abs(n.x()) < typename S::Real(0.7) ? Vec::Unit(0) : Vec::Unit(1);
        const Vec t1 = axis.cross(n).normalized();
        return {t1, Vec(n.cross(t1))};
    }
}

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
                              Real speculativeDistance, const ContinuousCollision<S>& ccd) {
    const std::size_t n = shapes_.size();
    shapePoses_.resize(n);
    boxes_.resize(n);
    movable_.resize(n);
    const Vec margin = Vec::Constant(speculativeDistance);
    for (std::size_t i = 0; i < n; ++i) {
        const ShapeRecord<S>& record = shapes_[i];
        const bool isStatic = bodies.constants[record.body].type == BodyType::Static;
        if (isStatic && boxesValid_) continue;
        shapePoses_[i] = compose<S>(bodies.pose[record.body], record.local);
        boxes_[i] = boundingBox<S>(record.shape, shapePoses_[i]);
        movable_[i] = bodies.constants[record.body].type == BodyType::Dynamic;
        if (movable_[i]) boxes_[i].min -= margin, boxes_[i].max += margin;
        if (!isStatic && ccd.looksAhead()) ccd.growBox(static_cast<std::uint32_t>(i), boxes_[i]);
    }
    boxesValid_ = true;
    broadPhase.update(boxes_, movable_, proxyPairs_);
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
                                  const ContinuousCollision<S>& ccd) {
    std::swap(contacts_, previous_);
    contacts_.clear();
    Search search{bodies, narrowPhase, makeManifold, speculativeDistance, ccd, previous_.cbegin()};
    for (const ProxyPair& p : proxyPairs_) {
        if (!mayCollide(bodies, shapes_[p.a].body, shapes_[p.b].body)) continue;
        const bool ordered = shapes_[p.a].body < shapes_[p.b].body;
        const std::uint32_t a = ordered ? p.a : p.b, b = ordered ? p.b : p.a;
        const bool surfaceA = isComposite<S>(shapes_[a].shape);
        if (!surfaceA && !isComposite<S>(shapes_[b].shape)) {
            addContact(search, a, b, kNone, [&](Manifold<S>& manifold) {
                narrowPhase.collide(shapes_[a].shape, shapePoses_[a], shapes_[b].shape, shapePoses_[b],
                                    speculativeDistance, manifold);
            });
            continue;
        }
        const std::uint32_t surface = surfaceA ? a : b, other = surfaceA ? b : a;
        findPieces(surface, other, speculativeDistance);
        for (const std::uint32_t piece : pieces_)
            addContact(search, a, b, piece, [&](Manifold<S>& manifold) {
                collidePiece<S>(narrowPhase, shapes_[surface].shape, piece, shapePoses_[surface],
                                shapes_[other].shape, shapePoses_[other], speculativeDistance, manifold);
                if (!surfaceA) flipManifold(manifold);
            });
    }
}

/// The contact of two shapes, or of one and a piece of the other, if there is one.
template <class S>
template <class Collide>
void ContactSet<S>::addContact(Search& search, std::uint32_t a, std::uint32_t b, std::uint32_t piece,
                               const Collide& collide) {
    const BodyArrays<S>& bodies = search.bodies;
    const auto sortKey = [](const Contact<S>& c) { return std::pair(pairKey(c.shapeA, c.shapeB), c.piece); };
    const auto key = std::pair(pairKey(a, b), piece);
    auto& old = search.old;
    while (old != previous_.cend() && sortKey(*old) < key) ++old;
    const bool before = old != previous_.cend() && sortKey(*old) == key;
    if (before && isAsleep(bodies, *old)) {
        contacts_.push_back(*old);
        return;
    }
    Contact<S>& contact = contacts_.emplace_back();
    collide(contact.manifold);
    contact.shapeA = a, contact.shapeB = b, contact.piece = piece;
    contact.bodyA = shapes_[a].body, contact.bodyB = shapes_[b].body;
    if (contact.manifold.count > 0) {
        if (before) contact.cache = old->cache;
        const Real size =
            std::min((boxes_[a].max - boxes_[a].min).norm(), (boxes_[b].max - boxes_[b].min).norm());
        search.makeManifold({shapePoses_[a], shapePoses_[b], size, search.speculativeDistance}, contact.cache,
                            contact.manifold);
    }
    placePoints(bodies, contact);
    // Pieces of a chain, mesh or field are found where they are, not ahead.
    if (piece == kNone && search.ccd.looksAhead())
        search.ccd.findAhead(contact, bodies, *this, search.narrowPhase);
    if (contact.manifold.count == 0) {
        contacts_.pop_back();
        return;
    }
    contact.coefficients = pair(shapes_[a].material, shapes_[b].material);
    if (before) takeOver(bodies, *old, contact);
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
void ContactSet<S>::advance(std::span<const Velocity<S>> motion) {
    for (Contact<S>& contact : contacts_) {
        const Velocity<S>&A = motion[contact.bodyA], &B = motion[contact.bodyB];
        for (int i = 0; i < contact.manifold.count; ++i) {
            typename Contact<S>::Point& point = contact.points[static_cast<std::size_t>(i)];
            const Vec moved = B.v + cross(B.w, point.rB) - A.v - cross(A.w, point.rA);
            point.separation += contact.manifold.normal.dot(moved);
        }
    }
}

template <class S>
void ContactSet<S>::addRows(const BodyArrays<S>& bodies, const ContactStep<S>& step,
                            ConstraintRows<S>& rows) {
    for (Contact<S>& contact : contacts_) {
        contact.asleep = isAsleep(bodies, contact);
        for (int i = 0; i < contact.manifold.count; ++i) {
            contact.points[static_cast<std::size_t>(i)].block = Contact<S>::kNoBlock;
            if (!contact.asleep) addPointRows(bodies, step, contact, i, rows);
        }
    }
}

template <class S>
void ContactSet<S>::addPointRows(const BodyArrays<S>& bodies, const ContactStep<S>& step, Contact<S>& contact,
                                 int index, ConstraintRows<S>& rows) {
    typename Contact<S>::Point& point = contact.points[static_cast<std::size_t>(index)];
    const Vec& n = contact.manifold.normal;
    const std::uint32_t a = contact.bodyA, b = contact.bodyB;

    Block<S> block;
    block.kind = BlockKind::Contact;
    block.first = static_cast<std::uint32_t>(rows.rows.size());
    block.a = a, block.b = b;
    block.friction = contact.coefficients.friction;
    block.staticFriction = contact.coefficients.staticFriction;
    block.invMassA = bodies.invMass[a], block.invMassB = bodies.invMass[b];
    block.rows =
        static_cast<std::uint8_t>(std::max(block.friction, block.staticFriction) > 0 ? 1 + S::tangents : 1);

    const Vec &rA = point.rA, &rB = point.rB;
    const auto makeRow = [&](const Vec& direction) {
        Row<S> row;
        row.lin = direction;
        row.angA = -cross(rA, direction);
        row.angB = cross(rB, direction);
        completeRow<S>(row, block, bodies.invInertia);
        row.invK = Real(1) / rowCoupling<S>(row, row, block);
        return row;
    };
    Row<S> normal = makeRow(n);
    const Real approach = rowVelocity<S>(normal, bodies.velocity[a], bodies.velocity[b]);
    const Real s = point.separation;
    // Rounding of coordinates of order one metre: closer than this is touching.
    const Real touching = Real(64) * std::numeric_limits<Real>::epsilon();
    const Real restitution = step.bounces ? contact.coefficients.restitution : Real(0);
    const bool bounces = restitution > 0 && approach < -step.restitutionThreshold;
    // The blow of an impact in the last sub-step is not what the contact carries from now on.
    if (point.impact) point.normalImpulse = 0, point.frictionImpulse.setZero();
    point.impact = approach < -step.impactSpeed;
    point.block = Contact<S>::kNoBlock;
    point.rebound = contact.ahead && bounces && s > touching ? restitution * approach : Real(0);
    const bool mayBounce = restitution > 0 && s > std::max(touching, step.restingGap);
    if (!contact.ahead && ((bounces && s > touching) || mayBounce)) {
        point.normalImpulse = 0;
        point.frictionImpulse.setZero();
        return;
    }
    normal.error = s;
    // A bounce that is still ahead is continuous collision's.
    block.restitution = bounces && point.rebound == 0 ? restitution : Real(0);
    if (bounces && point.rebound == 0)
        normal.bias = restitution * approach;
    else if (s > (point.impact ? Real(0) : step.gapSlop))
        normal.bias = s / step.h;
    normal.relaxedBias = normal.bias;
    if (normal.bias == 0) pushApart(step, block, s, normal);
    normal.impulse = step.warmStart * point.normalImpulse;
    rows.rows.push_back(normal);

    if (block.rows > 1) {
        const std::array<Vec, S::tangents> basis = tangentBasis<S>(n);
        for (const Vec& t : basis) {
            Row<S> row = makeRow(t);
            row.impulse = step.warmStart * t.dot(point.frictionImpulse);
            rows.rows.push_back(row);
        }
        const Row<S>* t = rows.rows.data() + block.first + 1;
        block.k11 = rowCoupling<S>(t[0], t[0], block);
        block.k12 = S::tangents > 1 ? rowCoupling<S>(t[0], t[S::tangents - 1], block) : Real(0);
        block.k22 = S::tangents > 1 ? rowCoupling<S>(t[S::tangents - 1], t[S::tangents - 1], block) : Real(1);
    }
    point.block = static_cast<std::uint32_t>(rows.blocks.size());
    rows.blocks.push_back(block);
}

/// What the bias rule makes of overlap.
template <class S>
void ContactSet<S>::pushApart(const ContactStep<S>& step, const Block<S>& block, Real s, Row<S>& normal) {
    const Real overlap = std::min(Real(0), s + step.slop);
    if (!step.bias.soft) {
        normal.bias = step.bias.share * overlap / step.h;
        return;
    }
    if (s > 0) return;
    const SoftTerms<Real> terms = softTerms(step.bias.contact, rowCoupling<S>(normal, normal, block), step.h);
    normal.bias = std::max(terms.biasRate * overlap, -step.bias.fastestPush);
    normal.softness = terms.gamma;
    normal.invK = Real(1) / rowK<S>(normal, block);
}

template <class S>
bool ContactSet<S>::bounceAhead(ConstraintRows<S>& rows) const {
    bool any = false;
    for (const Contact<S>& contact : contacts_)
        for (int i = 0; contact.ahead && i < contact.manifold.count; ++i) {
            const auto& point = contact.points[static_cast<std::size_t>(i)];
            if (point.rebound == 0 || point.block == Contact<S>::kNoBlock) continue;
            Row<S>& normal = rows.rows[rows.blocks[point.block].first];
            if (!(normal.impulse > 0)) continue;
            normal.relaxedBias = point.rebound;
            any = true;
        }
    return any;
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
void ContactSet<S>::storeImpulses(const ConstraintRows<S>& rows) {
    for (Contact<S>& contact : contacts_)
        for (int i = 0; i < contact.manifold.count; ++i) {
            typename Contact<S>::Point& point = contact.points[static_cast<std::size_t>(i)];
            if (point.block == Contact<S>::kNoBlock) continue;
            const Block<S>& block = rows.blocks[point.block];
            point.normalImpulse = rows.rows[block.first].impulse;
            point.frictionImpulse.setZero();
            for (std::uint32_t r = 1; r < block.rows; ++r)
                point.frictionImpulse += rows.rows[block.first + r].impulse * rows.rows[block.first + r].lin;
            point.normalTotal += point.normalImpulse;
            point.frictionTotal += point.frictionImpulse;
        }
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

template std::array<Space2f::Vec, Space2f::tangents> tangentBasis<Space2f>(const Space2f::Vec&);
template std::array<Space2d::Vec, Space2d::tangents> tangentBasis<Space2d>(const Space2d::Vec&);
template std::array<Space3f::Vec, Space3f::tangents> tangentBasis<Space3f>(const Space3f::Vec&);
template std::array<Space3d::Vec, Space3d::tangents> tangentBasis<Space3d>(const Space3d::Vec&);
template class ContactSet<Space2f>;
template class ContactSet<Space2d>;
template class ContactSet<Space3f>;
template class ContactSet<Space3d>;

}  // namespace rigor::engine
