// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/contacts.hpp"

#include <algorithm>
#include <utility>

#include "engine/narrowphase/surface_contact.hpp"

namespace rigor::engine {
namespace {

template <class S>
void applyAnswer(const PreSolveAnswer<S>& answer, Contact<S>& contact) {
    contact.coefficients = answer.coefficients;
    if (answer.surfaceVelocity.isZero(0)) return;
    if (!contact.driven) contact.surfaceA = contact.surfaceB = {};
    contact.driven = true;
    contact.surfaceB.v += answer.surfaceVelocity;
}

}  // namespace

template <class S>
void Contacts<S>::setExcluded(std::vector<std::uint64_t> pairs) {
    filter_.setExcluded(std::move(pairs));
    candidates_.invalidate();
}

template <class S>
void Contacts<S>::setShapeFilter(std::uint32_t shape, const ShapeFilter& filter) {
    shapes_.records()[shape].filter = filter;
    candidates_.invalidate();
}

template <class S>
void Contacts<S>::structureChanged() {
    shapes_.changed();
    pairs_.reset();
    candidates_.invalidate();
    sensors_.shapesChanged();
    coefficientsOf_ = 0;
}

template <class S>
void Contacts<S>::removeShapes(const BodyArrays<S>& bodies, std::span<const std::uint8_t> gone) {
    for (const Contact<S>& contact : list_) {
        if (!contact.touching || !(gone[contact.shapeA] || gone[contact.shapeB])) continue;
        Event<S>& event = removedEvents_.emplace_back();
        event.kind = EventKind::ContactEnds;
        event.bodyA = bodies.id[contact.bodyA];
        event.bodyB = bodies.id[contact.bodyB];
        event.shapeA = shapes_[contact.shapeA].id;
        event.shapeB = shapes_[contact.shapeB].id;
    }
    const std::vector<std::uint32_t> newIndex = shapes_.remove(gone);
    candidates_.renumber(newIndex);
    std::vector<std::uint32_t>& order = list_.order();
    std::size_t kept = 0;
    for (const std::uint32_t slot : order) {
        Contact<S>& contact = list_.at(slot);
        contact.shapeA = newIndex[contact.shapeA];
        contact.shapeB = newIndex[contact.shapeB];
        if (contact.shapeA == kNullIndex || contact.shapeB == kNullIndex)
            list_.remove(slot);
        else
            order[kept++] = slot;
    }
    order.resize(kept);
    structureChanged();
}

/// A contact whose bodies are now out of order is turned around; its features match those of the next step by place.
template <class S>
void Contacts<S>::bodyMoved(std::uint32_t from, std::uint32_t to) {
    for (ShapeRecord<S>& shape : shapes_.records())
        if (shape.body == from) shape.body = to;
    candidates_.orderBodies(shapes_);
    for (Contact<S>& contact : list_) {
        if (contact.bodyA == from) contact.bodyA = to;
        if (contact.bodyB == from) contact.bodyB = to;
        if (contact.bodyA < contact.bodyB) continue;
        std::swap(contact.bodyA, contact.bodyB);
        std::swap(contact.shapeA, contact.shapeB);
        flipManifold(contact.manifold);
        contact.cache = {};
        contact.moment = -contact.moment;
        contact.momentTotal = -contact.momentTotal;
        contact.lastNormal = -contact.lastNormal;
        contact.placed = false;
        for (std::size_t i = 0; i < contact.impulses.size(); ++i) {
            contact.impulses[i].friction = -contact.impulses[i].friction;
            contact.totals[i].friction = -contact.totals[i].friction;
            std::swap(contact.points[i].rA, contact.points[i].rB);
        }
    }
}

template <class S>
void Contacts<S>::forgetImpulses(std::uint32_t body) {
    for (Contact<S>& contact : list_) {
        if (contact.bodyA != body && contact.bodyB != body) continue;
        contact.impulses.fill({});
        contact.moment = zeroAng<S>();
    }
}

template <class S>
void Contacts<S>::findPairs(const BodyArrays<S>& bodies, BroadPhase<S>& broadPhase,
                            const ContactSearch<S>& search, const LookAhead<S>& ahead, const Tasks& tasks) {
    search_ = search;
    shapes_.update(bodies, search, ahead, tasks);
    pairs_.update(shapes_, broadPhase, search.boxMargin, tasks);
}

template <class S>
void Contacts<S>::findManifolds(const BodyArrays<S>& bodies, const NarrowPhase<S>& narrowPhase,
                                ManifoldFunction<S> makeManifold, const LookAhead<S>& ahead,
                                const Tasks& tasks) {
    filter_.setVetoed({});
    candidates_.update(bodies, shapes_, filter_, pairs_, search_, tasks);
    runFinder(bodies, search_, {}, narrowPhase, makeManifold, ahead, tasks);
    coefficientsOf_ = materials_.revision();
    if (preSolve_) callPreSolve(bodies, [](const Contact<S>&) { return true; });
}

template <class S>
void Contacts<S>::findAgain(const BodyArrays<S>& bodies, const SecondSearch& second,
                            typename S::Real motionTime, const NarrowPhase<S>& narrowPhase,
                            ManifoldFunction<S> makeManifold, const LookAhead<S>& ahead, const Tasks& tasks) {
    ContactSearch<S> search = search_;
    (search.motionTime > 0 ? search.motionTime : search.largeMotionTime) = motionTime;
    shapes_.update(bodies, search, ahead, tasks);
    runFinder(bodies, search, second, narrowPhase, makeManifold, ahead, tasks);
    // The others have blocks, are of other islands, of bodies that do not move, or were refused.
    const auto isNew = [&](const Contact<S>& contact) {
        const bool moves = bodies.invMass[contact.bodyA] > 0 || bodies.invMass[contact.bodyB] > 0;
        return contact.islands == second.islands && moves && !contact.vetoed &&
               contact.block[0] == kNullIndex;
    };
    if (preSolve_) callPreSolve(bodies, isNew);
}

template <class S>
void Contacts<S>::runFinder(const BodyArrays<S>& bodies, const ContactSearch<S>& search,
                            const SecondSearch& second, const NarrowPhase<S>& narrowPhase,
                            ManifoldFunction<S> makeManifold, const LookAhead<S>& ahead, const Tasks& tasks) {
    findTouched(bodies);
    // It keeps the points as they are.
    if (makeManifold == &manifoldClipped<S>) makeManifold = nullptr;
    const ContactUpdate<S> update{bodies,
                                  shapes_,
                                  materials_,
                                  narrowPhase,
                                  makeManifold,
                                  ahead,
                                  ContactCache<S>(shapes_, search.speculativeDistance),
                                  coefficientsOf_ == materials_.revision(),
                                  search.longestMotionTime(),
                                  search.bouncesAhead,
                                  touched_,
                                  second};
    finder_.run(update, pairs_.exact(), candidates_, list_, tasks);
}

template <class S>
void Contacts<S>::findTouched(const BodyArrays<S>& bodies) {
    if (search_.longestMotionTime() == 0) return;
    touched_.assign(bodies.size(), 0);
    for (const Contact<S>& contact : list_) {
        if (!contact.touching) continue;
        for (const std::uint32_t body : {contact.bodyA, contact.bodyB})
            touched_[body] = bodies.constants[body].type == BodyType::Dynamic;
    }
}

/// Contacts of bodies that sleep keep what they had.
template <class S>
template <class IsNew>
void Contacts<S>::callPreSolve(const BodyArrays<S>& bodies, const IsNew& isNew) {
    coefficientsOf_ = 0;
    std::vector<std::uint64_t> vetoed;
    for (Contact<S>& contact : list_) {
        const ShapeRecord<S>&a = shapes_[contact.shapeA], &b = shapes_[contact.shapeB];
        if (!isAsleep<S>(bodies, contact) && isNew(contact)) {
            const auto answer =
                preSolve_(bodies, a, b, contact.piece, contact.manifold, bodies.pose[contact.bodyA].p,
                          bodies.pose[contact.bodyB].p, contact.coefficients);
            contact.vetoed = !answer.has_value();
            if (answer) applyAnswer(*answer, contact);
        }
        if (!contact.vetoed) continue;
        contact.touching = false;
        contact.impulses.fill({});
        contact.moment = zeroAng<S>();
        vetoed.push_back(CollisionFilter<S>::vetoKey(a, b));
    }
    std::sort(vetoed.begin(), vetoed.end());
    filter_.setVetoed(std::move(vetoed));
}

template <class S>
std::optional<PreSolveAnswer<S>> Contacts<S>::lawOfImpact(const BodyArrays<S>& bodies, std::uint32_t shapeA,
                                                          std::uint32_t shapeB, const Manifold<S>& manifold,
                                                          const typename S::Vec& pA,
                                                          const typename S::Vec& pB) const {
    const ShapeRecord<S>&a = shapes_[shapeA], &b = shapes_[shapeB];
    const PairCoefficients<S> coefficients = materials_.pair(a.material, b.material);
    if (!preSolve_) return PreSolveAnswer<S>{coefficients};
    return preSolve_(bodies, a, b, kNullIndex, manifold, pA, pB, coefficients);
}

template <class S>
bool Contacts<S>::completeRestored() {
    coefficientsOf_ = 0;
    removedEvents_.clear();
    candidates_.invalidate();
    if (!candidates_.completeRestored(shapes_)) return false;
    for (Contact<S>& contact : list_) {
        const auto n = static_cast<std::size_t>(contact.manifold.count);
        for (std::size_t i = 0; i < n; ++i) contact.impacts = contact.impacts || contact.points[i].impact;
        // A world that solves patches does not write the points.
        contact.placed = n > 0 && !contact.points[0].rB.isZero(0);
    }
    std::size_t count = 0;
    for (const Candidate<S>& c : candidates_.list()) {
        if (c.contact == kNullIndex) continue;
        if (count >= list_.size()) return false;
        const Contact<S>& contact = list_[count++];
        if (contact.shapeA != c.a || contact.shapeB != c.b || contact.piece != c.piece) return false;
        if (c.cached && contact.cache.count != contact.manifold.count) return false;
    }
    return count == list_.size();
}

RIGOR_INSTANTIATE_CLASS(Contacts)

}  // namespace rigor::engine
