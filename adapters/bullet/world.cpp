// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario as a btDiscreteDynamicsWorld: building and stepping. Bullet's body frame is the centre-of-mass
// frame with principal axes, so every pose, shape and anchor goes through BodyRecord::comFrame.
#include "adapters/bullet/world.hpp"

#include <BulletDynamics/ConstraintSolver/btNNCGConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btLemkeSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>
#include <BulletDynamics/MLCPSolvers/btSolveProjectedGaussSeidel.h>

#include <algorithm>

#include "adapters/bullet/convert.hpp"
#include "adapters/bullet/joints.hpp"
#include "adapters/interface/joint_springs.hpp"
#include "adapters/interface/planar.hpp"
#include "adapters/interface/principal_axes.hpp"
#include "adapters/interface/reach.hpp"

namespace rigor::bullet {

using adapter::BodyState;
using adapter::numberSetting;
using adapter::Scenario;
using adapter::Settings;
using scenario::BodyType;

/// Decides for Bullet whether two overlapping boxes are a pair.
class BulletWorld::PairFilter final : public btOverlapFilterCallback {
  public:
    explicit PairFilter(const adapter::PairTable& table) : table_(table) {}
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
        const auto bodyOf = [](const btBroadphaseProxy* proxy) {
            const auto* object = static_cast<const btCollisionObject*>(proxy->m_clientObject);
            return static_cast<const BodyTag*>(object->getUserPointer())->body;
        };
        return table_.mayCollide(bodyOf(a), bodyOf(b));
    }

  private:
    const adapter::PairTable& table_;
};

namespace {

int gyroscopicFlags(const std::string& treatment) {
    if (treatment == "explicit") return BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT;
    if (treatment == "implicit_world") return BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD;
    if (treatment == "implicit_body") return BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY;
    return 0;  // no gyroscopic torque by Bullet
}

/// Bullet's own pools of contact manifolds and algorithms, but no larger than the pairs of shapes can fill. Bullet writes
/// the whole of a pool when it makes it: 4096 of each take longer than many a scene of a few bodies.
btDefaultCollisionConstructionInfo poolsFor(const Scenario& scenario) {
    btDefaultCollisionConstructionInfo info;
    std::size_t shapes = 1;  // the ground has one
    for (const auto& body : scenario.bodies) shapes += std::max<std::size_t>(1, body.shapes.size());
    constexpr std::size_t kSpare = 64;  // algorithms of compounds, and those made for a moment
    const std::size_t most = shapes * shapes + kSpare;
    const auto bounded = [most](int size) {
        return static_cast<int>(std::min(most, static_cast<std::size_t>(size)));
    };
    info.m_defaultMaxPersistentManifoldPoolSize = bounded(info.m_defaultMaxPersistentManifoldPoolSize);
    info.m_defaultMaxCollisionAlgorithmPoolSize = bounded(info.m_defaultMaxCollisionAlgorithmPoolSize);
    return info;
}

}  // namespace

BulletWorld::BulletWorld(const Scenario& scenario, double dt, const Settings& settings)
    : original_(scenario),
      scenario_(adapter::withStiffness(scenario.dimension == 2 ? adapter::planarLift(scenario) : scenario)),
      settings_(settings),
      dt_(dt),
      planar_(scenario.dimension == 2),
      externalGyro_(!planar_ && is("gyroscopic", "external")),
      pairs_(scenario_) {
    installContactCallback();
    createPipeline();
    configureSolver();
    linked_.resize(scenario_.bodies.size());
    if (is("articulation", "multibody")) linked_ = Articulations::linkedBodies(scenario_);
    for (int i = 0; i < static_cast<int>(scenario_.bodies.size()); ++i) addBody(i);
    groundShape_ = std::make_unique<btEmptyShape>();
    ground_ = std::make_unique<btRigidBody>(btScalar(0.0), nullptr, groundShape_.get());
    if (is("articulation", "multibody"))
        articulate();
    else
        for (const auto& joint : scenario_.joints) addJoint(joint);
}

BulletWorld::~BulletWorld() {
    for (auto& joint : joints_)
        for (auto& part : joint->built.parts) world_->removeConstraint(part.get());
    articulations_.reset();
    for (auto& record : records_)
        if (!record->linked) world_->removeRigidBody(record->body.get());
}

