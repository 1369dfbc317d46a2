// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <dart/collision/CollisionResult.hpp>
#include <dart/simulation/World.hpp>
#include <string>
#include <vector>

#include "adapters/dart/model.hpp"
#include "adapters/dart/solver.hpp"
#include "adapters/interface/engine.hpp"
#include "adapters/interface/state_setting.hpp"

namespace rigor::dart_adapter {

/// One scenario as a world of DART. Two-dimensional scenarios are lifted (adapters/interface/planar.hpp); their free
/// bodies have planar joints, so that nothing can leave the plane.
class DartWorld final : public adapter::World, public adapter::Snapshots, public adapter::StateSetting {
  public:
    DartWorld(const adapter::Scenario& scenario, double dt, const adapter::Settings& settings);

    void applyForce(int body, const Vec3& force, const Vec3& torque) override;
    void step() override;
    void readStates(std::span<adapter::BodyState> states) const override;
    void setStates(std::span<const adapter::BodyState> states) override;
    const char* warmStart() const override { return "discarded"; }
    void readContacts(std::vector<adapter::ContactPoint>& contacts) const override;
    adapter::ReadBack readBack() const override;
    std::vector<adapter::LedgerEntry> ledger() const override;
    adapter::StepCounters counters() const override;
    bool jointHolds(int joint) const override;
    adapter::Scheme scheme() const override { return adapter::Scheme::SymplecticEuler; }
    adapter::Snapshots* snapshots() override;
    void save(std::vector<unsigned char>& bytes) const override;
    bool restore(const std::vector<unsigned char>& bytes) override;

  private:
    struct Wrench {
        Vec3 force, torque;  ///< [N], [N m], world frame
    };

    void makeSolver();
    void applyForces();
    void addSwingSprings();
    void drive();
    void findContacts();
    void breakJoints();
    void useJointsThatHold();
    bool isContact(const dart::collision::Contact& contact) const;
    bool movable(const dart::collision::Contact& contact) const;
    void setCoefficients(const dart::dynamics::ShapeFrame& one, const dart::dynamics::ShapeFrame& two) const;
    void moveKinematic();
    bool escaped() const;
    adapter::BodyState stateOf(int body) const;
    bool is(const char* key, const char* value) const;
    double number(const char* key) const;

    adapter::Scenario scenario_;  ///< three-dimensional
    adapter::Settings settings_;
    double dt_ = 0.0;
    bool planar_ = false;
    bool escaped_ = false;  ///< a velocity has become so large that DART would end the process
    adapter::PairTable pairs_;
    Stabilisation stabilisation_;
    Model model_;
    dart::simulation::WorldPtr world_;
    PairwiseSolver* solver_ = nullptr;  ///< owned by the world
    dart::collision::CollisionGroupPtr group_;
    dart::collision::CollisionOption option_;
    dart::collision::CollisionResult found_;      ///< contacts of the last step, with their forces
    std::vector<adapter::BodyState> prescribed_;  ///< states of static and kinematic bodies
    std::vector<Wrench> forces_;                  ///< forces of the coming step, by scenario body
    std::vector<Pose> before_;                    ///< poses at the start of the last step, by scenario body
};

}  // namespace rigor::dart_adapter
