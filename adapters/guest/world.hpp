// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A world inside a guest. States are kept here after every request that changes them; contacts are fetched when they are
// read.
#pragma once

#include <memory>
#include <vector>

#include "adapters/guest/connection.hpp"
#include "adapters/interface/engine.hpp"
#include "adapters/interface/state_setting.hpp"

namespace rigor::guest {

class GuestWorld : public adapter::World, private adapter::Snapshots {
  public:
    /// Properties of a world in the answer to `build`.
    struct Abilities {
        adapter::Scheme scheme = adapter::Scheme::Unknown;
        bool impulses = false, snapshots = false;
        std::string warmStart;  ///< StateSetting::warmStart; "": states can not be set
    };
    /// `number` names the world in requests. `states`: after the build.
    GuestWorld(std::shared_ptr<Connection> connection, std::int64_t number, std::size_t joints,
               Abilities abilities, std::vector<adapter::BodyState> states);
    ~GuestWorld() override;

    void applyForce(int body, const adapter::Vec3& force, const adapter::Vec3& torque) override;
    bool applyImpulse(int body, const adapter::Vec3& impulse, const adapter::Vec3& angularImpulse) override;
    void step() override;
    void readStates(std::span<adapter::BodyState> states) const override;
    void readContacts(std::vector<adapter::ContactPoint>& contacts) const override;
    adapter::ReadBack readBack() const override;
    std::vector<adapter::LedgerEntry> ledger() const override;
    adapter::StepCounters counters() const override { return counters_; }
    adapter::Scheme scheme() const override { return abilities_.scheme; }
    bool jointHolds(int joint) const override { return holds_[joint]; }
    bool isAsleep(int body) const override { return asleep_[body]; }
    adapter::Snapshots* snapshots() override { return abilities_.snapshots ? this : nullptr; }

  protected:
    void setAll(std::span<const adapter::BodyState> states);
    const Abilities& abilities() const { return abilities_; }

  private:
    void save(std::vector<unsigned char>& bytes) const override;
    bool restore(const std::vector<unsigned char>& bytes) override;
    Frame request() const;  ///< a frame with the world's number
    void takeStates(const std::string& request, const Frame& answer);
    void takeStep(const Frame& answer);

    std::shared_ptr<Connection> connection_;
    std::int64_t number_;
    Abilities abilities_;
    std::vector<adapter::BodyState> states_;
    std::vector<double> forces_;  ///< forces of the next step, 7 numbers each: body, force, torque
    std::vector<bool> holds_, asleep_;
    adapter::StepCounters counters_;
};

/// One whose state can be set.
class SettableGuestWorld final : public GuestWorld, public adapter::StateSetting {
  public:
    using GuestWorld::GuestWorld;
    void setStates(std::span<const adapter::BodyState> states) override { setAll(states); }
    const char* warmStart() const override { return abilities().warmStart.c_str(); }
};

/// Builds a world from a request that is complete but for its kind; the answer decides what it can do.
std::unique_ptr<adapter::World> buildWorld(std::shared_ptr<Connection> connection, std::int64_t number,
                                           const adapter::Scenario& scenario, Frame request);

/// Reads rows of states, and of contacts between bodies of which there are so many.
std::vector<adapter::BodyState> statesOf(const Table& table);
std::vector<adapter::ContactPoint> contactsOf(const Table& table, std::size_t bodies);
inline constexpr std::size_t kStateColumns = 13, kContactColumns = 19;

}  // namespace rigor::guest