bool BulletWorld::is(const std::string& key, const std::string& value) const {
    return adapter::textSetting(settings_, key) == value;
}

void BulletWorld::createPipeline() {
    configuration_ = std::make_unique<btDefaultCollisionConfiguration>(poolsFor(scenario_));
    dispatcher_ = std::make_unique<btCollisionDispatcher>(configuration_.get());
    if (is("broadphase", "simple")) {
        broadphase_ = std::make_unique<btSimpleBroadphase>(static_cast<int>(scenario_.bodies.size()) + 1);
    } else if (is("broadphase", "axis_sweep_3")) {
        const btVector3 bound(10000, 10000, 10000);
        broadphase_ = std::make_unique<bt32BitAxisSweep3>(
            -bound, bound, static_cast<unsigned>(scenario_.bodies.size()) + 1u);
    } else {
        broadphase_ = std::make_unique<btDbvtBroadphase>();
    }
    filter_ = std::make_unique<PairFilter>(pairs_);
    broadphase_->getOverlappingPairCache()->setOverlapFilterCallback(filter_.get());
    createSolver();
    if (is("articulation", "multibody"))
        world_ = std::make_unique<btMultiBodyDynamicsWorld>(
            dispatcher_.get(), broadphase_.get(), static_cast<btMultiBodyConstraintSolver*>(solver_.get()),
            configuration_.get());
    else
        world_ = std::make_unique<btDiscreteDynamicsWorld>(dispatcher_.get(), broadphase_.get(),
                                                           solver_.get(), configuration_.get());
    world_->setGravity(toBullet(scenario_.gravity));
    world_->setInternalTickCallback(&BulletWorld::beforeStep, this, true);
    world_->getDispatchInfo().m_enableSatConvex = is("sat", "on");
}

void BulletWorld::createSolver() {
    const std::string& name = adapter::textSetting(settings_, "solver");
    if (is("articulation", "multibody")) {
        if (name != "si") throw adapter::notInAdapter("bullet", "btMultiBody with a solver other than si");
        solver_ = std::make_unique<btMultiBodyConstraintSolver>();
        return;
    }
    if (name == "mlcp_dantzig")
        mlcp_ = std::make_unique<btDantzigSolver>();
    else if (name == "mlcp_pgs")
        mlcp_ = std::make_unique<btSolveProjectedGaussSeidel>();
    else if (name == "mlcp_lemke")
        mlcp_ = std::make_unique<btLemkeSolver>();
    if (mlcp_) {
        auto solver = std::make_unique<btMLCPSolver>(mlcp_.get());
        mlcpSolver_ = solver.get();
        solver_ = std::move(solver);
    } else if (name == "nncg") {
        solver_ = std::make_unique<btNNCGConstraintSolver>();
    } else {
        solver_ = std::make_unique<btSequentialImpulseConstraintSolver>();
    }
}

void BulletWorld::configureSolver() {
    btContactSolverInfo& info = world_->getSolverInfo();
    const auto number = [&](const char* key) { return static_cast<btScalar>(numberSetting(settings_, key)); };
    info.m_numIterations = adapter::integerSetting(settings_, "iterations");
    info.m_erp = number("erp");
    info.m_erp2 = number("contact_erp");
    info.m_globalCfm = number("cfm");
    info.m_linearSlop = number("linear_slop");
    info.m_splitImpulse = is("split_impulse", "on");
    info.m_splitImpulsePenetrationThreshold = number("split_impulse_threshold");
    info.m_restitutionVelocityThreshold = number("restitution_threshold");
    // A factor of 0 and not the absent flag: without the flag Bullet does not store impulses either.
    info.m_solverMode |= SOLVER_USE_WARMSTARTING;
    info.m_warmstartingFactor = number("warm_starting");
    if (is("friction_directions", "2")) info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    if (is("friction_axis", "fixed"))
        info.m_solverMode |= SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
    // Bullet looks at a point's own directions only then (contact_rules.cpp, moving surfaces).
    const auto moves = [](const scenario::Shape& shape) { return shape.surfaceVelocity.moves(); };
    for (const scenario::Body& body : scenario_.bodies)
        if (std::any_of(body.shapes.begin(), body.shapes.end(), moves))
            info.m_solverMode |= SOLVER_ENABLE_FRICTION_DIRECTION_CACHING;
    // A direct solver's matrix should hold one island, not a batch of them.
    if (mlcpSolver_ != nullptr) info.m_minimumSolverBatchSize = 1;
}

