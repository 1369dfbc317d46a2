// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Impacts of bodies in flight at their own times within a step, for integrators of second order: a step that
// takes an impact at its end, or wherever contacts are found, is off by h |v|, whatever its order elsewhere.
//
// A body is in flight in a step if nothing acts on it but gravity and a constant force: no joint, no
// spring, no contact slower than an impact when the step began (without restitution, of twice what forces
// add in a step). Its way is then known,
//     p(t) = p_0 + t v_0 + t^2/2 a,   q(t) = exp(t W) q_0    (W the mean angular velocity of free rotation)
// Bodies in flight whose ways come near each other form a cluster: those that are no further apart when the
// step begins than they move relative to each other in it. Where the way of no body of a cluster
// meets anything, and the step has stopped none at a gap, the step stands as it is. Otherwise the cluster
// is stepped from impact to impact: both bodies go to where they touch, get the impulses of the impact
// there (impact.hpp), and go on for what is left of the step. A body that does not bounce stays in contact
// until the end of the step: with v_h = v + rest a, and impulses that hold the contact and oppose sliding
// by the law of friction, it moves by rest (v + v_h) / 2. If it turns about what it touches until another part of it is
// kSinks of the shapes' thickness below the surface, both parts collide there, and so on.
//
// A body in flight that comes near nothing else, and whose inertia is not that of a sphere, goes its own way
// from the start to the end of the step, if that has no sub-steps: the rotation schemes conserve along it what
// they conserve, which the mean of two midpoints does to second order only.
//
// A cluster is left to the step as it is, without impacts at their own times, where
//   - one of its bodies comes near a body that is not in flight, or a chain, mesh or height field, or has pushed a dynamic
//     one that is not in flight at a gap that only the next step would close: what it has lost the other has got,
//   - shapes overlap already when the step begins, or approach each other more slowly than that,
//   - there are more than kMaxImpacts impacts: chattering, which ends in contact,
//   - a body meets a second one while it is in contact,
//   - bodies still overlap at the end of the step.
//
// Cost: a broad phase of all shapes' ways in steps with bodies in flight; the closest points of the
// pairs that come near each other, about twice each; and what an impact takes.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/broadphase/broad_phase.hpp"
#include "engine/ccd/continuous_collision.hpp"
#include "engine/ccd/impact.hpp"
#include "engine/core/clone_ptr.hpp"
#include "engine/core/disjoint_sets.hpp"
#include "engine/narrowphase/distance.hpp"

namespace rigor::engine {

/// Distance that counts as touching: rounding of the coordinates, and what the closest points of curved
/// shapes are exact to [m].
template <class S>
typename S::Real touchingDistance(const Pose<S>& A, const Pose<S>& B, const ClosestPoints<S>& closest);

/// The smaller of two shapes' inscribed radii, at most 1 m.
template <class S>
typename S::Real thicknessOf(const ShapeRecord<S>& a, const ShapeRecord<S>& b);

template <class S>
class FlightImpacts {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    using Ang = typename S::Ang;

    FlightImpacts();

    /// The step begins where the bodies are; contacts are found `half` [s] later. Forces act on those with
    /// bound[i] != 0, or joints hold them.
    void begin(const BodyArrays<S>& bodies, std::span<const std::uint8_t> bound, Real half);
    // --- around the forces of each sub-step
    void beforeKick(const BodyArrays<S>& bodies);
    void afterKick(const BodyArrays<S>& bodies);
    /// Called when the bodies are where the step of world.h has taken them. Changes poses and velocities of
    /// bodies that have collided; appends their impacts. Returns how many clusters with impacts were left
    /// to the step. `bounces` false: no body does.
    int resolve(const MovedWorld<S>& world, bool bounces, std::vector<ImpactEvent<S>>& events);

    /// True if the last resolve() has changed where body i is: the contacts of the step are not those that
    /// have acted on it.
    bool hasCollided(std::size_t i) const { return collided_[i] != 0; }
    bool anyHasCollided() const {
        return std::find(collided_.begin(), collided_.end(), 1) != collided_.end();
    }

  private:
    static constexpr int kMaxImpacts = 16;  ///< largest number of impacts of one cluster in one step
    static constexpr int kMaxSunk = 3;      ///< largest number of touches of a pair by Touch::sinks
    /// Depth at which parts of bodies in contact collide, of the smaller inscribed radius; as much more each time.
    static constexpr double kSinks = 0.005;

