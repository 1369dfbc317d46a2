// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <ode/ode.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "adapters/interface/engine.hpp"
#include "adapters/interface/pair_table.hpp"
#include "adapters/interface/state_setting.hpp"
#include "adapters/ode/contacts.hpp"
#include "adapters/ode/joints.hpp"
#include "adapters/ode/shapes.hpp"

namespace rigor::ode {

/// One scenario in one ODE world. ODE's body frame has its origin at the centre of mass and the axes of the
/// scenario's body frame. Static bodies are geoms without a body. Two-dimensional scenarios are lifted
/// (adapters/interface/planar.hpp) and held in the x-y plane by Plane2D joints.
class OdeWorld final : public adapter::World, public adapter::Snapshots, public adapter::StateSetting {
  public:
    OdeWorld(const adapter::Scenario& scenario, double dt, const adapter::Settings& settings);
    ~OdeWorld() override;

    void applyForce(int body, const adapter::Vec3& force, const adapter::Vec3& torque) override;
    void step() override;
    void readStates(std::span<adapter::BodyState> states) const override;
    void setStates(std::span<const adapter::BodyState> states) override;
    const char* warmStart() const override { return "discarded"; }
    void readContacts(std::vector<adapter::ContactPoint>& contacts) const override;
    adapter::ReadBack readBack() const override;
    std::vector<adapter::LedgerEntry> ledger() const override;
    adapter::StepCounters counters() const override { return counters_; }
    adapter::Scheme scheme() const override { return adapter::Scheme::SymplecticEuler; }
    bool jointHolds(int joint) const override;
    adapter::Snapshots* snapshots() override { return this; }
    void save(std::vector<unsigned char>& bytes) const override;
    bool restore(const std::vector<unsigned char>& bytes) override;

  private:
    /// A world in which nothing has been made yet.
    struct Empty {};
    OdeWorld(Empty, const adapter::Scenario& scenario, double dt, const adapter::Settings& settings);

    enum class Friction { PyramidWorld, PyramidVelocity };

    /// Objects of one scenario body in ODE. Addresses are stable: ODE keeps pointers into it.
    struct BodyRecord {
        dBodyID body = nullptr;  ///< null for static bodies
        bool dynamic = false;
        bool ownGravity = false;  ///< gravityScale != 1: given as a force
        adapter::Vec3 gravity;    ///< acceleration [m/s^2]
        adapter::Vec3 com;        ///< centre of mass in the body frame [m]
        adapter::Mat3 inertia, inverseInertia;
        std::vector<std::unique_ptr<Geom>> geoms;
        /// gyroscopic=external: orientation whose angular momentum the next step has to start from
        bool turnPending = false;
        adapter::Quat turnFrom;
    };
    /// A contact that the current step acts upon.
    struct StepContact {
        GeomTag a, b;
        FoundPoint point;
        adapter::Pose poseA, poseB;  ///< poses of the two shapes when the contact was found
        dJointFeedback feedback;
        bool feedbackOnA = false;  ///< true: f1 is the force on A; false: on B
    };

    void configureWorld();
    void createSpace();
    void addBody(int index);
    void addDynamics(const scenario::Body& body, BodyRecord& record);
    adapter::BodyState stateOf(int index) const;
    adapter::Pose poseOf(int index) const;

    void doStep();
    void pushGravity();
    void breakJoints();
    void collidePairsOfBrokenJoints();
    void findContacts();
    void findPoints(dGeomID a, dGeomID b);
    void createContactJoints();
    void chooseFrictionDirection(const StepContact& contact, dContact& out) const;
    adapter::Vec3 surfaceSlip(const StepContact& c) const;
    void setSurfaceMotion(const StepContact& c, const adapter::Vec3& belt, bool firstIsA,
                          dContact& out) const;
    adapter::Vec3 freeVelocityAt(int body, const adapter::Vec3& point) const;
    void advance();
    void turnAngularMomentum(BodyRecord& record, const adapter::Quat& from);
    void keepInPlane(BodyRecord& record);
    static void nearPair(void* self, dGeomID a, dGeomID b);
    bool is(const std::string& key, const std::string& value) const;
    void appendGeometryLedger(std::vector<adapter::LedgerEntry>& lines) const;

    adapter::Scenario original_;  ///< scenario as given
    adapter::Scenario scenario_;  ///< three-dimensional
    adapter::Settings settings_;
    double dt_ = 0.0;
    bool planar_ = false, quickStep_ = false, externalGyro_ = false;
    Friction friction_ = Friction::PyramidWorld;
    std::size_t maxContacts_ = 0;
    std::size_t worldStepLimit_ = 0;
    double bounceThreshold_ = 0.0, contactCfm_ = 0.0;
    double ballMergeCosine_ = 2.0;  ///< merge angle as a cosine; above 1: spheres keep all their points

    adapter::PairTable pairs_;
    dWorldID world_ = nullptr;
    dSpaceID space_ = nullptr;
    dJointGroupID contactGroup_ = nullptr;
    std::vector<std::unique_ptr<BodyRecord>> records_;
    std::vector<std::unique_ptr<OdeJoint>> joints_;  ///< joints by scenario index
    std::vector<std::pair<dGeomID, dGeomID>> near_;
    std::vector<FoundPoint> found_;
    std::vector<StepContact> contacts_;

    bool broken_ = false;  ///< an error left ODE in the middle of something
    adapter::StepCounters counters_;
    std::int64_t steps_ = 0, fallbackSteps_ = 0, messages_ = 0;
};

}  // namespace rigor::ode
