// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts that a world shows of its last step. Where a step leads from midpoint to midpoint they have acted at the poses of
// its middle, which are not shown: those of convex shapes are found again at the poses that the world shows, by the same
// narrow phase, when they are read. Each point that has rows gives its impulses to the nearest one there. Impacts at their own
// times give theirs to the contact of their shapes, which are their closest points if they have parted since. Pieces of
// surfaces, and manifolds that are kept from step to step, are shown as step_shown.cpp has moved them.
#include <algorithm>

#include "engine/narrowphase/distance.hpp"
#include "engine/pipeline/small_turn.hpp"
#include "engine/pipeline/world.hpp"

namespace rigor::engine {
namespace {

/// A contact as it is shown: its manifold, and the impulses of each point.
template <class S>
struct ShownContact {
    Manifold<S> manifold;
    std::array<typename Contact<S>::Impulse, S::maxManifoldPoints> impulses{};
    std::array<bool, S::maxManifoldPoints> hasActed{};
};

template <class S>
bool hasActed(const Contact<S>& contact, std::size_t point) {
    const bool before = contact.parted && contact.totals[point].normal > 0;  // the second search
    return contact.block[point] != kNullIndex || contact.asleep || before;
}

template <class S>
ShownContact<S> asItActed(const Contact<S>& contact) {
    ShownContact<S> shown{contact.manifold, contact.totals, {}};
    for (std::size_t i = 0; i < shown.hasActed.size(); ++i) shown.hasActed[i] = hasActed(contact, i);
    return shown;
}

/// Largest distance of the points of a contact [m], at least `least`.
template <class S>
typename S::Real reachOf(const Contact<S>& contact, typename S::Real least) {
    for (int i = 0; i < contact.manifold.count; ++i)
        least = std::max(least, contact.manifold.points[static_cast<std::size_t>(i)].separation);
    return least;
}

/// Two convex shapes where the world shows them.
template <class S>
struct PosedPair {
    PosedPair(const WorldParts<S>& parts, std::uint32_t shapeA, std::uint32_t shapeB)
        : world(parts),
          a(world.contacts.shapes()[shapeA]),
          b(world.contacts.shapes()[shapeB]),
          Xa(compose<S>(world.bodies.arrays().pose[a.body], a.local)),
          Xb(compose<S>(world.bodies.arrays().pose[b.body], b.local)) {}

    /// Their manifold; empty where they are further apart than `reach` [m]. Where others are as good, its points are those
    /// that `memory` knows.
    Manifold<S> manifold(typename S::Real reach, const ManifoldMemory<S>& memory) const {
        Manifold<S> found;
        found.memory = memory;
        world.algorithms.narrowPhase->collide(a.shape, Xa, b.shape, Xb, reach, found);
        ManifoldCache<S> none;
        if (found.count > 0 && world.algorithms.makeManifold != nullptr)
            world.algorithms.makeManifold({Xa, Xb, 2 * std::min(a.radius, b.radius), reach}, none, found);
        return found;
    }
    /// Their closest points, as a manifold.
    Manifold<S> closest() const {
        Manifold<S> found;
        setToClosest<S>(closestPoints<S>(a.shape, Xa, b.shape, Xb), found);
        return found;
    }

    const WorldParts<S>& world;
    const ShapeRecord<S>&a, &b;
    Pose<S> Xa, Xb;
};

/// The point of a manifold that is nearest to one of the same contact, which showContacts() has moved to the same poses.
template <class S>
std::size_t nearestPoint(const Manifold<S>& manifold, const ManifoldPoint<S>& to) {
    const auto distance = [&](std::size_t i) {
        return (manifold.points[i].pointA + manifold.points[i].pointB - to.pointA - to.pointB).squaredNorm();
    };
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < static_cast<std::size_t>(manifold.count); ++i)
        if (distance(i) < distance(nearest)) nearest = i;
    return nearest;
}

/// A contact found again, with the impulses of the step. A point without impulses counts as one that has acted if
/// the shapes overlap there.
template <class S>
ShownContact<S> foundAgain(const WorldParts<S>& world, const Contact<S>& contact) {
    const PosedPair<S> pair(world, contact.shapeA, contact.shapeB);
    ShownContact<S> shown{
        pair.manifold(reachOf(contact, 2 * world.def.slop), contact.manifold.memory), {}, {}};
    if (shown.manifold.count == 0) shown.manifold = pair.closest();
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        if (!hasActed(contact, i)) continue;
        const std::size_t at = nearestPoint(shown.manifold, contact.manifold.points[i]);
        shown.hasActed[at] = true;
        shown.impulses[at].normal += contact.totals[i].normal;
        shown.impulses[at].friction += turnedInto<S>(shown.manifold.normal, contact.totals[i].friction);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(shown.manifold.count); ++i)
        shown.hasActed[i] = shown.hasActed[i] || shown.manifold.points[i].separation < 0;
    return shown;
}

