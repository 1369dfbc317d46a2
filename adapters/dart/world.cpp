// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario as a world of DART: building, stepping, snapshots.
#include "adapters/dart/world.hpp"

#include <algorithm>
#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionGroup.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/constraint/DantzigBoxedLcpSolver.hpp>
#include <dart/constraint/PgsBoxedLcpSolver.hpp>
#include <dart/dynamics/FreeJoint.hpp>

#include "adapters/dart/shapes.hpp"
#include "adapters/dart/swing.hpp"
#include "adapters/interface/joint_springs.hpp"
#include "adapters/interface/planar.hpp"
#include "adapters/interface/snapshot_numbers.hpp"

namespace rigor::dart_adapter {

using adapter::BodyState;
using adapter::numberSetting;
using adapter::PairTable;
using scenario::Body;
using scenario::BodyType;

namespace {

/// Velocity of a coordinate at which a run ends [m/s] or [rad/s].
constexpr double kMostVelocity = 1e10;

/// Layers, groups and joints that keep shapes from touching.
class Filter final : public dart::collision::CollisionFilter {
  public:
    Filter(const PairTable& pairs, const Model& model) : pairs_(pairs), model_(model) {}
    bool ignoresCollision(const dart::collision::CollisionObject* one,
                          const dart::collision::CollisionObject* two) const override {
        const PairTable::ShapeRef &a = model_.shapes.at(one->getShapeFrame()),
                                  &b = model_.shapes.at(two->getShapeFrame());
        return a.body == b.body || !pairs_.mayCollide(a.body, b.body) ||
               !pairs_.shapesMayTouch(a.body, a.shape, b.body, b.shape) ||
               !model_.surfaces.mayMeet(one->getShapeFrame(), two->getShapeFrame());
    }

