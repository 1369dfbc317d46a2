// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What the stages of a step do, in the order of World::forEachStage (step.cpp).
#include <algorithm>

#include "engine/pipeline/world.hpp"
#include "engine/solvers/natural_map.hpp"

namespace rigor::engine {
namespace {

/// Renews the biases of joints before an iteration, keeps its residual after it.
template <class S>
class StepMonitor final : public IterationMonitor<S> {
  public:
    using Real = typename S::Real;
    StepMonitor(JointSet<S>& joints, const BodyArrays<S>& bodies, JointStep<S>& step, ConstraintRows<S>& rows,
                Real tolerance, bool measure, const IterationObserver<S>& observer,
                std::vector<Real>& residuals)
        : joints_(joints),
          bodies_(bodies),
          step_(step),
          rows_(rows),
          tolerance_(tolerance),
          measure_(measure),
          observer_(observer),
          residuals_(residuals) {}
    void before(std::span<const Velocity<S>> velocities) override {
        change_ = joints_.updateBiases(bodies_, step_, velocities, rows_);
        ++updates_;
    }
    /// True once the joint bias, re-linearised at the predicted end-of-step poses, has stopped changing.
    bool biasConverged() const {
        const Real still = kStill * std::max(tolerance_, std::numeric_limits<Real>::epsilon());
        return updates_ < 4 || change_.step <= std::max(kSettled * change_.largest, still);
    }

    bool after(std::span<const Velocity<S>> velocities, Real change) override {
        Real residual = change;
        if (measure_) {
            before(velocities);
            residual = naturalMapResidual<S>(rows_, velocities);
        }
        residuals_.push_back(residual);
        if (observer_) observer_(static_cast<int>(residuals_.size()) - 1, rows_, residual);
        return change < tolerance_;
    }
    Real tolerance() const override { return tolerance_; }

