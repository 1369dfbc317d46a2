// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario as a MuJoCo model: building, stepping, snapshots.
#include "adapters/mujoco/world.hpp"

#include <algorithm>
#include <cstring>
#include <numbers>
#include <stdexcept>

#include "adapters/interface/joint_springs.hpp"
#include "adapters/interface/planar.hpp"
#include "adapters/interface/snapshot_numbers.hpp"

namespace rigor::mujoco {

using adapter::numberSetting;
using scenario::Body;
using scenario::BodyType;

namespace {

/// Rows of constraints beyond which MuJoCo's own sizes no longer fit into an int.
constexpr int kMostRows = 12000;

}  // namespace

MujocoWorld::MujocoWorld(const adapter::Scenario& scenario, double dt, const adapter::Settings& settings)
    : scenario_(adapter::withStiffness(scenario.dimension == 2 ? adapter::planarLift(scenario) : scenario)),
      settings_(settings),
      dt_(dt),
      planar_(scenario.dimension == 2),
      pairs_(scenario_) {
    useLibrary();
    model_ = buildModel(scenario_, pairs_, planar_, dt_, modelSettings());
    filter_ = {&pairs_, model_.shapes};
    forces_.assign(6 * static_cast<std::size_t>(model_.model->nbody), 0.0);
    const int shapes = model_.model->ngeom;
    makeData(64 + 4 * shapes, 0);
    for (const Body& body : scenario_.bodies)
        start_.push_back({body.pose.position, body.pose.orientation, body.velocity, body.angularVelocity});
    for (const int body : model_.forest.order) placeLink(body, start_);
    updatePoses();
}

bool MujocoWorld::is(const char* key, const char* value) const {
    return adapter::textSetting(settings_, key) == value;
}
double MujocoWorld::number(const char* key) const {
    return numberSetting(settings_, key);
}

ModelSettings MujocoWorld::modelSettings() const {
    const auto text = [&](const char* key) { return adapter::textSetting(settings_, key); };
    ModelSettings s;
    s.integrator = is("integrator", "euler") ? "Euler" : is("integrator", "rk4") ? "RK4" : "implicit";
    s.solver = is("solver", "pgs") ? "PGS" : is("solver", "cg") ? "CG" : "Newton";
    s.cone = text("cone");
    s.jacobian = text("jacobian");
    s.iterations = adapter::integerSetting(settings_, "iterations");
    s.noslipIterations = adapter::integerSetting(settings_, "noslip_iterations");
    s.tolerance = number("tolerance");
    s.impratio = number("impratio");
    s.warmStart = is("warm_starting", "on");
    s.restitution = is("restitution", "spring");
    s.bounceFrequency = std::numbers::pi / (number("bounce_steps") * dt_);
    const double time = number("solref_time");
    s.softness = {{time > 0.0 ? time : 2.0 * dt_, number("solref_damping")},
                  {number("solimp_min"), number("solimp_max"), 0.001, 0.5, 2.0}};
    // Equalities leave out how fast their rows turn: what swings on one drifts by v^2 / (l k), so they are critically
    // damped, which is stiffest for a time constant.
    s.rigid = s.softness;
    s.rigid.solref[1] = std::min(s.rigid.solref[1], 1.0);
    return s;
}

/// MuJoCo 2.2.2 allocates room for contacts and rows once.
void MujocoWorld::makeData(int contacts, int rows) {
    mjModel& model = *model_.model;
    capacity_ = contacts;
    const int rowsOfContact = is("cone", "pyramidal") ? 4 : 3;
    // Limits and equalities have rows beside those of contacts.
    const int others = model.nemax + 2 * (model.njnt + model.ntendon);
    model.nconmax = contacts;
    model.njmax = std::max(rows, rowsOfContact * contacts + others);
    if (model.njmax > kMostRows)
        throw std::runtime_error("mujoco: more than " + std::to_string(kMostRows) +
                                 " constraint rows, which MuJoCo 2.2.2 can not allocate");
    model.nstack = 100000 + 6 * model.nv * model.nv + 6 * model.njmax * std::max(model.nv, 10);
    data_.reset(mj_makeData(&model));
    if (!data_) throw std::runtime_error("mujoco: no memory for " + std::to_string(contacts) + " contacts");
    setFilter(*data_, &filter_);
}

void MujocoWorld::grow() {
    makeData(2 * capacity_, std::min(2 * model_.model->njmax, kMostRows));
}

bool MujocoWorld::overflowed() const {
    return data_->warning[mjWARN_CONTACTFULL].number > 0 || data_->warning[mjWARN_CNSTRFULL].number > 0;
}

void MujocoWorld::applyForce(int body, const Vec3& force, const Vec3& torque) {
    if (scenario_.bodies[body].type != BodyType::Dynamic) return;
    mjtNum* applied = forces_.data() + 6 * model_.bodies[body];
    const Vec3 f = fromMujoco(applied) + force, t = fromMujoco(applied + 3) + torque;
    toMujoco(f, applied);
    toMujoco(t, applied + 3);
}

/// Damping of bodies that hang on joints is a force; that of free ones is their joint's (model.cpp).
void MujocoWorld::addDamping() {
    for (std::size_t b = 0; b < scenario_.bodies.size(); ++b) {
        const Body& body = scenario_.bodies[b];
        const Link& link = model_.forest.links[b];
        const bool damped = body.linearVelocityKept != 1.0 || body.angularVelocityKept != 1.0;
        if (body.type != BodyType::Dynamic || link.joint == kNone || !damped) continue;
        const adapter::Damping damping = adapter::dampingOf(body, link, stateOf(static_cast<int>(b)), dt_);
        mjtNum* applied = data_->xfrc_applied + 6 * model_.bodies[b];
        toMujoco(fromMujoco(applied) + damping.force, applied);
        toMujoco(fromMujoco(applied + 3) + damping.torque, applied + 3);
    }
}

/// Gravity of single bodies is a force, for MuJoCo 2.2.2 has none; kinematic bodies have none at all.
void MujocoWorld::prepareForces() {
    std::copy(forces_.begin(), forces_.end(), data_->xfrc_applied);
    for (std::size_t b = 0; b < scenario_.bodies.size(); ++b) {
        const Body& body = scenario_.bodies[b];
        const bool kinematic = body.type == BodyType::Kinematic;
        if (body.type == BodyType::Static || (!kinematic && body.gravityScale == 1.0)) continue;
        const double mass = kinematic ? kKinematicMass : body.massProperties.mass;
        mjtNum* applied = data_->xfrc_applied + 6 * model_.bodies[b];
        const Vec3 f =
            fromMujoco(applied) + mass * ((kinematic ? 0.0 : body.gravityScale) - 1.0) * scenario_.gravity;
        toMujoco(f, applied);
    }
}

/// A motor without load reaches its speed in a step that its force allows: the force is the effective inertia of its
/// coordinate times the missing speed over the step, within its bound. MuJoCo's own velocity servo does the same, but
/// its implicit integrator counts a servo's damping where its force is bounded, too, and halves the acceleration.
void MujocoWorld::setMotors() {
    const mjModel& model = *model_.model;
    mj_tendon(&model, data_.get());
    mj_transmission(&model, data_.get());
    mj_crb(&model, data_.get());
    mj_factorM(&model, data_.get());
    std::vector<mjtNum> answer(model.nv);
    for (const Motor& motor : model_.motors) {
        // Effect of a unit of the actuator's force on the coordinates, and the speed that it measures.
        const mjtNum* moment =
            data_->actuator_moment + static_cast<std::ptrdiff_t>(motor.actuator) * model.nv;
        mj_solveM(&model, data_.get(), answer.data(), moment, 1);
        const double mobility = mju_dot(moment, answer.data(), model.nv);
        const double wanted = (motor.speed - mju_dot(moment, data_->qvel, model.nv)) / (mobility * dt_);
        data_->ctrl[motor.actuator] = std::clamp(wanted, -motor.maxForce, motor.maxForce);
    }
}

void MujocoWorld::step() {
    if (reset_) return;
    if (!model_.motors.empty()) setMotors();
    const State before = keepState();
    for (;;) {
        prepareForces();
        addDamping();
        bool stackFull = false;
        try {
            mj_step(model_.model.get(), data_.get());
        } catch (const std::runtime_error& error) {
            if (std::strstr(error.what(), "stack") == nullptr) throw;
            stackFull = true;
        }
        if (!stackFull && !overflowed()) break;
        grow();
        putState(before);
    }
    for (const int warning : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})
        if (data_->warning[warning].number > 0) reset_ = true;
    std::fill(forces_.begin(), forces_.end(), 0.0);
    if (!reset_) breakJoints();
    moveKinematic(before);
    updatePoses();
    ++steps_;
}

