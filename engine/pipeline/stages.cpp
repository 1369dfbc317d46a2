// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Implementation of the stages of a step, in the order of Step::forEachStage (step.cpp).
#include <algorithm>
#include <limits>
#include <utility>

#include "engine/pipeline/step.hpp"
#include "engine/solvers/natural_map.hpp"

namespace rigor::engine {
namespace {

/// Renews the biases of joints and of contacts that slide before an iteration, keeps its residual after it.
template <class S>
class StepMonitor final : public IterationMonitor<S> {
  public:
    using Real = typename S::Real;
    StepMonitor(JointSet<S>& joints, const ContactModel<S>& contacts, const BodyArrays<S>& bodies,
                JointStep<S>& step, ConstraintRows<S>& rows, Real tolerance, bool measure,
                const IterationObserver<S>& observer, std::vector<Real>& residuals)
        : joints_(joints),
          contacts_(contacts),
          bodies_(bodies),
          step_(step),
          rows_(rows),
          tolerance_(tolerance),
          measure_(measure),
          observer_(observer),
          residuals_(residuals) {}
    void before(std::span<const Velocity<S>> velocities) override {
        joints_.updateBiases(bodies_, step_, velocities, rows_);
        contacts_.updateSlips(velocities, rows_);
    }
    void before(std::span<const Velocity<S>> velocities, std::span<const std::uint32_t> blocks) override {
        joints_.updateBiases(bodies_, step_, velocities, rows_, blocks);
        contacts_.updateSlips(velocities, blocks, rows_);
    }
    bool mayRenew(std::uint32_t block) const override {
        return !isOfContact(rows_.blocks[block].kind) || contacts_.hasSlip(block);
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
    JointSet<S>& joints_;
    const ContactModel<S>& contacts_;
    const BodyArrays<S>& bodies_;
    JointStep<S>& step_;
    ConstraintRows<S>& rows_;
    Real tolerance_;
    bool measure_;
    const IterationObserver<S>& observer_;
    std::vector<Real>& residuals_;
};

}  // namespace

template <class S>
void Step<S>::findPairs() {
    if (motion_.isAtMidpoint()) toMidpoints();
    ContinuousCollision<S>& ccd = *algorithms_.ccd;
    BroadPhase<S>& broadPhase = *algorithms_.broadPhase;
    ccd.predict(bodies_, contacts_.shapes().records(), def_.gravity, state_.size);
    ContactSearch<S> search{def_.speculativeDistance, def_.cacheTolerance, def_.boxMargin,
                            algorithms_.usual.speculativeMotion * state_.size};
    search.volume = algorithms_.boundingVolume;
    search.bouncesAhead = contactModel_.bouncesAhead() || locatesLandings();
    if (algorithms_.large) {
        search.largeCacheTolerance = algorithms_.large->cacheTolerance;
        if (std::find(bodies_.islands.begin(), bodies_.islands.end(), IslandKind::Large) !=
            bodies_.islands.end())
            search.largeMotionTime = algorithms_.large->speculativeMotion * state_.size;
        search.bouncesAhead = search.bouncesAhead && algorithms_.large->contactModel->bouncesAhead();
    }
    if (algorithms_.fault != nullptr)
        search.cacheTolerance = search.boxMargin = 0;  // it may change the cache
    const std::size_t before = broadPhase.tests();
    contacts_.findPairs(bodies_, broadPhase, search, ccd, tasks_);
    result_.pairTests = broadPhase.tests() - before;
}

template <class S>
void Step<S>::findManifolds() {
    contacts_.findManifolds(bodies_, *algorithms_.narrowPhase, algorithms_.makeManifold, *algorithms_.ccd,
                            tasks_);
    world_.islands.changed();
    if (algorithms_.sleeping.wake) algorithms_.sleeping.wake(sleepStep());
    if (algorithms_.large) sortIslands();
    if (locatesLandings()) placeBounces();
    if (rowsLag()) findFirstFrames();
}

template <class S>
SleepStep<S> Step<S>::sleepStep() {
    return {bodies_,     contacts_.list(),         world_.currentIslands(),   world_.islands.marks(),
            state_.size, def_.sleepLinearVelocity, def_.sleepAngularVelocity, def_.timeToSleep};
}

template <class S>
void Step<S>::makeRows() {
    const Real h = state_.substepSize;
    const bool begins = state_.substep == 0;
    const bool inertiaHolds =
        contactModel_.keepsInertia() && joints_.records().empty() && motion_.inertiaHolds();
    if (begins || !inertiaHolds) Motion<S>::setInertia(bodies_, tasks_);
    rows_.clear();
    if (motion_.isAtMidpoint()) findLandingBodies();
    const ContactStep<S> step = contactStep();  // refers to the bodies that may land
    const BiasRule<Real> jointBias =
        method_.relinearizedJoints ? step.bias : method_.style.linearJointBias.value_or(step.bias);
    state_.jointStep = {h,
                        jointBias,
                        step.warmStart,
                        method_.relinearizedJoints && motion_.movesWithSolvedVelocity(),
                        step.islands,
                        motion_.isAtMidpoint() && !method_.style.positions,
                        begins};
    joints_.addRows(bodies_, state_.jointStep, rows_, tasks_);
    state_.jointRows = rows_.rows.size();
    if (begins || (state_.searchedAgain && state_.substep == method_.secondSearch))
        contactModel_.prepare(contacts_.list(), bodies_, step, tasks_);
    contactModel_.beginSubstep(contacts_.list(), bodies_, step, rows_, tasks_);
    if (algorithms_.restitution->solvesImpacts()) solveImpacts();
}

/// Sub-steps after the first have rows of a midpoint that does not follow one of the step before.
template <class S>
bool Step<S>::rowsLag() const {
    return motion_.isAtMidpoint() && !method_.style.positions && method_.substeps == 1;
}

/// The widest gap at a midpoint that counts as closed [m]. Iterations end at a tolerance, and the gaps that the velocities
/// left over open would be closed by velocities of their size in the next step, and so on: contacts at rest never would be.
template <class S>
typename S::Real gapAtMidpoint(const WorldDef<S>& def, typename S::Real h) {
    using Real = typename S::Real;
    const Real left = Real(100) * def.velocityTolerance * h * h * def.gravity.norm();
    const Real rounding = Real(8) * std::numeric_limits<Real>::epsilon();  // positions of a metre have it
    return std::min(def.gapSlop, std::max(left, rounding));
}

template <class S>
ContactStep<S> Step<S>::contactStep() const {
    const Real h = state_.substepSize;
    // Twice what gravity adds in a sub-step: a resting contact never approaches that fast.
    const Real gravityStep = h * def_.gravity.norm();
    return {h,
            def_.restitutionThreshold,
            Real(2) * h * gravityStep,
            std::max(def_.restitutionThreshold, Real(2) * gravityStep),
            biasRule(),
            def_.slop,
            motion_.isAtMidpoint() ? gapAtMidpoint(def_, h) : def_.gapSlop,
            def_.warmStarting && state_.lastSubstepSize > 0 ? h / state_.lastSubstepSize : Real(0),
            algorithms_.restitution->bounces(),
            motion_.isAtMidpoint() && !method_.style.positions,
            rowsLag(),
            state_.islands,
            state_.mayLand,
            state_.searchedAgain};
}

template <class S>
BiasRule<typename S::Real> Step<S>::biasRule() const {
    BiasRule<Real> rule = method_.style.bias ? *method_.style.bias : algorithms_.correction->bias();
    // A spring faster than a quarter of the step rate cannot be resolved [Catto2011].
    const Real fastest = Real(0.25) / state_.substepSize;
    rule.contact = {std::min(method_.contactFrequency, fastest), def_.contactDampingRatio};
    rule.joint = {std::min(def_.jointFrequency, fastest), def_.jointDampingRatio};
    return rule;
}

/// Impacts by themselves, before the forces of the step.
template <class S>
void Step<S>::solveImpacts() {
    if (std::none_of(rows_.blocks.begin(), rows_.blocks.end(),
                     [](const Block<S>& block) { return block.restitution > 0; }))
        return;
    state_.warmStart.clear();
    for (const Row<S>& row : rows_.rows) state_.warmStart.push_back(row.impulse);
    const bool relinearized = std::exchange(state_.jointStep.relinearized, false);
    // An impact has no impulses for a warm start, like a first step.
    algorithms_.restitution->impact(rows_, bodies_.velocity, [this] {
        solveVelocities(std::max(def_.firstStepIterations, method_.velocityIterations), false);
    });
    state_.jointStep.relinearized = relinearized;
    joints_.storeImpulses(bodies_, rows_, false, tasks_);
    contactModel_.store(contacts_.list(), rows_, false, tasks_);
    for (std::size_t i = 0; i < state_.warmStart.size(); ++i) rows_.rows[i].impulse = state_.warmStart[i];
}

template <class S>
void Step<S>::kick() {
    const double now = world_.clock.time + state_.substep * static_cast<double>(state_.substepSize);
    algorithms_.ccd->remember(bodies_);
    if (algorithms_.locatesImpacts) state_.flights.beforeKick(bodies_);
    motion_.kick(bodies_, {def_.gravity, &world_.forces, now}, state_.substepSize, tasks_);
    algorithms_.ccd->rememberKick(bodies_);
    if (algorithms_.locatesImpacts) state_.flights.afterKick(bodies_);
}

template <class S>
void Step<S>::solve() {
    if (motion_.isAtMidpoint()) beginLandings();
    // A first step has no impulses to start from.
    const bool fromNothing = world_.clock.steps == 0 && state_.substep == 0 && !method_.style.iterations;
    const int usual = method_.velocityIterations;
    solveVelocities(fromNothing ? std::max(def_.firstStepIterations, usual) : usual, false);
}

template <class S>
void Step<S>::solveVelocities(int iterations, bool warmStarted) {
    const Real h = state_.substepSize;
    const Real converged =
        def_.velocityTolerance > 0
            ? std::max(def_.velocityTolerance * h * def_.gravity.norm(), std::numeric_limits<Real>::epsilon())
            : Real(0);
    StepMonitor<S> monitor(joints_, contactModel_, bodies_, state_.jointStep, rows_, converged,
                           def_.measureResiduals, state_.observer, state_.residuals);
    SolverInput<S> input{rows_,       bodies_.velocity,       algorithms_.friction,  monitor, iterations, h,
                         warmStarted, def_.residualTolerance, def_.pyramidDirections};
    const bool mayRestart = state_.jointStep.relinearized && contactModel_.canRestart();
    if (mayRestart) state_.convergence.remember(joints_, rows_, bodies_.velocity);
    contactModel_.solve(*method_.solver, input, tasks_);
    result_.solverGaveUp = result_.solverGaveUp || method_.solver->gaveUp();
    if (!state_.jointStep.relinearized) return;
    const bool ideal =
        !state_.jointStep.bias.soft && state_.jointStep.bias.baumgarte == 0;  // other joints may do work
    // Rounding of positions changes biases by that over h.
    const Real still = Real(1e3) * std::max(converged, std::numeric_limits<Real>::epsilon());
    joints_.updateChanging(bodies_, state_.jointStep, bodies_.velocity, rows_, still);
    state_.convergence.find(joints_, rows_, bodies_.velocity, still, mayRestart && ideal);
    state_.convergence.restart(rows_, bodies_.velocity);
    solveLinearised(input, state_.convergence.working());
    input.warmStarted = true;
    solveLinearised(input, state_.convergence.changing());
}

/// Solves parts again whose joints have diverged, without their curvature. Contacts that have no rows cannot be taken apart.
template <class S>
void Step<S>::solveLinearised(const SolverInput<S>& input, std::span<const std::uint32_t> blocks) {
    if (blocks.empty()) return;
    joints_.linearise(bodies_, state_.jointStep, input.velocities, rows_, blocks);
    if (blocks.size() == rows_.blocks.size() || !contactModel_.canRestart()) {
        contactModel_.solve(*method_.solver, input, tasks_);
    } else {
        state_.part.load(input, blocks, true);
        contactModel_.solve(*method_.solver, state_.part.input(), tasks_);
        state_.part.store();
    }
    result_.solverGaveUp = result_.solverGaveUp || method_.solver->gaveUp();
}

template <class S>
void Step<S>::move() {
    motion_.move(bodies_, state_.substepSize, tasks_);
    if (motion_.isAtMidpoint()) placeLandings();
}

/// The world around a move of h [s] that begins `begin` [s] after the step. Bodies that are paused take no part.
template <class S>
MovedWorld<S> Step<S>::movedWorld(Real h, Real begin, std::span<const std::uint8_t> paused) {
    return {bodies_,
            contacts_,
            motion_,
            *algorithms_.narrowPhase,
            algorithms_.friction,
            def_.restitutionThreshold,
            h,
            begin,
            paused};
}

template <class S>
void Step<S>::resolveImpacts() {
    const Real h = state_.substepSize;
    const Real begin =
        static_cast<Real>(state_.substep) * h + (motion_.isAtMidpoint() ? Real(0.5) * h : Real(0));
    const bool inTime = algorithms_.ccd->resolve(movedWorld(h, begin, pausedBodies()), state_.impacts);
    result_.impactsCut = result_.impactsCut || !inTime;
}

template <class S>
void Step<S>::relax() {
    int iterations = method_.style.bias
                         ? method_.style.relaxIterations
                         : std::min(algorithms_.correction->relaxIterations(), method_.velocityIterations);
    if (contactModel_.applySpeculativeRestitution(contacts_.list(), rows_))
        iterations = std::max(iterations, method_.velocityIterations);
    if (iterations == 0) return;
    rows_.relax();
    state_.jointStep.relinearized = false;
    solveVelocities(iterations, true);
}

template <class S>
void Step<S>::solvePositions() {
    const Real h = state_.substepSize;
    StepMonitor<S> monitor(joints_, contactModel_, bodies_, state_.jointStep, rows_, Real(0),
                           def_.measureResiduals, state_.observer, state_.residuals);
    StepPositions<S> positions(bodies_, joints_, rows_, motion_.used(), h,
                               std::numeric_limits<Real>::infinity(), state_.positions);
    state_.jointStep.relinearized = false;
    method_.solver->solvePositions(positions, {rows_, bodies_.velocity, algorithms_.friction, monitor,
                                               method_.velocityIterations, h, true});
    // Velocities get what has moved the bodies beyond them: with symplectic Euler the result is (x - x0) / h,
    // and a body that nothing has moved keeps its velocity to the bit.
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (bodies_.invMass[i] == 0) continue;
        const Velocity<S>&used = motion_.used()[i], &moved = state_.positions.motion[i];
        bodies_.velocity[i].v += (moved.v - h * used.v) / h;
        const Ang turned = moved.w - Ang(h * used.w);
        if (dotAng(turned, turned) == Real(0)) continue;
        const Ang whole = logMap(compose(bodies_.pose[i].q, inverse(motion_.startRotations()[i])));
        bodies_.velocity[i].w += whole / h - used.w;
    }
}

template <class S>
void Step<S>::correct() {
    const Real h = state_.substepSize;
    const bool last = state_.substep + 1 == method_.substeps;
    if (last) countContacts();
    joints_.storeImpulses(bodies_, rows_, last, tasks_);
    contactModel_.store(contacts_.list(), rows_, last, tasks_);
    if (!method_.style.ownsCorrection) {
        // Slower than this a contact is as good as resting, and its overlap is corrected.
        const Real separating = std::max(def_.restitutionThreshold, Real(0.01));
        StepPositions<S> positions(bodies_, joints_, rows_, motion_.used(), h, separating, state_.positions);
        // Joints are put right again at the end of the step; one iteration keeps midpoints from drifting.
        const int most = def_.positionIterations, alone = motion_.isAtMidpoint() ? std::min(most, 1) : most;
        algorithms_.correction->correct(positions, {most, most, alone}, def_.slop);
    }
    motion_.finish(bodies_, h, tasks_);
    if (!last) advanceContacts();
    state_.lastSubstepSize = h;
}

template <class S>
void Step<S>::countContacts() {
    const ContactCounts contacts = contactModel_.counts();
    result_.contacts += contacts.points;
    result_.rows += state_.jointRows + contacts.rows;
}

/// Advances the contacts' separations: by the corrected poses if positions were corrected, by velocities
/// otherwise.
template <class S>
void Step<S>::advanceContacts() {
    const bool corrected = !method_.style.ownsCorrection || method_.style.positions;
    if (corrected)
        contactModel_.advance(contacts_.list(), state_.positions.motion, Real(1), tasks_);
    else
        contactModel_.advance(contacts_.list(), motion_.used(), state_.substepSize, tasks_);
}

#define RIGOR_INSTANTIATE(S)                                                                     \
    template void Step<S>::findPairs();                                                          \
    template void Step<S>::findManifolds();                                                      \
    template void Step<S>::makeRows();                                                           \
    template void Step<S>::kick();                                                               \
    template void Step<S>::solve();                                                              \
    template void Step<S>::move();                                                               \
    template MovedWorld<S> Step<S>::movedWorld(S::Real, S::Real, std::span<const std::uint8_t>); \
    template void Step<S>::resolveImpacts();                                                     \
    template void Step<S>::relax();                                                              \
    template void Step<S>::solvePositions();                                                     \
    template void Step<S>::correct();                                                            \
    template SleepStep<S> Step<S>::sleepStep();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
