// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts as the patches of the solver `wide` (solvers/wide/patch.hpp): made once per step, their impulses
// are read back at its end.
//
// Invariant: patch source k is contact k of the list; Contact::block is kPatch at all points of a contact that
// is solved, else kNullIndex.
#pragma once

#include "engine/contacts/contact_model.hpp"
#include "engine/solvers/wide/patches.hpp"

namespace rigor::engine {

template <class S>
class PatchContacts final : public ContactModel<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<ContactModel<S>> clone() const override { return std::make_unique<PatchContacts>(*this); }
    void prepare(ContactList<S>& contacts, const BodyArrays<S>& bodies, const ContactStep<S>& step,
                 const Tasks& tasks) override;
    void beginSubstep(ContactList<S>& contacts, BodyArrays<S>& bodies, const ContactStep<S>& step,
                      ConstraintRows<S>& rows, const Tasks& tasks) override;
    /// `solver` is a PatchSolver.
    void solve(Solver<S>& solver, const SolverInput<S>& input, const Tasks& tasks) override;
    void store(ContactList<S>& contacts, const ConstraintRows<S>& rows, bool last,
               const Tasks& tasks) override;
    void advance(ContactList<S>& contacts, std::span<const Velocity<S>> velocities, Real h,
                 const Tasks& tasks) override;
    ContactCounts counts() const override { return {patches_.points(), patches_.rows()}; }
    bool keepsInertia() const override { return true; }
    bool storesOnce() const override { return true; }
    bool canRestart() const override { return false; }
    bool bouncesAhead() const override { return true; }

  private:
    Patches<S> patches_;
    PatchPass pass_;          ///< constants of the sub-step
    bool continues_ = false;  ///< ContactStep::continues of the last prepare()
};

}  // namespace rigor::engine
