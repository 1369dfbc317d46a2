// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Fast bodies collide at their time of impact (time_of_impact.cpp: conservative advancement), and the rest of
// the step goes on from there.
//
// Policy, for each (sub-)step of h, after the bodies have moved from X_0 to X_1:
//  1. Each body's way is taken as x(t) = x_0 + t v, q(t) = exp(t w) q_0, v and w such that it ends in X_1.
//  2. Shapes that may pass each other unseen on it (moving_shape.hpp: they move relative to each other by
//     more than half of their thickness) and whose swept boxes overlap get their time of impact.
//  3. The earliest impact happens: both bodies go to where they are then. Their velocities lose the share
//     (1 - t/h) of what forces (not torques) have added over the step; they exchange impulses at the points
//     of their manifold (impact.cpp: Newton's restitution, the world's friction law); they get the forces of
//     the rest of the step back; and what would then push them together again is taken out without
//     restitution (a body that gravity holds on the surface). With the new velocities they go on for h - t.
//  4. The impacts of both bodies on their new ways are looked for, and so on from 3. Other bodies keep
//     their ways. After kMaxImpacts in a step a body stays where it is until the step ends: it keeps its
//     velocity and loses the time.
// Chains, meshes and height fields are met piece by piece (surface_impact.cpp).
// Only bodies that take part (BodyConstants::continuous) can be fast; they collide with all others. A callback
// (contacts/pre_solve.hpp) is called for each impact; one that it refuses is none for the rest of the (sub-)step.
// A pair that touches already when the search begins, or has contact rows in this step, is left to the
// solver: its impact counts only if the shapes would otherwise end up deeper in each other than a quarter of
// their thickness. Bodies that are slow for their size are left to the contacts alone, so scenes without fast
// bodies have the same bits as without this choice.
//
// [Mirtich1996] section 2.3 has steps 1 and 2 for a simulation that stops all bodies at every impact; here
// the others are not stopped, as usual in engines of fixed steps: a contact or joint of a body that collides
// is not solved in between, it corrects what the impact has done to it in the next step.
//
// Cost: O(bodies) when none is fast; else O(fast shapes times shapes) box tests, one time of impact for each
// pair that passes, and for each impact those of two bodies again. Limits: bodies in joints and stacks get
// the blow one step later than the one that was hit; the way between X_0 and X_1 is straight, also where the
// integrator's is not (error a h^2 / 8); pairs of boxes are tested in O(fast n) instead of by the broad
// phase.
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/ccd/continuous_collision.hpp"
#include "engine/ccd/impact.hpp"
#include "engine/ccd/surface_impact.hpp"
#include "engine/ccd/traits.hpp"
#include "engine/contacts/time_of_impact.hpp"
#include "engine/state/sleep.hpp"

namespace rigor::engine {
namespace {

// maximum number of impacts of one body in one (sub-)step: a sphere rattling between two walls
constexpr int kMaxImpacts = 32;

template <class S>
class ConservativeAdvancement final : public ContinuousCollision<S> {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    using Ang = typename S::Ang;

    std::unique_ptr<ContinuousCollision<S>> clone() const override {
        return std::make_unique<ConservativeAdvancement>(*this);
    }

    void remember(const BodyArrays<S>& bodies) override {
        ways_.resize(bodies.size());
        for (std::size_t i = 0; i < bodies.size(); ++i)
            ways_[i] = {bodies.pose[i], {}, 0, 0, false, bodies.pose[i].p, zeroAng<S>()};
        kick_.resize(bodies.size());
        for (std::size_t i = 0; i < bodies.size(); ++i) kick_[i] = bodies.velocity[i].v;
    }
    void rememberKick(const BodyArrays<S>& bodies) override {
        for (std::size_t i = 0; i < bodies.size(); ++i) kick_[i] = bodies.velocity[i].v - kick_[i];
    }

