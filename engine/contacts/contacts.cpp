// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/contacts.hpp"

namespace rigor::engine {

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
void Contacts<S>::structureChanged(bool indicesChanged) {
    shapes_.changed();
    pairs_.reset();
    candidates_.invalidate();
    coefficientsOf_ = 0;
    if (!indicesChanged) return;
    list_.clear();
    candidates_.clear();
}

template <class S>
void Contacts<S>::forgetImpulses(std::uint32_t body) {
    for (Contact<S>& contact : list_)
        if (contact.bodyA == body || contact.bodyB == body) contact.impulses.fill({});
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
    candidates_.update(bodies, shapes_, filter_, pairs_, search_, tasks);
    // It keeps the points as they are.
    if (makeManifold == &manifoldClipped<S>) makeManifold = nullptr;
    const ContactUpdate<S> update{bodies,
                                  shapes_,
                                  materials_,
                                  narrowPhase,
                                  makeManifold,
                                  ahead,
                                  ContactCache<S>(shapes_, search_.speculativeDistance),
                                  coefficientsOf_ == materials_.revision(),
                                  search_.longestMotionTime(),
                                  search_.bouncesAhead};
    finder_.run(update, pairs_.exact(), candidates_, list_, tasks);
    coefficientsOf_ = materials_.revision();
}

template <class S>
bool Contacts<S>::completeRestored() {
    coefficientsOf_ = 0;
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
