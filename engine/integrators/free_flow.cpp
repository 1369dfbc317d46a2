// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/integrators/free_flow.hpp"

#include <algorithm>

namespace rigor::engine {

template <class S>
void FreeFlow<S>::begin(const BodyArrays<S>& bodies, const Load<S>& load, const RotationScheme<S>& rotation,
                        TurnRotation<S> turnRotation) {
    bodies_ = &bodies;
    rotation_ = &rotation;
    turn_ = turnRotation;
    load_ = load;
    pose.assign(bodies.pose.begin(), bodies.pose.end());
    velocity.assign(bodies.velocity.begin(), bodies.velocity.end());
    wrench.resize(bodies.size());
    turn.assign(bodies.size(), zeroAng<S>());
}

template <class S>
void FreeFlow<S>::advance(AdvanceFlow<S> advancePiece, Real h) {
    const double length = static_cast<double>(h), start = load_.time;
    edges_.clear();
    // An edge this near to the ends of the step is at them: what is lost is below the rounding of h in f32.
    const double near = 1e-9 * length;
    if (load_.forces) load_.forces->edges(start + near, start + length - near, edges_);
    if (edges_.empty()) {
        advancePiece(*this, start, h);
    } else {
        std::sort(edges_.begin(), edges_.end());
        edges_.push_back(start + length);
        double from = start;
        for (const double to : edges_) {
            if (to - from <= near) continue;
            advancePiece(*this, from, static_cast<Real>(to - from));
            from = to;
        }
    }
    bodies_ = nullptr;
    rotation_ = nullptr;
    load_.forces = nullptr;
}

template <class S>
void FreeFlow<S>::evaluate(double from, double to) {
    std::copy(bodies_->wrench.begin(), bodies_->wrench.end(), wrench.begin());
    if (load_.forces) load_.forces->evaluate({from, to, pose, velocity, wrench});
}

template <class S>
typename S::Ang FreeFlow<S>::inverseInertiaTimes(std::size_t i, const typename S::Rot& q,
                                                 const Ang& a) const {
    if constexpr (S::dim == 2) {
        (void)q;
        return bodies_->invInertiaLocal[i] * a;
    } else {
        return rotate(q, Vec(bodies_->invInertiaLocal[i] * rotateInverse(q, a)));
    }
}

template <class S>
typename S::Ang FreeFlow<S>::inertiaTimes(std::size_t i, const typename S::Rot& q, const Ang& a) const {
    if constexpr (S::dim == 2) {
        (void)q;
        return constants(i).inertia * a;
    } else {
        return rotate(q, Vec(constants(i).inertia * rotateInverse(q, a)));
    }
}

RIGOR_INSTANTIATE_CLASS(FreeFlow)

}  // namespace rigor::engine
