// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/integrators/motion.hpp"

#include <atomic>
#include <cmath>
#include <utility>

namespace rigor::engine {

template <class S>
void Motion<S>::setInertia(BodyArrays<S>& bodies, const Tasks& tasks) {
    tasks.forEach(bodies.size(), kBodyGrain, [&](std::size_t i) {
        if (bodies.invMass[i] > 0)
            bodies.invInertia[i] = worldInertia<S>(bodies.pose[i].q, bodies.invInertiaLocal[i]);
    });
}

template <class S>
bool Motion<S>::toMidpoint(BodyArrays<S>& bodies, const PerIslandKind<Real>& half, bool same,
                           const Tasks& tasks) {
    const std::size_t n = bodies.size();
    Midpoints<S>& midpoints = bodies.midpoints;
    midpoints.pose.resize(n);
    midpoints.velocity.resize(n);
    midpoints.valid.resize(n, 0);
    std::atomic<bool> found = false;
    tasks.forEach(n, kBodyGrain, [&](std::size_t i) {
        if (bodies.constants[i].type == BodyType::Static || bodies.asleep[i]) return;
        if (same && midpoints.valid[i]) {
            bodies.pose[i] = midpoints.pose[i];
            bodies.velocity[i] = midpoints.velocity[i];
            return;
        }
        found = true;
        coast(bodies, i, half[bodies.islands[i]]);
    });
    return found;
}

/// Angular velocity in the middle of `time` by Euler's equation at its beginning: what free rotation needs to
/// be of second order. Where that changes it far, by the rotation scheme.
template <class S>
typename S::Ang Motion<S>::halfwayRotation(const BodyArrays<S>& bodies, std::size_t i, Real time) const {
    const Ang& w = bodies.velocity[i].w;
    if constexpr (S::dim == 3) {
        if (!rotation_.gyroscopic) return w;
        const typename S::Rot& q = bodies.pose[i].q;
        const Vec own = rotateInverse<Real>(q, w), momentum = bodies.constants[i].inertia * own;
        const Vec change = (Real(0.5) * time) * Vec(bodies.invInertiaLocal[i] * momentum.cross(own));
        if (change.squaredNorm() > Real(0.01) * own.squaredNorm())
            return freeRotation(bodies.constants[i], q, w, time);
        return rotate(q, Vec(own + change));
    } else {
        return w;
    }
}

template <class S>
void Motion<S>::coast(BodyArrays<S>& bodies, std::size_t i, Real time) const {
    Pose<S>& X = bodies.pose[i];
    Velocity<S>& velocity = bodies.velocity[i];
    const typename S::Rot q0 = X.q;
    const bool dynamic = bodies.invMass[i] > 0;
    const Ang mean = dynamic ? halfwayRotation(bodies, i, time) : velocity.w;
    X.p += time * velocity.v;
    X.q = turn_(q0, Ang(time * mean));
    if (dynamic) velocity.w = rotatedVelocity(bodies.constants[i], q0, X.q, velocity.w, mean);
}

template <class S>
void Motion<S>::flyToMidpoint(BodyArrays<S>& bodies, std::span<const std::uint8_t> flies, Real half) {
    const std::size_t n = bodies.size();
    startRotations_.resize(n);
    kicked_.resize(n);
    predicted_.resize(n);
    used_.assign(n, {});
    kickedInBlocks_ = false;
    for (std::size_t i = 0; i < n; ++i) {
        Pose<S>& X = bodies.pose[i];
        Velocity<S>& velocity = bodies.velocity[i];
        startRotations_[i] = X.q;
        kicked_[i] = predicted_[i] = velocity.w;
        if (!flies[i]) continue;
        if (bodies.invMass[i] > 0)
            velocity.w = predicted_[i] = rotation_.predict(bodies.constants[i], X.q, velocity.w, half);
        used_[i] = velocity;
        carry(X, velocity, half);
    }
}

template <class S>
void Motion<S>::toEnd(BodyArrays<S>& bodies, IslandKind islands, std::span<const Velocity<S>> way, Real half,
                      const Tasks& tasks) {
    Midpoints<S>& midpoints = bodies.midpoints;
    tasks.forEach(bodies.size(), kBodyGrain, [&](std::size_t i) {
        if (bodies.islands[i] != islands) return;
        midpoints.valid[i] = 0;
        if (bodies.constants[i].type == BodyType::Static || bodies.asleep[i]) return;
        Pose<S>& X = bodies.pose[i];
        Velocity<S>& velocity = bodies.velocity[i];
        midpoints.pose[i] = X;
        midpoints.velocity[i] = velocity;
        midpoints.valid[i] = 1;
        const Velocity<S>& used = bodies.constants[i].type == BodyType::Dynamic ? way[i] : velocity;
        X.p -= half * used.v;
        X.q = turn_(X.q, Ang(-half * used.w));
        if (bodies.invMass[i] > 0)
            velocity.w =
                rotatedVelocity(bodies.constants[i], midpoints.pose[i].q, X.q, velocity.w, velocity.w);
    });
}

template <class S>
void Motion<S>::kick(BodyArrays<S>& bodies, const Load<S>& load, Real h, const Tasks& tasks) {
    kickedInBlocks_ = goesInBlocks(load);
    if (kickedInBlocks_) {
        if (!std::exchange(begun_, true)) blocks_.begin(bodies, load.gravity, h, tasks);
        return blocks_.kick(bodies, h, tasks);
    }
    const std::size_t n = bodies.size();
    start_.assign(bodies.velocity.begin(), bodies.velocity.end());
    startRotations_.resize(n);
    for (std::size_t i = 0; i < n; ++i) startRotations_[i] = bodies.pose[i].q;
    if (!integrator_.advance) return kickOnce(bodies, load, h, tasks);
    flow_.begin(bodies, load, rotation_, turn_);
    flow_.advance(integrator_.advance, h);
    for (std::size_t i = 0; i < n; ++i)
        if (bodies.invMass[i] > 0) bodies.velocity[i] = flow_.velocity[i];
}

/// Fills wrench_. At the midpoint forces are evaluated again, with the velocities that they lead to there.
template <class S>
void Motion<S>::evaluateForces(const BodyArrays<S>& bodies, const Load<S>& load, Real h) {
    wrench_.assign(bodies.wrench.begin(), bodies.wrench.end());
    if (!load.forces || load.forces->size() == 0) return;
    const double begin = load.time, end = load.time + static_cast<double>(h);
    load.forces->evaluate({begin, end, bodies.pose, bodies.velocity, wrench_});
    if (!integrator_.atMidpoint) return;
    const Real half = Real(0.5) * h;
    middle_.assign(bodies.velocity.begin(), bodies.velocity.end());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.invMass[i] == 0) continue;
        const BodyConstants<S>& body = bodies.constants[i];
        const DampedStep<Real> linear = dampedStep(body.linearVelocityKept, half);
        const DampedStep<Real> angular = dampedStep(body.angularVelocityKept, half);
        const Vec acceleration = body.gravityScale * load.gravity + bodies.invMass[i] * wrench_[i].force;
        middle_[i].v = linear.kept * middle_[i].v + linear.kick * acceleration;
        middle_[i].w =
            angular.kept * middle_[i].w + angular.kick * Ang(bodies.invInertia[i] * wrench_[i].torque);
    }
    wrench_.assign(bodies.wrench.begin(), bodies.wrench.end());
    load.forces->evaluate({begin, end, bodies.pose, middle_, wrench_});
}

