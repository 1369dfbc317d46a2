// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Springs, motors and locks on the coordinates of pair.hpp, as forces and constraints of Simbody's.
#pragma once

#include <memory>

#include "adapters/simbody/pair.hpp"

namespace rigor::simbody {

/// A force along a coordinate. Its amount is positive where it increases the coordinate.
class PairForce : public SimTK::Force::Custom::Implementation {
  public:
    explicit PairForce(PairCoordinate on) : on_(std::move(on)) {}

    virtual double amount(const SimTK::State& state) const = 0;
    /// Torque, and force at the origin, on B; in the world.
    SimTK::SpatialVec onB(const SimTK::State& state) const;

    void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& forces,
                   SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector&) const override;
    SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0.0; }
    const PairCoordinate& coordinate() const { return on_; }

  protected:
    PairCoordinate on_;
};

/// A number that a force keeps in the state, outside the integrator's coordinates.
class Kept {
  public:
    explicit Kept(const SimTK::GeneralForceSubsystem& forces) : forces_(forces) {}
    void allocate(SimTK::State& state) const;
    double get(const SimTK::State& state) const;
    void set(SimTK::State& state, double value) const;

  private:
    const SimTK::GeneralForceSubsystem& forces_;
    mutable SimTK::DiscreteVariableIndex index_;
};

/// Spring and damper. A twist is counted over full turns from its value at the end of the step before.
class PairSpring final : public PairForce {
  public:
    PairSpring(const SimTK::GeneralForceSubsystem& forces, PairCoordinate on, const scenario::JointAxis& use);

    double amount(const SimTK::State& state) const override;
    void realizeTopology(SimTK::State& state) const override { last_.allocate(state); }

    bool countsTurns() const { return on_.countsTurns() && use_.stiffness > 0.0; }
    /// The angle from which turns are counted becomes the state's own.
    void follow(SimTK::State& state) const { last_.set(state, value(state)); }
    const Kept& last() const { return last_; }

  private:
    double value(const SimTK::State& state) const;

    scenario::JointAxis use_;
    Kept last_;
};

/// A force that stays what it was set to.
class PairPush final : public PairForce {
  public:
    PairPush(const SimTK::GeneralForceSubsystem& forces, PairCoordinate on)
        : PairForce(std::move(on)), force_(forces) {}

    double amount(const SimTK::State& state) const override { return force_.get(state); }
    void realizeTopology(SimTK::State& state) const override { force_.allocate(state); }
    void push(SimTK::State& state, double force) const { force_.set(state, force); }

  private:
    Kept force_;
};

/// Constraint that a coordinate has a speed, which is disabled by default, and one that it stays zero.
SimTK::Constraint keepSpeed(SimTK::SimbodyMatterSubsystem& matter, const PairCoordinate& of, double speed);
SimTK::Constraint keepZero(SimTK::SimbodyMatterSubsystem& matter, const PairCoordinate& of);

}  // namespace rigor::simbody
