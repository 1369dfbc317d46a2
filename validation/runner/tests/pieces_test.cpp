// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pieces of worlds whose errors are known by hand.
#include "validation/runner/pieces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adapters/interface/state_setting.hpp"
#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

/// One ball under gravity by symplectic Euler, off by `lag` [m] more in every step; it can be put elsewhere.
class Falling final : public adapter::World, public adapter::StateSetting {
  public:
    Falling(const scenario::Scenario& s, double dt, double lag) : s_(s), dt_(dt), lag_(lag) {
        for (const auto& b : s.bodies)
            states_.push_back({b.pose.position, b.pose.orientation, b.velocity, b.angularVelocity});
    }
    void applyForce(int, const adapter::Vec3&, const adapter::Vec3&) override {}
    void step() override {
        BodyState& ball = states_.at(1);
        ball.velocity += dt_ * s_.gravity;
        ball.position += dt_ * ball.velocity + scenario::Vec3{lag_, 0, 0};
    }
    void readStates(std::span<BodyState> states) const override {
        std::copy(states_.begin(), states_.end(), states.begin());
    }
    void readContacts(std::vector<ContactPoint>& contacts) const override { contacts.clear(); }
    adapter::ReadBack readBack() const override { return {}; }
    std::vector<adapter::LedgerEntry> ledger() const override { return {}; }
    adapter::Scheme scheme() const override { return adapter::Scheme::SymplecticEuler; }
    void setStates(std::span<const BodyState> states) override { states_[1] = states[1]; }
    const char* warmStart() const override { return "discarded"; }

  private:
    scenario::Scenario s_;
    double dt_, lag_;
    std::vector<BodyState> states_;
};

/// The same, rooted to its run.
class Rooted final : public adapter::World {
  public:
    explicit Rooted(Falling world) : world_(std::move(world)) {}
    void applyForce(int, const adapter::Vec3&, const adapter::Vec3&) override {}
    void step() override { world_.step(); }
    void readStates(std::span<BodyState> states) const override { world_.readStates(states); }
    void readContacts(std::vector<ContactPoint>& contacts) const override { contacts.clear(); }
    adapter::ReadBack readBack() const override { return {}; }
    std::vector<adapter::LedgerEntry> ledger() const override { return {}; }
    adapter::Scheme scheme() const override { return adapter::Scheme::SymplecticEuler; }

  private:
    Falling world_;
};

constexpr double kDt = 1.0 / 128.0;

const results::MetricRow& row(const std::vector<results::MetricRow>& rows, const std::string& name,
                              const std::string& subject) {
    for (const auto& r : rows)
        if (r.name == name && r.subject == subject) return r;
    throw std::runtime_error("no row " + name + " " + subject);
}

/// Symplectic Euler is off by g h t / 2 after t, from wherever it starts: k steps miss the parabola by g h^2
/// k / 2.
TEST(Pieces, ErrorsOfFreeFlightAreThoseOfThePieceAlone) {
    const auto loaded = fixtures::load(fixtures::thrownBall("ball"));
    const scenario::Scenario& s = loaded.first;
    const auto reference = makeReference(s);
    const double g = norm(s.gravity);
    for (const double lag : {0.0, 1e-3}) {
        const auto rows = measurePieces(
            s, kDt, {1, 4, 20}, [&](double dt) { return std::make_unique<Falling>(s, dt, lag); },
            reference.get());
        ASSERT_EQ(rows.size(), 12u);
        for (const int k : {1, 4, 20}) {
            const std::string subject = "every " + std::to_string(k) + (k == 1 ? " step" : " steps");
            const scenario::Vec3 miss = 0.5 * kDt * kDt * k * s.gravity + scenario::Vec3{lag * k, 0.0, 0.0};
            EXPECT_NEAR(row(rows, "piece_error", subject).value, norm(miss), 1e-12) << k;
            EXPECT_NEAR(row(rows, "piece_error_worst", subject).value, norm(miss), 1e-12) << k;
            EXPECT_EQ(row(rows, "piece_turn", subject).value, 0.0);
            EXPECT_EQ(row(rows, "piece_error", subject).unit, "m");
        }
        EXPECT_EQ(row(rows, "piece_error", "every 20 steps").note,
                  "3 pieces, put back on the reference free_flight; warm start discarded");
    }
    EXPECT_GT(g, 3.0);
}

/// The truth without a reference is a run with sixteen steps for one, whose own error is a sixteenth.
TEST(Pieces, WithoutAReferenceTheTruthIsAFinerRun) {
    const auto loaded = fixtures::load(fixtures::thrownBall("ball"));
    const scenario::Scenario& s = loaded.first;
    const auto rows = measurePieces(
        s, kDt, {4}, [&](double dt) { return std::make_unique<Falling>(s, dt, 0.0); }, nullptr);
    const double whole = 0.5 * norm(s.gravity) * kDt * kDt * 4.0;
    EXPECT_NEAR(row(rows, "piece_error", "every 4 steps").value, whole * 15.0 / 16.0, 1e-12);
    EXPECT_NE(row(rows, "piece_error", "every 4 steps").note.find("a run of its own at dt/16"),
              std::string::npos);
}

TEST(Pieces, WhatCannotBeMeasuredSaysWhy) {
    const auto loaded = fixtures::load(fixtures::thrownBall("ball"));
    const scenario::Scenario& s = loaded.first;
    const auto rooted = measurePieces(
        s, kDt, {4}, [&](double dt) { return std::make_unique<Rooted>(Falling(s, dt, 0.0)); }, nullptr);
    EXPECT_TRUE(std::isnan(row(rooted, "piece_error", "every 4 steps").value));
    EXPECT_EQ(row(rooted, "piece_error", "every 4 steps").note, "the adapter cannot put bodies back yet");
    const auto longer = measurePieces(
        s, kDt, {1000}, [&](double dt) { return std::make_unique<Falling>(s, dt, 0.0); }, nullptr);
    EXPECT_EQ(row(longer, "piece_error", "every 1000 steps").note, "the run is shorter than a piece");
}

}  // namespace
}  // namespace rigor::validation
