// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One step of h, as World::forEachStage writes it down:
//     find contacts    broad phase, narrow phase, where the bodies are
//     in each sub-step
//         rows         joints, contacts (approach speeds from before the forces)
//         velocities   v += h a; damping; gyroscopic term
//         solve        impulses for the rows
//         move         x += h v, q := exp(h w) q
//         impacts      fast bodies back to where they collide, and on from there  (where the choice needs it)
//         relax        impulses again, without the bias of position errors        (where the choice needs it)
//         correct      position correction; angular momentum to end velocity
// Solvers that iterate on positions move first, are put right (`positions`), and solve velocities after that.
#include <algorithm>
#include <atomic>
#include <chrono>

#include "engine/pipeline/world.hpp"

namespace rigor::engine {
namespace {

class PhaseClock {
  public:
    explicit PhaseClock(std::array<double, kPhases>& seconds) : seconds_(seconds) {}
    void end(Phase phase) {
        const auto now = std::chrono::steady_clock::now();
        seconds_[static_cast<std::size_t>(phase)] += std::chrono::duration<double>(now - start_).count();
    }

  private:
    std::array<double, kPhases>& seconds_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

const char* phaseName(Phase phase) {
    static constexpr const char* names[kPhases] = {"broad_phase", "narrow_phase", "rows",    "velocities",
                                                   "solve",       "move",         "impacts", "relax",
                                                   "positions",   "correct"};
    return names[static_cast<std::size_t>(phase)];
}

/// The stages of a step in their order: calls stage(Phase, sub-step, the member function that does the work).
template <class S>
template <class Visitor>
void World<S>::forEachStage(const Visitor& stage) const {
    stage(Phase::BroadPhase, 0, &World::findPairs);
    stage(Phase::NarrowPhase, 0, &World::findManifolds);
    for (int substep = 0; substep < substeps(); ++substep) {
        stage(Phase::Rows, substep, &World::makeRows);
        stage(Phase::Velocities, substep, &World::kick);
        if (!style_.positions) {
            stage(Phase::Solve, substep, &World::solve);
            stage(Phase::Move, substep, &World::move);
            stage(Phase::Impacts, substep, &World::resolveImpacts);
            stage(Phase::Relax, substep, &World::relax);
        } else {
            stage(Phase::Move, substep, &World::move);
            stage(Phase::Positions, substep, &World::solvePositions);
            stage(Phase::Solve, substep, &World::solve);
            stage(Phase::Impacts, substep, &World::resolveImpacts);
        }
        stage(Phase::Correct, substep, &World::correct);
    }
}

template <class S>
const StepResult<S>& World<S>::step(Real h) {
    beginStep(h);
    tasks_.withWorkers([this] {
        forEachStage([this](Phase phase, int substep, Work work) { runStage(phase, substep, work); });
        endStep();
    });
    return result_;
}

template <class S>
void World<S>::beginStep(Real h) {
    if (stepping()) throw EngineError("step_in_progress", "the last step has phases left to run");
    if (!(h > 0) || !std::isfinite(h)) throw EngineError("time_step", "a step must be positive and finite");
    for (const auto& record : forces_.records())  // a force that starts or ends wakes what it acts on
        if (const auto* force = std::get_if<ConstantForce<S>>(&record.def))
            for (const double edge : {force->start, force->end})
                if (edge >= time_ && edge < time_ + static_cast<double>(h)) wakeIslandOf(record.place.b);
    result_ = {};
    residuals_.clear();
    impacts_.clear();
    joints_.clearTotals();
    motion_.beginStep();
    progress_ = {true, 0, 0, h, h / Real(substeps())};
}

template <class S>
void World<S>::runStage(Phase phase, int substep, Work work) {
    PhaseClock clock(result_.seconds);
    progress_.substep = substep;
    (this->*work)();
    if (fault_ != nullptr) injectFault(phase);
    clock.end(phase);
    ++progress_.stagesDone;
}

/// The same loop as in step(), of which this call runs the first stage that has not run yet.
template <class S>
void World<S>::runPhase() {
    if (!stepping()) throw EngineError("no_step", "no step has begun");
    const int next = progress_.stagesDone;
    int stages = 0;
    tasks_.withWorkers([&] {
        forEachStage([&](Phase phase, int substep, Work work) {
            if (stages++ == next) runStage(phase, substep, work);
        });
        if (progress_.stagesDone == stages) endStep();
    });
}

template <class S>
typename World<S>::Stage World<S>::nextStage() const {
    Stage next;
    int stages = 0;
    forEachStage([&](Phase phase, int substep, Work) {
        if (stages++ == progress_.stagesDone) next = {phase, substep};
    });
    return next;
}

template <class S>
void World<S>::endStep() {
    progress_.active = false;
    tasks_.forEach(bodies_.size(), kBodyGrain, [this](std::size_t i) { bodies_.wrench[i] = {}; });
    contacts_.keepSides(bodies_, tasks_);
    if (sleeping_.rest) sleeping_.rest(sleepStep());
    checkFinite();
    time_ += static_cast<double>(progress_.size);
    ++stepCount_;
    result_.pairs = contacts_.pairSearch().count();
    const ContactCounts contacts = contactModel_->counts();
    result_.contacts = contacts.points;
    result_.rows = jointRows_ + contacts.rows;
    result_.narrowPhaseCalls = contacts_.queries();
    result_.iterations = static_cast<int>(residuals_.size());
    result_.measure = def_.measureResiduals ? ResidualMeasure::NaturalMap : ResidualMeasure::Change;
    result_.residuals = residuals_;
    events_.clear();
    contacts_.addEvents(bodies_, events_, tasks_);
    result_.events = events_;
    breakJoints();
    result_.impacts = impacts_;
    result_.sleeping = static_cast<std::size_t>(std::count(bodies_.asleep.begin(), bodies_.asleep.end(), 1));
}

template <class S>
void World<S>::checkFinite() {
    std::atomic<bool> finite = true;
    tasks_.forEach(bodies_.size(), kBodyGrain, [&](std::size_t i) {
        if (!bodies_.pose[i].p.allFinite() || !bodies_.velocity[i].v.allFinite() ||
            !finiteAng(bodies_.velocity[i].w))
            finite = false;
    });
    if (!finite) result_.nonFinite = true;
}

#define RIGOR_INSTANTIATE(S)                                       \
    template const StepResult<S>& World<S>::step(Real);            \
    template void World<S>::beginStep(Real);                       \
    template void World<S>::runPhase();                            \
    template typename World<S>::Stage World<S>::nextStage() const; \
    template void World<S>::checkFinite();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
