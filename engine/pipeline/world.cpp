// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/world.hpp"

#include <algorithm>
#include "engine/math/decompositions.hpp"

#include "engine/ccd/traits.hpp"
#include "engine/integrators/traits.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/traits.hpp"
#include "engine/shapes/surface.hpp"
#include "engine/solvers/traits.hpp"
#include "engine/state/settings.hpp"

namespace rigor::engine {
namespace {

void require(bool ok, const char* id, const char* message) {
    if (!ok) throw EngineError(id, message);
}

template <class S>
bool positiveDefinite(const typename S::Inertia& I) {
    if constexpr (S::dim == 2) {
        return I > 0 && std::isfinite(I);
    } else {
        if (!I.allFinite()) return false;
        const typename S::Real size = I.cwiseAbs().maxCoeff();
        if ((I - I.transpose()).cwiseAbs().maxCoeff() > typename S::Real(1e-4) * size) return false;
        return Eigen::SelfAdjointEigenSolver<typename S::Mat>(I, Eigen::EigenvaluesOnly)
                   .eigenvalues()
                   .minCoeff() > 0;
    }
}

template <class R>
R rotNorm(const Rot2<R>& q) {
    return std::sqrt(q.c * q.c + q.s * q.s);
}
template <class R>
R rotNorm(const Eigen::Quaternion<R>& q) {
    return q.norm();
}
template <class S>
bool validPose(const Pose<S>& X) {
    return X.p.allFinite() && std::abs(rotNorm(X.q) - typename S::Real(1)) < typename S::Real(1e-4);
}

template <class S>
void checkBody(const BodyDef<S>& def) {
    using Real = typename S::Real;
    require(validPose<S>(def.pose), "body_pose", "position must be finite, orientation a unit rotation");
    require(def.velocity.allFinite() && finiteAng(def.angularVelocity), "body_velocity",
            "velocities must be finite");
    require(def.centerOfMass.allFinite(), "body_center_of_mass", "centre of mass must be finite");
    require(std::isfinite(def.gravityScale), "body_gravity_scale", "gravity scale must be finite");
    const auto kept = [](Real k) { return k > 0 && k <= 1; };
    require(kept(def.linearVelocityKept) && kept(def.angularVelocityKept), "body_damping",
            "velocity kept per second must be in (0, 1]");
    if (def.type != BodyType::Dynamic) return;
    require(def.mass > 0 && std::isfinite(def.mass), "body_mass", "mass of a dynamic body must be positive");
    require(positiveDefinite<S>(def.inertia), "body_inertia",
            "inertia of a dynamic body must be symmetric and positive definite");
}

template <class S>
void checkCoefficients(const PairCoefficients<S>& c) {
    require(c.friction >= 0 && std::isfinite(c.friction), "material_friction",
            "friction must not be negative");
    require(c.restitution >= 0 && c.restitution <= 1, "material_restitution",
            "restitution must be in [0, 1]");
    require(c.staticFriction == 0 || (c.staticFriction >= c.friction && std::isfinite(c.staticFriction)),
            "material_static_friction", "static friction must be 0 (the same) or at least the friction");
}

// Sizes finite and positive, normals unit: an overload for each shape, so that a new one does not compile
// without.
template <class R>
bool validSize(R x) {
    return x > 0 && std::isfinite(x);
}
template <class S>
bool valid(const Sphere<S>& s) {
    return validSize(s.radius);
}
template <class S>
bool valid(const Capsule<S>& s) {
    return validSize(s.radius) && validSize(s.halfLength);
}
template <class S>
bool valid(const Box<S>& s) {
    return s.halfExtents.allFinite() && s.halfExtents.minCoeff() > 0;
}
template <class S>
bool valid(const HalfSpace<S>& s) {
    using R = typename S::Real;
    return std::isfinite(s.offset) && std::abs(s.normal.norm() - R(1)) < R(1e-4);
}
template <class S>
bool valid(const Cylinder<S>& s) {
    return validSize(s.radius) && validSize(s.halfLength);
}
template <class S>
bool valid(const Cone<S>& s) {
    return validSize(s.radius) && validSize(s.halfLength);
}
template <class S>
bool valid(const Triangle<S>& s) {
    return s.v[0].allFinite() && s.v[1].allFinite() && s.v[2].allFinite() &&
           validSize((s.v[1] - s.v[0]).cross(s.v[2] - s.v[0]).norm());
}
template <class S>
bool valid(const Segment<S>& s) {
    return s.a.allFinite() && s.b.allFinite() && validSize((s.b - s.a).norm());
}
/// Of shapes whose data is checked where it is made (makeHull, makeChain, ...).
template <class Shape>
requires requires(const Shape& s) {
    s.data != nullptr;
}
bool valid(const Shape& s) {
    return s.data != nullptr;
}

template <class S>
bool validShape(const Shape<S>& shape) {
    return std::visit([](const auto& s) { return valid(s); }, shape);
}

}  // namespace

template <class S>
World<S>::World(const WorldDef<S>& def) : def_(def) {
    checkSettings<S>(def);
    tasks_ = Tasks(def.threads);
    require(def.gravity.allFinite(), "gravity", "gravity must be finite");
    require(def.cacheTolerance == 0 || !manifoldTraits(def.manifold).remembers, "reuse_manifold",
            "a manifold that remembers needs the narrow phase in every step: reuse distance must be 0");
    const RotationScheme<S> rotation = findAlgorithm(rotationTable<S>(), "rotation", def.rotation).make();
    motion_ = {
        findAlgorithm(integratorTable<S>(), "integrator", def.integrator).make(), rotation,
        findAlgorithm(orientationUpdateTable<S>(), "orientation_update", def.orientationUpdate).make()};
    broadPhase_ = findAlgorithm(broadPhaseTable<S>(), "broad_phase", def.broadPhase).make();
    solver_ = findAlgorithm(solverTable<S>(), "solver", def.solver).make();
    correction_ =
        findAlgorithm(positionCorrectionTable<S>(), "position_correction", def.positionCorrection).make();
    ccd_ =
        findAlgorithm(continuousCollisionTable<S>(), "continuous_collision", def.continuousCollision).make();
    sleeping_ = findAlgorithm(sleepingTable<S>(), "sleeping", def.sleeping).make();
    restitution_ = findAlgorithm(restitutionTable<S>(), "restitution", def.restitution).make();
    contacts_.materials().setCombineRules(
        findAlgorithm(combineTable<Real>(), "friction_combine", def.frictionCombine).make,
        findAlgorithm(combineTable<Real>(), "restitution_combine", def.restitutionCombine).make);
    style_ = solver_->style();
    const ContactForm form = solverTraits(def.solver).contacts;
    contactModel_ = makeContactModel<S>(form);
    fault_ = findAlgorithm(faultTable<S>(), "fault", def.fault).make();
    if (form == ContactForm::Patches) {
        require(fault_ == nullptr, "fault_solver",
                "faults change rows of contacts, which this solver does not have");
        require(frictionShape(def.friction) == solverTraits(def.solver).friction, "friction_solver",
                "this solver has a friction law of its own, the cone's: friction must be cone");
        require(!restitution_->solvesImpacts(), "restitution_solver",
                "this restitution needs contacts as rows, which this solver does not have");
        require(!def.measureResiduals, "measure_residuals_solver",
                "residuals are measured on rows of contacts, which this solver does not have");
    }
    require(!style_.positions || !restitution_->solvesImpacts(), "restitution_solver",
            "this restitution needs a solver of velocities");
    friction_ = findAlgorithm(frictionTable<S>(), "friction", def.friction).make;
    narrowPhase_ = def.customNarrowPhase ? def.customNarrowPhase : makeNarrowPhase<S>(def.narrowPhase);
    makeManifold_ = findAlgorithm(manifoldTable<S>(), "manifold", def.manifold).make;
    if (form == ContactForm::Patches && integratorTraits(def.integrator).inBlocks &&
        orientationTraits(def.orientationUpdate).inBlocks && rotationTraits(def.rotation).inBlocks &&
        !continuousCollisionTraits(def.continuousCollision).acts)
        motion_.moveInBlocks(rotation.gyroscopic);

    // Body 0 is the world.
    bodies_.pose.emplace_back();
    bodies_.velocity.emplace_back();
    bodies_.wrench.emplace_back();
    bodies_.asleep.push_back(0);
    bodies_.stillTime.push_back(0);
    bodies_.constants.emplace_back();
    bodies_.constants[0].collides = false;
    bodies_.invMass.push_back(0);
    bodies_.invInertiaLocal.push_back(zeroInertia<S>());
    bodies_.invInertia.push_back(zeroInertia<S>());
    bodies_.id.emplace_back();
}

template <class S>
BodyId World<S>::addBody(const BodyDef<S>& def) {
    checkBody<S>(def);
    islands();  // of the last step
    const bool dynamic = def.type == BodyType::Dynamic;
    BodyConstants<S> constants;
    constants.type = def.type;
    constants.collides = def.collides;
    constants.centerOfMass = def.centerOfMass;
    constants.gravityScale = def.gravityScale;
    constants.linearVelocityKept = def.linearVelocityKept;
    constants.angularVelocityKept = def.angularVelocityKept;
    if (dynamic) {
        constants.mass = def.mass;
        constants.inertia = def.inertia;
        if constexpr (S::dim == 3) constants.inertia = Real(0.5) * (def.inertia + def.inertia.transpose());
    }
    const Pose<S> pose{def.pose.p, normalizedRot(def.pose.q)};
    const BodyId id = bodyIds_.add(static_cast<std::uint32_t>(bodies_.size()));
    bodies_.pose.push_back({toWorld<S>(pose, def.centerOfMass), pose.q});
    bodies_.velocity.push_back(def.type == BodyType::Static ? Velocity<S>{}
                                                            : Velocity<S>{def.velocity, def.angularVelocity});
    bodies_.wrench.emplace_back();
    bodies_.asleep.push_back(0);
    bodies_.stillTime.push_back(0);
    bodies_.constants.push_back(constants);
    bodies_.invMass.push_back(dynamic ? Real(1) / def.mass : Real(0));
    bodies_.invInertiaLocal.push_back(dynamic ? inverseInertia<S>(constants.inertia) : zeroInertia<S>());
    bodies_.invInertia.push_back(zeroInertia<S>());
    bodies_.id.push_back(id);
    return id;
}

template <class S>
ShapeId World<S>::addShape(BodyId body, const ShapeDef<S>& def) {
    const std::uint32_t dense = bodyIds_.dense(body);
    require(validPose<S>(def.pose), "shape_pose", "position must be finite, orientation a unit rotation");
    require(validShape<S>(def.shape), "shape_size",
            "sizes must be positive and finite, normals unit vectors");
    require(def.material < contacts_.materials().size(), "shape_material", "unknown material");
    const bool isStatic = bodies_.constants[dense].type == BodyType::Static;
    require(!std::holds_alternative<HalfSpace<S>>(def.shape) || isStatic, "half_space_body",
            "a half-space needs a static body");
    require(!isStaticOnly<S>(def.shape) || isStatic, "surface_body",
            "segments, chains, triangles, meshes and height fields need a static body");
    ShapeRecord<S> record;
    record.shape = def.shape;
    record.local = {def.pose.p - bodies_.constants[dense].centerOfMass, normalizedRot(def.pose.q)};
    record.body = dense;
    record.material = def.material;
    record.boundingRadius = coreBoundingRadius<S>(record.shape, record.local);
    record.inscribedRadius = inscribedRadiusOf<S>(record.shape);
    const Aabb<S> box = boundingBox<S>(record.shape, {});
    record.middle = middleOf<S>(record.shape);
    record.radius = box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).norm();
    const ShapeId id = contacts_.shapes().add(record);
    if (sleeping_.wake && bodies_.constants[dense].type != BodyType::Dynamic)
        // It may stand in the way of any of them.
        for (std::uint32_t i = 0; i < bodies_.size(); ++i) wakeBody(bodies_, i);
    wakeIslandOf(dense);
    contacts_.structureChanged(false);
    return id;
}

