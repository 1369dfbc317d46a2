// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Islands in violent motion: those in which several bodies close in on each other so fast that a step takes them more than
// a tenth of their inscribed radius further. What hits a body sends it another way than the one along which its contacts
// were found, into bodies that it was not seen to come to. Such islands find their contacts for each half of the step
// (step_second_search.cpp), and otherwise are solved as usual ones.
//
// An island that joints hold, or that bounces, has its impacts at their own times within the step and is none of those, nor
// is one with a single impact. With continuous collision there are none.
#include <algorithm>

#include "engine/pipeline/point_speed.hpp"
#include "engine/pipeline/step.hpp"

namespace rigor::engine {
namespace {

constexpr double kViolent = 0.1;
constexpr std::size_t kLeastViolent = 2;  ///< least number of contacts of an island that close in fast
constexpr std::size_t kViolentShare = 8;  ///< least share of them is one of so many contacts

}  // namespace

/// Finds the contacts between two bodies that impulses move and that close in fast.
template <class S>
void Step<S>::findViolent() {
    std::vector<std::uint32_t>& violent = state_.sort.violent;
    violent.clear();
    if (!algorithms_.violent || algorithms_.continuous || hasMovingSurface()) return;
    const ShapeSet<S>& shapes = contacts_.shapes();
    const ContactList<S>& contacts = contacts_.list();
    for (std::uint32_t k = 0; k < contacts.size(); ++k) {
        const Contact<S>& contact = contacts[k];
        const std::uint32_t a = contact.bodyA, b = contact.bodyB;
        if (contact.islands == IslandKind::Large || contact.piece != kNullIndex) continue;
        if (contact.manifold.count == 0 || bodies_.invMass[a] == 0 || bodies_.invMass[b] == 0) continue;
        const Real closing = -normalSpeed<S>(bodies_, contact, contact.manifold.points[0]);
        const Real thin =
            std::min(shapes[contact.shapeA].inscribedRadius, shapes[contact.shapeB].inscribedRadius);
        if (closing * state_.size > static_cast<Real>(kViolent) * thin) violent.push_back(k);
    }
}

template <class S>
void Step<S>::countViolent(const Islands& islands) {
    for (const std::uint32_t k : state_.sort.violent) {
        const Contact<S>& contact = contacts_.list()[k];
        ++state_.sort.counts[std::min(islands.islandOf(contact.bodyA), islands.islandOf(contact.bodyB))]
              .violent;
    }
}

/// Whether an island of so many contacts that close in fast, or a world of them, may be in violent motion.
template <class S>
bool Step<S>::mayBeViolent(std::size_t contacts) {
    return contacts >= kLeastViolent;
}

template <class S>
bool Step<S>::isViolent(const typename IslandSort<S>::Counts& c) {
    return mayBeViolent(c.violent) && c.violent * kViolentShare >= c.contacts && c.joints == 0 && !c.bounces;
}

#define RIGOR_INSTANTIATE(S)                             \
    template void Step<S>::findViolent();                \
    template void Step<S>::countViolent(const Islands&); \
    template bool Step<S>::mayBeViolent(std::size_t);    \
    template bool Step<S>::isViolent(const typename IslandSort<S>::Counts&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