template <class S>
void Motion<S>::kickOnce(BodyArrays<S>& bodies, const Load<S>& load, Real h, const Tasks& tasks) {
    const std::size_t n = bodies.size();
    evaluateForces(bodies, load, h);
    kicked_.resize(n);
    predicted_.resize(n);
    tasks.forEach(n, kBodyGrain, [&](std::size_t i) {
        if (bodies.invMass[i] == 0) return;
        const BodyConstants<S>& body = bodies.constants[i];
        const DampedStep<Real> linear = dampedStep(body.linearVelocityKept, h);
        const DampedStep<Real> angular = dampedStep(body.angularVelocityKept, h);
        Velocity<S>& velocity = bodies.velocity[i];
        const Vec acceleration = body.gravityScale * load.gravity + bodies.invMass[i] * wrench_[i].force;
        velocity.v = linear.kept * velocity.v + linear.kick * acceleration;
        kicked_[i] = angular.kept * velocity.w + angular.kick * Ang(bodies.invInertia[i] * wrench_[i].torque);
        predicted_[i] = rotation_.predict(body, bodies.pose[i].q, kicked_[i], h);
        velocity.w = predicted_[i];
    });
}

template <class S>
void Motion<S>::move(BodyArrays<S>& bodies, Real h, const Tasks& tasks) {
    used_.resize(bodies.size());
    if (kickedInBlocks_)
        blocks_.move(bodies, used_, h, tasks);
    else if (integrator_.advance)
        moveAlongFlow(bodies, h, tasks);
    else
        integrator_.move(bodies, start_, used_, h, turn_, tasks);
}

