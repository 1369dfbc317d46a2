// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario inside the in-house engine. Bodies are added in the order of the scenario, so that A of a
// contact is the body of lower index on both sides. Read-back comes from the engine's own objects.
#include <algorithm>

#include "adapters/interface/batch.hpp"
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/joint_springs.hpp"
#include "adapters/interface/pair_table.hpp"
#include "adapters/interface/state_setting.hpp"
#include "adapters/rigor/convert_joint.hpp"
#include "adapters/rigor/native_world.hpp"
#include "adapters/rigor/parts.hpp"
#include "adapters/rigor/settings.hpp"
#include "adapters/rigor/staged.hpp"
#include "engine/embedding/world_batch.hpp"
#include "engine/integrators/traits.hpp"
#include "engine/pipeline/world.hpp"

namespace rigor::adapter {
namespace {

using engine::Space2d;
using engine::Space2f;
using engine::Space3d;
using engine::Space3f;

template <class S>
typename S::Ang toEngineAng(const Vec3& v) {
    if constexpr (S::dim == 2)
        return static_cast<typename S::Real>(v.z);
    else
        return toEngineVec<S>(v);
}
template <class R>
Vec3 fromEngineAng(R v) {
    return {0.0, 0.0, static_cast<double>(v)};
}
template <class R>
Vec3 fromEngineAng(const Eigen::Matrix<R, 3, 1>& v) {
    return fromEngineVec(v);
}
template <class R>
Quat fromEngineRot(const engine::Rot2<R>& q) {
    return scenario::fromAxisAngle({0, 0, 1}, std::atan2(static_cast<double>(q.s), static_cast<double>(q.c)));
}
template <class R>
Quat fromEngineRot(const Eigen::Quaternion<R>& q) {
    const Quat raw{static_cast<double>(q.w()), static_cast<double>(q.x()), static_cast<double>(q.y()),
                   static_cast<double>(q.z())};
    return sizeof(R) == sizeof(double) ? raw : scenario::normalized(raw);
}
template <class S>
typename S::Inertia toEngineInertia(const Mat3& m) {
    using R = typename S::Real;
    if constexpr (S::dim == 2) {
        return static_cast<R>(m(2, 2));
    } else {
        typename S::Inertia I;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) I(i, j) = static_cast<R>(m(i, j));
        return I;
    }
}
template <class S>
Mat3 fromEngineInertia(const typename S::Inertia& I) {
    Mat3 m;
    if constexpr (S::dim == 2) {
        m(2, 2) = static_cast<double>(I);
    } else {
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) m(i, j) = static_cast<double>(I(i, j));
    }
    return m;
}

engine::BodyType toEngineType(scenario::BodyType type) {
    switch (type) {
        case scenario::BodyType::Static:
            return engine::BodyType::Static;
        case scenario::BodyType::Kinematic:
            return engine::BodyType::Kinematic;
        case scenario::BodyType::Dynamic:
            break;
    }
    return engine::BodyType::Dynamic;
}

template <class S>
BodyState stateOf(const engine::World<S>& world, engine::BodyId body) {
    const engine::Pose<S> X = world.pose(body);
    return {fromEngineVec(X.p), fromEngineRot(X.q), fromEngineVec(world.velocity(body)),
            fromEngineAng(world.angularVelocity(body))};
}

template <class S>
class RigorWorld final : public World, public StateSetting {
  public:
    using R = typename S::Real;

    RigorWorld(const Scenario& scenario, double dt, const Settings& settings)
        : scenario_(withStiffness(scenario)),
          settings_(settings),
          pairs_(scenario),
          dt_(static_cast<R>(dt)),
          world_(toWorldDef<S>(scenario, settings)) {
        populate();
    }

    void applyForce(int body, const Vec3& force, const Vec3& torque) override {
        if (scenario_.bodies[body].type != scenario::BodyType::Dynamic) return;
        world_.applyForce(id(body), toEngineVec<S>(force), toEngineAng<S>(torque));
    }
    bool evaluatesForces() const override { return true; }
    /// Single-stage integrators take an impulse as every engine does, as a force during one step; to the
    /// others such a force would be an average over the step.
    bool applyImpulse(int body, const Vec3& impulse, const Vec3& angularImpulse) override {
        if (isEuler()) return false;
        world_.applyImpulse(id(body), toEngineVec<S>(impulse), toEngineAng<S>(angularImpulse));
        return true;
    }
    void step() override { world_.step(dt_); }

