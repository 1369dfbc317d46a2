// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Injects a fault (engine/faults) between the stages of a step. Called only where the world has one.
#include "engine/pipeline/step.hpp"

namespace rigor::engine {
namespace {

template <class S>
void injectIntoManifolds(const BodyArrays<S>& bodies, const Fault<S>& fault, std::uint64_t step,
                         Contacts<S>& contacts) {
    const ShapeSet<S>& shapes = contacts.shapes();
    for (Contact<S>& contact : contacts.list()) {
        const std::uint32_t a = contact.shapeA, b = contact.shapeB;
        fault.manifold(shapes[a].shape, shapes.pose(a), shapes[b].shape, shapes.pose(b), step,
                       contact.manifold);
        placePoints(bodies, contact);
    }
}

template <class S>
void injectIntoRows(const BodyArrays<S>& bodies, const Fault<S>& fault, const ContactList<S>& contacts,
                    ConstraintRows<S>& rows) {
    for (const Contact<S>& contact : contacts)
        for (int i = 0; i < contact.manifold.count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            if (contact.block[k] == kNullIndex) continue;
            Block<S>& block = rows.blocks[contact.block[k]];
            Row<S>* first = rows.rows.data() + block.first;
            ContactRows<S> faulty{block,
                                  {first, block.rows},
                                  contact.coefficients.restitution,
                                  rowVelocity<S>(*first, bodies.velocity[block.a], bodies.velocity[block.b]),
                                  contact.points[k].separation};
            fault.contact(faulty);
        }
}

}  // namespace

template <class S>
void Step<S>::injectFault(Phase phase) {
    const Fault<S>& fault = *algorithms_.fault;
    switch (phase) {
        case Phase::BroadPhase:
            contacts_.pairSearch().edit(
                [&](std::vector<ProxyPair>& pairs) { fault.pairs(contacts_.shapes().movable(), pairs); });
            break;
        case Phase::NarrowPhase:
            injectIntoManifolds<S>(bodies_, fault, world_.clock.steps, contacts_);
            break;
        case Phase::Velocities:
            injectIntoRows<S>(bodies_, fault, contacts_.list(), rows_);
            break;
        case Phase::Solve:
            fault.solved(bodies_, rows_);
            break;
        case Phase::Move:
            fault.moved(bodies_, motion_.startRotations(), state_.substepSize);
            if (fault.movesStatics()) contacts_.structureChanged();
            break;
        default:
            break;
    }
}

#define RIGOR_INSTANTIATE(S) template void Step<S>::injectFault(Phase);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
