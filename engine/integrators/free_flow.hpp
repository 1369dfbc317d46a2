// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The motion that forces alone would give, for integrators of several stages. All bodies advance together,
// because forces couple them.
#pragma once

#include <span>
#include <vector>

#include "engine/forces/force_set.hpp"
#include "engine/integrators/integrator.hpp"

namespace rigor::engine {

/// Loads on the bodies besides constraints. The bodies' own wrenches come on top.
template <class S>
struct Load {
    typename S::Vec gravity = S::Vec::Zero();  ///< [m/s^2]
    const ForceSet<S>* forces = nullptr;       ///< forces; may be null
    double time = 0;                           ///< time at the start of the step or sub-step [s]
};

/// Copies of the bodies' states that an integrator may move about.
template <class S>
class FreeFlow {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    using Ang = typename S::Ang;

    /// Takes the bodies' states as the start.
    void begin(const BodyArrays<S>& bodies, const Load<S>& load, const RotationScheme<S>& rotation,
               TurnRotation<S> turn);
    /// Advances by h with `advance`, in one piece, or in several where a force starts or ends in between.
    void advance(AdvanceFlow<S> advance, Real h);

    // --- for integrators. Arrays by dense body index; only dynamic and kinematic bodies may be changed.
    std::size_t size() const { return pose.size(); }
    bool isDynamic(std::size_t i) const { return bodies_->invMass[i] > 0; }
    bool isKinematic(std::size_t i) const { return bodies_->constants[i].type == BodyType::Kinematic; }
    const BodyConstants<S>& constants(std::size_t i) const { return bodies_->constants[i]; }
    const RotationScheme<S>& rotation() const { return *rotation_; }
    typename S::Rot turned(const typename S::Rot& q, const Ang& v) const { return turn_(q, v); }
    /// Inverse inertia of body i in the orientation q, times a.
    Ang inverseInertiaTimes(std::size_t i, const typename S::Rot& q, const Ang& a) const;
    Ang inertiaTimes(std::size_t i, const typename S::Rot& q, const Ang& a) const;
    /// Fills `wrench` with all forces but gravity and damping at pose and velocity; forces with a beginning
    /// and an end act as in their mean over [begin, end].
    void evaluate(double begin, double end);
    /// Gravity and the force of `wrench` [m/s^2].
    Vec acceleration(std::size_t i) const {
        return constants(i).gravityScale * load_.gravity + bodies_->invMass[i] * wrench[i].force;
    }

    std::vector<Pose<S>> pose;
    std::vector<Velocity<S>> velocity;
    std::vector<Wrench<S>> wrench;
    std::vector<Ang> turn;  ///< rotation since the start [rad], to first order where it changes its axis

    // --- data shared by the stages of an integrator
    struct Rate {
        Vec p, v;        ///< rates of position [m/s] and velocity [m/s^2]
        Ang turn, spin;  ///< rates of rotation vector [rad/s] and of angular momentum or velocity
    };
    std::vector<Pose<S>> startPose;
    std::vector<Velocity<S>> startVelocity;
    std::vector<Wrench<S>> startWrench;
    std::vector<Rate> rate, sum;

  private:
    const BodyArrays<S>* bodies_ = nullptr;  // valid between begin() and the end of advance()
    const RotationScheme<S>* rotation_ = nullptr;
    TurnRotation<S> turn_ = nullptr;
    Load<S> load_;
    std::vector<double> edges_;
};

}  // namespace rigor::engine
