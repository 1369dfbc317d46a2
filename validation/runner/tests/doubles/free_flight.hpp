// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A small, honest engine for tests of the harness: symplectic Euler without contacts, whose every number has
// a closed form. The faulty engines beside it are this one with one fault each.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <limits>
#include <memory>

#include "adapters/interface/engine.hpp"

namespace rigor::doubles {

using namespace rigor::adapter;

class FreeFlightWorld : public World {
  public:
    FreeFlightWorld(const Scenario& scenario, double dt, const Settings& settings)
        : scenario_(scenario),
          dt_(dt),
          pause_(integerSetting(settings, "pause_us")),
          allocations_(integerSetting(settings, "allocations")),
          asleep_(integerSetting(settings, "asleep")),
          states_(scenario.bodies.size()),
          forces_(scenario.bodies.size()) {
        for (std::size_t i = 0; i < states_.size(); ++i) {
            const auto& b = scenario.bodies[i];
            states_[i] = {b.pose.position, b.pose.orientation, b.velocity, b.angularVelocity};
        }
    }

    void applyForce(int body, const Vec3& force, const Vec3&) override { forces_[body] += force; }

    void step() override {
        ++steps_;
        if (pause_ > 0) usleep(pause_);
        for (int i = 0; i < allocations_; ++i) {
            void* volatile memory = std::malloc(64);
            std::free(memory);
        }
        for (std::size_t i = 0; i < states_.size(); ++i) {
            const auto& b = scenario_.bodies[i];
            if (b.type != scenario::BodyType::Dynamic) continue;
            states_[i].velocity +=
                dt_ * (b.gravityScale * scenario_.gravity + forces_[i] / b.massProperties.mass);
            states_[i].position += dt_ * states_[i].velocity;
            forces_[i] = {};
        }
        misbehave();
    }

    void readStates(std::span<BodyState> states) const override {
        for (std::size_t i = 0; i < states.size(); ++i) states[i] = states_[i];
    }
    void readContacts(std::vector<ContactPoint>& contacts) const override { contacts.clear(); }
    bool isAsleep(int body) const override { return body < asleep_; }

    ReadBack readBack() const override {
        ReadBack back;
        for (std::size_t i = 0; i < states_.size(); ++i) {
            const auto& b = scenario_.bodies[i];
            const auto& m = b.massProperties;
            back.bodies.push_back(
                {m.mass, m.centerOfMass, m.inertia, states_[i], b.gravityScale * scenario_.gravity});
        }
        return back;
    }
    std::vector<LedgerEntry> ledger() const override { return {}; }
    Scheme scheme() const override { return Scheme::SymplecticEuler; }

  protected:
    /// Fault of an engine at the end of each step.
    virtual void misbehave() {}
    bool isDue() const { return steps_ == 5; }

    Scenario scenario_;
    double dt_;
    useconds_t pause_;
    int allocations_, asleep_;
    std::vector<BodyState> states_;
    std::vector<Vec3> forces_;
    int steps_ = 0;
};

template <class WorldType>
class DoubleDynamics : public DynamicsEngine {
  public:
    std::unique_ptr<World> build(const Scenario& scenario, double dt,
                                 const Settings& settings) const override {
        return std::make_unique<WorldType>(scenario, dt, settings);
    }
};

/// Every shape and joint is accepted, so that only the fault under test decides.
inline Capabilities doubleCapabilities() {
    Capabilities c;
    c.dimensions = {2, 3};
    c.shapes = {"sphere", "circle",  "box",        "capsule",    "cylinder", "cone",
                "hull",   "polygon", "half_space", "half_plane", "segment"};
    c.joints = {"ball", "hinge", "slider", "fixed", "distance"};
    c.kinematicBodies = c.damping = c.gravityScale = c.centerOfMassOffset = true;
    return c;
}

inline EngineInfo doubleInfo() {
    return {"double", "1", "f64", "Test double", ""};
}

inline std::vector<Option> doubleOptions() {
    return {{"pause_us", {}, 0.0, 1e6, true, "0", "0", "microseconds of sleep in each step"},
            {"allocations", {}, 0.0, 1e6, true, "0", "0", "calls of malloc in each step, of 64 bytes"},
            {"asleep", {}, 0.0, 1e6, true, "0", "0", "bodies that are said to sleep"}};
}

template <class WorldType>
class DoubleEngine : public Engine {
  public:
    EngineInfo info() const override { return doubleInfo(); }
    Capabilities capabilities() const override {
        Capabilities c = doubleCapabilities();
        c.dynamics = true;
        return c;
    }
    std::vector<Option> options() const override { return doubleOptions(); }
    const DynamicsEngine* dynamics() const override { return &dynamics_; }

  private:
    DoubleDynamics<WorldType> dynamics_;
};

template <class WorldType>
std::unique_ptr<Engine> makeDouble() {
    return std::make_unique<DoubleEngine<WorldType>>();
}

}  // namespace rigor::doubles
