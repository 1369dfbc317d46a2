// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies on joints in reduced coordinates: btMultiBody, Featherstone's articulated-body algorithm. Every set
// of dynamic bodies that joints connect becomes one multibody: a spanning tree of its joints from the world,
// or from its first body where nothing holds it, and constraints for the joints that close loops. In 2D a
// first body without a joint to the world is a link too, which travels along x and y and turns about z.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <memory>
#include <vector>

#include "adapters/interface/engine.hpp"

namespace rigor::bullet {

struct ArticulationSettings {
    double dt = 0.0;               ///< [s]
    double damping = 0.0;          ///< btMultiBody's, linear and angular
    double maximalVelocity = 1e9;  ///< limit of a coordinate's speed; Bullet clamps it [m/s] or [rad/s]
    bool rungeKutta = false;       ///< RK4 instead of semi-implicit Euler
    bool gyroscopic = true;
    bool maySleep = false;
    bool planar = false;  ///< everything stays in the plane z = 0
};

class Articulations {
  public:
    /// Data of a body's record that its link needs.
    struct LinkSource {
        adapter::Pose comFrame;  ///< centre of mass and principal axes, in the body frame
        btVector3 moments;       ///< [kg m^2]
        btCollisionShape* shape = nullptr;
        void* tag = nullptr;
        btScalar contactProcessingThreshold = btScalar(BT_LARGE_FLOAT);
    };

    /// Bodies that become links: the dynamic ones that a joint names. Throws Unsupported if btMultiBody lacks
    /// a feature of their joints.
    static std::vector<bool> linkedBodies(const adapter::Scenario& scenario);

    /// Adds the multibodies to the world; `sources` is indexed by body.
    Articulations(const adapter::Scenario& scenario, std::vector<LinkSource> sources,
                  btMultiBodyDynamicsWorld& world, const ArticulationSettings& settings);
    ~Articulations();

    bool has(int body) const { return links_[body].multiBody != nullptr; }
    /// Forward kinematics of all links: Bullet's cached poses are those of the start of its step.
    void update();
    btTransform pose(int body) const;  ///< pose of the centre-of-mass frame
    btVector3 velocity(int body) const;
    btVector3 angularVelocity(int body) const;
    double mass(int body) const;
    btVector3 moments(int body) const;
    /// force and torque of the next step
    void addForce(int body, const btVector3& force, const btVector3& torque);
    /// Torques and forces of the joints' springs and dampers at the present state, for the next step.
    void pullSprings();
    bool asleep(int body) const;
    int loops() const { return loops_; }

  private:
    struct Link {
        btMultiBody* multiBody = nullptr;
        int index = -1;  ///< -1: the base
        btTransform pose = btTransform::getIdentity();
        btVector3 velocity{0, 0, 0}, angularVelocity{0, 0, 0};
    };
    /// Spring of a hinge or slider of the tree; q is Bullet's coordinate of the link.
    struct Spring {
        btMultiBody* multiBody = nullptr;
        int index = 0;
        double stiffness = 0.0, damping = 0.0, target = 0.0;
    };
    struct Edge;
    struct Tree;

    void build(const Tree& tree);
    void addFloatingRoot(btMultiBody& multiBody, int body);
    void addLink(btMultiBody& multiBody, int index, const Edge& edge);
    void setCoordinates(btMultiBody& multiBody, int index, const Edge& edge);
    void addDrives(btMultiBody& multiBody, int index, const Edge& edge);
    void closeLoop(btMultiBody& multiBody, const scenario::Joint& joint);
    void addCollider(int body);
    btTransform startPose(int body) const;  ///< kNone, static: the world frame
    void addConstraint(std::unique_ptr<btMultiBodyConstraint> constraint);

    const adapter::Scenario& scenario_;
    std::vector<LinkSource> sources_;
    btMultiBodyDynamicsWorld& world_;
    ArticulationSettings settings_;
    std::vector<Link> links_;  ///< link of each body
    std::vector<std::unique_ptr<btMultiBody>> multiBodies_;
    std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
    std::vector<std::unique_ptr<btMultiBodyConstraint>> constraints_;
    std::vector<Spring> springs_;
    int loops_ = 0;
};

}  // namespace rigor::bullet
