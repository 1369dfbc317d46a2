// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Many worlds of one scene, stepped side by side on threads: for sweeps of parameters, fits and learning.
//
//     WorldBatch<Space3d> batch(world, 1000, {.threads = 8});          // a thousand copies
//     batch.forEach([&](std::size_t i, World<Space3d>& w) { w.setVelocity(ball, start[i], {0, 0, 0}); });
//     batch.step(1.0 / 60, 120);
//     batch.readStates(states);                                        // worlds x bodies x 13 numbers
//
// Each world is stepped by one thread at a time and shares nothing with the others, so that it has the bits that it
// has alone, for any number of threads. Worlds that have threads of their own (WorldDef::threads) wait for more
// cores than there are: leave them at 1.
//
// A world that throws is out until reset(): it is not stepped, and failures() has its index and the exception. The
// others go on.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/tasks.hpp"
#include "engine/embedding/body_numbers.hpp"

namespace rigor::engine {

struct BatchSettings {
    int threads = 1;  ///< 1 .. 1024
};

/// Numbers of a wrench: force [N], torque [N m].
template <class S>
inline constexpr std::size_t kBodyWrench = S::dim == 2 ? 3 : 6;

struct BatchFailure {
    std::size_t world = 0;
    std::exception_ptr error;
};

template <class S>
class WorldBatch {
  public:
    using Real = typename S::Real;
    /// Makes the world of an index, the same one at each call for reset() to lead back; called by one thread.
    using Builder = std::function<World<S>(std::size_t world)>;
    /// Something to do with one world, from any thread.
    using WorldWork = std::function<void(std::size_t world, World<S>&)>;

    /// Copies of a world. Throws EngineError "batch_size" for no world, "threads" for a number out of range.
    WorldBatch(const World<S>& world, std::size_t count, const BatchSettings& settings = {});
    /// Worlds that may differ in all but their number of bodies. Throws what `build` throws, and EngineError
    /// "batch_bodies" where the numbers differ.
    WorldBatch(std::size_t count, Builder build, const BatchSettings& settings = {});

    std::size_t size() const { return worlds_.size(); }
    std::size_t bodies() const { return bodies_; }  ///< bodies of each world
    World<S>& world(std::size_t i) { return worlds_[i]; }
    const World<S>& world(std::size_t i) const { return worlds_[i]; }

    /// Advances every world by `steps` steps of h [s]. Returns false where a world has failed, now or before.
    bool step(Real h, int steps = 1);
    /// Calls `before` for a world before each of its steps.
    bool step(Real h, int steps, const WorldWork& before);
    /// Calls `work` for every world that has not failed.
    bool forEach(const WorldWork& work);

    /// Worlds that have thrown since they were made or reset, by index.
    std::span<const BatchFailure> failures() const { return failures_; }
    /// Leads worlds back to the one that was copied, or builds them again. Throws EngineError "batch_world" for an
    /// index out of range.
    void reset(std::span<const std::size_t> worlds);
    void reset(std::size_t world) { reset(std::span(&world, 1)); }

    // --- arrays over worlds. Throw EngineError "batch_array" for arrays of another length, and "batch_bodies" where
    // a world has lost or gained bodies since it was made.
    /// Number of numbers of all states: worlds x bodies x kBodyState, bodies in the order of World::bodies().
    std::size_t stateSize() const { return size() * bodies_ * kBodyState<S>; }
    /// States of failed worlds are those where they stopped.
    void readStates(std::span<Real> states) const;
    /// Puts bodies into these states (World::setPose and setVelocity). A body whose numbers are those that readStates()
    /// gives now is left as it is, to the bit, with its contacts. A state that a world refuses is a failure of
    /// this world. Returns as step() does.
    bool writeStates(std::span<const Real> states);
    /// Forces and torques that act at the centres of mass during the next step, worlds x bodies x kBodyWrench.
    bool applyWrenches(std::span<const Real> wrenches);
    /// One number for each world: rest value of a joint's spring, or speed of its motor. The worlds have the joint
    /// by the same handle, as copies have.
    bool setJointTargets(JointId joint, int axis, std::span<const Real> targets);
    bool setJointMotors(JointId joint, int axis, std::span<const Real> speeds, Real maxForce);

    /// Snapshot of each world; restored ones go on to the same bits (World::saveSnapshot).
    void saveSnapshots(std::vector<std::vector<unsigned char>>& snapshots) const;
    bool restoreSnapshots(std::span<const std::vector<unsigned char>> snapshots);

  private:
    /// Worlds that a thread reads the states of at once.
    static constexpr std::size_t kWorldGrain = 16;

    void begin();
    void requireSize(std::size_t numbers, std::size_t perWorld) const;
    template <class Work>
    bool forEachAlive(const Work& work);

    Tasks tasks_;
    std::vector<World<S>> worlds_;
    std::shared_ptr<const World<S>> start_;  ///< null where `build_` makes the worlds
    Builder build_;
    std::size_t bodies_ = 0;
    std::vector<std::exception_ptr>
        errors_;  ///< failures by world, each written by the thread that works on it
    std::vector<BatchFailure> failures_;
};

}  // namespace rigor::engine