    bool resolve(const MovedWorld<S>& world, std::vector<ImpactEvent<S>>& events) override {
        takeWays(world);
        vetoed_.clear();
        if (!anyFast(world)) return true;
        findCandidates(world);
        bool inTime = true;
        while (!candidates_.empty()) {
            const auto first = std::min_element(candidates_.begin(), candidates_.end(), earlier);
            const Candidate hit = *first;
            inTime = collide(world, hit, events) && inTime;
            const std::uint32_t a = bodyOf(world, hit.a), b = bodyOf(world, hit.b);
            std::erase_if(candidates_, [&](const Candidate& c) {
                const std::uint32_t ca = bodyOf(world, c.a), cb = bodyOf(world, c.b);
                return (ways_[a].changed && (ca == a || cb == a)) ||
                       (ways_[b].changed && (ca == b || cb == b)) || (c.a == hit.a && c.b == hit.b);
            });
            for (const std::uint32_t body : {a, b})
                if (ways_[body].changed) searchFrom(world, body, hit.impact.time, body == a ? b : a);
        }
        endWays(world);
        return inTime;
    }

  private:
    /// The way of a body from `begin` to the end of the step.
    struct Way {
        Pose<S> start;
        Velocity<S> velocity;
        Real begin = 0;  ///< [s]
        int impacts = 0;
        bool changed = false;       ///< true if an impact has changed it
        Vec origin = Vec::Zero();   ///< position at the start of the (sub-)step
        Ang turned = zeroAng<S>();  ///< rotation vectors of the ways before this one, added up
    };
    struct Candidate {
        std::uint32_t a = 0, b = 0;  ///< shapes; the body of a has the lower index
        TimeOfImpact<S> impact;      ///< times since the (sub-)step began
    };
    static bool earlier(const Candidate& c, const Candidate& d) {
        if (c.impact.time != d.impact.time) return c.impact.time < d.impact.time;
        return c.a != d.a ? c.a < d.a : c.b < d.b;
    }
    static std::uint32_t bodyOf(const MovedWorld<S>& world, std::uint32_t shape) {
        return world.contacts.shapes()[shape].body;
    }

    /// ways_ hold the starts; now the velocities that lead from there to where the bodies are.
    void takeWays(const MovedWorld<S>& world) {
        const auto used = world.motion.used();
        for (std::size_t i = 0; i < ways_.size(); ++i) {
            Way& way = ways_[i];
            way.velocity = {};
            if (world.bodies.constants[i].type == BodyType::Static) continue;
            way.velocity = straightVelocity<S>(way.start, world.bodies.pose[i], used[i], world.h);
        }
    }

    MovingShape<S> moving(const MovedWorld<S>& world, std::uint32_t shape, Real from) const {
        const ShapeRecord<S>& record = world.contacts.shapes()[shape];
        const Way& way = ways_[record.body];
        return movingShape<S>(record, movedPose<S>(way.start, way.velocity, from - way.begin), way.velocity);
    }

    static bool isContinuous(const MovedWorld<S>& world, std::uint32_t shape) {
        return world.bodies.constants[bodyOf(world, shape)].continuous;
    }

    /// True if the shape is fast. If two shapes may pass through each other within a step, at least one of
    /// them moves by more than half of its own thickness.
    bool isFast(const MovedWorld<S>& world, std::uint32_t shape) const {
        if (!isContinuous(world, shape)) return false;
        const MovingShape<S> m = moving(world, shape, 0);
        return m.motion(world.h) > Real(0.5) * m.inscribedRadius;
    }
    bool anyFast(const MovedWorld<S>& world) {
        fast_.clear();
        const auto count = static_cast<std::uint32_t>(world.contacts.shapes().size());
        for (std::uint32_t i = 0; i < count; ++i)
            if (isFast(world, i)) fast_.push_back(i);
        return !fast_.empty();
    }

    void findCandidates(const MovedWorld<S>& world) {
        candidates_.clear();
        const auto count = static_cast<std::uint32_t>(world.contacts.shapes().size());
        boxes_.resize(count);
        for (std::uint32_t i = 0; i < count; ++i) boxes_[i] = sweptBox<S>(moving(world, i, 0), world.h);
        std::size_t next = 0;
        for (std::uint32_t i : fast_) {
            ++next;
            for (std::uint32_t j = 0; j < count; ++j) {
                if (j == i || !boxes_[i].overlaps(boxes_[j])) continue;
                // Two fast ones collide in the turn of the first.
                if (j < i &&
                    std::binary_search(fast_.begin(), fast_.begin() + static_cast<std::ptrdiff_t>(next), j))
                    continue;
                addCandidate(world, i, j, 0);
            }
        }
    }

