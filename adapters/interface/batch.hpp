// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Optional interface of an engine that steps many worlds of one scenario side by side: a DynamicsEngine that is a
// BatchingEngine (found by dynamic_cast). Other engines step their worlds one after the other (LoopedWorlds).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "adapters/interface/engine.hpp"

namespace rigor::adapter {

class BatchWorlds {
  public:
    virtual ~BatchWorlds() = default;
    virtual std::size_t size() const = 0;
    /// Advances every world by so many steps.
    virtual void step(int steps) = 0;
    /// Time of the last step() by the engine's own clock [s] (StepCounters::stepSeconds); < 0: there is none.
    virtual double ownSeconds() const { return -1.0; }
    /// States of a world's bodies, as World::readStates.
    virtual void readStates(std::size_t world, std::span<BodyState> states) const = 0;
};

class BatchingEngine : public DynamicsEngine {
  public:
    /// Worlds as build() makes them, `worlds` >= 1, on so many threads. Throws as build() does.
    virtual std::unique_ptr<BatchWorlds> buildBatch(const Scenario& scenario, double dt,
                                                    const Settings& settings, std::size_t worlds,
                                                    int threads) const = 0;
};

/// Worlds of any engine, stepped by the calling thread: each makes all its steps before the next one begins.
class LoopedWorlds final : public BatchWorlds {
  public:
    explicit LoopedWorlds(std::vector<std::unique_ptr<World>> worlds) : worlds_(std::move(worlds)) {}
    std::size_t size() const override { return worlds_.size(); }
    void step(int steps) override {
        seconds_ = 0.0;
        for (const auto& world : worlds_)
            for (int k = 0; k < steps; ++k) {
                world->step();
                if (hasClock_) addSeconds(world->counters().stepSeconds);
            }
    }
    double ownSeconds() const override { return hasClock_ ? seconds_ : -1.0; }
    void readStates(std::size_t world, std::span<BodyState> states) const override {
        worlds_[world]->readStates(states);
    }

  private:
    /// The first step without a time shows that the engine has no clock; its counters are not queried again.
    void addSeconds(double own) {
        hasClock_ = own >= 0.0;
        seconds_ += own;
    }

    std::vector<std::unique_ptr<World>> worlds_;
    bool hasClock_ = true;
    double seconds_ = 0.0;  ///< time of the last step() [s]
};

}  // namespace rigor::adapter
