// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adapters/box2d/contact_rules.hpp"
#include "adapters/box2d/joints.hpp"
#include "adapters/box2d/shapes.hpp"
#include "adapters/interface/engine.hpp"
#include "adapters/interface/pair_table.hpp"
#include "adapters/interface/state_setting.hpp"

namespace rigor::box2d {

/// One scenario in one b2World, whose lengths are `scale` times the scenario's.
class Box2dWorld final : public adapter::World, public adapter::StateSetting {
  public:
    Box2dWorld(const adapter::Scenario& scenario, double dt, const adapter::Settings& settings);

    void applyForce(int body, const adapter::Vec3& force, const adapter::Vec3& torque) override;
    void step() override;
    void readStates(std::span<adapter::BodyState> states) const override;
    void setStates(std::span<const adapter::BodyState> states) override;
    const char* warmStart() const override { return "contacts discarded"; }
    void readContacts(std::vector<adapter::ContactPoint>& contacts) const override;
    adapter::ReadBack readBack() const override;
    std::vector<adapter::LedgerEntry> ledger() const override;
    adapter::StepCounters counters() const override;
    adapter::Scheme scheme() const override { return adapter::Scheme::SymplecticEuler; }
    bool isAsleep(int body) const override;
    bool jointHolds(int joint) const override { return !joints_[joint].empty(); }

  private:
    struct BodyRecord {
        b2Body* body = nullptr;
        Pose frame;  ///< the Box2D body frame in the scenario's; apart only for kinematic bodies
        BodyTag tag;
        std::vector<std::unique_ptr<FixtureTag>> fixtureTags;
    };

    ShapeSettings shapeSettings() const;
    void addBody(int index);
    void addFixtures(BodyRecord& record, int index);
    void setMass(b2Body& body, const scenario::Body& source) const;
    void addJoint(const scenario::Joint& joint);
    void breakJoints();
    void collidePairsOfBrokenJoints();
    void appendContact(const b2Contact& contact, std::vector<adapter::ContactPoint>& contacts) const;
    adapter::BodyState stateOf(const BodyRecord& record) const;
    void appendShapeLedger(std::vector<adapter::LedgerEntry>& lines) const;
    bool is(const std::string& key, const std::string& value) const;

    adapter::Scenario scenario_;
    adapter::Settings settings_;
    double dt_ = 0.0;
    double scale_ = 1.0;
    int velocityIterations_ = 0, positionIterations_ = 0;
    int steps_ = 0;
    ShapeSettings shapes_;
    adapter::PairTable pairs_;
    std::vector<std::unique_ptr<BodyRecord>> records_;
    std::unique_ptr<ContactRules> rules_;
    std::unique_ptr<b2World> world_;   // declared after the objects that its bodies and callbacks point at
    b2Body* ground_ = nullptr;         ///< body that joints to the world are attached to
    std::vector<Parts> joints_;        ///< joints by the scenario's index; empty once broken
    std::vector<b2Transform> before_;  ///< poses at the start of the last step, by body
};

}  // namespace rigor::box2d
