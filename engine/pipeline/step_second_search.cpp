// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The second search for contacts, in the middle of a step in which bodies move violently. The first one looks along
// straight ways, with the velocities v_0, w_0 that bodies have when the step of h begins. At time t, with the velocities
// v, w, it has misjudged where a point of a body will be by up to
//     (h - t) (|v - v_0| + r |w - w_0|) + h^2/2 |w|^2 r         r: bounding radius about the centre of mass
// the blows since, and the arcs on which points turn. A body is disturbed where this is more than kMisjudged of its
// shape's inscribed radius: a corner that no contact holds may then be that deep in another body before the next
// step finds it. Pairs with a disturbed body go through the narrow phase again, the others' manifolds follow their
// bodies, and the patches are prepared anew. Pairs of the broad phase stay as they are: boxes were grown by the way of
// the whole step.
//
// Of a wall of 500 bricks that a heavy ball breaks, those hit move by their own thickness within a step. Twice as many
// sub-steps without the second search leave overlaps as they are.
//
// There is none with integrators other than moreau_midpoint, whose contacts are shown where the step began, with
// continuous collision or a fault, and with chains, meshes or height fields on kinematic bodies.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/pipeline/step.hpp"

namespace rigor::engine {
namespace {

constexpr double kMisjudged = 0.1;
constexpr std::size_t kShapeGrain = 256;  ///< least number of shapes for a task: some microseconds of work

}  // namespace

template <class S>
void Step<S>::searchAgain() {
    if (algorithms_.fault != nullptr || hasMovingSurface() || !findDisturbed()) return;
    if (contactModel_.storesOnce()) contactModel_.store(contacts_.list(), rows_, true, tasks_);
    // Bodies that are paused may have come to the midpoints of other sub-steps since the first search.
    const std::span<const std::uint8_t> paused = pausedBodies();
    for (std::size_t i = 0; i < paused.size(); ++i)
        if (paused[i]) bodies_.asleep[i] = 0;
    contacts_.keepSides(bodies_, tasks_);
    for (std::size_t i = 0; i < paused.size(); ++i)
        if (paused[i]) bodies_.asleep[i] = 1;
    const Real done = static_cast<Real>(state_.substep) * state_.substepSize;
    contacts_.findAgain(bodies_, {state_.disturbed, state_.islands}, state_.size - done,
                        *algorithms_.narrowPhase, algorithms_.makeManifold, *algorithms_.ccd, tasks_);
    world_.islands.changed();
    state_.searchedAgain = true;
    state_.searchTime[state_.islands] += done;
    // motionToEnd() has kinematic bodies from state_.searchTime.
    for (std::size_t i = 0; i < state_.leads.size(); ++i)
        if (bodies_.constants[i].type != BodyType::Static && bodies_.islands[i] == state_.islands)
            state_.leads[i].middle = bodies_.pose[i];
}

/// Returns whether there is any.
template <class S>
bool Step<S>::findDisturbed() {
    const Real rest = state_.size - static_cast<Real>(state_.substep) * state_.substepSize;
    const Real arc = Real(0.5) * state_.size * state_.size;
    const ShapeSet<S>& shapes = contacts_.shapes();
    state_.disturbed.assign(bodies_.size(), 0);
    std::atomic<bool> any = false;
    tasks_.forEach(shapes.size(), kShapeGrain, [&](std::size_t k) {
        const ShapeRecord<S>& shape = shapes[k];
        if (bodies_.invMass[shape.body] == 0) return;
        const Velocity<S>&now = bodies_.velocity[shape.body], &was = state_.foreseen[shape.body];
        const Ang turned = now.w - was.w;
        const Real r = shape.boundingRadius;
        const Real misjudged = rest * ((now.v - was.v).norm() + r * std::sqrt(dotAng(turned, turned))) +
                               arc * r * dotAng(now.w, now.w);
        if (!(misjudged > static_cast<Real>(kMisjudged) * shape.inscribedRadius)) return;
        // Several shapes may be of one body.
        std::atomic_ref(state_.disturbed[shape.body]).store(1, std::memory_order_relaxed);
        any.store(true, std::memory_order_relaxed);
    });
    return any;
}

template <class S>
bool Step<S>::hasMovingSurface() const {
    const ShapeSet<S>& shapes = contacts_.shapes();
    return std::any_of(shapes.surfaces().begin(), shapes.surfaces().end(), [&](std::uint32_t surface) {
        return bodies_.constants[shapes[surface].body].type == BodyType::Kinematic;
    });
}

#define RIGOR_INSTANTIATE(S) template void Step<S>::searchAgain();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
