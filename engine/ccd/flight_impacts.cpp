// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/ccd/flight_impacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/contacts/row_lag.hpp"
#include "engine/state/sleep.hpp"

namespace rigor::engine {
namespace {

/// Largest overlap at the end of a step in which bodies have collided, of the smaller inscribed radius.
constexpr double kDeepest = 0.02;

void keepOnce(std::vector<std::uint32_t>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// True if the step has stopped bodies at a gap that they were closing, or let them bounce where they close it.
template <class S>
bool stopsAtGap(const Contact<S>& contact) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i)
        if (contact.impulses[i].normal > 0 &&
            (contact.bounceTime > 0 || contact.manifold.points[i].separation > 0))
            return true;
    return false;
}

/// The angular velocity of free rotation changes.
template <class S>
bool tumbles(const typename S::Inertia& inertia) {
    if constexpr (S::dim == 2) {
        return false;
    } else {
        const typename S::Inertia rest =
            inertia - inertia.trace() / typename S::Real(3) * S::Inertia::Identity();
        return rest.cwiseAbs().maxCoeff() >
               typename S::Real(8) * std::numeric_limits<typename S::Real>::epsilon() * inertia.trace();
    }
}

}  // namespace

template <class S>
FlightImpacts<S>::FlightImpacts()
    : broadPhase_(findAlgorithm(broadPhaseTable<S>(), "broad_phase", "wide_tree").make()) {}

template <class S>
void FlightImpacts<S>::begin(const BodyArrays<S>& bodies, std::span<const std::uint8_t> bound, Real half) {
    half_ = half;
    const std::size_t n = bodies.size();
    startPose_.assign(bodies.pose.begin(), bodies.pose.end());
    startVelocity_.assign(bodies.velocity.begin(), bodies.velocity.end());
    bound_.assign(bound.begin(), bound.end());
    gained_.assign(n, Vec::Zero());
    for (std::size_t i = 0; i < n; ++i) {
        const Ang& torque = bodies.wrench[i].torque;
        if (bodies.asleep[i] || bodies.constants[i].angularVelocityKept != Real(1) ||
            dotAng(torque, torque) > Real(0))
            bound_[i] = 1;
    }
}

template <class S>
void FlightImpacts<S>::beforeKick(const BodyArrays<S>& bodies) {
    beforeKick_.resize(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) beforeKick_[i] = bodies.velocity[i].v;
}

template <class S>
void FlightImpacts<S>::afterKick(const BodyArrays<S>& bodies) {
    for (std::size_t i = 0; i < bodies.size(); ++i) gained_[i] += bodies.velocity[i].v - beforeKick_[i];
}

template <class S>
int FlightImpacts<S>::resolve(const MovedWorld<S>& world, bool bounces, std::vector<ImpactEvent<S>>& events) {
    bounces_ = bounces;
    collided_.assign(world.bodies.size(), 0);
    findFlying(world);
    if (std::find(flying_.begin(), flying_.end(), 1) == flying_.end()) return 0;
    makeWays(world);
    findPairs(world);
    hitClusters_.clear();
    for (Pair& pair : pairs_) {
        const bool fliesA = flying_[world.contacts.shapes()[pair.a].body] != 0;
        pair.cluster = clusters_.rootOf(world.contacts.shapes()[fliesA ? pair.a : pair.b].body);
        pair.touch = firstTouch(world, pair, 0);
        if (pair.touch.overlapped)
            blocked_[pair.cluster] = 1;
        else if (pair.touch.hit)
            hitClusters_.push_back(pair.cluster);
    }
    keepOnce(hitClusters_);
    auto left =
        static_cast<int>(std::count_if(hitClusters_.begin(), hitClusters_.end(),
                                       [&](std::uint32_t cluster) { return blocked_[cluster] != 0; }));
    // The step has stopped some at gaps that they close only in the next one.
    for (const Contact<S>& contact : world.contacts.list())
        for (const std::uint32_t body : {contact.bodyA, contact.bodyB})
            if (flying_[body] && stopsAtGap(contact) && approaches(world, contact))
                hitClusters_.push_back(clusters_.rootOf(body));
    keepOnce(hitClusters_);
    tumble(world);
    const std::size_t before = events.size();
    for (const std::uint32_t cluster : hitClusters_)
        if (!blocked_[cluster]) left += !runCluster(world, cluster, events);
    std::stable_sort(events.begin() + static_cast<std::ptrdiff_t>(before), events.end(),
                     [](const ImpactEvent<S>& e, const ImpactEvent<S>& f) { return e.time < f.time; });
    return left;
}