    void searchFrom(const MovedWorld<S>& world, std::uint32_t body, Real time, std::uint32_t other) {
        const ShapeSet<S>& shapes = world.contacts.shapes();
        const auto count = static_cast<std::uint32_t>(shapes.size());
        const Real rest = world.h - time;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (shapes[i].body != body) continue;
            boxes_[i] = sweptBox<S>(moving(world, i, time), rest);
            for (std::uint32_t j = 0; j < count; ++j) {
                // The pair of the impact itself is searched from its higher body.
                if (shapes[j].body == other && ways_[other].changed && body < other) continue;
                if (j != i && boxes_[i].overlaps(boxes_[j])) addCandidate(world, i, j, time);
            }
        }
    }

    void addCandidate(const MovedWorld<S>& world, std::uint32_t i, std::uint32_t j, Real time) {
        const ShapeSet<S>& shapes = world.contacts.shapes();
        if (!isContinuous(world, i) && !isContinuous(world, j)) return;
        if (!world.contacts.filter().mayCollide(world.bodies, shapes[i], shapes[j])) return;
        if (std::find(vetoed_.begin(), vetoed_.end(), pairKey(i, j)) != vetoed_.end()) return;
        const std::uint32_t bi = shapes[i].body, bj = shapes[j].body;
        // Bodies that impulses do not move meet a paused body in that body's half of the step.
        for (const auto& [paused, other] : {std::pair(bi, bj), std::pair(bj, bi)})
            if (world.isPaused(paused) && world.bodies.invMass[other] == 0) return;
        Candidate c{bi < bj ? i : j, bi < bj ? j : i, {}};
        const MovingShape<S> a = moving(world, c.a, time), b = moving(world, c.b, time);
        const Real rest = world.h - time;
        if (!mayPassUnseen<S>(a, b, rest)) return;
        const bool known = hasRows<S>(world.contacts.list(), c.a, c.b);
        c.impact = SurfaceImpact<S>::isOne(a, b) ? surfaceImpact_.find(a, b, rest, known, world.narrowPhase)
                                                 : timeOfImpact<S>(a, b, rest, known);
        if (!c.impact.hit) return;
        c.impact.time += time;
        c.impact.exact += time;
        candidates_.push_back(c);
    }

    /// False: a body has had its maximum number of impacts and loses the rest of its motion.
    bool collide(const MovedWorld<S>& world, const Candidate& hit, std::vector<ImpactEvent<S>>& events) {
        BodyArrays<S>& bodies = world.bodies;
        const ShapeSet<S>& shapes = world.contacts.shapes();
        const std::uint32_t a = shapes[hit.a].body, b = shapes[hit.b].body;
        const Real t = hit.impact.time, rest = world.h - t;
        Manifold<S> manifold;
        TimeOfImpact<S> now = hit.impact;
        now.time = 0;
        const MovingShape<S> shapeA = moving(world, hit.a, t), shapeB = moving(world, hit.b, t);
        if (SurfaceImpact<S>::isOne(shapeA, shapeB))
            surfaceImpact_.collideAt(shapeA, shapeB, now, world.narrowPhase, manifold);
        else
            collideAt<S>(shapeA, shapeB, now, world.narrowPhase, manifold);
        const auto law =
            world.contacts.lawOfImpact(bodies, hit.a, hit.b, manifold, shapeA.body.p, shapeB.body.p);
        if (!law) {
            vetoed_.push_back(pairKey(hit.a, hit.b));
            return true;
        }
        // The rest of its island follows when the next step finds it moving.
        for (const std::uint32_t i : {a, b}) {
            if (world.isPaused(i))
                bodies.invMass[i] = Real(1) / bodies.constants[i].mass;
            else
                wakeBody(bodies, i);
        }
        for (const std::uint32_t i : {a, b}) goTo(world, i, t);
        impactSolver_.begin(bodies, shapes[hit.a], shapes[hit.b], manifold, *law);
        const Real impulse = impactSolver_.solve(bodies, world.friction, world.restitutionThreshold, true);
        Vec friction = impactSolver_.frictionImpulse();
        for (const std::uint32_t i : {a, b})
            if (moves(world, i)) bodies.velocity[i].v += (rest / world.h) * kick_[i];
        const Real held = impactSolver_.solve(bodies, world.friction, Real(0), false);
        friction += impactSolver_.frictionImpulse();
        for (const std::uint32_t i : {a, b})
            if (world.isPaused(i)) bodies.invMass[i] = 0;
        const bool first = goOn(world, a, t), second = goOn(world, b, t), inTime = first && second;
        if (impulse + held > 0)
            events.push_back({bodies.id[a], bodies.id[b], shapes[hit.a].id, shapes[hit.b].id,
                              world.begin + hit.impact.exact,
                              Vec(Real(0.5) * (hit.impact.closest.pointA + hit.impact.closest.pointB)),
                              manifold.normal, impulse + held, friction});
        return inTime;
    }