template <class S>
std::uint32_t World<S>::addMaterial(Real friction, Real restitution, Real staticFriction) {
    const PairCoefficients<S> own{friction, restitution, staticFriction};
    checkCoefficients<S>(own);
    return contacts_.materials().add(own);
}

template <class S>
void World<S>::setPair(std::uint32_t materialA, std::uint32_t materialB,
                       const PairCoefficients<S>& coefficients) {
    require(materialA < contacts_.materials().size() && materialB < contacts_.materials().size(),
            "pair_material", "unknown material");
    checkCoefficients<S>(coefficients);
    contacts_.materials().setPair(materialA, materialB, coefficients);
}

template <class S>
const PairCoefficients<S>& World<S>::pairCoefficients(std::uint32_t a, std::uint32_t b) const {
    require(a < contacts_.materials().size() && b < contacts_.materials().size(), "pair_material",
            "unknown material");
    return contacts_.materials().pair(a, b);
}

/// The last body takes the place of the removed one; likewise its shapes and joints.
template <class S>
void World<S>::removeBody(BodyId body) {
    const std::uint32_t gone = bodyIds_.dense(body);
    const auto last = static_cast<std::uint32_t>(bodies_.size() - 1);
    wakeNeighboursOf(gone);
    const auto fill = [gone](auto& array) {
        array[gone] = array.back();
        array.pop_back();
    };
    fill(bodies_.pose);
    fill(bodies_.velocity);
    fill(bodies_.wrench);
    fill(bodies_.constants);
    fill(bodies_.asleep);
    fill(bodies_.stillTime);
    fill(bodies_.invMass);
    fill(bodies_.invInertiaLocal);
    fill(bodies_.invInertia);
    fill(bodies_.id);
    bodyIds_.remove(body);
    if (gone != last) bodyIds_.move(bodies_.id[gone], gone);

    contacts_.shapes().bodyRemoved(gone, last);

    auto& joints = joints_.records();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        Joint<S>& joint = joints[i].joint;
        if (joint.a == gone || joint.b == gone) {
            jointIds_.remove(joint.id);
            continue;
        }
        if (joint.a == last) joint.a = gone;
        if (joint.b == last) joint.b = gone;
        jointIds_.move(joint.id, static_cast<std::uint32_t>(kept));
        if (kept != i) joints[kept] = joints[i];
        ++kept;
    }
    joints.resize(kept);
    forces_.bodyRemoved(gone, last);
    rebuildExclusions();
    contacts_.structureChanged(true);
    broadPhase_->reset();
    islandsStale_ = true;
}

