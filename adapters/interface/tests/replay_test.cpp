// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/replay.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace rigor::adapter {
namespace {

/// One particle whose future hangs on a number without getter or setter: a push acts on what all earlier
/// steps have left there.
class SecretWorld : public World, public StateSetting {
  public:
    void applyForce(int, const Vec3& force, const Vec3&) override { force_ = force_ + force; }
    bool applyImpulse(int, const Vec3& impulse, const Vec3&) override {
        state_.velocity = state_.velocity + impulse;
        return true;
    }
    void step() override {
        secret_ = 0.3 * secret_ + norm(force_) + norm(state_.velocity);
        state_.velocity = state_.velocity + 0.01 * force_ + Vec3{0.001 * secret_, 0, 0};
        state_.position = state_.position + 0.01 * state_.velocity;
        force_ = {};
    }
    void setStates(std::span<const BodyState> states) override { state_ = states[0]; }
    const char* warmStart() const override { return "kept"; }
    void readStates(std::span<BodyState> states) const override { states[0] = state_; }
    void readContacts(std::vector<ContactPoint>& contacts) const override { contacts.clear(); }
    ReadBack readBack() const override { return {}; }
    std::vector<LedgerEntry> ledger() const override { return {}; }
    Scheme scheme() const override { return Scheme::SymplecticEuler; }

  private:
    BodyState state_;
    Vec3 force_;
    double secret_ = 1.0;
};

std::unique_ptr<ReplayWorld> world() {
    return std::make_unique<ReplayWorld>([] { return std::make_unique<SecretWorld>(); });
}
void steps(ReplayWorld& w, int n) {
    for (int i = 0; i < n; ++i) w.step();
}
BodyState stateOf(const ReplayWorld& w) {
    std::vector<BodyState> states(1);
    w.readStates(states);
    return states[0];
}
Vec3 after(ReplayWorld& w, int n) {
    steps(w, n);
    return stateOf(w).position;
}
std::vector<unsigned char> saved(ReplayWorld& w) {
    std::vector<unsigned char> bytes;
    w.snapshots()->save(bytes);
    return bytes;
}

TEST(Replay, EveryKindOfEntryComesBack) {
    const auto w = world();
    ASSERT_NE(w->snapshots(), nullptr);
    steps(*w, 3);
    w->applyForce(0, {1, 2, 3}, {});
    steps(*w, 2);
    EXPECT_TRUE(w->applyImpulse(0, {0, 1, 0}, {}));
    steps(*w, 1);
    BodyState elsewhere = stateOf(*w);
    elsewhere.position.z = 5.0;
    w->setStates({&elsewhere, 1});
    steps(*w, 4);
    w->applyForce(0, {0, 0, 2}, {});  // the world has not stepped yet
    const auto bytes = saved(*w);
    const Vec3 future = after(*w, 10);
    ASSERT_TRUE(w->snapshots()->restore(bytes));
    EXPECT_EQ(saved(*w), bytes);
    EXPECT_EQ(after(*w, 10), future);

    const auto twin = world();
    ASSERT_TRUE(twin->snapshots()->restore(bytes));
    EXPECT_EQ(after(*twin, 10), future);
    EXPECT_EQ(saved(*twin), saved(*w));
}

TEST(Replay, StepsThatEndALogAreCountedOn) {
    const auto w = world();
    steps(*w, 5);
    const auto bytes = saved(*w);
    ASSERT_TRUE(w->snapshots()->restore(bytes));
    steps(*w, 7);
    EXPECT_EQ(saved(*w).size(), bytes.size()) << "one entry for all steps";
    const auto longer = saved(*w);
    const Vec3 future = after(*w, 10);
    const auto twin = world();
    ASSERT_TRUE(twin->snapshots()->restore(longer));
    EXPECT_EQ(after(*twin, 10), future);
}

TEST(Replay, WithoutALogOfThePastThereIsNone) {
    const auto requested = world(), late = world(), never = world();
    EXPECT_NE(requested->snapshots(), nullptr);
    for (ReplayWorld* w : {requested.get(), late.get()}) w->applyForce(0, {1, 0, 0}, {});
    EXPECT_NE(requested->snapshots(), nullptr);
    EXPECT_EQ(late->snapshots(), nullptr) << "the force is not in the log";
    steps(*never, 100);
    EXPECT_NE(never->snapshots(), nullptr) << "steps are always counted";
}

TEST(Replay, DamagedBytesLeaveTheWorldAsItIs) {
    const auto w = world();
    ASSERT_NE(w->snapshots(), nullptr);
    w->applyForce(0, {1, 2, 3}, {});
    steps(*w, 3);
    auto bytes = saved(*w);
    const Vec3 here = stateOf(*w).position;
    bytes.pop_back();
    EXPECT_THROW(w->snapshots()->restore(bytes), std::runtime_error);
    bytes[0] = 'x';
    EXPECT_THROW(w->snapshots()->restore(bytes), std::runtime_error);
    EXPECT_EQ(stateOf(*w).position, here);
}

}  // namespace
}  // namespace rigor::adapter