  private:
    static constexpr Real kSettled = Real(1e-3);  ///< of the largest bias
    static constexpr Real kStill = Real(1e3);  ///< tolerances of the iteration: rounding of positions over h
    BiasChange<Real> change_;
    int updates_ = 0;  ///< convergence is not required of two or three
    JointSet<S>& joints_;
    const BodyArrays<S>& bodies_;
    JointStep<S>& step_;
    ConstraintRows<S>& rows_;
    Real tolerance_;
    bool measure_;
    const IterationObserver<S>& observer_;
    std::vector<Real>& residuals_;
};

/// Divergence test of the re-linearisation: largest work of the equality rows relative to the kinetic energy
/// of their bodies. A pendulum of length L has up to g h^2 / (2 L); a chain of 20 links 6e-5.
constexpr double kMostWork = 0.01;

}  // namespace

template <class S>
void World<S>::findPairs() {
    ccd_->predict(bodies_, contacts_.shapes().records(), def_.gravity, progress_.size);
    result_.pairTests = broadPhase_->tests();
    contacts_.findPairs(bodies_, *broadPhase_, contactSearch(), *ccd_, tasks_);
    result_.pairTests = broadPhase_->tests() - result_.pairTests;
}

template <class S>
void World<S>::findManifolds() {
    contacts_.findManifolds(bodies_, *narrowPhase_, makeManifold_, *ccd_, tasks_);
    islandsStale_ = true;
    if (sleeping_.wake) sleeping_.wake(sleepStep());
}

template <class S>
void World<S>::solve() {
    const bool fromNothing = stepCount_ == 0 && progress_.substep == 0 && !style_.iterations;
    solveVelocities(
        fromNothing ? std::max(def_.firstStepIterations, velocityIterations()) : velocityIterations(), false);
}

template <class S>
void World<S>::move() {
    motion_.move(bodies_, progress_.substepSize, tasks_);
}

/// A fault may change what would be cached.
template <class S>
ContactSearch<S> World<S>::contactSearch() const {
    if (fault_ != nullptr) return {def_.speculativeDistance, 0, 0};
    return {def_.speculativeDistance, def_.cacheTolerance, def_.boxMargin};
}

template <class S>
void World<S>::kick() {
    ccd_->remember(bodies_);
    motion_.kick(bodies_, load(), progress_.substepSize, tasks_);
    ccd_->rememberKick(bodies_);
}

template <class S>
void World<S>::resolveImpacts() {
    const Real h = progress_.substepSize;
    const bool inTime =
        ccd_->resolve({bodies_, contacts_, motion_, *narrowPhase_, friction_, def_.restitutionThreshold, h,
                       static_cast<Real>(progress_.substep) * h},
                      impacts_);
    result_.impactsCut = result_.impactsCut || !inTime;
}

template <class S>
Load<S> World<S>::load() const {
    return {def_.gravity, &forces_, time_ + progress_.substep * static_cast<double>(progress_.substepSize)};
}

template <class S>
void World<S>::makeRows() {
    const Real h = progress_.substepSize;
    const bool begins = progress_.substep == 0;
    const bool inertiaHolds =
        contactModel_->keepsInertia() && joints_.records().empty() && motion_.inertiaHolds();
    if (begins || !inertiaHolds) Motion<S>::setInertia(bodies_, tasks_);
    rows_.clear();
    const ContactStep<S> step = contactStep();
    const BiasRule<Real> jointBias =
        def_.relinearizedJoints ? step.bias : style_.linearJointBias.value_or(step.bias);
    jointStep_ = {h, jointBias, step.warmStart, def_.relinearizedJoints && motion_.movesWithSolvedVelocity()};
    joints_.addRows(bodies_, jointStep_, rows_);
    jointRows_ = rows_.rows.size();
    if (begins) contactModel_->prepare(contacts_.list(), bodies_, step, tasks_);
    contactModel_->beginSubstep(contacts_.list(), bodies_, step, rows_, tasks_);
    if (restitution_->solvesImpacts()) solveImpacts();
}

template <class S>
ContactStep<S> World<S>::contactStep() const {
    const Real h = progress_.substepSize;
    // Twice what gravity adds in a sub-step: a resting contact never approaches that fast.
    const Real gravityStep = h * def_.gravity.norm();
    return {h,
            def_.restitutionThreshold,
            Real(2) * h * gravityStep,
            std::max(def_.restitutionThreshold, Real(2) * gravityStep),
            biasRule(),
            def_.slop,
            def_.gapSlop,
            def_.warmStarting && lastStepSize_ > 0 ? h / lastStepSize_ : Real(0),
            restitution_->bounces()};
}

/// Impacts by themselves, before the forces of the step.
template <class S>
void World<S>::solveImpacts() {
    if (std::none_of(rows_.blocks.begin(), rows_.blocks.end(),
                     [](const Block<S>& block) { return block.restitution > 0; }))
        return;
    warmStart_.clear();
    for (const Row<S>& row : rows_.rows) warmStart_.push_back(row.impulse);
    const bool relinearized = std::exchange(jointStep_.relinearized, false);
    // Like a first step, an impact has no impulses to start from.
    restitution_->impact(rows_, bodies_.velocity, [this] {
        solveVelocities(std::max(def_.firstStepIterations, velocityIterations()), false);
    });
    jointStep_.relinearized = relinearized;
    joints_.storeImpulses(bodies_, rows_);
    contactModel_->store(contacts_.list(), rows_, false, tasks_);
    for (std::size_t i = 0; i < warmStart_.size(); ++i) rows_.rows[i].impulse = warmStart_[i];
}

template <class S>
BiasRule<typename S::Real> World<S>::biasRule() const {
    BiasRule<Real> rule = style_.bias ? *style_.bias : correction_->bias();
    // A spring faster than a quarter of the step rate cannot be resolved [Catto2011].
    const Real fastest = Real(0.25) / progress_.substepSize;
    rule.contact = {std::min(def_.contactFrequency, fastest), def_.contactDampingRatio};
    rule.joint = {std::min(def_.jointFrequency, fastest), def_.jointDampingRatio};
    return rule;
}

template <class S>
void World<S>::solveVelocities(int iterations, bool warmStarted) {
    const Real h = progress_.substepSize;
    const Real converged =
        def_.velocityTolerance > 0
            ? std::max(def_.velocityTolerance * h * def_.gravity.norm(), std::numeric_limits<Real>::epsilon())
            : Real(0);
    StepMonitor<S> monitor(joints_, bodies_, jointStep_, rows_, converged, def_.measureResiduals, observer_,
                           residuals_);
    SolverInput<S> input{rows_,
                         bodies_.velocity,
                         friction_,
                         monitor,
                         iterations,
                         h,
                         warmStarted,
                         def_.residualTolerance,
                         def_.pyramidDirections};
    const bool mayRestart = jointStep_.relinearized && contactModel_->canRestart();
    if (mayRestart) joints_.remember(rows_, bodies_.velocity);
    contactModel_->solve(*solver_, input, tasks_);
    result_.solverGaveUp = result_.solverGaveUp || solver_->gaveUp();
    if (!jointStep_.relinearized) return;
    // The joint biases are re-linearised in every iteration. That diverges where light links rotate far in a
    // step, or where the joints hardly allow the motion, as in a flat net: then the step is solved again with
    // the linearisation at its start.
    const bool ideal = !jointStep_.bias.soft && jointStep_.bias.baumgarte == 0;  // else joints may do work
    const bool diverges = mayRestart && ideal && joints_.work(rows_, bodies_.velocity) > Real(kMostWork);
    if (!diverges && monitor.biasConverged()) return;
    jointStep_.curvature = 0;
    if (diverges) joints_.restart(rows_, bodies_.velocity);
    input.warmStarted = warmStarted || !diverges;
    contactModel_->solve(*solver_, input, tasks_);
}

template <class S>
void World<S>::relax() {
    int iterations =
        style_.bias ? style_.relaxIterations : std::min(correction_->relaxIterations(), velocityIterations());
    if (contactModel_->applySpeculativeRestitution(contacts_.list(), rows_))
        iterations = std::max(iterations, velocityIterations());
    if (iterations == 0) return;
    rows_.relax();
    jointStep_.relinearized = false;
    solveVelocities(iterations, true);
}

template <class S>
void World<S>::solvePositions() {
    const Real h = progress_.substepSize;
    StepMonitor<S> monitor(joints_, bodies_, jointStep_, rows_, Real(0), def_.measureResiduals, observer_,
                           residuals_);
    StepPositions<S> positions(bodies_, joints_, rows_, motion_.used(), h,
                               std::numeric_limits<Real>::infinity(), positionScratch_);
    jointStep_.relinearized = false;
    solver_->solvePositions(positions,
                            {rows_, bodies_.velocity, friction_, monitor, velocityIterations(), h, true});
    // Velocities get what has moved the bodies beyond them: with symplectic Euler the result is (x - x0) / h,
    // and a body that nothing has moved keeps its velocity to the bit.
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (bodies_.invMass[i] == 0) continue;
        const Velocity<S>&used = motion_.used()[i], &moved = positionScratch_.motion[i];
        bodies_.velocity[i].v += (moved.v - h * used.v) / h;
        const Ang turned = moved.w - Ang(h * used.w);
        if (dotAng(turned, turned) == Real(0)) continue;
        const Ang whole = logMap(compose(bodies_.pose[i].q, inverse(motion_.startRotations()[i])));
        bodies_.velocity[i].w += whole / h - used.w;
    }
}