template <class S>
void FlightImpacts<S>::tumble(const MovedWorld<S>& world) {
    const bool inSubsteps = Real(4) * half_ < Real(1.5) * world.h;
    if (inSubsteps) return;  // shorter ways are nearer
    stopped_.assign(world.bodies.size(), 0);
    for (const Contact<S>& contact : world.contacts.list())
        for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i)
            if (contact.totals[i].normal > 0) stopped_[contact.bodyA] = stopped_[contact.bodyB] = 1;
    for (std::uint32_t i = 0; i < world.bodies.size(); ++i) {
        if (!flying_[i] || stopped_[i] || !tumbles<S>(world.bodies.constants[i].inertia)) continue;
        if (blocked_[clusters_.rootOf(i)]) continue;
        goTo(world, i, world.h);
        world.bodies.leaveMidpoint(i);
    }
}

/// Slower approaches are those of contacts: without restitution, of up to twice what forces add in a step.
template <class S>
typename S::Real FlightImpacts<S>::slowestImpact(const MovedWorld<S>& world, Real restitution,
                                                 std::uint32_t a, std::uint32_t b) const {
    if (restitution > 0) return world.restitutionThreshold;
    return std::max(world.restitutionThreshold, Real(2) * (gained_[b] - gained_[a]).norm());
}

/// Normal velocity of a point of a contact when the step began; < 0: approaching.
template <class S>
typename S::Real FlightImpacts<S>::normalSpeed(const Contact<S>& contact, int point) const {
    const ManifoldPoint<S>& where = contact.manifold.points[static_cast<std::size_t>(point)];
    const std::uint32_t a = contact.bodyA, b = contact.bodyB;
    const Velocity<S>&A = startVelocity_[a], &B = startVelocity_[b];
    const Vec rA = where.pointA - startPose_[a].p - half_ * A.v,
              rB = where.pointB - startPose_[b].p - half_ * B.v;
    const Vec& n = contact.manifold.normal;
    return n.dot(relativeVelocity<S>({rA, rB, n}, A, B));
}

template <class S>
bool FlightImpacts<S>::approaches(const MovedWorld<S>& world, const Contact<S>& contact) const {
    const Real slowest = slowestImpact(world, contact.coefficients.restitution, contact.bodyA, contact.bodyB);
    for (int i = 0; i < contact.manifold.count; ++i)
        if (normalSpeed(contact, i) < -slowest) return true;
    return false;
}