template <class S>
void World<S>::applyForce(BodyId body, const Vec& force, const Ang& torque) {
    require(force.allFinite() && finiteAng(torque), "force", "forces must be finite");
    const std::uint32_t i = bodyIds_.dense(body);
    if (!force.isZero(0) || dotAng(torque, torque) > Real(0)) wakeIslandOf(i);
    Wrench<S>& wrench = bodies_.wrench[i];
    wrench.force += force;
    wrench.torque += torque;
}

template <class S>
ForceId World<S>::addForce(const ForceDef<S>& def) {
    const ForceId id = forces_.add(def, bodies_, bodyIds_);
    wakeIslandOf(forces_.place(id).a);
    wakeIslandOf(forces_.place(id).b);
    return id;
}

template <class S>
void World<S>::removeForce(ForceId force) {
    wakeIslandOf(forces_.place(force).a);
    wakeIslandOf(forces_.place(force).b);
    forces_.remove(force);
}

template <class S>
void World<S>::applyImpulse(BodyId body, const Vec& impulse, const Ang& angularImpulse) {
    require(impulse.allFinite() && finiteAng(angularImpulse), "impulse", "impulses must be finite");
    const std::uint32_t i = bodyIds_.dense(body);
    require(bodies_.constants[i].type == BodyType::Dynamic, "impulse", "an impulse needs a dynamic body");
    wakeIslandOf(i);
    bodies_.velocity[i].v += bodies_.invMass[i] * impulse;
    bodies_.velocity[i].w +=
        Ang(worldInertia<S>(bodies_.pose[i].q, bodies_.invInertiaLocal[i]) * angularImpulse);
}

