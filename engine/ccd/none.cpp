// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// No continuous collision detection. Contacts are still found up to WorldDef::speculativeDistance ahead,
// which lets resting bodies land without overlap but stops nothing fast: a body that moves further in a step
// than it and the other are thick may pass through.
#include "engine/ccd/continuous_collision.hpp"
#include "engine/ccd/traits.hpp"

namespace rigor::engine {
namespace {

template <class S>
class NoContinuousCollision final : public ContinuousCollision<S> {
  public:
    std::unique_ptr<ContinuousCollision<S>> clone() const override {
        return std::make_unique<NoContinuousCollision>(*this);
    }
};

}  // namespace

ContinuousCollisionTraits makeNoContinuousCollisionTraits() {
    return {.acts = false};
}

template <class S>
std::unique_ptr<ContinuousCollision<S>> makeNoContinuousCollision() {
    return std::make_unique<NoContinuousCollision<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeNoContinuousCollision, ContinuousCollision);

}  // namespace rigor::engine