/// False: the cluster is left to the step.
template <class S>
bool FlightImpacts<S>::runCluster(const MovedWorld<S>& world, std::uint32_t cluster,
                                  std::vector<ImpactEvent<S>>& events) {
    BodyArrays<S>& bodies = world.bodies;
    const std::size_t eventsBefore = events.size();
    members_.clear();
    for (std::uint32_t i = 0; i < bodies.size(); ++i)
        if (flying_[i] && clusters_.rootOf(i) == cluster) members_.push_back(i);
    saved_.clear();
    for (const std::uint32_t i : members_) saved_.emplace_back(bodies.pose[i], bodies.velocity[i]);
    clusterPairs_.clear();
    for (const Pair& pair : pairs_)
        if (pair.cluster == cluster) clusterPairs_.push_back(pair);
    bool ok = true;
    for (int impacts = 0; ok; ++impacts) {
        const Pair* first = nullptr;
        for (const Pair& pair : clusterPairs_)
            if (pair.touch.hit && (first == nullptr || pair.touch.time < first->touch.time)) first = &pair;
        if (first == nullptr) break;
        const Pair hit = *first;
        const std::uint32_t a = world.contacts.shapes()[hit.a].body, b = world.contacts.shapes()[hit.b].body;
        ok = impacts < kMaxImpacts && (hit.touch.sinks || (!ways_[a].held && !ways_[b].held)) &&
             collide(world, hit, events) && searchAgain(world, hit, cluster);
    }
    if (!ok || sinksIn(world)) {
        for (std::size_t k = 0; k < members_.size(); ++k) {
            bodies.pose[members_[k]] = saved_[k].first;
            bodies.velocity[members_[k]] = saved_[k].second;
        }
        events.resize(eventsBefore);
        return false;
    }
    for (const std::uint32_t i : members_) {
        goTo(world, i, world.h);
        if (ways_[i].held) bodies.velocity[i] = ways_[i].end;
        bodies.leaveMidpoint(i);
        collided_[i] = 1;
    }
    return true;
}

/// True if bodies of the cluster overlap at the end of the step.
template <class S>
bool FlightImpacts<S>::sinksIn(const MovedWorld<S>& world) const {
    const ShapeSet<S>& shapes = world.contacts.shapes();
    return std::any_of(clusterPairs_.begin(), clusterPairs_.end(), [&](const Pair& pair) {
        return look(world, pair, world.h).distance <
               -static_cast<Real>(kDeepest) * thicknessOf<S>(shapes[pair.a], shapes[pair.b]);
    });
}

/// The touches to come after a hit. False: the cluster is left to the step.
template <class S>
bool FlightImpacts<S>::searchAgain(const MovedWorld<S>& world, const Pair& hit, std::uint32_t cluster) {
    const ShapeSet<S>& shapes = world.contacts.shapes();
    const std::uint32_t a = shapes[hit.a].body, b = shapes[hit.b].body;
    const auto isNew = [&](std::uint32_t body) { return flying_[body] && (body == a || body == b); };
    for (const std::uint32_t body : {a, b})
        if (flying_[body] && !searchFrom(world, body, cluster)) return false;
    for (Pair& pair : clusterPairs_) {
        if (!isNew(shapes[pair.a].body) && !isNew(shapes[pair.b].body)) continue;
        pair.touch = {};
        const bool same = pair.a == hit.a && pair.b == hit.b;
        pair.sunk += same && hit.touch.sinks;
        if (same && (ways_[a].held || ways_[b].held)) {
            if (pair.sunk < kMaxSunk) pair.touch = nextSinking(world, pair, hit.touch.time);
            continue;
        }
        pair.touch = firstTouch(world, pair, hit.touch.time);
        if (pair.touch.overlapped) return false;
    }
    return true;
}

/// The body at time t of its way, with the velocity that it has then.
template <class S>
void FlightImpacts<S>::goTo(const MovedWorld<S>& world, std::uint32_t i, Real t) {
    BodyArrays<S>& bodies = world.bodies;
    const Way& way = ways_[i];
    bodies.pose[i] = way.at(t);
    bodies.velocity[i] = {way.linearAt(t),
                          world.motion.rotatedVelocity(bodies.constants[i], way.start.q, bodies.pose[i].q,
                                                       way.velocity.w, way.turning)};
    bodies.invInertia[i] = worldInertia<S>(bodies.pose[i].q, bodies.invInertiaLocal[i]);
}

