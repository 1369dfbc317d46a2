// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One step of h:
//     find contacts where the bodies are      broad phase, narrow phase
//     make rows                               joints, contacts (approach speeds from before the forces)
//     kick                                    v += h a; damping; gyroscopic term
//     solve                                   impulses for the rows
//     drift                                   x += h v, q := exp(h w) q; angular momentum to end velocity
//     correct positions
#include <chrono>

#include "engine/pipeline/world.hpp"

namespace rigor::engine {
namespace {

template <class S>
class JointBiases final : public BiasUpdate<S> {
  public:
    JointBiases(const JointSet<S>& joints, const BodyArrays<S>& bodies, const JointStep<S>& step,
                ConstraintRows<S>& rows)
        : joints_(joints), bodies_(bodies), step_(step), rows_(rows) {}
    void updateBiases(std::span<const Velocity<S>> velocities) override {
        joints_.updateBiases(bodies_, step_, velocities, rows_);
    }

  private:
    const JointSet<S>& joints_;
    const BodyArrays<S>& bodies_;
    JointStep<S> step_;
    ConstraintRows<S>& rows_;
};

class PhaseClock {
  public:
    explicit PhaseClock(std::array<double, kPhases>& seconds) : seconds_(seconds) {}
    void end(Phase phase) {
        const auto now = std::chrono::steady_clock::now();
        seconds_[static_cast<std::size_t>(phase)] = std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

  private:
    std::array<double, kPhases>& seconds_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

const char* phaseName(Phase phase) {
    static constexpr const char* names[kPhases] = {"broad_phase", "narrow_phase", "rows",   "velocities",
                                                   "solve",       "move",         "correct"};
    return names[static_cast<std::size_t>(phase)];
}

template <class S>
const StepResult<S>& World<S>::step(Real h) {
    if (!(h > 0) || !std::isfinite(h)) throw EngineError("time_step", "a step must be positive and finite");
    result_ = {};
    PhaseClock clock(result_.seconds);

    contacts_.findPairs(bodies_, *broadPhase_, def_.speculativeDistance);
    clock.end(Phase::BroadPhase);
    contacts_.findManifolds(bodies_, collide_, def_.speculativeDistance);
    clock.end(Phase::NarrowPhase);

    Motion<S>::setInertia(bodies_);
    rows_.clear();
    const Real warmStart = def_.warmStarting && lastStepSize_ > 0 ? h / lastStepSize_ : Real(0);
    const bool curved = def_.curvedJoints && motion_.movesWithSolvedVelocity();
    const JointStep<S> jointStep{h, correction_->biasFactor(), warmStart, curved};
    joints_.addRows(bodies_, jointStep, rows_);
    // Twice what gravity adds in a step: a resting contact never approaches that fast.
    const Real gravityStep = h * def_.gravity.norm();
    const Real impactSpeed = std::max(def_.restitutionThreshold, Real(2) * gravityStep);
    contacts_.addRows(bodies_,
                      {h, def_.restitutionThreshold, Real(2) * h * gravityStep, impactSpeed,
                       correction_->biasFactor(), def_.slop, def_.gapSlop, warmStart},
                      rows_);
    clock.end(Phase::Rows);

    motion_.kick(bodies_, def_.gravity, h);
    clock.end(Phase::Velocities);

    JointBiases<S> biases(joints_, bodies_, jointStep, rows_);
    const bool first = stepCount_ == 0;
    // A millionth of what gravity adds in a step, or the limit of the precision.
    const Real converged = std::max(Real(1e-6) * gravityStep, std::numeric_limits<Real>::epsilon());
    solver_->solve(
        {rows_, bodies_.velocity, friction_, &biases,
         first ? std::max(def_.firstStepIterations, def_.velocityIterations) : def_.velocityIterations,
         first ? converged : Real(0)},
        residuals_);
    joints_.storeImpulses(rows_);
    contacts_.storeImpulses(rows_);
    clock.end(Phase::Solve);

    motion_.move(bodies_, h);
    clock.end(Phase::Move);

    // Slower than this a contact is as good as resting, and its overlap is corrected.
    const Real separating = std::max(def_.restitutionThreshold, Real(0.01));
    StepPositions<S> positions(bodies_, joints_, contacts_, rows_, motion_.used(), h, separating,
                               positionScratch_);
    correction_->correct(positions, def_.positionIterations, def_.slop);
    motion_.finish(bodies_, h);
    bodies_.wrench.assign(bodies_.size(), {});
    checkFinite();
    clock.end(Phase::Correct);

    lastStepSize_ = h;
    ++stepCount_;
    result_.pairs = contacts_.proxyPairs().size();
    result_.contacts = contacts_.separations().size();
    result_.rows = rows_.rows.size();
    result_.iterations = static_cast<int>(residuals_.size());
    result_.residuals = residuals_;
    return result_;
}

template <class S>
void World<S>::checkFinite() {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (!bodies_.pose[i].p.allFinite() || !bodies_.velocity[i].v.allFinite() ||
            !finiteAng(bodies_.velocity[i].w))
            result_.nonFinite = true;
}

#define RIGOR_INSTANTIATE(S)                            \
    template const StepResult<S>& World<S>::step(Real); \
    template void World<S>::checkFinite();
RIGOR_INSTANTIATE(Space2f)
RIGOR_INSTANTIATE(Space2d)
RIGOR_INSTANTIATE(Space3f)
RIGOR_INSTANTIATE(Space3d)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