/// True: of two convex shapes, and not by a manifold that is kept from step to step.
template <class S>
bool mayBeFoundAgain(const ShapeSet<S>& shapes, const Contact<S>& contact) {
    return contact.cache.count == 0 && contact.manifold.count > 0 &&
           !isComposite<S>(shapes[contact.shapeA].shape) && !isComposite<S>(shapes[contact.shapeB].shape);
}

/// Shapes that have come to overlap since contacts were looked for.
template <class S>
ShownContact<S> foundSince(const WorldParts<S>& world, const Candidate<S>& candidate) {
    ShownContact<S> shown;
    const auto& constants = world.bodies.arrays().constants;
    const ShapeSet<S>& shapes = world.contacts.shapes();
    const bool moves = constants[shapes[candidate.a].body].type == BodyType::Dynamic ||
                       constants[shapes[candidate.b].body].type == BodyType::Dynamic;
    if (!moves || isComposite<S>(shapes[candidate.a].shape) || isComposite<S>(shapes[candidate.b].shape))
        return shown;
    shown.manifold = PosedPair<S>(world, candidate.a, candidate.b).manifold(0, {});
    for (std::size_t i = 0; i < static_cast<std::size_t>(shown.manifold.count); ++i)
        shown.hasActed[i] = shown.manifold.points[i].separation < 0;
    return shown;
}

/// Appends the points of a contact that have acted.
template <class S>
void append(const WorldParts<S>& world, std::uint32_t shapeA, std::uint32_t shapeB,
            const ShownContact<S>& shown, std::vector<ContactView<S>>& out) {
    const ShapeRecord<S>&a = world.contacts.shapes()[shapeA], &b = world.contacts.shapes()[shapeB];
    const std::vector<BodyId>& ids = world.bodies.arrays().id;
    for (std::size_t i = 0; i < static_cast<std::size_t>(shown.manifold.count); ++i) {
        if (!shown.hasActed[i]) continue;
        const ManifoldPoint<S>& point = shown.manifold.points[i];
        out.push_back({ids[a.body], ids[b.body], a.id, b.id, point.pointA, point.pointB,
                       shown.manifold.normal, point.separation, shown.impulses[i].normal,
                       shown.impulses[i].friction});
    }
}

/// An impact at its own time: its impulses are those of the contact that its shapes have at the end of the step, or of
/// their closest points there. Shapes that are not convex have none.
template <class S>
void addImpact(const WorldParts<S>& world, const ImpactEvent<S>& impact, std::vector<ContactView<S>>& out) {
    const ShapeSet<S>& shapes = world.contacts.shapes();
    if (!shapes.ids().contains(impact.shapeA) || !shapes.ids().contains(impact.shapeB)) return;
    const auto distance = [&](const ContactView<S>& view) {
        return (view.pointB - impact.point).squaredNorm();
    };
    ContactView<S>* nearest = nullptr;
    for (ContactView<S>& view : out)
        if (view.shapeA == impact.shapeA && view.shapeB == impact.shapeB &&
            (nearest == nullptr || distance(view) < distance(*nearest)))
            nearest = &view;
    if (nearest == nullptr) {
        const std::uint32_t a = shapes.ids().dense(impact.shapeA), b = shapes.ids().dense(impact.shapeB);
        if (isComposite<S>(shapes[a].shape) || isComposite<S>(shapes[b].shape)) return;
        ShownContact<S> shown;
        shown.manifold = PosedPair<S>(world, a, b).closest();
        shown.hasActed[0] = true;
        append(world, a, b, shown, out);
        nearest = &out.back();
    }
    nearest->normalImpulse += impact.impulse;
    nearest->frictionImpulse += turnedInto<S>(nearest->normal, impact.friction);
}

}  // namespace

template <class S>
void World<S>::readContacts(std::vector<ContactView<S>>& out) const {
    const ContactList<S>& contacts = parts_.contacts.list();
    out.clear();
    if (!contactsAtStepEnd()) {
        for (const Contact<S>& contact : contacts)
            if (!contact.vetoed) append(parts_, contact.shapeA, contact.shapeB, asItActed(contact), out);
        return;
    }
    for (const Candidate<S>& candidate : parts_.contacts.candidates().list()) {
        if (candidate.contact == kNullIndex) {
            append(parts_, candidate.a, candidate.b, foundSince(parts_, candidate), out);
            continue;
        }
        const Contact<S>& contact = contacts.at(candidate.contact);
        if (contact.vetoed) continue;
        append(parts_, contact.shapeA, contact.shapeB,
               mayBeFoundAgain(parts_.contacts.shapes(), contact) ? foundAgain(parts_, contact)
                                                                  : asItActed(contact),
               out);
    }
    for (const ImpactEvent<S>& impact : lastStep().impacts) addImpact(parts_, impact, out);
}

#define RIGOR_INSTANTIATE(S) template void World<S>::readContacts(std::vector<ContactView<S>>&) const;
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