/// False: the cluster is to be left to the step.
template <class S>
bool FlightImpacts<S>::collide(const MovedWorld<S>& world, const Pair& pair,
                               std::vector<ImpactEvent<S>>& events) {
    BodyArrays<S>& bodies = world.bodies;
    const ShapeRecord<S>&sa = world.contacts.shapes()[pair.a], &sb = world.contacts.shapes()[pair.b];
    const std::uint32_t a = sa.body, b = sb.body;
    const Real t = pair.touch.time;
    for (const std::uint32_t i : {a, b})
        if (flying_[i] && ways_[i].held) release(world, i, t, events);
    const Pose<S> A = ways_[a].at(t), B = ways_[b].at(t);
    const Real within = pair.touch.sinks ? sinkingDepth(pair) : Real(1e-6);
    const Real near =
        std::max(within * thicknessOf<S>(sa, sb), Real(4) * touchingDistance<S>(A, B, pair.touch.closest));
    manifold_ = {};
    world.narrowPhase.collide(sa.shape, compose<S>(A, sa.local), sb.shape, compose<S>(B, sb.local), near,
                              manifold_);
    if (manifold_.count == 0) setToClosest<S>(pair.touch.closest, manifold_);
    const auto law = world.contacts.lawOfImpact(bodies, pair.a, pair.b, manifold_, A.p, B.p);
    if (!law) return false;
    const Pose<S> endA = bodies.pose[a], endB = bodies.pose[b];
    bodies.pose[a] = A;
    bodies.pose[b] = B;
    for (const std::uint32_t i : {a, b})
        if (flying_[i]) goTo(world, i, t);
    impactSolver_.begin(bodies, sa, sb, manifold_, *law);
    const Real impulse = impactSolver_.solve(bodies, world.friction, world.restitutionThreshold, bounces_);
    Vec friction = impactSolver_.frictionImpulse();
    for (const std::uint32_t i : {a, b}) {
        if (!flying_[i]) continue;
        Way& way = ways_[i];
        way.start = bodies.pose[i];
        way.velocity = bodies.velocity[i];
        way.begin = t;
        way.turning =
            world.motion.freeRotation(bodies.constants[i], way.start.q, way.velocity.w, world.h - t);
    }
    // Contact goes on where no point parts and forces press; where another part sinks in, at those that do not.
    const Vec& n = manifold_.normal;
    Real fastest = 0, slowest = std::numeric_limits<Real>::max();
    for (int i = 0; i < manifold_.count; ++i) {
        const ManifoldPoint<S>& where = manifold_.points[static_cast<std::size_t>(i)];
        const Velocity<S>&vA = bodies.velocity[a], &vB = bodies.velocity[b];
        const Real parts =
            n.dot(vB.v + cross(vB.w, Vec(where.pointB - B.p)) - vA.v - cross(vA.w, Vec(where.pointA - A.p)));
        fastest = std::max(fastest, parts);
        slowest = std::min(slowest, parts);
    }
    const bool presses = n.dot(ways_[a].acceleration - ways_[b].acceleration) > 0;
    Real held = 0;
    if ((pair.touch.sinks ? slowest : fastest) <= world.restitutionThreshold && presses) {
        held = hold(world, a, b, t);
        friction += impactSolver_.frictionImpulse();
        Way& reports = ways_[flying_[a] ? a : b];
        reports.heldImpulse = held;
        reports.heldFriction = impactSolver_.frictionImpulse();
        reports.event = events.size();
    }
    if (!flying_[a]) bodies.pose[a] = endA;
    if (!flying_[b]) bodies.pose[b] = endB;
    if (impulse + held > 0)
        events.push_back({bodies.id[a], bodies.id[b], sa.id, sb.id, world.begin + t,
                          Vec(Real(0.5) * (pair.touch.closest.pointA + pair.touch.closest.pointB)), n,
                          impulse + held, friction});
    return true;
}

/// Ends a contact at t, with the velocity that the body has then: it has given that part of its impulses.
template <class S>
void FlightImpacts<S>::release(const MovedWorld<S>& world, std::uint32_t i, Real t,
                               std::vector<ImpactEvent<S>>& events) {
    Way& way = ways_[i];
    const Real share = (t - way.begin) / (world.h - way.begin);
    const Vec first = Real(2) * way.velocity.v - way.end.v;
    if (way.heldImpulse > 0) {
        events[way.event].impulse -= (Real(1) - share) * way.heldImpulse;
        events[way.event].friction -= (Real(1) - share) * way.heldFriction;
    }
    way.heldImpulse = 0;
    way.start = way.at(t);
    way.velocity = {Vec(first + share * (way.end.v - first)),
                    Ang(way.velocity.w + share * (way.end.w - way.velocity.w))};
    way.begin = t;
    way.acceleration = way.pull;
    way.held = false;
    way.turning =
        world.motion.freeRotation(world.bodies.constants[i], way.start.q, way.velocity.w, world.h - t);
}

