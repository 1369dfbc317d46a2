// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/integrators/motion.hpp"

namespace rigor::engine {

template <class S>
void Motion<S>::setInertia(BodyArrays<S>& bodies) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (bodies.invMass[i] > 0)
            bodies.invInertia[i] = worldInertia<S>(bodies.pose[i].q, bodies.invInertiaLocal[i]);
}

template <class S>
void Motion<S>::kick(BodyArrays<S>& bodies, const Vec& gravity, Real h) {
    const std::size_t n = bodies.size();
    start_.assign(bodies.velocity.begin(), bodies.velocity.end());
    kicked_.resize(n);
    predicted_.resize(n);
    startRotations_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        startRotations_[i] = bodies.pose[i].q;
        if (bodies.invMass[i] == 0) continue;
        const BodyConstants<S>& body = bodies.constants[i];
        const DampedStep<Real> linear = dampedStep(body.linearVelocityKept, h);
        const DampedStep<Real> angular = dampedStep(body.angularVelocityKept, h);
        Velocity<S>& velocity = bodies.velocity[i];
        const Wrench<S>& wrench = bodies.wrench[i];
        const Vec acceleration = body.gravityScale * gravity + bodies.invMass[i] * wrench.force;
        velocity.v = linear.kept * velocity.v + linear.kick * acceleration;
        kicked_[i] = angular.kept * velocity.w + angular.kick * Ang(bodies.invInertia[i] * wrench.torque);
        predicted_[i] = rotation_.predict(body, bodies.pose[i].q, kicked_[i], h);
        velocity.w = predicted_[i];
    }
}

template <class S>
void Motion<S>::move(BodyArrays<S>& bodies, Real h) {
    used_.resize(bodies.size());
    integrator_.move(bodies, start_, used_, h);
}

template <class S>
void Motion<S>::finish(BodyArrays<S>& bodies, Real h) {
    (void)h;
    if (!rotation_.finish) return;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.invMass[i] == 0) continue;
        Ang& w = bodies.velocity[i].w;
        w = rotation_.finish(bodies.constants[i], startRotations_[i], bodies.pose[i].q, kicked_[i],
                             predicted_[i], w);
    }
}

template <class S>
void Motion<S>::interrupt(BodyArrays<S>& bodies, std::size_t i) {
    if (!rotation_.finish) return;
    Ang& w = bodies.velocity[i].w;
    w = rotation_.finish(bodies.constants[i], startRotations_[i], bodies.pose[i].q, kicked_[i], predicted_[i],
                         w);
}

template <class S>
void Motion<S>::resume(BodyArrays<S>& bodies, std::size_t i, Real rest) {
    if (!rotation_.finish) return;
    Ang& w = bodies.velocity[i].w;
    startRotations_[i] = bodies.pose[i].q;
    kicked_[i] = w;
    w = predicted_[i] = rotation_.predict(bodies.constants[i], bodies.pose[i].q, w, rest);
}

template class Motion<Space2f>;
template class Motion<Space2d>;
template class Motion<Space3f>;
template class Motion<Space3d>;

}  // namespace rigor::engine