    /// Motion of a body from `begin` to the end of the step.
    struct Way {
        Pose<S> start;
        Velocity<S> velocity;  ///< at the start
        Vec acceleration = Vec::Zero();
        Ang turning = zeroAng<S>();  ///< mean angular velocity
        Real begin = 0;              ///< [s]
        Vec pull = Vec::Zero();      ///< acceleration by forces
        bool held = false;           ///< in contact until the end of the step
        Velocity<S> end;             ///< velocity at the end of the step, if held
        Real heldImpulse =
            0;  ///< normal impulse of that contact [N s]; 0 in the way of the second of two bodies
        Vec heldFriction = Vec::Zero();  ///< impulse of its friction on the second body [N s]
        std::size_t event = 0;           ///< index of the impact that reports them
        Pose<S> at(Real t) const {
            const Real s = t - begin;
            return {start.p + s * velocity.v + (Real(0.5) * s * s) * acceleration,
                    rotatedBy(start.q, Ang(s * turning))};
        }
        Vec linearAt(Real t) const { return velocity.v + (t - begin) * acceleration; }
    };
    struct Touch {
        bool hit = false, overlapped = false;
        bool sinks = false;  ///< a part of two bodies in contact sinks in
        Real time = 0;
        ClosestPoints<S> closest;
    };
    struct Pair {
        std::uint32_t a = 0, b = 0;  ///< shapes; the body of a has the lower index
        std::uint32_t cluster = 0;   ///< a body in flight
        int sunk = 0;                ///< number of touches by Touch::sinks
        Touch touch;
    };

    Real slowestImpact(const MovedWorld<S>& world, Real restitution, std::uint32_t a, std::uint32_t b) const;
    Real normalSpeed(const Contact<S>& contact, int point) const;
    bool approaches(const MovedWorld<S>& world, const Contact<S>& contact) const;
    void findFlying(const MovedWorld<S>& world);
    void makeWays(const MovedWorld<S>& world);
    Aabb<S> boxOf(const MovedWorld<S>& world, std::uint32_t shape, Aabb<S> box) const;
    void findPairs(const MovedWorld<S>& world);
    bool mayTouch(const MovedWorld<S>& world, const Pair& pair) const;
    void joinPushed(const MovedWorld<S>& world);
    void addPair(const MovedWorld<S>& world, std::uint32_t i, std::uint32_t j);
    Touch firstTouch(const MovedWorld<S>& world, const Pair& pair, Real from) const;
    static Real sinkingDepth(const Pair& pair) {
        return static_cast<Real>(kSinks) * static_cast<Real>(1 + pair.sunk);
    }
    Touch nextSinking(const MovedWorld<S>& world, const Pair& pair, Real from) const;
    bool comesNear(const MovedWorld<S>& world, const Pair& pair, Real from) const;
    Real turningAlong(const MovedWorld<S>& world, const Pair& pair, const Vec& n) const;
    Real fastestAlong(const MovedWorld<S>& world, const Pair& pair, const Vec& n, Real t) const;
    Real closingSpeed(const Pair& pair, const MovedWorld<S>& world, const ClosestPoints<S>& closest,
                      Real t) const;
    ClosestPoints<S> look(const MovedWorld<S>& world, const Pair& pair, Real t) const;

    bool runCluster(const MovedWorld<S>& world, std::uint32_t cluster, std::vector<ImpactEvent<S>>& events);
    bool sinksIn(const MovedWorld<S>& world) const;
    bool collide(const MovedWorld<S>& world, const Pair& pair, std::vector<ImpactEvent<S>>& events);
    bool searchFrom(const MovedWorld<S>& world, std::uint32_t body, std::uint32_t cluster);
    bool searchAgain(const MovedWorld<S>& world, const Pair& hit, std::uint32_t cluster);
    void goTo(const MovedWorld<S>& world, std::uint32_t body, Real t);
    void tumble(const MovedWorld<S>& world);
    void release(const MovedWorld<S>& world, std::uint32_t body, Real t, std::vector<ImpactEvent<S>>& events);
    Real hold(const MovedWorld<S>& world, std::uint32_t a, std::uint32_t b, Real t);

    // --- by dense body index
    std::vector<Pose<S>> startPose_;
    std::vector<Velocity<S>> startVelocity_;
    std::vector<std::uint8_t> bound_;  ///< joints or forces act on it, or it is asleep
    std::vector<std::uint8_t> flying_, collided_;
    std::vector<std::uint8_t> stopped_;     ///< the step has changed its velocity by a contact
    std::vector<Vec> beforeKick_, gained_;  ///< velocity added by forces [m/s]
    std::vector<Way> ways_;
    DisjointSets clusters_;              ///< clusters of bodies in flight, by body
    std::vector<std::uint8_t> blocked_;  ///< 1 for a root: its cluster is left to the step
    // --- by dense shape index
    std::vector<Aabb<S>> boxes_, startBoxes_;  ///< boxes of the ways (boxOf), and of the starts alone
    std::vector<std::uint8_t> movable_;        ///< 1 for shapes of bodies in flight
    std::vector<ProxyPair> found_;
    ClonePtr<BroadPhase<S>> broadPhase_;
    std::vector<Pair> pairs_, clusterPairs_;
    std::vector<std::uint32_t>
        blockers_;  ///< bodies in flight that come near what they cannot meet in flight
    std::vector<std::uint32_t> hitClusters_, members_;
    std::vector<std::pair<Pose<S>, Velocity<S>>> saved_;
    Vec drift_ = Vec::Zero();  ///< mean way of the bodies in flight without forces [m]
    Real half_ = 0;            ///< time at which contacts were found [s]
    bool bounces_ = true;
    ImpactSolver<S> impactSolver_;
    Manifold<S> manifold_;
};

}  // namespace rigor::engine
