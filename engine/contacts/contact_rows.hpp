// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts as rows, in every sub-step anew. The rows of a point, and the conditions for none, are in
// contact_rows.cpp.
//
// Invariant: Contact::block[i] is the row block of point i in the last sub-step, kNullIndex where it has none.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/contacts/contact_model.hpp"
#include "engine/contacts/row_lag.hpp"

namespace rigor::engine {

template <class S>
class RowContacts final : public ContactModel<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<ContactModel<S>> clone() const override { return std::make_unique<RowContacts>(*this); }
    void prepare(ContactList<S>& contacts, const BodyArrays<S>& bodies, const ContactStep<S>& step,
                 const Tasks& tasks) override;
    void beginSubstep(ContactList<S>& contacts, BodyArrays<S>& bodies, const ContactStep<S>& step,
                      ConstraintRows<S>& rows, const Tasks& tasks) override;
    void updateSlips(std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows) const override;
    void updateSlips(std::span<const Velocity<S>> velocities, std::span<const std::uint32_t> blocks,
                     ConstraintRows<S>& rows) const override;
    bool hasSlip(std::uint32_t block) const override {
        return block < slipOf_.size() && slipOf_[block] != kNullIndex;
    }
    void solve(Solver<S>& solver, const SolverInput<S>& input, const Tasks& tasks) override;
    bool applySpeculativeRestitution(const ContactList<S>& contacts, ConstraintRows<S>& rows) const override;
    void store(ContactList<S>& contacts, const ConstraintRows<S>& rows, bool last,
               const Tasks& tasks) override;
    void advance(ContactList<S>& contacts, std::span<const Velocity<S>> velocities, Real h,
                 const Tasks& tasks) override;
    std::span<const LandingPoint<Real>> landings() const override { return landings_; }
    const RowLags<S>* lagsOf(std::size_t index) const override {
        return index < lags_.size() ? &lags_[index] : nullptr;
    }
    ContactCounts counts() const override { return counts_; }

  private:
    /// Indices of the contacts whose islands this model makes rows of.
    void findOwn(const ContactList<S>& contacts);
    void findSlips(const ContactList<S>& contacts, const BodyArrays<S>& bodies, const ContactStep<S>& step,
                   const ConstraintRows<S>& rows);

    ContactCounts counts_;
    IslandKind islands_ = IslandKind::Usual;
    /// A point that slid before the forces of the sub-step acted.
    struct Slip {
        std::uint32_t block = 0;
        std::array<Real, S::tangents> before{};   ///< along its tangents [m/s]
        std::array<Real, S::tangents> surface{};  ///< velocity of the surfaces over the bodies [m/s]
    };
    void updateSlip(const Slip& slip, std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows) const;

    std::vector<std::uint32_t> own_;  ///< indices of contacts, in the order of the list, in this sub-step
    /// One for each contact, up to date for those of own_ alone; empty in steps whose rows are not those of a midpoint.
    std::vector<RowLags<S>> lags_;
    std::vector<LandingPoint<Real>> landings_;
    std::vector<Slip> slips_;            ///< points where friction opposes the mean slip
    std::vector<std::uint32_t> slipOf_;  ///< slip of each block, kNullIndex: none
    bool stepBegins_ = false;            ///< the next sub-step is the first of its step
};

/// Rounding of coordinates of order one metre: closer than this is touching.
template <class R>
inline constexpr R kTouching = R(64) * std::numeric_limits<R>::epsilon();

// --- contact_lags.cpp
/// Whether a point that is apart closes its gap within the step and bounces at its own time then.
template <class S>
bool bouncesAhead(const BodyArrays<S>& bodies, const ContactStep<S>& step, const Contact<S>& contact,
                  const typename Contact<S>::Point& point);
/// Places the points of a contact, and finds what the rows of those that it had in the last step lag by.
template <class S>
void placeWithLags(const BodyArrays<S>& bodies, Contact<S>& contact, RowLags<S>& lags);
/// Adds to the rows of a point what they lag by. A point that lands within the step has the law of impact; `lag` gets when.
template <class S>
void addLag(const BodyArrays<S>& bodies, const ContactStep<S>& step, const Contact<S>& contact,
            std::size_t index, RowLag<S>& lag, const Block<S>& block, Row<S>* rows);

/// The points that land within the step, of those contacts that `own` has the indices of; lags have the index of the contact.
template <class S>
void findLandings(const ContactList<S>& contacts, std::span<const std::uint32_t> own,
                  std::span<const RowLags<S>> lags, std::vector<LandingPoint<typename S::Real>>& landings);

/// Unit tangents that with n form a right-handed orthonormal frame; a function of n alone.
template <class S>
std::array<typename S::Vec, S::tangents> tangentBasis(const typename S::Vec& n);

}  // namespace rigor::engine
