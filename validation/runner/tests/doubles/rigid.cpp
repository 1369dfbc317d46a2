// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The engine of rigid.hpp and, by its option "fault", the same engine with one fault: mistakes that real
// engines and real adapters have made. ../faults_test.cpp says which metric has to find each of them.
#include "validation/runner/tests/doubles/rigid.hpp"

#include <map>

namespace rigor::doubles {
namespace {

// ------------------------------------------------------------------------------------------ motion
struct GravityTwice : RigidWorld {
    using RigidWorld::RigidWorld;
    Vec3 gravityOn(std::size_t i) const override { return 2.0 * RigidWorld::gravityOn(i); }
    ReadBack readBack() const override {  // one lets the engine do it, one adds it as a force
        ReadBack back = RigidWorld::readBack();
        for (auto& body : back.bodies) body.gravity = 0.5 * body.gravity;
        return back;
    }
};
struct GravityDouble : RigidWorld {
    using RigidWorld::RigidWorld;
    Vec3 gravityOn(std::size_t i) const override { return 2.0 * RigidWorld::gravityOn(i); }
};
/// Says symplectic, is explicit: the same size of error, the other way.
struct WrongScheme : RigidWorld {
    using RigidWorld::RigidWorld;
    void movePosition(Moving& m) const override { m.position += stepOf() * m.velocityBefore; }
};
/// Steps by 1/64 s for every requested time step, as often as time allows.
struct OwnStep : RigidWorld {
    using RigidWorld::RigidWorld;
    double stepOf() const override { return 1.0 / 64.0; }
    void step() override {
        while (time_ + 0.5 * stepOf() < (steps_ + 1) * dt_) {
            const int steps = steps_;
            RigidWorld::step();
            steps_ = steps;
            time_ += stepOf();
        }
        ++steps_;
    }
    double time_ = 0.0;
};
/// Takes 1e-4 of every velocity per second, which hides what the integrator gains.
struct HiddenDamping : RigidWorld {
    using RigidWorld::RigidWorld;
    void endOfStep() override {
        for (auto& m : bodies_) m.velocity = (1.0 - 1e-4 * dt_) * m.velocity;
    }
};

// ---------------------------------------------------------------------------------------- rotation
struct InertiaNotRotated : RigidWorld {
    using RigidWorld::RigidWorld;
    Quat frameOfInertia(const Quat&) const override { return {}; }
};
/// Adds the parts' inertias without Steiner's terms.
struct CompoundInertia : RigidWorld {
    using RigidWorld::RigidWorld;
    Mat3 inertiaOf(std::size_t i) const override {
        const auto& body = scenario_.bodies[i];
        const double all = massPropertiesFromShapes(body.shapes, scenario_.materials, 3).mass;
        Mat3 sum;
        for (const auto& shape : body.shapes) {
            const auto part = massPropertiesFromShapes({shape}, scenario_.materials, 3);
            sum = sum + scaledToMass(part, part.mass / all * body.massProperties.mass).inertia;
        }
        return sum;
    }
};
struct CompoundInertiaHidden : CompoundInertia {
    using CompoundInertia::CompoundInertia;
    Mat3 reportedInertia(std::size_t i) const override { return RigidWorld::inertiaOf(i); }
};
struct CompoundInertiaAnnounced : CompoundInertia {
    using CompoundInertia::CompoundInertia;
    std::vector<LedgerEntry> ledger() const override {
        return {{"inertia", "exact", "sum of the parts", Realisation::Approximate, "no Steiner terms"}};
    }
};
struct QuaternionDrifts : RigidWorld {
    using RigidWorld::RigidWorld;
    BodyState reported(std::size_t i) const override {
        BodyState s = stateOf(i);
        const double longer = 1.0 + 1e-6 * steps_;
        auto& q = s.orientation;
        q = {longer * q.w, longer * q.x, longer * q.y, longer * q.z};
        return s;
    }
};

// --------------------------------------------------------------------------------------- reporting
struct BodyFrameSpin : RigidWorld {
    using RigidWorld::RigidWorld;
    BodyState reported(std::size_t i) const override {
        BodyState s = stateOf(i);
        s.angularVelocity = rotateInverse(s.orientation, s.angularVelocity);
        return s;
    }
};
/// The scalar last, where it is read first.
struct QuaternionOrder : RigidWorld {
    using RigidWorld::RigidWorld;
    BodyState reported(std::size_t i) const override {
        BodyState s = stateOf(i);
        s.orientation = {s.orientation.x, s.orientation.y, s.orientation.z, s.orientation.w};
        return s;
    }
};
/// The states of the step before: right at the start, a step late ever after.
struct StateDelayed : RigidWorld {
    using RigidWorld::RigidWorld;
    void step() override {
        late_.resize(bodies_.size());
        for (std::size_t i = 0; i < late_.size(); ++i) late_[i] = stateOf(i);
        RigidWorld::step();
    }
    BodyState reported(std::size_t i) const override { return late_.empty() ? stateOf(i) : late_[i]; }
    std::vector<BodyState> late_;
};
struct IdsSwapped : RigidWorld {
    using RigidWorld::RigidWorld;
    BodyState reported(std::size_t i) const override { return stateOf(bodies_.size() - 1 - i); }
};
/// The frame's origin taken for the centre of mass.
struct OriginIsCenter : RigidWorld {
    using RigidWorld::RigidWorld;
    BodyState reported(std::size_t i) const override {
        BodyState s = stateOf(i);
        s.position = bodies_[i].position;
        return s;
    }
};

// ---------------------------------------------------------------------------------------- contacts
struct NormalFlipped : RigidWorld {
    using RigidWorld::RigidWorld;
    ContactPoint reported(const Contact& c) const override {
        ContactPoint p = c.point;
        p.normal = -p.normal;
        return p;
    }
};
/// Every other normal leans by 10 mrad.
struct NormalFlickers : RigidWorld {
    using RigidWorld::RigidWorld;
    ContactPoint reported(const Contact& c) const override {
        ContactPoint p = c.point;
        if (steps_ % 2 == 0) p.normal = rotate(turnedBy({}, {0.01, 0, 0}), p.normal);
        return p;
    }
};
/// Does not report its contacts in one step of four.
struct ContactsBlink : RigidWorld {
    using RigidWorld::RigidWorld;
    void readContacts(std::vector<ContactPoint>& contacts) const override {
        RigidWorld::readContacts(contacts);
        if (steps_ % 4 == 0) contacts.clear();
    }
};
/// Takes every contact for 2 mm deep, and has its points the wrong way round.
struct PointsSwapped : RigidWorld {
    using RigidWorld::RigidWorld;
    ContactPoint reported(const Contact& c) const override {
        ContactPoint p = c.point;
        p.depth = 2e-3;
        p.pointA = p.pointB - p.depth * p.normal;
        return p;
    }
};
struct MomentumLeak : RigidWorld {
    using RigidWorld::RigidWorld;
    Vec3 reaction(const Vec3& impulse) const override { return (1.0 - 1e-6) * impulse; }
};
struct FrictionSquared : RigidWorld {
    using RigidWorld::RigidWorld;
    PairCoefficients coefficients(int a, int b) const override {
        PairCoefficients pair = RigidWorld::coefficients(a, b);
        pair.friction *= pair.friction;
        return pair;
    }
};
struct FrictionPyramid : RigidWorld {
    using RigidWorld::RigidWorld;
    Vec3 limited(const Vec3& impulse, double limit) const override {
        const auto clamp = [limit](double x) { return std::clamp(x, -limit, limit); };
        return {clamp(impulse.x), clamp(impulse.y), clamp(impulse.z)};
    }
};
/// Half a tangent frame taken for the other: friction of the right size, turned by 0.1 rad from the slip.
struct FrictionSideways : RigidWorld {
    using RigidWorld::RigidWorld;
    Vec3 limited(const Vec3& impulse, double limit) const override {
        return rotate(scenario::fromAxisAngle({0, 1, 0}, 0.1), RigidWorld::limited(impulse, limit));
    }
};
template <int Percent>
struct Restitution : RigidWorld {
    using RigidWorld::RigidWorld;
    PairCoefficients coefficients(int a, int b) const override {
        PairCoefficients pair = RigidWorld::coefficients(a, b);
        pair.restitution *= 1.0 + 0.01 * Percent;
        return pair;
    }
};
/// Shapes are found a millimetre late and reported as if they had just touched.
struct ShapesShrunk : RigidWorld {
    using RigidWorld::RigidWorld;
    double gapSeen(double gap) const override { return gap + 1e-3; }
};

// -------------------------------------------------------------------------------------------- rest
/// 0.1 mm/s or 1 mrad/s, in what should rest.
struct Sinking : RigidWorld {
    using RigidWorld::RigidWorld;
    void endOfStep() override { bodies_.back().position += dt_ * Vec3{0, -1e-4, 0}; }
};
struct Creeping : RigidWorld {
    using RigidWorld::RigidWorld;
    void endOfStep() override { bodies_.back().position += dt_ * Vec3{1e-4, 0, 0}; }
};
struct Turning : RigidWorld {
    using RigidWorld::RigidWorld;
    void endOfStep() override {
        auto& q = bodies_.back().orientation;
        q = turnedBy(q, {0, 1e-3 * dt_, 0});
    }
};
struct Jitter : RigidWorld {
    using RigidWorld::RigidWorld;
    BodyState reported(std::size_t i) const override {
        BodyState s = stateOf(i);
        if (isDynamic(i)) s.velocity += Vec3{0, steps_ % 2 == 0 ? 1e-3 : -1e-3, 0};
        return s;
    }
};

// ----------------------------------------------------------------------------------------- the list
template <class W>
std::unique_ptr<World> make(const Scenario& scenario, double dt, const Settings& settings) {
    return std::make_unique<W>(scenario, dt, settings);
}
using Maker = std::unique_ptr<World> (*)(const Scenario&, double, const Settings&);

const std::map<std::string, Maker> kFaults{{"none", &make<RigidWorld>},
                                           {"body_frame_spin", &make<BodyFrameSpin>},
                                           {"compound_inertia", &make<CompoundInertia>},
                                           {"compound_inertia_announced", &make<CompoundInertiaAnnounced>},
                                           {"compound_inertia_hidden", &make<CompoundInertiaHidden>},
                                           {"contacts_blink", &make<ContactsBlink>},
                                           {"creeping", &make<Creeping>},
                                           {"friction_pyramid", &make<FrictionPyramid>},
                                           {"friction_sideways", &make<FrictionSideways>},
                                           {"friction_squared", &make<FrictionSquared>},
                                           {"gravity_double", &make<GravityDouble>},
                                           {"gravity_twice", &make<GravityTwice>},
                                           {"hidden_damping", &make<HiddenDamping>},
                                           {"ids_swapped", &make<IdsSwapped>},
                                           {"inertia_not_rotated", &make<InertiaNotRotated>},
                                           {"jitter", &make<Jitter>},
                                           {"momentum_leak", &make<MomentumLeak>},
                                           {"normal_flickers", &make<NormalFlickers>},
                                           {"normal_flipped", &make<NormalFlipped>},
                                           {"origin_is_center", &make<OriginIsCenter>},
                                           {"own_step", &make<OwnStep>},
                                           {"points_swapped", &make<PointsSwapped>},
                                           {"quaternion_drifts", &make<QuaternionDrifts>},
                                           {"quaternion_order", &make<QuaternionOrder>},
                                           {"restitution_high", &make<Restitution<1>>},
                                           {"restitution_low", &make<Restitution<-1>>},
                                           {"shapes_shrunk", &make<ShapesShrunk>},
                                           {"sinking", &make<Sinking>},
                                           {"state_delayed", &make<StateDelayed>},
                                           {"turning", &make<Turning>},
                                           {"wrong_scheme", &make<WrongScheme>}};

class FaultyDynamics : public DynamicsEngine {
  public:
    std::unique_ptr<World> build(const Scenario& scenario, double dt,
                                 const Settings& settings) const override {
        return kFaults.at(textSetting(settings, "fault"))(scenario, dt, settings);
    }
};

class RigidDouble : public Engine {
  public:
    EngineInfo info() const override { return doubleInfo(); }
    Capabilities capabilities() const override {
        Capabilities c = doubleCapabilities();
        c.dynamics = c.contactImpulses = true;
        c.joints.push_back("hinge.limit");
        return c;
    }
    std::vector<Option> options() const override {
        std::vector<std::string> names;
        for (const auto& [name, maker] : kFaults) names.push_back(name);
        return {{"fault", names, 0.0, 0.0, false, "none", "none", "what is wrong with this engine"}};
    }
    const DynamicsEngine* dynamics() const override { return &dynamics_; }

  private:
    FaultyDynamics dynamics_;
};

std::unique_ptr<Engine> makeRigidDouble() {
    return std::make_unique<RigidDouble>();
}

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeRigidDouble)
