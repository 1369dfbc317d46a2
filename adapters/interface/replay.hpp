// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Snapshots of worlds whose library keeps part of its state to itself: the log of what was done to the world
// since it was built, replayed into one built anew. The future is the same bit for bit where the library is
// deterministic. Restoring costs the steps of the log again; saving costs its length: a few bytes, and 57
// for each force, 104 for each body of each setStates.
#pragma once

#include <functional>

#include "adapters/interface/engine.hpp"
#include "adapters/interface/state_setting.hpp"

namespace rigor::adapter {

class ReplayWorld final : public World, public Snapshots, public StateSetting {
  public:
    /// Builds the same world at every call; it must be a StateSetting and have no stages.
    using Build = std::function<std::unique_ptr<World>()>;
    explicit ReplayWorld(Build build);

    void applyForce(int body, const Vec3& force, const Vec3& torque) override;
    bool evaluatesForces() const override { return world_->evaluatesForces(); }
    bool applyImpulse(int body, const Vec3& impulse, const Vec3& angularImpulse) override;
    void step() override;
    void setStates(std::span<const BodyState> states) override;
    const char* warmStart() const override { return setter_->warmStart(); }

    void readStates(std::span<BodyState> states) const override { world_->readStates(states); }
    void readContacts(std::vector<ContactPoint>& contacts) const override { world_->readContacts(contacts); }
    ContactInstant contactInstant() const override { return world_->contactInstant(); }
    ReadBack readBack() const override { return world_->readBack(); }
    std::vector<LedgerEntry> ledger() const override { return world_->ledger(); }
    StepCounters counters() const override { return world_->counters(); }
    Scheme scheme() const override { return world_->scheme(); }
    bool jointHolds(int joint) const override { return world_->jointHolds(joint); }
    bool isAsleep(int body) const override { return world_->isAsleep(body); }

    /// The first call starts the log of forces, impulses and states set; steps are counted from the start. A
    /// call after something was done that the log does not hold gives null.
    Snapshots* snapshots() override;
    void save(std::vector<unsigned char>& bytes) const override { bytes = log_; }
    /// Throws std::runtime_error for bytes that are cut short or no log; the world then stays as it is.
    bool restore(const std::vector<unsigned char>& bytes) override;

  private:
    bool recording();
    void put(const void* data, std::size_t size);
    void putPush(unsigned char kind, int body, const Vec3& linear, const Vec3& angular);
    void adopt(std::unique_ptr<World> world);

    Build build_;
    std::unique_ptr<World> world_;
    StateSetting* setter_ = nullptr;  ///< world_
    std::vector<unsigned char> log_;
    std::size_t stepsAt_ = 0;  ///< offset in log_ of the count of the steps that end it; log_.size(): none
    bool records_ = false;     ///< snapshots() has been called
    bool lost_ = false;        ///< something was done before that
};

}  // namespace rigor::adapter
