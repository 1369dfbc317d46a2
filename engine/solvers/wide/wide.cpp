// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Small steps with soft contacts, eight contacts at a time. The method is that of tgs_soft.cpp [Catto2024];
// what differs is what a contact is and how it is visited:
//   - the contacts of two shapes are one patch (patch.hpp): up to four normal rows, and friction of the patch
//     as a whole at its centre of pressure, three rows in place of eight;
//   - the points of a patch are swept twice at each visit, which calms stacks for little more time;
//   - patches are coloured so that those of one colour share no body that moves, and stand in blocks of
//     eight, number by number, which SIMD takes side by side; threads take what is between regions of bodies
//     colour by colour, then regions (colouring.hpp);
//   - patches are made once per step; in the sub-steps their separations follow the bodies to first order;
//   - joints are rows as everywhere, remade in every sub-step and solved all at once (joint_group.hpp): rigid
//     and aimed half of the way to where they should be where they are linearised (WorldDef::curvedJoints
//     off), which long chains under heavy ends need and which damps what swings; else as springs.
// Patches are reckoned with in f32 whatever the world's precision (patch.hpp); joints and bodies are not.
// A contact of one point obeys the same laws as with tgs_soft, and a patch that slides without turning or
// turns without sliding, too. Contacts that come as rows, where nobody has made patches, are solved row by
// row as there.
//
// substeps and velocity_iterations 0 mean 4 and 1. Cost per step: substeps * 2 visits of every patch.
// Known limits: those of soft contacts, tgs_soft.cpp.
#include "engine/solvers/joints/joint_group.hpp"
#include "engine/solvers/row_kernels.hpp"
#include "engine/solvers/traits.hpp"
#include "engine/solvers/wide/patches.hpp"

namespace rigor::engine {

SolverTraits makeWideTraits() {
    return {.substeps = 4,
            .iterations = 1,
            .relaxIterations = 1,
            .errors = ErrorHandling::Springs,
            // One visit solves what is linear: rigid joints, half of whose drift goes in each sub-step, and
            // the velocity of that with the relaxation. What is curved it takes as springs.
            .linearJointShare = 0.5,
            .friction = FrictionShape::Cone,
            .frictionOfPatches = true,
            .contactsInSingle = true,
            .stops = StopRule::Never};
}

namespace {

template <class S>
class Wide final : public Solver<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<Solver<S>> clone() const override { return std::make_unique<Wide>(*this); }

    SolverStyle<S> style() const override { return styleOf<S>(makeWideTraits()); }

    Patches<S>* patches() override { return &patches_; }

    void solve(const SolverInput<S>& input) override {
        if (!input.pass) return solveRowByRow(input, ContactOrder::FrictionLast, sweeps_);
        ConstraintRows<S>& rows = input.constraints;
        if (!input.warmStarted) {
            joints_.begin(rows);
            joints_.warmStart(rows, input.velocities);
        }
        PatchPass pass = *input.pass;
        pass.soft = !input.warmStarted;
        for (int i = 0; i < input.iterations; ++i) {
            input.monitor.before(input.velocities);
            pass.last = input.warmStarted && i + 1 == input.iterations;
            Real change = 0;
            if (!patches_.empty())
                change = patches_.visit(input.velocities, pass, pass.soft && i == 0, input.tasks);
            if (!joints_.empty()) change = std::max(change, joints_.solve(rows, input.velocities));
            input.monitor.after(input.velocities, change);
        }
    }

  private:
    BlockSweeps<S> sweeps_;
    JointGroup<S> joints_;
    Patches<S> patches_;
};

}  // namespace

template <class S>
std::unique_ptr<Solver<S>> makeWide() {
    return std::make_unique<Wide<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeWide, Solver);

}  // namespace rigor::engine
