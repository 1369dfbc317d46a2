// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Newton's law of impact: n . u+ >= -e n . u-, with equality where there is an impulse. It is a bias of the
// normal row (e times the approach, contacts/contact_rows.cpp), so the velocity solver does all the work and
// friction acts over the impact as a whole. Known limits: with friction, off-centre impacts may gain energy
// [KaneLevinson1985], [Stronge1990]; Poisson's law does not.
#include "engine/solvers/restitution.hpp"

namespace rigor::engine {
namespace {

template <class S>
class Newton final : public Restitution<S> {
  public:
    std::unique_ptr<Restitution<S>> clone() const override { return std::make_unique<Newton>(*this); }
};

}  // namespace

template <class S>
std::unique_ptr<Restitution<S>> makeNewtonRestitution() {
    return std::make_unique<Newton<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeNewtonRestitution, Restitution);

}  // namespace rigor::engine