/// Contact from t to the end of the step, by the impulses that hold it at the end. Returns the normal one.
template <class S>
typename S::Real FlightImpacts<S>::hold(const MovedWorld<S>& world, std::uint32_t a, std::uint32_t b,
                                        Real t) {
    BodyArrays<S>& bodies = world.bodies;
    const Real rest = world.h - t;
    for (const std::uint32_t i : {a, b})
        if (flying_[i]) bodies.velocity[i].v += rest * ways_[i].acceleration;
    const Real impulse = impactSolver_.solve(bodies, world.friction, Real(0), false);
    for (const std::uint32_t i : {a, b}) {
        if (!flying_[i]) continue;
        Way& way = ways_[i];
        way.held = true;
        way.end = bodies.velocity[i];
        way.velocity = {Vec(Real(0.5) * (way.velocity.v + way.end.v)), way.velocity.w};
        way.turning = Real(0.5) * (way.velocity.w + way.end.w);
        way.acceleration.setZero();
    }
    return impulse;
}

/// Pairs of a body that has a new way. False: it comes near a body that is not of the cluster.
template <class S>
bool FlightImpacts<S>::searchFrom(const MovedWorld<S>& world, std::uint32_t body, std::uint32_t cluster) {
    const ShapeSet<S>& shapes = world.contacts.shapes();
    const auto count = static_cast<std::uint32_t>(shapes.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        if (shapes[i].body != body) continue;
        boxes_[i] =
            boxOf(world, i, boundingBox<S>(shapes[i].shape, compose<S>(ways_[body].start, shapes[i].local)));
        for (std::uint32_t j = 0; j < count; ++j) {
            const std::uint32_t other = shapes[j].body;
            if (other == body || !boxes_[i].overlaps(boxes_[j])) continue;
            if (!world.contacts.filter().mayCollide(world.bodies, shapes[i], shapes[j])) continue;
            Pair pair;
            pair.a = body < other ? i : j;
            pair.b = body < other ? j : i;
            pair.cluster = cluster;
            const bool known = std::any_of(clusterPairs_.begin(), clusterPairs_.end(),
                                           [&](const Pair& p) { return p.a == pair.a && p.b == pair.b; });
            if (known) continue;
            const bool fixed = world.bodies.constants[other].type != BodyType::Dynamic;
            const bool member = flying_[other] && clusters_.rootOf(other) == cluster;
            const bool surface = isComposite<S>(shapes[j].shape) || isComposite<S>(shapes[i].shape);
            if (!surface && !comesNear(world, pair, ways_[body].begin)) continue;
            if ((!fixed && !member) || surface) return false;
            clusterPairs_.push_back(pair);
        }
    }
    return true;
}

#define RIGOR_INSTANTIATE(S)                                                                             \
    template FlightImpacts<S>::FlightImpacts();                                                          \
    template void FlightImpacts<S>::begin(const BodyArrays<S>&, std::span<const std::uint8_t>, Real);    \
    template void FlightImpacts<S>::beforeKick(const BodyArrays<S>&);                                    \
    template void FlightImpacts<S>::afterKick(const BodyArrays<S>&);                                     \
    template void FlightImpacts<S>::tumble(const MovedWorld<S>&);                                        \
    template int FlightImpacts<S>::resolve(const MovedWorld<S>&, bool, std::vector<ImpactEvent<S>>&);    \
    template typename S::Real FlightImpacts<S>::slowestImpact(const MovedWorld<S>&, Real, std::uint32_t, \
                                                              std::uint32_t) const;
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