namespace {

/// The fraction of a constraint's change d of a velocity, squared norm dd, that moves the body (motion.hpp);
/// ff: squared norm of what forces changed.
template <class R>
R movingShare(R dd, R ff) {
    return ff >= dd ? R(0.5) : R(1) - R(0.5) * std::sqrt(ff / dd);
}

}  // namespace

template <class S>
void Motion<S>::moveAlongFlow(BodyArrays<S>& bodies, Real h, const Tasks& tasks) {
    tasks.forEach(bodies.size(), kBodyGrain, [&](std::size_t i) {
        used_[i] = {};
        if (bodies.constants[i].type == BodyType::Static) return;
        Pose<S>& X = bodies.pose[i];
        used_[i] = {(flow_.pose[i].p - X.p) / h, flow_.turn[i] / h};
        X = flow_.pose[i];
        const Velocity<S>&solved = bodies.velocity[i], free = flow_.velocity[i], before = start_[i];
        const Vec dv = solved.v - free.v, fv = free.v - before.v;
        const Ang dw = solved.w - free.w, fw = free.w - before.w;
        const Real dv2 = dv.squaredNorm(), dw2 = dotAng(dw, dw);
        if (dv2 > 0) {
            const Vec moving = movingShare(dv2, fv.squaredNorm()) * dv;
            X.p += h * moving;
            used_[i].v += moving;
        }
        if (dw2 > 0) {
            const Ang moving = movingShare(dw2, dotAng(fw, fw)) * dw;
            X.q = turn_(X.q, Ang(h * moving));
            used_[i].w += moving;
        }
    });
}

template <class S>
void Motion<S>::finish(BodyArrays<S>& bodies, Real h, const Tasks& tasks) {
    (void)h;
    if (kickedInBlocks_) return blocks_.finish(bodies, tasks);
    // The velocities of a free flow are those of the end already.
    if (!rotation_.finish || integrator_.advance) return;
    tasks.forEach(bodies.size(), kBodyGrain, [&](std::size_t i) {
        if (bodies.invMass[i] == 0) return;
        Ang& w = bodies.velocity[i].w;
        w = rotation_.finish(bodies.constants[i], startRotations_[i], bodies.pose[i].q, kicked_[i],
                             predicted_[i], w);
    });
}

template <class S>
void Motion<S>::interrupt(BodyArrays<S>& bodies, std::size_t i) {
    if (!rotation_.finish || integrator_.advance) return;
    Ang& w = bodies.velocity[i].w;
    w = rotation_.finish(bodies.constants[i], startRotations_[i], bodies.pose[i].q, kicked_[i], predicted_[i],
                         w);
}

template <class S>
void Motion<S>::resume(BodyArrays<S>& bodies, std::size_t i, Real rest) {
    if (!rotation_.finish || integrator_.advance) return;
    Ang& w = bodies.velocity[i].w;
    startRotations_[i] = bodies.pose[i].q;
    kicked_[i] = w;
    w = predicted_[i] = rotation_.predict(bodies.constants[i], bodies.pose[i].q, w, rest);
}

RIGOR_INSTANTIATE_CLASS(Motion)

}  // namespace rigor::engine
