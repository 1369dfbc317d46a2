// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <memory>
#include <vector>

#include "adapters/interface/engine.hpp"
#include "adapters/interface/state_setting.hpp"
#include "adapters/simbody/model.hpp"

namespace rigor::simbody {

/// One scenario as a multibody system of Simbody with one integrator, which is initialised at every step of the
/// harness. Two-dimensional scenarios are lifted (adapters/interface/planar.hpp); their free bodies have planar joints.
class SimbodyWorld final : public adapter::World, public adapter::Snapshots, public adapter::StateSetting {
  public:
    SimbodyWorld(const adapter::Scenario& scenario, double dt, const adapter::Settings& settings);

    void applyForce(int body, const Vec3& force, const Vec3& torque) override;
    bool evaluatesForces() const override { return true; }
    bool applyImpulse(int body, const Vec3& impulse, const Vec3& angularImpulse) override;
    void step() override;
    void readStates(std::span<adapter::BodyState> states) const override;
    void setStates(std::span<const adapter::BodyState> states) override;
    const char* warmStart() const override { return "discarded"; }
    void readContacts(std::vector<adapter::ContactPoint>& contacts) const override { contacts.clear(); }
    adapter::ReadBack readBack() const override;
    std::vector<adapter::LedgerEntry> ledger() const override;
    adapter::StepCounters counters() const override;
    adapter::Scheme scheme() const override;
    bool jointHolds(int joint) const override;
    adapter::Snapshots* snapshots() override { return this; }
    void save(std::vector<unsigned char>& bytes) const override;
    bool restore(const std::vector<unsigned char>& bytes) override;

  private:
    struct Wrench {
        Vec3 force, torque;  ///< [N], [N m], world frame
    };

    void place(std::span<const adapter::BodyState> states);
    void prepareForces();
    void setMotors();
    /// Accelerations of the coordinates with motors, [i] of the i-th motor, [j][i] by a unit of the j-th one's force.
    struct MotorProblem {
        std::vector<double> rates, accelerations;  ///< without motors' forces
        std::vector<std::vector<double>> gains;
        std::vector<SimTK::Vector> changes;  ///< accelerations of all coordinates by that unit
    };
    MotorProblem motorProblem();
    std::vector<double> motorForces(const MotorProblem& problem) const;
    void hold(const std::vector<std::size_t>& held, const MotorProblem& problem);
    void releaseMotors();
    void integrate();
    void breakJoints();
    void countTurns();
    void realize(SimTK::Stage stage) const { model_->system.realize(state_, stage); }
    adapter::BodyState stateOf(int body) const;
    bool is(const char* key, const char* value) const;

    adapter::Scenario scenario_;  ///< three-dimensional
    adapter::Settings settings_;
    double dt_ = 0.0;
    bool planar_ = false;
    std::unique_ptr<Model> model_;
    std::shared_ptr<SimTK::Integrator> integrator_;
    SimTK::State state_;
    std::int64_t steps_ = 0;
    double next_ = 0.0;            ///< size that the integrator proposes for its next step; 0: none yet [s]
    std::vector<Wrench> forces_;   ///< forces of the coming step, by scenario body
    std::vector<bool> nearSpeed_;  ///< flags by motor: the last step's force led to its speed
    bool lost_ = false;            ///< the integrator has left all numbers
    int internalSteps_ = 0;        ///< steps of the integrator in the last step
};

}  // namespace rigor::simbody