ShapeSettings BulletWorld::shapeSettings() const {
    ShapeSettings shapes;
    shapes.polyhedralFeatures = is("sat", "on");
    shapes.boxMargin = numberSetting(settings_, "box_margin");
    shapes.cylinderMargin = numberSetting(settings_, "cylinder_margin");
    shapes.hullMargin = numberSetting(settings_, "hull_margin");
    shapes.halfSpaceAsBox = is("half_space", "box");
    shapes.internalEdges = is("internal_edges", "on");
    // Single precision resolves 3e-5 m at 500 m, so the box stays no larger than it has to be.
    const double most = sizeof(btScalar) == sizeof(double) ? 5000.0 : 500.0;
    const adapter::Reach reach = adapter::reachOf(scenario_, 50.0, most);
    shapes.halfSpaceCenter = reach.middle;
    shapes.halfSpaceReach = reach.distance;
    return shapes;
}

void BulletWorld::addBody(int index) {
    const scenario::Body& body = scenario_.bodies[index];
    const bool dynamic = body.type == BodyType::Dynamic;
    auto record = std::make_unique<BodyRecord>();
    btVector3 moments(0, 0, 0);
    record->comFrame.position = body.massProperties.centerOfMass;
    if (dynamic) {
        const adapter::PrincipalAxes principal = adapter::principalAxes(body.massProperties.inertia);
        record->comFrame.orientation = principal.axes;
        moments = toBullet(principal.moments);
    }
    record->shape = std::make_unique<BodyShape>(body, record->comFrame, shapeSettings());
    record->tag.table = &pairs_;
    record->tag.body = index;
    record->tag.frame = inverse(record->comFrame);
    if (std::any_of(body.shapes.begin(), body.shapes.end(),
                    [](const scenario::Shape& shape) { return shape.surfaceVelocity.moves(); }))
        record->tag.source = &body;
    for (const auto& shape : body.shapes) record->tag.materials.push_back(shape.material);
    if (record->tag.materials.empty()) record->tag.materials.push_back(0);

    btRigidBody::btRigidBodyConstructionInfo info(
        dynamic ? static_cast<btScalar>(body.massProperties.mass) : btScalar(0.0), nullptr,
        record->shape->get(), moments);
    info.m_startWorldTransform = toBullet(body.pose * record->comFrame);
    // v *= (1 - d)^dt: the format's "kept per second" is 1 - d.
    info.m_linearDamping = static_cast<btScalar>(1.0 - body.linearVelocityKept);
    info.m_angularDamping = static_cast<btScalar>(1.0 - body.angularVelocityKept);
    record->body = std::make_unique<btRigidBody>(info);
    btRigidBody& rigid = *record->body;
    rigid.setUserPointer(&record->tag);
    rigid.setCollisionFlags(rigid.getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    if (body.type == BodyType::Kinematic) {
        rigid.setCollisionFlags(rigid.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
        record->velocity = toBullet(body.velocity);
        record->angularVelocity = toBullet(body.angularVelocity);
    }
    if (body.type != BodyType::Static) {
        rigid.setLinearVelocity(toBullet(body.velocity));
        rigid.setAngularVelocity(toBullet(body.angularVelocity));
    }
    if (!is("sleeping", "on") || body.type == BodyType::Kinematic)
        rigid.setActivationState(DISABLE_DEACTIVATION);
    rigid.setFlags(planar_ ? 0 : gyroscopicFlags(adapter::textSetting(settings_, "gyroscopic")));
    if (is("speculative_contacts", "by_restitution"))
        rigid.setContactProcessingThreshold(pairs_.mayBounce(index) ? btScalar(0.0) : btScalar(1e-4));
    if (planar_) {
        rigid.setLinearFactor(btVector3(1, 1, 0));
        rigid.setAngularFactor(btVector3(0, 0, 1));
    }
    record->linked = linked_[index];
    if (record->linked) {
        records_.push_back(std::move(record));
        return;
    }
    world_->addRigidBody(&rigid);
    // Set after adding the body: the world overwrites a body's own gravity.
    if (dynamic) rigid.setGravity(toBullet(body.gravityScale * scenario_.gravity));
    records_.push_back(std::move(record));
}

void BulletWorld::addJoint(const scenario::Joint& joint) {
    const auto endOf = [&](int index) {
        if (index == scenario::kNone) return JointEnd{ground_.get(), {}, {}, nullptr};
        const BodyRecord& record = *records_[index];
        const scenario::Body& body = scenario_.bodies[index];
        return JointEnd{record.body.get(), record.comFrame, body.pose, &body};
    };
    const auto moved = [&](int index) {
        return index != scenario::kNone && scenario_.bodies[index].type == BodyType::Kinematic;
    };
    const bool weighted =
        is("frame_offset", "by_body") ? !moved(joint.bodyA) && !moved(joint.bodyB) : is("frame_offset", "on");
    const JointSettings settings{dt_, weighted, is("spring_limits", "on")};
    auto record = std::make_unique<JointRecord>();
    record->built = buildJoint(joint, endOf(joint.bodyA), endOf(joint.bodyB), settings);
    setBreaking(joint, *record);
    // The pair filter decides whether the two collide.
    for (const auto& part : record->built.parts) world_->addConstraint(part.get(), false);
    joints_.push_back(std::move(record));
}

/// Bullet's own threshold is one impulse that no row may reach, be it of a force along one axis of the joint
/// or of a torque; the feedback gives force and torque as vectors.
void BulletWorld::setBreaking(const scenario::Joint& joint, JointRecord& record) {
    const bool byForce = joint.breakForce < 1e299, byTorque = joint.breakTorque < 1e299;
    if (!byForce && !byTorque) return;
    if (is("breaking", "impulse_threshold") && !byTorque) {
        for (const auto& part : record.built.parts)
            part->setBreakingImpulseThreshold(static_cast<btScalar>(joint.breakForce * dt_));
        return;
    }
    record.watched = true;
    record.feedback.resize(record.built.parts.size());
    for (std::size_t i = 0; i < record.feedback.size(); ++i)
        record.built.parts[i]->setJointFeedback(&record.feedback[i]);
}

bool BulletWorld::JointRecord::holds() const {
    return std::all_of(built.parts.begin(), built.parts.end(),
                       [](const auto& part) { return part->isEnabled(); });
}

/// Follows Bullet's threshold: a joint that broke in this step does not act from the next one on; if one part
/// breaks, all do.
void BulletWorld::breakJoints() {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        JointRecord& record = *joints_[i];
        const auto release = [&] {
            for (const auto& part : record.built.parts) part->setEnabled(false);
        };
        if (!record.holds()) {
            release();
            continue;
        }
        if (!record.watched) continue;
        const scenario::Joint& joint = scenario_.joints[i];
        Vec3 force, torque;
        for (const btJointFeedback& feedback : record.feedback) {
            force += fromBullet(feedback.m_appliedForceBodyB);
            torque += fromBullet(feedback.m_appliedTorqueBodyB);
        }
        const auto b = static_cast<std::size_t>(joint.bodyB);
        const BodyRecord& body = *records_[b];
        const Pose pose = fromBullet(body.body->getWorldTransform()) * inverse(body.comFrame);
        const Vec3 arm = pose * joint.anchorB - fromBullet(body.body->getWorldTransform().getOrigin());
        torque = torque - cross(arm, force);
        if (planar_) {
            force.z = 0.0;
            torque.x = torque.y = 0.0;
        }
        if (norm(force) > joint.breakForce || norm(torque) > joint.breakTorque) release();
    }
}

adapter::Scheme BulletWorld::scheme() const {
    const bool other = articulations_ && is("multibody_integrator", "rk4");
    return other ? adapter::Scheme::Unknown : adapter::Scheme::SymplecticEuler;
}

bool BulletWorld::jointHolds(int joint) const {
    return articulations_ || joints_[joint]->holds();
}

void BulletWorld::articulate() {
    std::vector<Articulations::LinkSource> sources;
    for (const auto& record : records_)
        sources.push_back({record->comFrame, record->body->getLocalInertia(), record->shape->get(),
                           &record->tag, record->body->getContactProcessingThreshold()});
    ArticulationSettings settings;
    settings.dt = dt_;
    // Rounded as the library's own default is, a float literal in either precision.
    settings.damping = static_cast<float>(numberSetting(settings_, "multibody_damping"));
    settings.maximalVelocity = numberSetting(settings_, "multibody_velocity_limit");
    settings.rungeKutta = is("multibody_integrator", "rk4");
    settings.gyroscopic = !is("gyroscopic", "none");
    settings.maySleep = is("sleeping", "on");
    settings.planar = planar_;
    articulations_ = std::make_unique<Articulations>(
        scenario_, std::move(sources), static_cast<btMultiBodyDynamicsWorld&>(*world_), settings);
}

/// The world pulls at every link alike.
void BulletWorld::pullScaledGravity() {
    for (std::size_t i = 0; i < records_.size(); ++i) {
        const scenario::Body& body = scenario_.bodies[i];
        if (!records_[i]->linked || body.gravityScale == 1.0) continue;
        const Vec3 rest = (body.massProperties.mass * (body.gravityScale - 1.0)) * scenario_.gravity;
        articulations_->addForce(i, toBullet(rest), btVector3(0, 0, 0));
    }
}

void BulletWorld::applyForce(int body, const Vec3& force, const Vec3& torque) {
    if (records_[body]->linked) {
        articulations_->addForce(body, toBullet(force), toBullet(torque));
        return;
    }
    btRigidBody& rigid = *records_[body]->body;
    if (rigid.isStaticOrKinematicObject()) return;
    rigid.activate();
    rigid.applyCentralForce(toBullet(force));
    rigid.applyTorque(toBullet(torque));
}

void BulletWorld::step() {
    std::vector<btMatrix3x3> bases;
    if (externalGyro_)
        for (const auto& record : records_) bases.push_back(record->body->getWorldTransform().getBasis());
    if (articulations_) {
        pullScaledGravity();
        articulations_->pullSprings();
    }
    // Zero sub-steps allowed means: exactly one step of this length.
    world_->stepSimulation(static_cast<btScalar>(dt_), 0);
    if (articulations_) articulations_->update();
    breakJoints();
    moveKinematicBodies();
    if (externalGyro_) turnAngularMomenta(bases);
    ++steps_;
}

/// Bullet derives a kinematic body's velocity from its last two poses before this callback; its own constant
/// velocity is set here, so that friction uses it while the pose is still that of the start of the step.
void BulletWorld::beforeStep(btDynamicsWorld* world, btScalar) {
    auto& self = *static_cast<BulletWorld*>(world->getWorldUserInfo());
    for (auto& record : self.records_) {
        if (!record->body->isKinematicObject()) continue;
        record->body->setLinearVelocity(record->velocity);
        record->body->setAngularVelocity(record->angularVelocity);
    }
    for (const auto& joint : self.joints_) {
        for (const SwingSpring& spring : joint->built.swingSprings) spring.update();
        for (const Damper& damper : joint->built.dampers) damper.update();
        for (TurnLimit& limit : joint->built.turnLimits) limit.update();
    }
}

void BulletWorld::moveKinematicBodies() {
    for (auto& record : records_) {
        btRigidBody& body = *record->body;
        if (!body.isKinematicObject()) continue;
        btTransform next;
        btTransformUtil::integrateTransform(body.getWorldTransform(), record->velocity,
                                            record->angularVelocity, static_cast<btScalar>(dt_), next);
        body.setWorldTransform(next);
        body.setInterpolationWorldTransform(next);
    }
}

/// gyroscopic=external: w := I(R1)^-1 I(R0) w keeps the angular momentum of a free body exactly.
void BulletWorld::turnAngularMomenta(const std::vector<btMatrix3x3>& basesBefore) {
    for (std::size_t i = 0; i < records_.size(); ++i) {
        btRigidBody& body = *records_[i]->body;
        if (records_[i]->linked || body.isStaticOrKinematicObject() || !body.isActive()) continue;
        const btVector3 inertia = body.getLocalInertia(), inverseInertia = body.getInvInertiaDiagLocal();
        const btMatrix3x3& before = basesBefore[i];
        const btMatrix3x3& after = body.getWorldTransform().getBasis();
        const btVector3 momentum = before * (inertia * (before.transpose() * body.getAngularVelocity()));
        body.setAngularVelocity(after * (inverseInertia * (after.transpose() * momentum)));
    }
}

}  // namespace rigor::bullet
