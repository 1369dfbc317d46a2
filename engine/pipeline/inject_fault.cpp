// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Injects a fault (engine/faults) between the stages of a step. Called only where the world has one.
#include "engine/pipeline/world.hpp"

namespace rigor::engine {

template <class S>
void ContactSet<S>::injectIntoManifolds(const BodyArrays<S>& bodies, const Fault<S>& fault,
                                        std::uint64_t step) {
    for (Contact<S>& contact : contacts_) {
        fault.manifold(shapes_[contact.shapeA].shape, shapePoses_[contact.shapeA],
                       shapes_[contact.shapeB].shape, shapePoses_[contact.shapeB], step, contact.manifold);
        placePoints(bodies, contact);
    }
}

template <class S>
void ContactSet<S>::injectIntoRows(const BodyArrays<S>& bodies, const Fault<S>& fault,
                                   ConstraintRows<S>& rows) {
    for (Contact<S>& contact : contacts_)
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

template <class S>
void World<S>::injectFault(Phase phase) {
    switch (phase) {
        case Phase::BroadPhase:
            contacts_.injectIntoPairs(*fault_);
            break;
        case Phase::NarrowPhase:
            contacts_.injectIntoManifolds(bodies_, *fault_, stepCount_);
            break;
        case Phase::Velocities:
            contacts_.injectIntoRows(bodies_, *fault_, rows_);
            break;
        case Phase::Solve:
            fault_->solved(bodies_, rows_);
            break;
        case Phase::Move:
            fault_->moved(bodies_, motion_.startRotations(), progress_.substepSize);
            if (fault_->movesStatics()) contacts_.structureChanged(false);
            break;
        default:
            break;
    }
}

#define RIGOR_INSTANTIATE(S)                                                                                \
    template void ContactSet<S>::injectIntoManifolds(const BodyArrays<S>&, const Fault<S>&, std::uint64_t); \
    template void ContactSet<S>::injectIntoRows(const BodyArrays<S>&, const Fault<S>&, ConstraintRows<S>&); \
    template void World<S>::injectFault(Phase);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