/// Kinematic bodies move exactly with their velocities, whatever pushed them in the step.
void MujocoWorld::moveKinematic(const State& before) {
    const mjModel& model = *model_.model;
    for (std::size_t b = 0; b < scenario_.bodies.size(); ++b) {
        if (scenario_.bodies[b].type != BodyType::Kinematic) continue;
        const int dof = model.body_dofadr[model_.bodies[b]];
        const int at = model.jnt_qposadr[model.body_jntadr[model_.bodies[b]]];
        const mjtNum *position = before.numbers.data() + at,
                     *velocity = before.numbers.data() + model.nq + dof;
        const int travels = planar_ ? 3 : 6;
        std::copy_n(velocity, travels, data_->qvel + dof);
        for (int i = 0; i < 3; ++i) data_->qpos[at + i] = position[i] + dt_ * velocity[i];
        if (planar_) continue;
        std::copy_n(position + 3, 4, data_->qpos + at + 3);
        mju_quatIntegrate(data_->qpos + at + 3, velocity + 3, dt_);
    }
}

/// Poses and velocities of bodies at the state that the step has led to; contacts stay those of the step. Kinematics
/// normalises the quaternions of the state, in bits that would depend on how often they are requested.
void MujocoWorld::updatePoses() {
    const std::vector<mjtNum> positions(data_->qpos, data_->qpos + model_.model->nq);
    mj_kinematics(model_.model.get(), data_.get());
    mj_comPos(model_.model.get(), data_.get());
    mj_comVel(model_.model.get(), data_.get());
    std::copy(positions.begin(), positions.end(), data_->qpos);
}

