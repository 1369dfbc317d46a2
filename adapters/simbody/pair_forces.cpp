// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/simbody/pair_forces.hpp"

#include <cmath>
#include <numbers>

#include "adapters/interface/joint_trees.hpp"

namespace rigor::simbody {

using SimTK::Array_;
using SimTK::ConstrainedBodyIndex;
using SimTK::SpatialVec;
using SimTK::State;

SpatialVec PairForce::onB(const State& state) const {
    return amount(state) * on_.gradient(on_.poses(state)).b;
}

void PairForce::calcForce(const State& state, SimTK::Vector_<SpatialVec>& forces,
                          SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector&) const {
    const double force = amount(state);
    if (force == 0.0) return;
    const PairCoordinate::Motions along = on_.gradient(on_.poses(state));
    forces[on_.a().getMobilizedBodyIndex()] += force * along.a;
    forces[on_.b().getMobilizedBodyIndex()] += force * along.b;
}

void Kept::allocate(State& state) const {
    index_ =
        forces_.allocateDiscreteVariable(state, SimTK::Stage::Dynamics, new SimTK::Value<SimTK::Real>(0.0));
}
double Kept::get(const State& state) const {
    return SimTK::Value<SimTK::Real>::downcast(forces_.getDiscreteVariable(state, index_));
}
void Kept::set(State& state, double value) const {
    SimTK::Value<SimTK::Real>::updDowncast(forces_.updDiscreteVariable(state, index_)) = value;
}

PairSpring::PairSpring(const SimTK::GeneralForceSubsystem& forces, PairCoordinate on,
                       const scenario::JointAxis& use)
    : PairForce(std::move(on)), use_(use), last_(forces) {}

double PairSpring::value(const State& state) const {
    const double value = on_.value(on_.poses(state));
    return countsTurns() ? adapter::nearestTurn(value, last_.get(state)) : value;
}

double PairSpring::amount(const State& state) const {
    const PairCoordinate::Poses at = on_.poses(state);
    const double rate = PairCoordinate::product(on_.gradient(at), on_.motions(state));
    const double stretch = use_.stiffness > 0.0 ? value(state) - use_.target : 0.0;
    return -(use_.stiffness * stretch + use_.damping * rate);
}

namespace {

/// A constraint on one coordinate. Poses and motions are in the frame of the nearest body that carries both.
class OnPair : public SimTK::Constraint::Custom::Implementation {
  public:
    OnPair(SimTK::SimbodyMatterSubsystem& matter, const PairCoordinate& on, bool isPosition)
        : Implementation(matter, isPosition ? 1 : 0, isPosition ? 0 : 1, 0),
          on_(on),
          a_(addConstrainedBody(on.a())),
          b_(addConstrainedBody(on.b())) {}

  protected:
    using Bodies = Array_<SpatialVec, ConstrainedBodyIndex>;
    using Forces = Array_<SpatialVec, ConstrainedBodyIndex>;
    using Reals = Array_<SimTK::Real>;

    PairCoordinate::Poses posesOf(const State& state) const {
        return {getBodyTransformFromState(state, a_), getBodyTransformFromState(state, b_)};
    }
    double rateOf(const State& state, const Bodies& motions) const {
        return PairCoordinate::product(on_.gradient(posesOf(state)), {motions[a_], motions[b_]});
    }
    double accelerationOf(const State& state, const Bodies& accelerations) const {
        return rateOf(state, accelerations) + on_.bias(posesOf(state), {getBodyVelocityFromState(state, a_),
                                                                        getBodyVelocityFromState(state, b_)});
    }
    void addForces(const State& state, double force, Forces& forces) const {
        const PairCoordinate::Motions along = on_.gradient(posesOf(state));
        forces[a_] += force * along.a;
        forces[b_] += force * along.b;
    }

    PairCoordinate on_;
    ConstrainedBodyIndex a_, b_;
};

class Speed final : public OnPair {
  public:
    Speed(SimTK::SimbodyMatterSubsystem& matter, const PairCoordinate& on, double speed)
        : OnPair(matter, on, false), speed_(speed) {
        setDisabledByDefault(true);
    }
    Implementation* clone() const override { return new Speed(*this); }

    void calcVelocityErrors(const State& state, const Bodies& motions,
                            const Array_<SimTK::Real, SimTK::ConstrainedUIndex>&,
                            Reals& errors) const override {
        errors[0] = rateOf(state, motions) - speed_;
    }
    void calcVelocityDotErrors(const State& state, const Bodies& accelerations,
                               const Array_<SimTK::Real, SimTK::ConstrainedUIndex>&,
                               Reals& errors) const override {
        errors[0] = accelerationOf(state, accelerations);
    }
    void addInVelocityConstraintForces(const State& state, const Reals& multipliers, Forces& forces,
                                       Array_<SimTK::Real, SimTK::ConstrainedUIndex>&) const override {
        addForces(state, multipliers[0], forces);
    }

  private:
    double speed_;
};

class Zero final : public OnPair {
  public:
    Zero(SimTK::SimbodyMatterSubsystem& matter, const PairCoordinate& on) : OnPair(matter, on, true) {}
    Implementation* clone() const override { return new Zero(*this); }

    void calcPositionErrors(const State&, const Array_<SimTK::Transform, ConstrainedBodyIndex>& poses,
                            const Array_<SimTK::Real, SimTK::ConstrainedQIndex>&,
                            Reals& errors) const override {
        errors[0] = on_.value({poses[a_], poses[b_]});
    }
    void calcPositionDotErrors(const State& state, const Bodies& motions,
                               const Array_<SimTK::Real, SimTK::ConstrainedQIndex>&,
                               Reals& errors) const override {
        errors[0] = rateOf(state, motions);
    }
    void calcPositionDotDotErrors(const State& state, const Bodies& accelerations,
                                  const Array_<SimTK::Real, SimTK::ConstrainedQIndex>&,
                                  Reals& errors) const override {
        errors[0] = accelerationOf(state, accelerations);
    }
    void addInPositionConstraintForces(const State& state, const Reals& multipliers, Forces& forces,
                                       Array_<SimTK::Real, SimTK::ConstrainedQIndex>&) const override {
        addForces(state, multipliers[0], forces);
    }
};

}  // namespace

SimTK::Constraint keepSpeed(SimTK::SimbodyMatterSubsystem& matter, const PairCoordinate& of, double speed) {
    return SimTK::Constraint::Custom(new Speed(matter, of, speed));
}
SimTK::Constraint keepZero(SimTK::SimbodyMatterSubsystem& matter, const PairCoordinate& of) {
    return SimTK::Constraint::Custom(new Zero(matter, of));
}

}  // namespace rigor::simbody
