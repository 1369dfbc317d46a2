// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// No restitution: every impact is inelastic, whatever the materials say.
#include "engine/solvers/restitution.hpp"

namespace rigor::engine {
namespace {

template <class S>
class None final : public Restitution<S> {
  public:
    std::unique_ptr<Restitution<S>> clone() const override { return std::make_unique<None>(*this); }
    bool bounces() const override { return false; }
};

}  // namespace

template <class S>
std::unique_ptr<Restitution<S>> makeNoRestitution() {
    return std::make_unique<None<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeNoRestitution, Restitution);

}  // namespace rigor::engine