adapter::Scheme MujocoWorld::scheme() const {
    return is("integrator", "rk4") ? adapter::Scheme::RungeKutta4 : adapter::Scheme::SymplecticEuler;
}

MujocoWorld::State MujocoWorld::keepState() const {
    const mjModel& m = *model_.model;
    State state;
    auto& out = state.numbers;
    const auto put = [&](const mjtNum* from, std::size_t count) {
        out.insert(out.end(), from, from + count);
    };
    put(data_->qpos, m.nq);
    put(data_->qvel, m.nv);
    put(data_->qacc_warmstart, m.nv);
    put(&data_->time, 1);
    put(forces_.data(), forces_.size());
    for (int i = 0; i < m.neq; ++i) out.push_back(m.eq_active[i]);
    return state;
}

void MujocoWorld::putState(const State& state) {
    mjModel& m = *model_.model;
    const mjtNum* from = state.numbers.data();
    const auto take = [&](mjtNum* to, std::size_t count) {
        std::copy_n(from, count, to);
        from += count;
    };
    take(data_->qpos, m.nq);
    take(data_->qvel, m.nv);
    take(data_->qacc_warmstart, m.nv);
    take(&data_->time, 1);
    take(forces_.data(), forces_.size());
    for (int i = 0; i < m.neq; ++i) m.eq_active[i] = static_cast<mjtByte>(from[i]);
}

void MujocoWorld::save(std::vector<unsigned char>& bytes) const {
    adapter::NumberWriter(bytes).put(keepState().numbers);
}

bool MujocoWorld::restore(const std::vector<unsigned char>& bytes) {
    State state = keepState();
    if (bytes.size() != state.numbers.size() * sizeof(mjtNum)) return false;
    adapter::NumberReader(bytes).take(state.numbers);
    putState(state);
    reset_ = false;
    updatePairs();
    for (auto& warning : data_->warning) warning.number = 0;
    updatePoses();
    return true;
}

}  // namespace rigor::mujoco
