// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adapters/chipmunk/joints.hpp"
#include "adapters/chipmunk/shapes.hpp"
#include "adapters/interface/engine.hpp"
#include "adapters/interface/pair_table.hpp"
#include "adapters/interface/state_setting.hpp"

namespace rigor::chipmunk {

/// Data behind a shape's user data.
struct ShapeTag {
    int body = 0, shape = 0, material = 0;
    const scenario::Shape* source = nullptr;  ///< null where its surface does not move
};

/// One scenario in one cpSpace.
class ChipmunkWorld final : public adapter::World, public adapter::StateSetting {
  public:
    ChipmunkWorld(const adapter::Scenario& scenario, double dt, const adapter::Settings& settings);

    void applyForce(int body, const adapter::Vec3& force, const adapter::Vec3& torque) override;
    void step() override;
    void readStates(std::span<adapter::BodyState> states) const override;
    void setStates(std::span<const adapter::BodyState> states) override;
    const char* warmStart() const override { return "kept"; }
    void readContacts(std::vector<adapter::ContactPoint>& contacts) const override;
    /// cpSpaceStep moves the bodies first, and finds contacts where that has led them.
    adapter::ContactInstant contactInstant() const override {
        return positionsLast_ ? adapter::ContactInstant::StepStart : adapter::ContactInstant::StepEnd;
    }
    adapter::ReadBack readBack() const override;
    std::vector<adapter::LedgerEntry> ledger() const override;
    adapter::StepCounters counters() const override;
    adapter::Scheme scheme() const override;
    bool jointHolds(int joint) const override { return !joints_[joint].empty(); }

  private:
    /// Chipmunk's body frame is the scenario's.
    struct BodyRecord {
        Owned<cpBody> body;
        bool moves = false, dynamic = false;
        double linearKept = 1.0, angularKept = 1.0;  ///< parts of the velocities kept in a step
        double gravityScale = 1.0;
        std::vector<std::unique_ptr<ShapeTag>> tags;
        std::vector<Owned<cpShape>> shapes;
    };

    void addBody(int index);
    void addShapes(BodyRecord& record, int index);
    void addJoint(const scenario::Joint& joint);
    void breakJoints();
    bool is(const char* key, const char* value) const;
    double number(const char* key) const;
    adapter::BodyState stateOf(const BodyRecord& record) const;
    cpVect surfaceVelocity(cpArbiter* arbiter, const cpShape* a, const cpShape* b) const;
    scenario::PairCoefficients probe(int materialA, int materialB) const;
    void appendContacts(const cpArbiter& arbiter, std::vector<adapter::ContactPoint>& contacts) const;

    static cpBool preSolve(cpArbiter* arbiter, cpSpace* space, cpDataPointer self);
    static void postSolve(cpArbiter* arbiter, cpSpace* space, cpDataPointer self);
    static void updateVelocity(cpBody* body, cpVect gravity, cpFloat damping, cpFloat dt);
    static void stay(cpBody*, cpFloat) {}

    adapter::Scenario scenario_;
    adapter::Settings settings_;
    double dt_ = 0.0;
    bool positionsLast_ = false;
    HalfPlane halfPlane_;
    adapter::PairTable pairs_;
    Owned<cpBody> ground_;  ///< body that joints to the world are attached to
    std::vector<std::unique_ptr<BodyRecord>> records_;
    std::vector<Parts> joints_;  ///< joints by the scenario's index; empty once broken
    Owned<cpSpace> space_;       ///< declared after its bodies, shapes and constraints, which outlive it
    std::vector<cpArbiter*> touching_;  ///< arbiters that the last step solved
    std::vector<cpVect> centers_;  ///< centres of mass when the contacts of the last step were found, by body
};

}  // namespace rigor::chipmunk