template <class S>
void World<S>::correct() {
    const Real h = progress_.substepSize;
    const bool last = progress_.substep + 1 == substeps();
    joints_.storeImpulses(bodies_, rows_);
    contactModel_->store(contacts_.list(), rows_, last, tasks_);
    if (!style_.ownsCorrection) {
        // Slower than this a contact is as good as resting, and its overlap is corrected.
        const Real separating = std::max(def_.restitutionThreshold, Real(0.01));
        StepPositions<S> positions(bodies_, joints_, rows_, motion_.used(), h, separating, positionScratch_);
        correction_->correct(positions, def_.positionIterations, def_.slop);
    }
    motion_.finish(bodies_, h, tasks_);
    if (!last) {
        // Where nothing but velocities moves bodies, these say where they are.
        const bool corrected = !style_.ownsCorrection || style_.positions;
        if (corrected)
            contactModel_->advance(contacts_.list(), positionScratch_.motion, Real(1), tasks_);
        else
            contactModel_->advance(contacts_.list(), motion_.used(), h, tasks_);
    }
    lastStepSize_ = h;
}

#define RIGOR_INSTANTIATE(S)                  \
    template void World<S>::findPairs();      \
    template void World<S>::findManifolds();  \
    template void World<S>::makeRows();       \
    template void World<S>::kick();           \
    template void World<S>::solve();          \
    template void World<S>::move();           \
    template void World<S>::resolveImpacts(); \
    template void World<S>::relax();          \
    template void World<S>::solvePositions(); \
    template void World<S>::correct();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
