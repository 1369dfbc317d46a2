// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The faces of an engine (dynamics, collision, broad phase, contact problems) and the module that
// carries them.
//
// An adapter is a shared library `rigor_adapter_<name>.so` (another precision of the same engine:
// `rigor_adapter_<name>.f32.so`) that exports RIGOR_ADAPTER_MODULE. The process that needs an engine loads
// it.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "adapters/interface/contact_problem.hpp"
#include "adapters/interface/staged.hpp"
#include "adapters/interface/types.hpp"

namespace rigor::adapter {

/// One scenario inside one engine at one fixed time step.
class World {
  public:
    virtual ~World() = default;

    /// Adds a force [N] and torque [N m], world frame, at the centre of mass of a dynamic body, acting during
    /// the next step only. Calls accumulate.
    virtual void applyForce(int body, const Vec3& force, const Vec3& torque) = 0;

    /// True if the world evaluates the scenario's force elements itself, so that no caller applies them: only
    /// an engine that evaluates forces more than once in a step needs to.
    virtual bool evaluatesForces() const { return false; }

    /// Changes linear [N s] and angular [N m s] momentum of a dynamic body at once. False: the engine leaves
    /// that to a force during the next step.
    virtual bool applyImpulse(int body, const Vec3& impulse, const Vec3& angularImpulse) {
        (void)body;
        (void)impulse;
        (void)angularImpulse;
        return false;
    }

    /// Advances by exactly one fixed step.
    virtual void step() = 0;

    /// States of all bodies by scenario index; `states.size()` is the number of bodies.
    virtual void readStates(std::span<BodyState> states) const = 0;

    /// Contacts that the last step acted upon, placed at the poses of contactInstant(): points lie on the surfaces as
    /// they stood then, whatever the step has done with the bodies since. Replaces `contacts`.
    virtual void readContacts(std::vector<ContactPoint>& contacts) const = 0;
    /// The same after every step of a world.
    virtual ContactInstant contactInstant() const { return ContactInstant::StepStart; }

    virtual ReadBack readBack() const = 0;

    /// Resolved settings and everything that could not be matched.
    virtual std::vector<LedgerEntry> ledger() const = 0;

    virtual StepCounters counters() const { return {}; }
    virtual Scheme scheme() const = 0;

    /// True while a joint holds, false once it has broken.
    virtual bool jointHolds(int joint) const {
        (void)joint;
        return true;
    }

    /// True if the engine has put a body to sleep: stopped it and leaves it out of its steps.
    virtual bool isAsleep(int body) const {
        (void)body;
        return false;
    }

    /// Null for engines whose steps can not be looked into, and whose state can not be taken back.
    virtual StagedWorld* staged() { return nullptr; }
    virtual Snapshots* snapshots() { return nullptr; }
};

class DynamicsEngine {
  public:
    virtual ~DynamicsEngine() = default;

    /// Builds the scenario's world. `settings` is complete (see resolveSettings). The scenario has passed
    /// checkScenarioInput. Throws Unsupported with the missing capability, BadInput for what may not reach
    /// the library.
    virtual std::unique_ptr<World> build(const Scenario& scenario, double dt,
                                         const Settings& settings) const = 0;
};

class CollisionEngine {
  public:
    virtual ~CollisionEngine() = default;

    /// Narrow phases to choose from by CollisionQuery::algorithm, the values of the option "narrow_phase";
    /// empty for an engine without a choice.
    virtual std::vector<std::string> algorithms() const { return {}; }

    /// Throws Unsupported for shape pairs the engine does not have, BadInput for an unknown algorithm.
    virtual CollisionAnswer collide(const CollisionQuery& query) const = 0;
};

/// A set of boxes kept by one engine's broad phase.
class BroadPhase {
  public:
    virtual ~BroadPhase() = default;

    /// All overlapping pairs of exactly these boxes, each once, sorted; called repeatedly with moved boxes of
    /// the same count.
    virtual void update(std::span<const Aabb> boxes, std::vector<Pair>& pairs) = 0;
};

class BroadPhaseEngine {
  public:
    virtual ~BroadPhaseEngine() = default;
    virtual std::vector<std::string> algorithms() const = 0;
    virtual std::unique_ptr<BroadPhase> create(const std::string& algorithm, int dimension) const = 0;
};

/// A loaded engine.
class Engine {
  public:
    virtual ~Engine() = default;
    virtual EngineInfo info() const = 0;
    virtual Capabilities capabilities() const = 0;
    virtual std::vector<Option> options()
        const = 0;  ///< keys without "preset"; "precision" only where one module has several
    virtual const DynamicsEngine* dynamics() const { return nullptr; }
    virtual const CollisionEngine* collision() const { return nullptr; }
    virtual const BroadPhaseEngine* broadPhase() const { return nullptr; }
    virtual const ContactSolverEngine* contactSolvers() const { return nullptr; }
};

/// Raised with every change of this folder's headers or of scenarios/model that an adapter could notice.
inline constexpr int kAdapterAbi = 8;

struct Module {
    int abi = 0;
    std::unique_ptr<Engine> (*create)() = nullptr;
};

}  // namespace rigor::adapter

/// The one entry point of an adapter; `factory` is a function returning std::unique_ptr<Engine>.
#define RIGOR_ADAPTER_MODULE(factory)                                                                \
    extern "C" __attribute__((visibility("default"))) const rigor::adapter::Module* rigorAdapter() { \
        static const rigor::adapter::Module module{rigor::adapter::kAdapterAbi, factory};            \
        return &module;                                                                              \
    }