    /// True if the body has a way that an impact changes.
    bool moves(const MovedWorld<S>& world, std::uint32_t i) const {
        return world.bodies.invMass[i] > 0 && !world.isPaused(i);
    }

    /// The body at time t of its way, with the velocity that it has then.
    void goTo(const MovedWorld<S>& world, std::uint32_t i, Real t) {
        BodyArrays<S>& bodies = world.bodies;
        if (!moves(world, i)) return;
        Way& way = ways_[i];
        way.turned += (t - way.begin) * way.velocity.w;
        way.start = movedPose<S>(way.start, way.velocity, t - way.begin);
        way.begin = t;
        bodies.pose[i] = way.start;
        world.motion.interrupt(bodies, i);
        bodies.invInertia[i] = worldInertia<S>(way.start.q, bodies.invInertiaLocal[i]);
        bodies.velocity[i].v -= (1 - t / world.h) * kick_[i];
    }

    bool goOn(const MovedWorld<S>& world, std::uint32_t i, Real t) {
        BodyArrays<S>& bodies = world.bodies;
        if (!moves(world, i)) return true;
        Way& way = ways_[i];
        way.changed = true;
        world.motion.resume(bodies, i, world.h - t);
        way.velocity = bodies.velocity[i];
        if (++way.impacts < kMaxImpacts) return true;
        way.velocity = {};
        return false;
    }

    void endWays(const MovedWorld<S>& world) {
        for (std::uint32_t i = 0; i < ways_.size(); ++i) {
            const Way& way = ways_[i];
            if (!way.changed) continue;
            Pose<S>& X = world.bodies.pose[i];
            const Real rest = world.h - way.begin;
            X = movedPose<S>(way.start, way.velocity, rest);
            world.motion.replaceUsed(
                i, {Vec((X.p - way.origin) / world.h), Ang((way.turned + rest * way.velocity.w) / world.h)});
        }
    }

    std::vector<Way> ways_;            ///< motion of each body by dense body index
    std::vector<Vec> kick_;            ///< velocities before the kick, then what forces added to them
    std::vector<std::uint32_t> fast_;  ///< shapes, sorted
    std::vector<Aabb<S>> boxes_;       ///< swept, by shape
    std::vector<Candidate> candidates_;
    std::vector<std::uint64_t> vetoed_;  ///< pairs of shapes whose impact the callback has refused
    ImpactSolver<S> impactSolver_;
    SurfaceImpact<S> surfaceImpact_;
};

}  // namespace

ContinuousCollisionTraits makeConservativeAdvancementTraits() {
    return {};
}

template <class S>
std::unique_ptr<ContinuousCollision<S>> makeConservativeAdvancement() {
    return std::make_unique<ConservativeAdvancement<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeConservativeAdvancement, ContinuousCollision);

}  // namespace rigor::engine