    void readStates(std::span<BodyState> states) const override {
        for (std::size_t i = 0; i < bodies_.size(); ++i) states[i] = state(i);
    }

    /// The engine moves no body by hand: its world is built anew where it is to be, with empty caches.
    void setStates(std::span<const BodyState> states) override {
        std::vector<bool> holds;
        for (std::size_t j = 0; j < scenario_.joints.size(); ++j) holds.push_back(jointHolds(j));
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            scenario::Body& body = scenario_.bodies[i];
            if (body.type == scenario::BodyType::Static) continue;
            const BodyState now = isDynamic(i) ? states[i] : state(i);
            body.pose = {now.position, now.orientation};
            body.velocity = now.velocity;
            body.angularVelocity = now.angularVelocity;
        }
        elapsed_ += world_.time();
        world_ = engine::World<S>(toWorldDef<S>(scenario_, settings_));
        bodies_.clear();
        indices_ = {};
        populate();
        for (std::size_t j = 0; j < holds.size(); ++j)
            if (!holds[j]) world_.removeJoint(indices_.joint[j]);
    }
    const char* warmStart() const override { return "discarded"; }

    void readContacts(std::vector<ContactPoint>& contacts) const override {
        contacts.clear();
        world_.readContacts(views_);
        for (const engine::ContactView<S>& view : views_) {
            // Found because it was near, but the step did not need it.
            if (view.separation > 0 && view.normalImpulse == 0) continue;
            ContactPoint c;
            c.bodyA = static_cast<int>(view.bodyA.index) - 1;
            c.bodyB = static_cast<int>(view.bodyB.index) - 1;
            c.shapeA = indices_.shape[view.shapeA.index];
            c.shapeB = indices_.shape[view.shapeB.index];
            c.pointA = fromEngineVec(view.pointA);
            c.pointB = fromEngineVec(view.pointB);
            c.normal = fromEngineVec(view.normal);
            c.depth = -static_cast<double>(view.separation);
            c.hasImpulse = true;
            c.normalImpulse = static_cast<double>(view.normalImpulse);
            c.frictionImpulse = fromEngineVec(view.frictionImpulse);
            contacts.push_back(c);
        }
    }

    adapter::ContactInstant contactInstant() const override {
        return world_.contactsAtStepEnd() ? adapter::ContactInstant::StepEnd
                                          : adapter::ContactInstant::StepStart;
    }

    ReadBack readBack() const override {
        ReadBack result;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            const engine::BodyConstants<S>& body = world_.constants(bodies_[i]);
            const bool moves = body.type == engine::BodyType::Dynamic;
            BodyReadBack b;
            b.mass = static_cast<double>(body.mass);
            b.centerOfMass = fromEngineVec(body.centerOfMass);
            b.inertia = fromEngineInertia<S>(body.inertia);
            b.state = state(i);
            if (moves) b.gravity = fromEngineVec(typename S::Vec(body.gravityScale * world_.def().gravity));
            result.bodies.push_back(b);
        }
        for (const PairTable::Example& example : pairs_.examples()) {
            const engine::PairCoefficients<S>& c =
                world_.pairCoefficients(material(example.materialA), material(example.materialB));
            result.pairs.push_back({example.materialA, example.materialB, static_cast<double>(c.friction),
                                    static_cast<double>(c.restitution)});
        }
        return result;
    }

    std::vector<LedgerEntry> ledger() const override {
        bool bounces = false;
        for (const PairTable::Example& m : pairs_.examples())
            bounces = bounces || pairs_.coefficients(m.materialA, m.materialB).restitution > 0;
        return settingsLedger(scenario_, settings_, bounces,
                              static_cast<double>(dt_) / static_cast<double>(world_.substeps()));
    }

    StepCounters counters() const override {
        const engine::StepResult<S>& last = world_.lastStep();
        StepCounters c;
        c.pairTests = last.pairTests;
        c.pairs = last.pairs;
        c.narrowPhaseQueries = static_cast<std::int64_t>(last.narrowPhaseCalls);
        c.contacts = last.contacts;
        c.solverIterations = last.iterations;
        if (!last.residuals.empty()) c.residual = static_cast<double>(last.residuals.back());
        for (std::size_t i = 0; i < engine::kPhases; ++i)
            c.phaseSeconds[engine::phaseName(static_cast<engine::Phase>(i))] = last.seconds[i];
        return c;
    }

    Scheme scheme() const override {
        if (world_.substeps() != 1) return Scheme::Unknown;  // another step than the one reported
        switch (engine::integratorTraits(world_.def().integrator).scheme) {
            case engine::FlightScheme::SymplecticEuler:
                return Scheme::SymplecticEuler;
            case engine::FlightScheme::ExplicitEuler:
                return Scheme::ExplicitEuler;
            case engine::FlightScheme::MoreauMidpoint:
                return Scheme::MoreauMidpoint;
            case engine::FlightScheme::VelocityVerlet:
                return Scheme::VelocityVerlet;
            case engine::FlightScheme::RungeKutta4:
                return Scheme::RungeKutta4;
            case engine::FlightScheme::Other:
                return Scheme::Unknown;
        }
        return Scheme::Unknown;
    }

    bool jointHolds(int joint) const override { return world_.contains(indices_.joint[joint]); }
    bool isAsleep(int body) const override { return isDynamic(body) && world_.isAsleep(id(body)); }
    StagedWorld* staged() override { return &staged_; }
    std::unique_ptr<BatchWorlds> batch(std::size_t worlds, int threads) const;
    NativeWorld<S> native() const { return {world_, bodies_, indices_.joint, materials_}; }
    Snapshots* snapshots() override { return &snapshots_; }

  private:
    engine::BodyId id(int body) const { return body == scenario::kNone ? engine::BodyId{} : bodies_[body]; }
    bool isEuler() const {
        return engine::integratorTraits(world_.def().integrator).forces == engine::ForceTimes::Start;
    }
    bool isDynamic(int body) const {
        return body != scenario::kNone && scenario_.bodies[body].type == scenario::BodyType::Dynamic;
    }
    std::uint32_t material(int index) const { return materials_[static_cast<std::size_t>(index)]; }

    BodyState state(int body) const { return stateOf(world_, id(body)); }

    /// Everything of the scenario into an empty world.
    void populate() {
        addMaterials();
        for (const scenario::Body& body : scenario_.bodies) addBody(body);
        for (const scenario::Joint& joint : scenario_.joints) addJoint(joint);
        for (const scenario::Force& force : scenario_.forces)
            std::visit([this](const auto& f) { this->addForce(f); }, force);
    }

    /// The scenario's pair table, in which pairs that it does not name have sqrt(mu_a mu_b) and min(e_a,
    /// e_b). If another combine rule is requested, those pairs are left to the engine.
    void addMaterials() {
        const bool ownRule = !combinesAsScenarios(settings_);
        const auto named = [&](int a, int b) {
            return std::any_of(scenario_.pairs.begin(), scenario_.pairs.end(), [=](const auto& pair) {
                return std::minmax(pair.a, pair.b) == std::minmax(a, b);
            });
        };
        const int count = scenario_.materials.size();
        for (const scenario::Material& m : scenario_.materials)
            materials_.push_back(world_.addMaterial(toEngineCoefficients(m)));
        for (int a = 0; a < count; ++a)
            for (int b = a; b < count; ++b) {
                if (ownRule && !named(a, b)) continue;
                world_.setPair(material(a), material(b), toEngineCoefficients(pairs_.coefficients(a, b)));
            }
    }
    template <class Surface>
    static engine::PairCoefficients<S> toEngineCoefficients(const Surface& c) {
        return {static_cast<R>(c.friction), static_cast<R>(c.restitution), static_cast<R>(c.staticFriction),
                static_cast<R>(c.rollingFriction), static_cast<R>(c.torsionalFriction)};
    }

    void addBody(const scenario::Body& body) {
        engine::BodyDef<S> def;
        def.type = toEngineType(body.type);
        def.pose = toEnginePose<S>(body.pose);
        def.velocity = toEngineVec<S>(body.velocity);
        def.angularVelocity = toEngineAng<S>(body.angularVelocity);
        def.centerOfMass = toEngineVec<S>(body.massProperties.centerOfMass);
        if (body.type == scenario::BodyType::Dynamic) {
            def.mass = static_cast<R>(body.massProperties.mass);
            def.inertia = toEngineInertia<S>(body.massProperties.inertia);
        }
        def.linearVelocityKept = static_cast<R>(body.linearVelocityKept);
        def.angularVelocityKept = static_cast<R>(body.angularVelocityKept);
        def.gravityScale = static_cast<R>(body.gravityScale);
        def.collides = body.collides;
        const engine::BodyId added = world_.addBody(def);
        bodies_.push_back(added);
        // Shapes of a body that never collides are for its mass and for pictures; the engine needs neither.
        if (!body.collides) return;
        for (std::size_t i = 0; i < body.shapes.size(); ++i) {
            engine::ShapeDef<S> shape;
            shape.shape = toEngineShape<S>(body.shapes[i].geometry);
            shape.pose = toEnginePose<S>(body.shapes[i].pose);
            shape.material = material(body.shapes[i].material);
            const scenario::SurfaceVelocity& surface = body.shapes[i].surfaceVelocity;
            shape.surfaceVelocity = {toEngineVec<S>(surface.linear), toEngineAng<S>(surface.angular)};
            shape.filter = toEngineFilter(body.shapes[i].filter);
            const engine::ShapeId shapeId = world_.addShape(added, shape);
            indices_.shape.resize(shapeId.index + 1);
            indices_.shape[shapeId.index] = i;
        }
    }

    void addJoint(const scenario::Joint& joint) {
        engine::JointDef<S> def;
        def.type = toEngineJoint(joint.type);
        def.bodyA = id(joint.bodyA);
        def.bodyB = id(joint.bodyB);
        def.anchorA = toEngineVec<S>(joint.anchorA);
        def.anchorB = toEngineVec<S>(joint.anchorB);
        def.axisA = toEngineVec<S>(joint.axisA);
        def.axisB = toEngineVec<S>(joint.axisB);
        def.length = static_cast<R>(joint.length);
        def.normalA = toEngineVec<S>(joint.normalA);
        def.spinAxisB = toEngineVec<S>(joint.spinAxisB);
        def.collideConnected = joint.collideConnected;
        for (std::size_t k = 0; k < joint.axes.size(); ++k) def.axes[k] = toEngineAxis<R>(joint.axes[k]);
        def.breakForce = toEngineBound<R>(joint.breakForce);
        def.breakTorque = toEngineBound<R>(joint.breakTorque);
        indices_.joint.push_back(world_.addJoint(def));
    }

    // Forces on bodies that no force moves are for pictures only.
    void addForce(const scenario::ConstantForce& f) {
        if (!isDynamic(f.body) || f.end <= elapsed_) return;
        engine::ConstantForce<S> def;
        def.body = id(f.body);
        def.force = toEngineVec<S>(f.force);
        def.torque = toEngineAng<S>(f.torque);
        def.start = std::max(0.0, f.start - elapsed_);
        def.end = f.end - elapsed_;
        world_.addForce(def);
    }
    void addForce(const scenario::SpringForce& f) {
        if (!isDynamic(f.bodyA) && !isDynamic(f.bodyB)) return;
        engine::LinearSpring<S> def;
        def.bodyA = id(f.bodyA);
        def.bodyB = id(f.bodyB);
        def.anchorA = toEngineVec<S>(f.anchorA);
        def.anchorB = toEngineVec<S>(f.anchorB);
        def.stiffness = static_cast<R>(f.stiffness);
        def.damping = static_cast<R>(f.damping);
        def.restLength = static_cast<R>(f.restLength);
        world_.addForce(def);
    }
    void addForce(const scenario::DragForce& f) {
        if (!isDynamic(f.body)) return;
        world_.addForce(engine::LinearDrag<S>{id(f.body), static_cast<R>(f.coefficient)});
        if (f.quadratic > 0.0)
            world_.addForce(engine::QuadraticDrag<S>{id(f.body), static_cast<R>(f.quadratic)});
    }

    Scenario scenario_;
    Settings settings_;
    PairTable pairs_;
    R dt_;
    double elapsed_ = 0.0;  ///< time when world_ was built anew [s]
    engine::World<S> world_;
    std::vector<std::uint32_t> materials_;  ///< the engine's index of each of the scenario's materials
    std::vector<engine::BodyId> bodies_;
    ScenarioIndices indices_;
    RigorStaged<S> staged_{world_, dt_, indices_};
    RigorSnapshots<S> snapshots_{world_};
    mutable std::vector<engine::ContactView<S>> views_;
};

