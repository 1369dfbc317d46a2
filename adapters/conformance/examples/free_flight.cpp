// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The smallest complete adapter: an engine whose bodies fly freely and touch nothing, by symplectic Euler and
// turns at constant angular velocity. Its "library" is the Body struct below.
#include "adapters/interface/engine.hpp"
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/inverse.hpp"

namespace {

using namespace rigor::adapter;
using rigor::scenario::BodyType;
namespace scenario = rigor::scenario;

/// State that the library keeps: the pose of the centre of mass and its velocities.
struct Body {
    bool moves = false;
    double mass = 0.0;
    Mat3 inertia, inverseInertia;
    Vec3 com, gravity, position, velocity, spin, force, torque;
    Quat orientation;
};

class FreeFlightWorld final : public World {
  public:
    FreeFlightWorld(const Scenario& scenario, double dt) : planar_(scenario.dimension == 2), dt_(dt) {
        for (const auto& given : scenario.bodies) {
            Body body;
            body.moves = given.type == BodyType::Dynamic;
            body.com = given.massProperties.centerOfMass;
            body.position = given.pose * body.com;
            body.orientation = given.pose.orientation;
            if (body.moves) {
                body.mass = given.massProperties.mass;
                body.inertia = given.massProperties.inertia;
                if (planar_) body.inertia(0, 0) = body.inertia(1, 1) = body.inertia(2, 2);
                body.inverseInertia = inverseOf(body.inertia);
                body.gravity = given.gravityScale * scenario.gravity;
                body.velocity = given.velocity;
                body.spin = given.angularVelocity;
            }
            bodies_.push_back(body);
        }
    }

    void applyForce(int body, const Vec3& force, const Vec3& torque) override {
        bodies_[body].force += force;
        bodies_[body].torque += torque;
    }

    void step() override {
        for (Body& b : bodies_) {
            if (!b.moves) continue;
            b.velocity += dt_ * (b.gravity + b.force / b.mass);
            b.spin += dt_ * rotate(b.orientation, b.inverseInertia * rotateInverse(b.orientation, b.torque));
            b.position += dt_ * b.velocity;
            if (const double rate = norm(b.spin); rate > 0.0)
                b.orientation =
                    normalized(scenario::fromAxisAngle(b.spin / rate, rate * dt_) * b.orientation);
            b.force = b.torque = {};
        }
    }

    void readStates(std::span<BodyState> states) const override {
        for (std::size_t i = 0; i < states.size(); ++i) states[i] = stateOf(bodies_[i]);
    }
    void readContacts(std::vector<ContactPoint>& contacts) const override { contacts.clear(); }

    ReadBack readBack() const override {
        ReadBack all;
        for (const Body& b : bodies_) all.bodies.push_back({b.mass, b.com, b.inertia, stateOf(b), b.gravity});
        return all;
    }

    std::vector<LedgerEntry> ledger() const override {
        std::vector<LedgerEntry> lines{
            {"integrator", "symplectic_euler", "symplectic_euler", Realisation::Exact, ""}};
        if (!planar_)
            lines.push_back({"gyroscopic_term", "exact rigid-body rotation", "none", Realisation::Approximate,
                             "angular velocity is constant without torque, whatever the inertia"});
        return lines;
    }
    Scheme scheme() const override { return Scheme::SymplecticEuler; }

  private:
    static BodyState stateOf(const Body& b) {
        return {b.position - rotate(b.orientation, b.com), b.orientation, b.velocity, b.spin};
    }

    bool planar_;
    double dt_;
    std::vector<Body> bodies_;
};

class FreeFlight final : public Engine, public DynamicsEngine {
  public:
    EngineInfo info() const override { return {"free_flight", "1.0", "f64", "Free flight", ""}; }
    /// No shapes and no joints: scenarios that need them are refused by checkSupported.
    Capabilities capabilities() const override {
        Capabilities c;
        c.dynamics = true;
        c.dimensions = {2, 3};
        c.gravityScale = c.centerOfMassOffset = true;
        return c;
    }
    std::vector<Option> options() const override { return {}; }
    const DynamicsEngine* dynamics() const override { return this; }

    std::unique_ptr<World> build(const Scenario& scenario, double dt, const Settings&) const override {
        checkScenarioInput(scenario, dt);
        checkSupported(scenario, capabilities(), "free_flight");
        return std::make_unique<FreeFlightWorld>(scenario, dt);
    }
};

std::unique_ptr<Engine> createEngine() {
    return std::make_unique<FreeFlight>();
}

}  // namespace

RIGOR_ADAPTER_MODULE(createEngine)