  private:
    const PairTable& pairs_;
    const Model& model_;
};

/// FCL finds contacts with sideways normals where the end faces of two prisms lie in one plane, or the upper one's reach
/// farther (plain_programs/dart/sides.cpp): what stands is made twice as deep as what moves on it.
void deepen(scenario::Geometry& geometry) {
    constexpr double kDeeper = 2.0;
    if (auto* box = std::get_if<scenario::Box>(&geometry)) box->halfExtents.z *= kDeeper;
    if (auto* hull = std::get_if<scenario::ConvexHull>(&geometry))
        for (Vec3& v : hull->vertices) v.z *= kDeeper;
    if (auto* mesh = std::get_if<scenario::TriangleMesh>(&geometry))
        for (Vec3& v : mesh->vertices) v.z *= kDeeper;
}

adapter::Scenario liftedFor(const std::string& narrowPhase, const adapter::Scenario& scenario) {
    adapter::Scenario lifted = adapter::planarLift(scenario);
    if (narrowPhase != "fcl_mesh" && narrowPhase != "fcl_primitive") return lifted;
    for (Body& body : lifted.bodies)
        if (body.type != BodyType::Dynamic)
            for (scenario::Shape& shape : body.shapes) deepen(shape.geometry);
    return lifted;
}

}  // namespace

DartWorld::DartWorld(const adapter::Scenario& scenario, double dt, const adapter::Settings& settings)
    : scenario_(adapter::withStiffness(
          scenario.dimension == 2 ? liftedFor(adapter::textSetting(settings, "narrow_phase"), scenario)
                                  : scenario)),
      settings_(settings),
      dt_(dt),
      planar_(scenario.dimension == 2),
      pairs_(scenario_),
      model_(buildModel(scenario_, planar_, adapter::textSetting(settings, "narrow_phase"))) {
    stabilisation_ = {number("contact_erp"), number("contact_max_speed"), number("contact_cfm"),
                      number("joint_erp"),   number("joint_max_speed"),   number("joint_cfm")};
    world_ = dart::simulation::World::create("scenario");
    world_->setTimeStep(dt);
    world_->setGravity(toDart(scenario_.gravity));
    makeSolver();
    for (const Body& body : scenario_.bodies)
        prescribed_.push_back(
            {body.pose.position, body.pose.orientation, body.velocity, body.angularVelocity});
    for (const int body : model_.forest.order) placeBody(model_, scenario_, body, prescribed_);
    for (const int joint : model_.forest.loops)
        model_.loops.emplace_back(scenario_, joint, model_.forest, model_.bodies, planar_);
    // FCL's trees are built where the shapes stand when they are added.
    for (const auto& skeleton : model_.skeletons) world_->addSkeleton(skeleton);
    useJointsThatHold();
    group_ = solver_->takeGroup();
    option_.enableContact = true;
    option_.maxNumContacts = static_cast<std::size_t>(adapter::integerSetting(settings_, "max_contacts"));
    option_.collisionFilter = std::make_shared<Filter>(pairs_, model_);
    forces_.resize(scenario_.bodies.size());
    before_.resize(scenario_.bodies.size());
}

bool DartWorld::is(const char* key, const char* value) const {
    return adapter::textSetting(settings_, key) == value;
}
double DartWorld::number(const char* key) const {
    return numberSetting(settings_, key);
}

/// As DART has them by itself: Dantzig's method, and projected Gauss-Seidel where that fails.
void DartWorld::makeSolver() {
    using namespace dart::constraint;
    const auto pgs = std::make_shared<PgsBoxedLcpSolver>();
    PgsBoxedLcpSolver::Option option;
    option.mMaxIteration = adapter::integerSetting(settings_, "pgs_iterations");
    pgs->setOption(option);
    std::unique_ptr<PairwiseSolver> solver;
    if (is("solver", "dantzig"))
        solver = std::make_unique<PairwiseSolver>(std::make_shared<DantzigBoxedLcpSolver>(), pgs);
    else
        solver = std::make_unique<PairwiseSolver>(pgs, nullptr);
    solver->setCollisionDetector(makeDetector(adapter::textSetting(settings_, "narrow_phase")));
    solver_ = solver.get();
    world_->setConstraintSolver(std::move(solver));
}

void DartWorld::applyForce(int body, const Vec3& force, const Vec3& torque) {
    if (scenario_.bodies[body].type != BodyType::Dynamic) return;
    forces_[body].force += force;
    forces_[body].torque += torque;
}

void DartWorld::addSwingSprings() {
    const auto of = [&](int body) { return body == kNone ? BodyState{} : stateOf(body); };
    for (std::size_t j = 0; j < scenario_.joints.size(); ++j) {
        const scenario::Joint& joint = scenario_.joints[j];
        if (!hasSwingSpring(joint) || !jointHolds(static_cast<int>(j))) continue;
        const Vec3 torque = swingTorque(joint, of(joint.bodyA), of(joint.bodyB));
        if (joint.bodyA != kNone) applyForce(joint.bodyA, {}, -torque);
        applyForce(joint.bodyB, {}, torque);
        for (LoopJoint& loop : model_.loops)
            if (loop.joint() == static_cast<int>(j)) loop.setSpringTorque(norm(torque));
    }
}

/// Forces of the step, springs of swings, gravity of bodies that have their own, and damping.
void DartWorld::applyForces() {
    addSwingSprings();
    for (std::size_t b = 0; b < scenario_.bodies.size(); ++b) {
        const Body& body = scenario_.bodies[b];
        if (body.type != BodyType::Dynamic) continue;
        Wrench& wrench = forces_[b];
        if (body.gravityScale != 1.0)
            wrench.force += body.massProperties.mass * body.gravityScale * scenario_.gravity;
        if (body.linearVelocityKept != 1.0 || body.angularVelocityKept != 1.0) {
            const adapter::Damping damping =
                adapter::dampingOf(body, model_.forest.links[b], stateOf(static_cast<int>(b)), dt_);
            wrench.force += damping.force;
            wrench.torque += damping.torque;
        }
        if (norm(wrench.force) > 0.0) model_.bodies[b]->addExtForce(toDart(wrench.force));
        if (norm(wrench.torque) > 0.0) model_.bodies[b]->addExtTorque(toDart(wrench.torque));
        wrench = {};
    }
}

/// Commands of motors and of kinematic bodies, which DART forgets after each step.
void DartWorld::drive() {
    for (const auto& [joint, speed] : model_.motors) joint->setCommand(0, speed);
    for (std::size_t b = 0; b < scenario_.bodies.size(); ++b) {
        if (scenario_.bodies[b].type != BodyType::Kinematic) continue;
        dart::dynamics::Joint& joint = *model_.bodies[b]->getParentJoint();
        joint.setCommands(joint.getVelocities());
    }
}

/// DART takes the lesser friction of two shapes and the product of their restitutions.
void DartWorld::setCoefficients(const dart::dynamics::ShapeFrame& one,
                                const dart::dynamics::ShapeFrame& two) const {
    const auto materialOf = [&](const dart::dynamics::ShapeFrame& frame) {
        const PairTable::ShapeRef& shape = model_.shapes.at(&frame);
        return scenario_.bodies[shape.body].shapes[shape.shape].material;
    };
    const auto aspectOf = [](const dart::dynamics::ShapeFrame& frame) {
        return const_cast<dart::dynamics::ShapeFrame&>(frame).getDynamicsAspect();
    };
    const scenario::PairCoefficients& pair = pairs_.coefficients(materialOf(one), materialOf(two));
    auto *first = aspectOf(one), *second = aspectOf(two);
    for (auto* aspect : {first, second})
        if (aspect->getFrictionCoeff() != pair.friction) aspect->setFrictionCoeff(pair.friction);
    if (first->getRestitutionCoeff() != pair.restitution) first->setRestitutionCoeff(pair.restitution);
    if (second->getRestitutionCoeff() != 1.0) second->setRestitutionCoeff(1.0);
}

/// False where no joint lets the two bodies of a contact come nearer or apart: its row of the problem is zero, which ends
/// in an assertion of DART that numbers are none.
bool DartWorld::movable(const dart::collision::Contact& contact) const {
    const auto bodyOf = [&](const dart::collision::CollisionObject* object) {
        return model_.bodies[model_.shapes.at(object->getShapeFrame()).body];
    };
    const auto *one = bodyOf(contact.collisionObject1), *two = bodyOf(contact.collisionObject2);
    const dart::dynamics::ConstSkeletonPtr skeleton = one->getSkeleton();
    if (skeleton != two->getSkeleton()) return true;
    const Eigen::RowVectorXd row =
        contact.normal.transpose() *
        (skeleton->getLinearJacobian(one, one->getWorldTransform().inverse() * contact.point) -
         skeleton->getLinearJacobian(two, two->getWorldTransform().inverse() * contact.point));
    return row.norm() > 1e-9;
}

/// DART's own solver takes the same ones, but for those that push through a surface.
bool DartWorld::isContact(const dart::collision::Contact& contact) const {
    return !dart::collision::Contact::isZeroNormal(contact.normal) && contact.penetrationDepth >= 0.0 &&
           model_.surfaces.pushesOut(contact);
}

void DartWorld::findContacts() {
    auto& constraints = solver_->beginContacts();
    found_.clear();
    group_->collide(option_, &found_);
    for (std::size_t i = 0; i < found_.getNumContacts(); ++i) {
        dart::collision::Contact& contact = found_.getContact(i);
        if (!isContact(contact) || !movable(contact)) continue;
        setCoefficients(*contact.collisionObject1->getShapeFrame(),
                        *contact.collisionObject2->getShapeFrame());
        constraints.push_back(std::make_shared<dart::constraint::ContactConstraint>(contact, dt_));
    }
}

/// DART breaks no joint: after a step in which one has borne more than its strength its constraints are left out.
void DartWorld::breakJoints() {
    bool any = false;
    for (LoopJoint& joint : model_.loops) {
        if (!joint.holds() || !joint.isOverloaded(dt_)) continue;
        joint.setHolds(false);
        any = true;
    }
    if (any) useJointsThatHold();
}

/// Bodies that a joint kept from colliding collide once it has broken.
void DartWorld::useJointsThatHold() {
    std::vector<dart::constraint::ConstraintBasePtr> constraints;
    for (const LoopJoint& joint : model_.loops)
        if (joint.holds())
            constraints.insert(constraints.end(), joint.constraints().begin(), joint.constraints().end());
    solver_->setJoints(std::move(constraints));
    pairs_.keepApart(scenario_, [&](std::size_t joint) { return jointHolds(static_cast<int>(joint)); });
}

bool DartWorld::jointHolds(int joint) const {
    return std::all_of(model_.loops.begin(), model_.loops.end(),
                       [&](const LoopJoint& loop) { return loop.joint() != joint || loop.holds(); });
}

/// A few steps later such numbers are none, at which DART's assertions end the process.
bool DartWorld::escaped() const {
    return std::any_of(model_.skeletons.begin(), model_.skeletons.end(), [](const auto& skeleton) {
        return !(skeleton->getVelocities().template lpNorm<Eigen::Infinity>() < kMostVelocity) &&
               skeleton->getNumDofs() > 0;
    });
}

void DartWorld::step() {
    if (escaped_) return;
    stabilisation_.use();
    for (std::size_t b = 0; b < before_.size(); ++b) {
        const BodyState state = stateOf(static_cast<int>(b));
        before_[b] = {state.position, state.orientation};
    }
    applyForces();
    drive();
    findContacts();
    world_->step();
    breakJoints();
    moveKinematic();
    escaped_ = escaped();
}

/// Kinematic bodies move exactly with their velocities.
void DartWorld::moveKinematic() {
    for (std::size_t b = 0; b < scenario_.bodies.size(); ++b) {
        if (scenario_.bodies[b].type != BodyType::Kinematic) continue;
        BodyState& state = prescribed_[b];
        state.position += dt_ * state.velocity;
        const double rate = norm(state.angularVelocity);
        if (rate > 0.0)
            state.orientation = normalized(scenario::fromAxisAngle(state.angularVelocity / rate, rate * dt_) *
                                           state.orientation);
        placeBody(model_, scenario_, static_cast<int>(b), prescribed_);
    }
}

void DartWorld::setStates(std::span<const BodyState> states) {
    std::vector<BodyState> all(scenario_.bodies.size());
    readStates(all);
    for (std::size_t i = 0; i < all.size(); ++i)
        if (scenario_.bodies[i].type == BodyType::Dynamic) all[i] = states[i];
    for (const int body : model_.forest.order)
        if (scenario_.bodies[body].type == BodyType::Dynamic) placeBody(model_, scenario_, body, all);
}

/// FCL's trees of boxes remember where the shapes have been, so that contacts come in another order after a restore.
adapter::Snapshots* DartWorld::snapshots() {
    return is("narrow_phase", "ode") || is("narrow_phase", "dart") ? this : nullptr;
}

void DartWorld::save(std::vector<unsigned char>& bytes) const {
    adapter::NumberWriter out(bytes);
    const auto putAll = [&](const Eigen::VectorXd& values) {
        out.put(std::span(values.data(), static_cast<std::size_t>(values.size())));
    };
    for (const auto& skeleton : model_.skeletons) {
        putAll(skeleton->getPositions());
        putAll(skeleton->getVelocities());
    }
    for (const BodyState& state : prescribed_) {
        out.put(state.position);
        out.put(state.orientation);
    }
    for (const Wrench& wrench : forces_) {
        out.put(wrench.force);
        out.put(wrench.torque);
    }
    for (const LoopJoint& joint : model_.loops) out.put(joint.holds() ? 1.0 : 0.0);
}

bool DartWorld::restore(const std::vector<unsigned char>& bytes) {
    std::vector<unsigned char> now;
    save(now);
    if (bytes.size() != now.size()) return false;
    adapter::NumberReader in(bytes);
    for (const auto& skeleton : model_.skeletons) {
        Eigen::VectorXd values(static_cast<Eigen::Index>(skeleton->getNumDofs()));
        const std::span all(values.data(), skeleton->getNumDofs());
        in.take(all);
        skeleton->setPositions(values);
        in.take(all);
        skeleton->setVelocities(values);
    }
    for (BodyState& state : prescribed_) {
        state.position = in.takeVector();
        state.orientation = in.takeQuat();
    }
    for (Wrench& wrench : forces_) {
        wrench.force = in.takeVector();
        wrench.torque = in.takeVector();
    }
    for (LoopJoint& joint : model_.loops) joint.setHolds(in.take() != 0.0);
    useJointsThatHold();
    escaped_ = false;
    return true;
}

}  // namespace rigor::dart_adapter
