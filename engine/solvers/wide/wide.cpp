// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Small steps with soft contacts, eight contacts at a time in SIMD. The method is that of tgs_soft.cpp
// [Catto2024], with a different contact model and order:
//   - the contact of two shapes is one patch (patch.hpp): up to four normal rows, and friction of the whole
//     patch at its center of pressure, three rows in place of eight;
//   - each pass sweeps the points of a patch forwards and backwards, which steadies stacks at little cost;
//   - patches are coloured so that those of one colour share no moving body, and stored in blocks of eight,
//     structure of arrays, for SIMD; threads solve the contacts between partitions of bodies colour by
//     colour, then one partition each (colouring.hpp);
//   - patches are made once per step; in the sub-steps their separations follow the bodies to first order;
//   - joints are rows as in the other solvers, made again in every sub-step and solved by one factorisation
//     (joint_group.hpp). Linearised joints (WorldDef::relinearizedJoints off) are rigid with a Baumgarte
//     factor of one half: long chains under heavy ends need it, and it damps swings. Otherwise they are
//     springs.
// Patches are f32 whatever the world's precision (patch.hpp); joints and bodies are not.
// A contact of one point obeys the same laws as with tgs_soft; so does a patch that slides without spinning
// or spins without sliding. Contacts given as rows are solved row by row as there.
//
// substeps and velocity_iterations 0 mean 4 and 1. Cost per step: substeps * 2 passes over all patches.
// Known limits: those of soft contacts, tgs_soft.cpp.
#include "engine/solvers/joints/joint_group.hpp"
#include "engine/solvers/sequential_impulses.hpp"
#include "engine/solvers/traits.hpp"
#include "engine/solvers/wide/patch_solver.hpp"

namespace rigor::engine {

SolverTraits makeWideTraits() {
    return {.substeps = 4,
            .iterations = 1,
            .relaxIterations = 1,
            .errors = ErrorHandling::Springs,
            // One pass solves linearised joints: rigid, with half of the drift removed in each sub-step and
            // the velocity of that removed by the relaxation. Joints are springs otherwise.
            .linearJointBaumgarte = 0.5,
            .friction = FrictionShape::Cone,
            .contacts = ContactForm::Patches,
            .frictionOfPatches = true,
            .contactsInSingle = true,
            .stops = StopRule::Never};
}

namespace {

template <class S>
class Wide final : public PatchSolver<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<Solver<S>> clone() const override { return std::make_unique<Wide>(*this); }

    SolverStyle<S> style() const override { return styleOf<S>(makeWideTraits()); }

    void useThreads(const Tasks& tasks) override { sweeps_.useThreads(tasks); }

    void solve(const SolverInput<S>& input) override {
        solveRowByRow(input, ContactOrder::FrictionLast, sweeps_);
    }

    void solvePatches(const SolverInput<S>& input, Patches<S>& patches, const PatchPass& parameters,
                      const Tasks& tasks) override {
        ConstraintRows<S>& rows = input.constraints;
        joints_.useThreads(tasks);
        if (!input.warmStarted) {
            joints_.begin(rows);
            joints_.warmStart(rows, input.velocities);
        }
        PatchPass pass = parameters;
        pass.soft = !input.warmStarted;
        for (int i = 0; i < input.iterations; ++i) {
            input.monitor.before(input.velocities);
            pass.last = input.warmStarted && i + 1 == input.iterations;
            Real change = 0;
            if (!patches.empty())
                change = patches.solvePass(input.velocities, pass, pass.soft && i == 0, tasks);
            if (!joints_.empty()) change = std::max(change, joints_.solve(rows, input.velocities));
            input.monitor.after(input.velocities, change);
        }
    }

  private:
    BlockSweeps<S> sweeps_;
    JointGroup<S> joints_;
};

}  // namespace

template <class S>
std::unique_ptr<Solver<S>> makeWide() {
    return std::make_unique<Wide<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeWide, Solver);

}  // namespace rigor::engine
