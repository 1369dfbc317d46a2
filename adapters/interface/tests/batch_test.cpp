// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Worlds that are stepped one after the other, and the time that their engine says they took.
#include "adapters/interface/batch.hpp"

#include <gtest/gtest.h>

namespace rigor::adapter {
namespace {

/// World whose engine has a clock of its own, or none.
class TimedWorld : public World {
  public:
    explicit TimedWorld(double seconds) : seconds_(seconds) {}
    void applyForce(int, const Vec3&, const Vec3&) override {}
    void step() override { state_.position.x += 1; }
    void readStates(std::span<BodyState> states) const override { states[0] = state_; }
    void readContacts(std::vector<ContactPoint>& contacts) const override { contacts.clear(); }
    ReadBack readBack() const override { return {}; }
    std::vector<LedgerEntry> ledger() const override { return {}; }
    Scheme scheme() const override { return Scheme::Unknown; }
    StepCounters counters() const override {
        StepCounters counters;
        counters.stepSeconds = seconds_;
        return counters;
    }

  private:
    double seconds_;
    BodyState state_;
};

LoopedWorlds worlds(std::vector<double> seconds) {
    std::vector<std::unique_ptr<World>> all;
    for (const double s : seconds) all.push_back(std::make_unique<TimedWorld>(s));
    return LoopedWorlds(std::move(all));
}

TEST(LoopedWorlds, AddUpTheTimesOfTheEnginesOwnClock) {
    LoopedWorlds both = worlds({0.25, 0.5});
    both.step(4);
    EXPECT_EQ(both.ownSeconds(), 3.0);
    both.step(1);
    EXPECT_EQ(both.ownSeconds(), 0.75) << "of the last call alone";
    std::vector<BodyState> states(1);
    both.readStates(1, states);
    EXPECT_EQ(states[0].position.x, 5);
}

TEST(LoopedWorlds, HaveNoTimeOfAnEngineWithoutAClock) {
    LoopedWorlds none = worlds({-1, -1});
    none.step(3);
    EXPECT_LT(none.ownSeconds(), 0);
}

}  // namespace
}  // namespace rigor::adapter
