// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The bodies that fly in a step, their ways, and the pairs of shapes whose ways come near each other.
#include <algorithm>
#include <cmath>

#include "engine/ccd/flight_impacts.hpp"
#include "engine/state/sleep.hpp"

namespace rigor::engine {

/// Marks the bodies in flight.
template <class S>
void FlightImpacts<S>::findFlying(const MovedWorld<S>& world) {
    const BodyArrays<S>& bodies = world.bodies;
    const std::size_t n = bodies.size();
    flying_.resize(n);
    for (std::size_t i = 0; i < n; ++i)
        flying_[i] = bodies.constants[i].type == BodyType::Dynamic && bodies.invMass[i] > 0 && !bound_[i] &&
                     bodies.islands[i] == IslandKind::Usual;
    if (std::find(flying_.begin(), flying_.end(), 1) == flying_.end()) return;
    for (const Contact<S>& contact : world.contacts.list()) {
        const std::uint32_t a = contact.bodyA, b = contact.bodyB;
        if (contact.vetoed || (!flying_[a] && !flying_[b])) continue;
        const Real slowest = slowestImpact(world, contact.coefficients.restitution, a, b);
        for (int i = 0; i < contact.manifold.count; ++i) {
            if (std::abs(normalSpeed(contact, i)) > slowest) continue;
            flying_[a] = flying_[b] = 0;
            break;
        }
    }
}

template <class S>
void FlightImpacts<S>::makeWays(const MovedWorld<S>& world) {
    const BodyArrays<S>& bodies = world.bodies;
    ways_.resize(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        Way& way = ways_[i];
        way = Way{};
        way.start = startPose_[i];
        way.velocity = startVelocity_[i];
        way.turning = startVelocity_[i].w;
        if (flying_[i]) {
            way.acceleration = way.pull = gained_[i] / world.h;
            way.turning =
                world.motion.freeRotation(bodies.constants[i], way.start.q, way.velocity.w, world.h);
        } else if (bodies.constants[i].type == BodyType::Dynamic) {
            way.velocity = {Vec((bodies.pose[i].p - way.start.p) / world.h), startVelocity_[i].w};
        } else if (bodies.constants[i].type == BodyType::Static) {
            way.velocity = {};
            way.turning = zeroAng<S>();
        }
    }
}

/// Contains the shape from the time that its body's way begins, when it has the box `box`, to the end: as seen from the
/// frame that moves by drift_ in the step. As far in every direction, so that all pairs of mayTouch() overlap.
template <class S>
Aabb<S> FlightImpacts<S>::boxOf(const MovedWorld<S>& world, std::uint32_t shape, Aabb<S> box) const {
    const ShapeRecord<S>& record = world.contacts.shapes()[shape];
    const Way& way = ways_[record.body];
    const Real rest = world.h - way.begin;
    const Vec d = rest * way.velocity.v + (Real(0.5) * rest * rest) * way.acceleration;
    // The parabola is this far from its chord.
    const Real bulge = (Real(0.125) * rest * rest) * way.acceleration.norm();
    const Real turn =
        std::min(rest * std::sqrt(dotAng(way.turning, way.turning)), Real(2)) * record.boundingRadius;
    const Vec start = (way.begin / world.h) * drift_;
    const Vec margin = Vec::Constant((d - (rest / world.h) * drift_).norm() + bulge + turn);
    box.min -= start + margin;
    box.max += margin - start;
    return box;
}

/// False where the shapes are further apart when the step begins than they move relative to each other in it: neighbours
/// that fall side by side. The distance of surfaces is that of their boxes.
template <class S>
bool FlightImpacts<S>::mayTouch(const MovedWorld<S>& world, const Pair& pair) const {
    const ShapeRecord<S>&a = world.contacts.shapes()[pair.a], &b = world.contacts.shapes()[pair.b];
    const Way &A = ways_[a.body], &B = ways_[b.body];
    const Real h = world.h;
    const Real turning = std::sqrt(dotAng(A.turning, A.turning)) * a.boundingRadius +
                         std::sqrt(dotAng(B.turning, B.turning)) * b.boundingRadius;
    const Real motion = h * ((A.velocity.v - B.velocity.v).norm() + turning) +
                        Real(0.5) * h * h * (A.acceleration - B.acceleration).norm();
    const Aabb<S>&boxA = startBoxes_[pair.a], &boxB = startBoxes_[pair.b];
    const Vec apart = (boxA.min - boxB.max).cwiseMax(boxB.min - boxA.max).cwiseMax(Real(0));
    if (!(apart.squaredNorm() <= motion * motion)) return false;
    if (isComposite<S>(a.shape) || isComposite<S>(b.shape)) return true;
    return look(world, pair, Real(0)).distance <= motion + Real(1e-9);
}

/// Pairs of shapes whose boxes overlap, at least one of a body in flight.
template <class S>
void FlightImpacts<S>::findPairs(const MovedWorld<S>& world) {
    const ShapeSet<S>& shapes = world.contacts.shapes();
    const auto count = static_cast<std::uint32_t>(shapes.size());
    boxes_.resize(count);
    startBoxes_.resize(count);
    movable_.resize(count);
    drift_.setZero();
    Real flying = 0;
    for (std::size_t i = 0; i < ways_.size(); ++i) {
        if (!flying_[i]) continue;
        drift_ += ways_[i].velocity.v;
        ++flying;
    }
    drift_ *= world.h / flying;
    for (std::uint32_t i = 0; i < count; ++i) {
        const ShapeRecord<S>& shape = shapes[i];
        startBoxes_[i] = boundingBox<S>(shape.shape, compose<S>(startPose_[shape.body], shape.local));
        boxes_[i] = boxOf(world, i, startBoxes_[i]);
        movable_[i] = flying_[shape.body];
    }
    broadPhase_->update(boxes_, movable_, found_);
    clusters_.begin(static_cast<std::uint32_t>(world.bodies.size()));
    blocked_.assign(world.bodies.size(), 0);
    pairs_.clear();
    blockers_.clear();
    for (const ProxyPair& pair : found_) addPair(world, pair.a, pair.b);
    joinPushed(world);
    for (const std::uint32_t body : blockers_) blocked_[clusters_.rootOf(body)] = 1;
    std::sort(pairs_.begin(), pairs_.end(),
              [](const Pair& p, const Pair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
}

/// Bodies in flight that the step has pushed apart, at gaps that they close only in the next one, share a cluster: its
/// bodies go their own ways together, or none does, so that no momentum is lost. Bodies that are not in flight keep what
/// they got.
template <class S>
void FlightImpacts<S>::joinPushed(const MovedWorld<S>& world) {
    for (const Contact<S>& contact : world.contacts.list()) {
        const std::uint32_t a = contact.bodyA, b = contact.bodyB;
        if (!(flying_[a] || flying_[b])) continue;
        const auto pushes = [](const auto& total) { return total.normal > 0; };
        if (std::none_of(contact.totals.begin(), contact.totals.end(), pushes)) continue;
        if (flying_[a] && flying_[b])
            clusters_.join(a, b);
        else if (world.bodies.constants[flying_[a] ? b : a].type == BodyType::Dynamic)
            blockers_.push_back(flying_[a] ? a : b);
    }
}

template <class S>
void FlightImpacts<S>::addPair(const MovedWorld<S>& world, std::uint32_t i, std::uint32_t j) {
    const ShapeSet<S>& shapes = world.contacts.shapes();
    const std::uint32_t bi = shapes[i].body, bj = shapes[j].body;
    if (bi == bj || !(flying_[bi] || flying_[bj])) return;
    if (!world.contacts.filter().mayCollide(world.bodies, shapes[i], shapes[j])) return;
    Pair pair;
    pair.a = bi < bj ? i : j;
    pair.b = bi < bj ? j : i;
    if (!mayTouch(world, pair)) return;
    const bool meets = (flying_[bi] || world.bodies.constants[bi].type != BodyType::Dynamic) &&
                       (flying_[bj] || world.bodies.constants[bj].type != BodyType::Dynamic) &&
                       !isComposite<S>(shapes[i].shape) && !isComposite<S>(shapes[j].shape);
    if (flying_[bi] && flying_[bj]) clusters_.join(bi, bj);
    if (!meets) {
        blockers_.push_back(flying_[bi] ? bi : bj);
        return;
    }
    pairs_.push_back(pair);
}

#define RIGOR_INSTANTIATE(S)                                                           \
    template void FlightImpacts<S>::findFlying(const MovedWorld<S>&);                  \
    template void FlightImpacts<S>::makeWays(const MovedWorld<S>&);                    \
    template void FlightImpacts<S>::findPairs(const MovedWorld<S>&);                   \
    template bool FlightImpacts<S>::mayTouch(const MovedWorld<S>&, const Pair&) const; \
    template void FlightImpacts<S>::addPair(const MovedWorld<S>&, std::uint32_t, std::uint32_t);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