template <class S>
void World<S>::setVelocity(BodyId body, const Vec& velocity, const Ang& angularVelocity) {
    require(velocity.allFinite() && finiteAng(angularVelocity), "body_velocity", "velocities must be finite");
    const std::uint32_t i = bodyIds_.dense(body);
    require(bodies_.constants[i].type != BodyType::Static, "static_body", "a static body has no velocity");
    wakeIslandOf(i);
    bodies_.velocity[i] = {velocity, angularVelocity};
}

template <class S>
Pose<S> World<S>::pose(BodyId body) const {
    const std::uint32_t i = bodyIds_.dense(body);
    const Pose<S>& X = bodies_.pose[i];
    if (bodies_.constants[i].centerOfMass.isZero(0)) return X;
    return {X.p - rotate(X.q, bodies_.constants[i].centerOfMass), X.q};
}

template <class S>
void World<S>::readContacts(std::vector<ContactView<S>>& out) const {
    out.clear();
    for (const Contact<S>& contact : contacts_.list())
        for (int i = 0; i < contact.manifold.count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const ManifoldPoint<S>& where = contact.manifold.points[k];
            if (contact.block[k] == kNullIndex && !contact.asleep) continue;
            out.push_back({bodies_.id[contact.bodyA], bodies_.id[contact.bodyB],
                           contacts_.shapes()[contact.shapeA].id, contacts_.shapes()[contact.shapeB].id,
                           where.pointA, where.pointB, contact.manifold.normal, where.separation,
                           contact.totals[k].normal, contact.totals[k].friction});
        }
}

RIGOR_INSTANTIATE_CLASS(World)

}  // namespace rigor::engine
