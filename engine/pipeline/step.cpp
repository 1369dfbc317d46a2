// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One step of h, as Step::forEachStage writes it down:
//     find contacts    broad phase, narrow phase, where the bodies are
//     in each sub-step
//         find again   contacts of bodies in violent motion, in the middle of the step  (where the choice allows it)
//         rows         joints, contacts (approach speeds from before the forces)
//         velocities   v += h a; damping; gyroscopic term
//         solve        impulses for the rows
//         move         x += h v, q := exp(h w) q
//         impacts      fast bodies back to where they collide, and on from there  (where the choice needs it)
//         relax        impulses again, without the bias of position errors        (where the choice needs it)
//         correct      position correction; angular momentum to end velocity
// Solvers that iterate on positions move first, are put right (`positions`), and solve velocities after that.
#include "engine/pipeline/step.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

namespace rigor::engine {
namespace {

/// A force that starts or ends in [begin, end) wakes what it acts on.
template <class S>
void wakeByForces(WorldParts<S>& world, double begin, double end) {
    for (const auto& record : world.forces.records())
        if (const auto* force = std::get_if<ConstantForce<S>>(&record.def))
            for (const double edge : {force->start, force->end})
                if (edge >= begin && edge < end) world.wakeIslandOf(record.place.b);
}

}  // namespace

const char* phaseName(Phase phase) {
    static constexpr const char* names[kPhases] = {"broad_phase", "narrow_phase", "rows",    "velocities",
                                                   "solve",       "move",         "impacts", "relax",
                                                   "positions",   "correct"};
    return names[static_cast<std::size_t>(phase)];
}

/// The stages of a step in their order: calls each(islands, Phase, sub-step, the member function that does the
/// work). Which islands there are is known once the contacts are.
template <class S>
template <class Visitor>
void Step<S>::forEachStage(const WorldParts<S>& world, const StepState<S>& state, const Visitor& each) {
    each(IslandKind::Usual, Phase::BroadPhase, 0, &Step::findPairs);
    each(IslandKind::Usual, Phase::NarrowPhase, 0, &Step::findManifolds);
    // Usual islands last: their rows can be read after the step.
    for (const IslandKind islands : {IslandKind::Large, IslandKind::Violent, IslandKind::Usual}) {
        if (!state.any[islands]) continue;
        const IslandMethod<S>& method = world.algorithms.method(islands);
        for (int substep = 0; substep < method.substeps; ++substep) {
            const auto stage = [&](Phase phase, Work work) { each(islands, phase, substep, work); };
            if (substep > 0 && substep == method.secondSearch) stage(Phase::NarrowPhase, &Step::searchAgain);
            stage(Phase::Rows, &Step::makeRows);
            stage(Phase::Velocities, &Step::kick);
            if (!method.style.positions) {
                stage(Phase::Solve, &Step::solve);
                stage(Phase::Move, &Step::move);
                stage(Phase::Impacts, &Step::resolveImpacts);
                stage(Phase::Relax, &Step::relax);
            } else {
                stage(Phase::Move, &Step::move);
                stage(Phase::Positions, &Step::solvePositions);
                stage(Phase::Solve, &Step::solve);
                stage(Phase::Impacts, &Step::resolveImpacts);
            }
            stage(Phase::Correct, &Step::correct);
        }
    }
}

template <class S>
Step<S>::Step(WorldParts<S>& world, StepState<S>& state, IslandKind islands)
    : world_(world),
      state_(state),
      def_(world.def),
      algorithms_(world.algorithms),
      kind_(islands),
      method_(world.algorithms.method(islands)),
      tasks_(world.tasks),
      bodies_(world.bodies.arrays()),
      contacts_(world.contacts),
      joints_(world.joints.set()),
      motion_(method_.motion),
      contactModel_(*method_.contactModel),
      rows_(state.rows),
      result_(state.result) {}

template <class S>
void Step<S>::begin(Real h) {
    if (state_.active) throw EngineError("step_in_progress", "the last step has phases left to run");
    if (!(h > 0) || !std::isfinite(h))
        throw EngineError("time_step",
                          "found " + std::to_string(h) + ", expected a finite number above 0 [s]");
    const double now = world_.clock.time;
    wakeByForces(world_, now, now + static_cast<double>(h));
    result_ = {};
    state_.residuals.clear();
    state_.residuals.reserve(static_cast<std::size_t>(method_.velocityIterations * method_.substeps));
    state_.impacts.clear();
    joints_.clearTotals();
    state_.active = true;
    state_.stagesDone = state_.substep = 0;
    state_.size = h;
    state_.substepSize = h / Real(algorithms_.usual.substeps);
    state_.any = {true};
}

template <class S>
void Step<S>::runAll() {
    try {
        tasks_.withWorkers([this] {
            Clock::time_point mark = Clock::now();
            forEachStage(world_, state_, [&](IslandKind islands, Phase phase, int substep, Work work) {
                Step(world_, state_, islands).run(phase, substep, work, mark);
            });
            end();
        });
    } catch (...) {
        abandon();
        throw;
    }
}

/// A stage begins where the one before it has ended: `mark`, which this call moves on. In a tiny world reading the clock
/// costs as much as a stage.
template <class S>
void Step<S>::run(Phase phase, int substep, Work work, Clock::time_point& mark) {
    state_.substep = substep;
    if (phase == Phase::Rows && substep == 0) beginIslands();
    (this->*work)();
    if (algorithms_.fault != nullptr) injectFault(phase);
    const Clock::time_point now = Clock::now();
    result_.seconds[static_cast<std::size_t>(phase)] += std::chrono::duration<double>(now - mark).count();
    mark = now;
    ++state_.stagesDone;
}

/// The same loop as in runAll(), of which this call runs the first stage that has not run yet.
template <class S>
void Step<S>::runNext() {
    if (!state_.active) throw EngineError("no_step", "no step has begun");
    const int next = state_.stagesDone;
    int stages = 0;
    try {
        tasks_.withWorkers([&] {
            Clock::time_point mark = Clock::now();
            forEachStage(world_, state_, [&](IslandKind islands, Phase phase, int substep, Work work) {
                if (stages++ == next) Step(world_, state_, islands).run(phase, substep, work, mark);
            });
            if (state_.stagesDone == stages) end();
        });
    } catch (...) {
        abandon();
        throw;
    }
}

/// A callback has thrown: the step ends where it is, and the next one may begin.
template <class S>
void Step<S>::abandon() {
    state_.active = false;
    for (std::uint32_t i = 0; i < state_.sort.paused.size(); ++i) resume(i);
}

template <class S>
typename Step<S>::Stage Step<S>::next(const WorldParts<S>& world, const StepState<S>& state) {
    Stage next;
    int stages = 0;
    forEachStage(world, state, [&](IslandKind, Phase phase, int substep, Work) {
        if (stages++ == state.stagesDone) next = {phase, substep};
    });
    return next;
}

template <class S>
void Step<S>::end() {
    state_.active = false;
    endIslands();
    tasks_.forEach(bodies_.size(), kBodyGrain, [this](std::size_t i) { bodies_.wrench[i] = {}; });
    contacts_.keepSides(bodies_, tasks_);
    if (algorithms_.sleeping.rest) algorithms_.sleeping.rest(sleepStep());
    if (motion_.isAtMidpoint()) toEnd();
    result_.nonFinite = !isFinite();
    world_.clock.time += static_cast<double>(state_.size);
    ++world_.clock.steps;
    result_.pairs = contacts_.pairSearch().count();
    result_.narrowPhaseCalls = contacts_.queries();
    result_.iterations = static_cast<int>(state_.residuals.size());
    result_.measure = def_.measureResiduals ? ResidualMeasure::NaturalMap : ResidualMeasure::Change;
    result_.residuals = state_.residuals;
    state_.events.clear();
    contacts_.addEvents(bodies_, state_.events, tasks_);
    result_.events = state_.events;
    breakJoints();
    result_.impacts = state_.impacts;
    result_.sleeping = static_cast<std::size_t>(std::count(bodies_.asleep.begin(), bodies_.asleep.end(), 1));
}

/// Removes the joints whose mean force or torque over the step was too large for them.
template <class S>
void Step<S>::breakJoints() {
    world_.joints.findOverloaded(world_.lastStepSize(), state_.broken);
    for (const JointId joint : state_.broken) world_.removeJoint(joint);
    result_.broken = state_.broken;
}

template <class S>
bool Step<S>::isFinite() const {
    std::atomic<bool> finite = true;
    tasks_.forEach(bodies_.size(), kBodyGrain, [&](std::size_t i) {
        if (!bodies_.pose[i].p.allFinite() || !bodies_.velocity[i].v.allFinite() ||
            !finiteAng(bodies_.velocity[i].w))
            finite = false;
    });
    return finite;
}

#define RIGOR_INSTANTIATE(S)                                           \
    template Step<S>::Step(WorldParts<S>&, StepState<S>&, IslandKind); \
    template void Step<S>::begin(Real);                                \
    template void Step<S>::runAll();                                   \
    template void Step<S>::runNext();                                  \
    template typename Step<S>::Stage Step<S>::next(const WorldParts<S>&, const StepState<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