/// Copies of a world.
template <class S>
class RigorWorlds final : public BatchWorlds {
  public:
    RigorWorlds(const engine::World<S>& world, typename S::Real dt, std::span<const engine::BodyId> bodies,
                std::size_t worlds, int threads)
        : dt_(dt), bodies_(bodies.begin(), bodies.end()), batch_(world, worlds, {threads}) {}
    std::size_t size() const override { return batch_.size(); }
    void step(int steps) override {
        if (!batch_.step(dt_, steps)) std::rethrow_exception(batch_.failures().front().error);
    }
    void readStates(std::size_t world, std::span<BodyState> states) const override {
        for (std::size_t i = 0; i < bodies_.size(); ++i) states[i] = stateOf(batch_.world(world), bodies_[i]);
    }

  private:
    typename S::Real dt_;
    std::vector<engine::BodyId> bodies_;
    engine::WorldBatch<S> batch_;
};

template <class S>
std::unique_ptr<BatchWorlds> RigorWorld<S>::batch(std::size_t worlds, int threads) const {
    return std::make_unique<RigorWorlds<S>>(world_, dt_, bodies_, worlds, threads);
}

void checkBuild(const Scenario& scenario, double dt) {
    checkScenarioInput(scenario, dt);
    checkSupported(scenario, rigorCapabilities(), "rigor");
}

