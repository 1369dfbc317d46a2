// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <string>
#include <vector>

#include "adapters/interface/engine.hpp"
#include "adapters/interface/pair_table.hpp"
#include "adapters/interface/state_setting.hpp"
#include "adapters/mujoco/model.hpp"

namespace rigor::mujoco {

/// One scenario as a MuJoCo model and its data. Two-dimensional scenarios are lifted (adapters/interface/planar.hpp);
/// their free bodies have two slides and a hinge, so that nothing can leave the plane.
class MujocoWorld final : public adapter::World, public adapter::Snapshots, public adapter::StateSetting {
  public:
    MujocoWorld(const adapter::Scenario& scenario, double dt, const adapter::Settings& settings);

    void applyForce(int body, const adapter::Vec3& force, const adapter::Vec3& torque) override;
    void step() override;
    void readStates(std::span<adapter::BodyState> states) const override;
    void setStates(std::span<const adapter::BodyState> states) override;
    const char* warmStart() const override { return "discarded"; }
    void readContacts(std::vector<adapter::ContactPoint>& contacts) const override;
    adapter::ReadBack readBack() const override;
    std::vector<adapter::LedgerEntry> ledger() const override;
    adapter::StepCounters counters() const override;
    adapter::Scheme scheme() const override;
    bool jointHolds(int joint) const override;
    adapter::Snapshots* snapshots() override { return this; }
    void save(std::vector<unsigned char>& bytes) const override;
    bool restore(const std::vector<unsigned char>& bytes) override;

  private:
    /// State that the next step starts from.
    struct State {
        std::vector<mjtNum> numbers;
    };

    struct Reaction {
        double force = 0.0, torque = 0.0;  ///< [N], [N m]
    };

    ModelSettings modelSettings() const;
    Reaction reactionOf(int joint) const;
    void breakJoints();
    void updatePairs();
    void addDamping();
    void makeData(int contacts, int rows);
    void grow();
    void prepareForces();
    void setMotors();
    bool overflowed() const;
    void moveKinematic(const State& before);
    void updatePoses();
    State keepState() const;
    void putState(const State& state);
    void placeLink(int body, std::span<const adapter::BodyState> states);
    void placeFree(int body, const Pose& pose, const adapter::BodyState& state);
    adapter::BodyState stateOf(int body) const;
    Pose linkPose(int body, const adapter::BodyState& state) const;
    bool is(const char* key, const char* value) const;
    double number(const char* key) const;

    adapter::Scenario scenario_;  ///< three-dimensional
    adapter::Settings settings_;
    double dt_ = 0.0;
    bool planar_ = false;
    bool reset_ = false;  ///< MuJoCo found numbers that are none, and started again
    int capacity_ = 0;    ///< contacts that the data hold
    adapter::PairTable pairs_;
    Model model_;
    ContactFilterData filter_;
    DataOwner data_;
    std::vector<adapter::BodyState> start_;  ///< states of bodies that do not move
    std::vector<mjtNum> forces_;  ///< xfrc_applied of the coming step, without gravity's corrections
    std::int64_t steps_ = 0;
};

}  // namespace rigor::mujoco
