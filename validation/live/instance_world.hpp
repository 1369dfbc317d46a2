// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One engine on one scenario under control of a user: forwards by steps or stages, backwards, with a body
// dragged along. In this process; instance.hpp puts it into one of its own.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adapters/interface/prepared_engine.hpp"
#include "validation/live/scene_now.hpp"
#include "validation/runner/stepper.hpp"

namespace rigor::validation {

/// A spring with a damper from a point of a dynamic body to a point of the world, as a pointer holds it.
struct Drag {
    int body = 0;
    scenario::Vec3 point;    ///< point in the body frame [m]
    scenario::Vec3 target;   ///< target in the world frame [m]
    double stiffness = 0.0;  ///< [N/m]; <= 0: such that it swings at 2 Hz. Less where a step is too long
    friend bool operator==(const Drag&, const Drag&) = default;
};

class InstanceWorld {
  public:
    /// Builds the world. Throws adapter::Unsupported, adapter::BadInput, and what a library throws.
    InstanceWorld(scenario::Scenario scenario, adapter::EngineSpec spec, double dt);

    const scenario::Scenario& scenario() const { return scenario_; }
    const adapter::Settings& settings() const { return engine_.settings; }
    adapter::World& world() { return *world_; }
    double dt() const { return dt_; }
    std::size_t steps() const { return stepper_->steps(); }
    std::span<const adapter::BodyState> states() { return stepper_->states(); }
    /// States at which the last whole step began: its contacts belong to their poses. Empty before any step.
    std::span<const adapter::BodyState> statesBefore() const { return before_; }
    /// A sentence once a state is not finite: the instance goes no further, only back.
    const std::string& nonFinite() const { return nonFinite_; }

    /// Goes on for `steps` steps, or less: until `seconds` of wall time are over, at least one. A step that
    /// has begun in stages is ended first and counts.
    void advance(std::size_t steps, double seconds);
    /// Runs one stage; begins a step where none has begun. False: the engine has no stages.
    bool stage();
    bool inStep() const;
    /// Impulses of the rows before the first iteration of the solver in this step of stages; empty before it.
    const std::vector<double>& startImpulses() const { return startImpulses_; }
    const std::string& lastStage() const { return lastStage_; }  ///< run by stage() in this step; "" none
    /// Goes to the state after `steps` steps from the start and repeats the drags in between.
    void goTo(std::size_t steps);

    /// Snapshots that goTo() begins at.
    struct History {
        std::size_t bytes, every;  ///< all of them; one in so many steps
    };
    static constexpr std::size_t kMostKeptBytes = std::size_t{64} << 20;
    /// Empty where the engine takes none.
    std::optional<History> history() const;

    /// Sets the drag that acts from the next step on; empty: none. Throws adapter::BadInput.
    void drag(const std::optional<Drag>& drag);
    const std::optional<Drag>& drag() const { return drag_; }
    /// Point of the body that the spring acts on [m] and its force [N]; empty without a spring.
    struct Pull {
        scenario::Vec3 point, force;
    };
    std::optional<Pull> pull();

    SceneNow now();

  private:
    struct StoredSnapshot {
        std::vector<unsigned char> bytes;
        std::vector<double> coordinates;
        std::vector<adapter::BodyState> before;
        std::size_t size() const { return bytes.size() + before.size() * sizeof(adapter::BodyState); }
    };

    void build();
    void beginStep();
    void endStep();
    void watch(bool on);
    void keep();
    bool restore(std::size_t steps);

    scenario::Scenario scenario_;
    adapter::EngineSpec spec_;
    double dt_;
    adapter::PreparedEngine engine_;
    std::unique_ptr<adapter::World> world_;
    std::optional<Stepper> stepper_;
    std::vector<adapter::BodyState> before_;  ///< states at which the last whole step began
    std::vector<adapter::BodyState> start_;   ///< states at which the step under way began
    JointCoordinates coordinates_;
    std::string nonFinite_, lastStage_;
    bool watched_ = false;  ///< the iterations of the solver
    std::vector<double> startImpulses_;

    std::optional<Drag> drag_;
    std::map<std::size_t, std::optional<Drag>> drags_;  ///< drags by the step from which they act
    std::map<std::size_t, StoredSnapshot> snapshots_;   ///< snapshots by steps taken
    std::size_t keptBytes_ = 0, keepEvery_ = 1;
};

}  // namespace rigor::validation
