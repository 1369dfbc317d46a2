// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The form in which the solver gets the contacts of a step. A solver's traits say which model it takes
// (solvers/traits.hpp, ContactForm):
//     contact_rows.hpp      rows like those of joints, made anew in every sub-step
//     contact_patches.hpp   patches, made once per step and solved in SIMD (solvers/wide)
//
//     prepare                          the first sub-step
//     for each sub-step
//         beginSubstep                 before forces act: finds points that bounce and speculative ones
//         solve                        impulses, once or several times
//         store, advance               impulses back to the contacts; separations follow the bodies
//
// Each call is for all contacts of the islands that the step solves now (pipeline/island_method.hpp).
#pragma once

#include <memory>
#include <span>

#include "engine/constraints/soft.hpp"
#include "engine/contacts/contact.hpp"
#include "engine/contacts/row_lag.hpp"
#include "engine/core/tasks.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {

/// Parameters of a sub-step for contacts.
template <class S>
struct ContactStep {
    typename S::Real h;                     ///< size of the sub-step [s]
    typename S::Real restitutionThreshold;  ///< [m/s]
    typename S::Real restingGap;            ///< upper bound of what gravity closes in this sub-step [m]
    typename S::Real impactSpeed;           ///< faster approaches are impacts and not warm started from [m/s]
    BiasRule<typename S::Real> bias;        ///< bias of the rows from penetration
    typename S::Real slop;                  ///< [m]
    typename S::Real gapSlop;               ///< gaps up to this count as closed [m]
    typename S::Real warmStart;             ///< factor on the last impulses; 0: none
    bool bounces = true;                    ///< false: restitution is off
    bool meanSlip = false;                  ///< friction opposes the mean slip of the step (updateSlips)
    bool rowsLag = false;                   ///< the rows are those of the step's middle (row_lag.hpp)
    IslandKind islands = IslandKind::Usual;      ///< the model is for the contacts of these islands
    std::span<const std::uint8_t> mayLand = {};  ///< bodies that land at their own times; empty: none
    bool continues = false;  ///< the contacts were found again within the step: their totals go on
};

/// Bits of ContactStep::mayLand: what bodies may do at their own times within a step, and what they do
/// (pipeline/step_landings.cpp, step_bounces.cpp).
inline constexpr std::uint8_t kMayLand = 1, kMayBounce = 2, kLands = 4, kBounces = 8;

/// A point of which the gap closes within the step, and whose row has the law of impact.
template <class Real>
struct LandingPoint {
    std::uint32_t block;
    Real time;     ///< fraction of the step until it closes
    bool bounces;  ///< the contact has restitution
};

/// Numbers of points and rows that a model has passed to the solver in the last sub-step.
struct ContactCounts {
    std::size_t points = 0, rows = 0;
};

template <class S>
class ContactModel {
  public:
    using Real = typename S::Real;

    virtual ~ContactModel() = default;
    virtual std::unique_ptr<ContactModel> clone() const = 0;

    /// Once per step, before the first beginSubstep(); again where the contacts were found again within it.
    virtual void prepare(ContactList<S>& contacts, const BodyArrays<S>& bodies, const ContactStep<S>& step,
                         const Tasks& tasks) = 0;
    /// The bodies' velocities are those before the forces of the sub-step. Contacts that are rows are appended
    /// to `rows`, which have the joints' already.
    virtual void beginSubstep(ContactList<S>& contacts, BodyArrays<S>& bodies, const ContactStep<S>& step,
                              ConstraintRows<S>& rows, const Tasks& tasks) = 0;
    /// Solves the joints' rows of `input` and all contacts.
    virtual void solve(Solver<S>& solver, const SolverInput<S>& input, const Tasks& tasks) = 0;
    /// Called before each iteration of a solve, at the velocities that it has reached: biases of friction rows
    /// where friction opposes the mean slip of the step, and not that at its end.
    virtual void updateSlips(std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows) const {
        (void)velocities;
        (void)rows;
    }
    /// The same for some blocks alone, in any order.
    virtual void updateSlips(std::span<const Velocity<S>> velocities, std::span<const std::uint32_t> blocks,
                             ConstraintRows<S>& rows) const {
        (void)velocities;
        (void)blocks;
        (void)rows;
    }
    /// Whether updateSlips() may change the biases of a block.
    virtual bool hasSlip(std::uint32_t block) const {
        (void)block;
        return false;
    }
    /// Called between two solves: gives points of speculative contacts that the impact has reached their
    /// rebound. Returns whether there are any.
    virtual bool applySpeculativeRestitution(const ContactList<S>& contacts, ConstraintRows<S>& rows) const {
        (void)contacts;
        (void)rows;
        return false;
    }
    /// Reads the impulses of the sub-step that ends; `last`: it is the last of its step.
    virtual void store(ContactList<S>& contacts, const ConstraintRows<S>& rows, bool last,
                       const Tasks& tasks) = 0;
    /// Updates the separations after the bodies have moved for h [s] with the given velocities, to first
    /// order: C += n . (dB + aB x rB - dA - aA x rA), with d = h v and a = h w; exact for translation and for
    /// rolling spheres.
    virtual void advance(ContactList<S>& contacts, std::span<const Velocity<S>> velocities, Real h,
                         const Tasks& tasks) = 0;

    /// The landings of the sub-step, in the order of contacts.
    virtual std::span<const LandingPoint<Real>> landings() const { return {}; }

    /// Lags of the rows of contact `index` of the list (row_lag.hpp); none in steps whose rows are not those of a midpoint.
    virtual const RowLags<S>* lagsOf(std::size_t index) const {
        (void)index;
        return nullptr;
    }

    virtual ContactCounts counts() const = 0;
    /// Later sub-steps need the bodies' world inertia of the first.
    virtual bool keepsInertia() const { return false; }
    /// store() reads what the whole step has led to, after its last sub-step alone.
    virtual bool storesOnce() const { return false; }
    /// A solve can be done again from the velocities and impulses before it.
    virtual bool canRestart() const { return true; }
    /// Points that bounce may be found ahead: they do so when they touch.
    virtual bool bouncesAhead() const { return false; }
};

template <class S>
std::unique_ptr<ContactModel<S>> makeContactModel(ContactForm form);

}  // namespace rigor::engine
