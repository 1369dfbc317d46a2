// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <string>
#include <vector>

#include "adapters/bullet/articulation.hpp"
#include "adapters/bullet/contact_rules.hpp"
#include "adapters/bullet/joints.hpp"
#include "adapters/bullet/shapes.hpp"
#include "adapters/interface/engine.hpp"
#include "adapters/interface/state_setting.hpp"

class btMLCPSolver;
class btMLCPSolverInterface;

namespace rigor::bullet {

/// One scenario in one btDiscreteDynamicsWorld. Two-dimensional scenarios are lifted (adapters/interface/
/// planar.hpp) and kept in the x-y plane by Bullet's linear and angular factors. With articulation=multibody
/// bodies on joints are links of btMultiBody and their rigid bodies are not in the world; those give shapes
/// and masses.
class BulletWorld final : public adapter::World, public adapter::StateSetting {
  public:
    BulletWorld(const adapter::Scenario& scenario, double dt, const adapter::Settings& settings);
    ~BulletWorld() override;

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
    bool isAsleep(int body) const override;
    bool jointHolds(int joint) const override;

  private:
    /// Objects of one scenario body in Bullet. Addresses are stable: Bullet keeps pointers to all of it.
    struct BodyRecord {
        adapter::Pose
            comFrame;  ///< Bullet's frame (origin: centre of mass, principal axes) in the body frame
        std::unique_ptr<BodyShape> shape;
        std::unique_ptr<btRigidBody> body;
        BodyTag tag;
        btVector3 velocity{0, 0, 0}, angularVelocity{0, 0, 0};  ///< velocities of a kinematic body
        bool linked = false;                                    ///< a link of articulations_
    };
    struct JointRecord {
        BuiltJoint built;
        std::vector<btJointFeedback> feedback;  ///< feedback of each part: mean force and torque of the last
                                                ///< step
        bool watched = false;                   ///< broken by its feedback

        bool holds() const;  ///< true if none of its parts is broken
    };
    class PairFilter;

    void createPipeline();
    void createSolver();
    void configureSolver();
    void addBody(int index);
    void addJoint(const scenario::Joint& joint);
    void articulate();
    void pullScaledGravity();
    void setBreaking(const scenario::Joint& joint, JointRecord& record);
    void breakJoints();
    ShapeSettings shapeSettings() const;
    adapter::BodyState stateOf(const BodyRecord& record) const;
    void moveKinematicBodies();
    void turnAngularMomenta(const std::vector<btMatrix3x3>& basesBefore);
    void readImpulses(const btManifoldPoint& point, double towardsB, adapter::ContactPoint& contact) const;
    void appendManifold(const btPersistentManifold& manifold,
                        std::vector<adapter::ContactPoint>& contacts) const;
    void appendJointLedger(std::vector<adapter::LedgerEntry>& lines) const;
    void appendGeometryLedger(std::vector<adapter::LedgerEntry>& lines) const;
    static void beforeStep(btDynamicsWorld* world, btScalar dt);
    bool is(const std::string& key, const std::string& value) const;

    adapter::Scenario original_;  ///< scenario as given
    adapter::Scenario scenario_;  ///< three-dimensional
    adapter::Settings settings_;
    double dt_ = 0.0;
    bool planar_ = false;
    bool externalGyro_ = false;
    int steps_ = 0;

    adapter::PairTable pairs_;
    std::vector<bool> linked_;  ///< bodies that are links; see Articulations::linkedBodies
    std::vector<std::unique_ptr<BodyRecord>> records_;
    std::unique_ptr<btEmptyShape> groundShape_;
    std::unique_ptr<btRigidBody> ground_;  ///< body that joints to the world are attached to; not in the
                                           ///< world
    std::vector<std::unique_ptr<JointRecord>> joints_;  ///< joints by scenario index

    std::unique_ptr<btDefaultCollisionConfiguration> configuration_;
    std::unique_ptr<btCollisionDispatcher> dispatcher_;
    std::unique_ptr<btBroadphaseInterface> broadphase_;
    std::unique_ptr<PairFilter> filter_;
    std::unique_ptr<btMLCPSolverInterface> mlcp_;
    std::unique_ptr<btSequentialImpulseConstraintSolver> solver_;
    btMLCPSolver* mlcpSolver_ = nullptr;
    std::unique_ptr<btDiscreteDynamicsWorld> world_;
    std::unique_ptr<Articulations> articulations_;  ///< null with maximal coordinates
};

}  // namespace rigor::bullet
