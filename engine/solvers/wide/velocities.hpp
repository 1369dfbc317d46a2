// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The velocities of bodies as patches read and change them, in f32. In worlds of f32 they are the world's
// own. In worlds of f64 a velocity is the sum of two f32 numbers, v = base + rest: base is v rounded and
// stays, rest is what rounding has left, 2^-24 of v, and takes the changes. The difference of two bases is
// exact where the bodies go nearly alike, so that a patch knows its relative velocity, and bodies get what it
// makes of it, as well as if they were slow.
#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "engine/solvers/wide/patch.hpp"
#include "engine/state/numbers.hpp"

namespace rigor::engine {

template <class S>
class PatchVelocities {
  public:
    using F = PatchSpace<S>;
    static constexpr bool kSplit = !std::is_same_v<S, F>;

    void resize(std::size_t bodies) {
        before_.resize(bodies);
        if constexpr (kSplit) {
            base_.resize(bodies);
            rest_.resize(bodies);
        }
    }
    std::size_t size() const { return before_.size(); }
    /// What patches work on: data()[i] of body i, from base()[i] unless that is null.
    Velocity<F>* data() const { return data_; }
    const Velocity<F>* base() const { return kSplit ? base_.data() : nullptr; }
    /// The world's velocities, from now on and until they change.
    void refer(std::span<Velocity<S>> world) {
        world_ = world.data();
        if constexpr (kSplit)
            data_ = rest_.data();
        else
            data_ = world_;
    }
    /// Bodies [first, last) before patches are visited; `gained`, unless it is null, is added.
    void begin(std::size_t first, std::size_t last, const Velocity<F>* gained) {
        auto before = numbers(before_.data(), first, last);
        if constexpr (kSplit) {
            const auto v = numbers(world_, first, last);
            auto base = numbers(base_.data(), first, last);
            base = v.template cast<PatchReal>();
            before = (v - base.template cast<typename S::Real>()).template cast<PatchReal>();
            numbers(data_, first, last) = before;
        } else {
            before = numbers(data_, first, last);
        }
        if (gained != nullptr) numbers(data_, first, last) += numbers(gained, first, last);
    }
    /// After it: made[i] is what the visits (and `gained`) have made, or is added to what it was. Returns the
    /// largest [m/s or rad/s].
    PatchReal end(std::size_t first, std::size_t last, Velocity<F>* made, bool add) {
        const auto change = numbers(data_, first, last) - numbers(before_.data(), first, last);
        if constexpr (kSplit) numbers(world_, first, last) += change.template cast<typename S::Real>();
        auto sum = numbers(made, first, last);
        if (add)
            sum += change;
        else
            sum = change;
        return change.abs().maxCoeff();
    }

  private:
    Velocity<S>* world_ = nullptr;
    Velocity<F>* data_ = nullptr;
    std::vector<Velocity<F>> base_, rest_;  ///< if split
    std::vector<Velocity<F>> before_;       ///< data() before a visit
};

}  // namespace rigor::engine