class RigorDynamics final : public BatchingEngine {
  public:
    std::unique_ptr<World> build(const Scenario& scenario, double dt,
                                 const Settings& settings) const override {
        return made<std::unique_ptr<World>>(
            scenario, dt, settings, [](auto world) { return std::unique_ptr<World>(std::move(world)); });
    }
    std::unique_ptr<BatchWorlds> buildBatch(const Scenario& scenario, double dt, const Settings& settings,
                                            std::size_t worlds, int threads) const override {
        return made<std::unique_ptr<BatchWorlds>>(
            scenario, dt, settings, [=](const auto& world) { return world->batch(worlds, threads); });
    }

  private:
    /// `take` of the world in the scenario's dimension and the precision of the settings.
    template <class Result, class Take>
    static Result made(const Scenario& scenario, double dt, const Settings& settings, const Take& take) {
        checkBuild(scenario, dt);
        const bool single = textSetting(settings, "precision") == "f32";
        try {
            if (scenario.dimension == 2) {
                if (single) return take(std::make_unique<RigorWorld<Space2f>>(scenario, dt, settings));
                return take(std::make_unique<RigorWorld<Space2d>>(scenario, dt, settings));
            }
            if (single) return take(std::make_unique<RigorWorld<Space3f>>(scenario, dt, settings));
            return take(std::make_unique<RigorWorld<Space3d>>(scenario, dt, settings));
        } catch (const std::invalid_argument& error) {
            throw BadInput(error.what());
        }
    }
};

}  // namespace

template <class S>
NativeWorld<S> makeNativeWorld(const Scenario& scenario, double dt, const Settings& settings) {
    checkBuild(scenario, dt);
    try {
        return RigorWorld<S>(scenario, dt, settings).native();
    } catch (const std::invalid_argument& error) {
        throw BadInput(error.what());
    }
}
#define RIGOR_INSTANTIATE(S) \
    template NativeWorld<S> makeNativeWorld<S>(const Scenario&, double, const Settings&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

std::unique_ptr<DynamicsEngine> makeRigorDynamics() {
    return std::make_unique<RigorDynamics>();
}

}  // namespace rigor::adapter
