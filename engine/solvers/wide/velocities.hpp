// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The f32 velocities of bodies that patches read and change. In f32 worlds they are the world's own. In f64
// worlds a velocity is the sum of two f32 numbers, v = base + remainder. The base is v rounded and constant;
// the remainder is the rounding error, 2^-24 of v, and takes the changes. The difference of two bases is
// exact where the velocities are nearly equal, so that relative velocities are as accurate as those of slow
// bodies.
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
            remainder_.resize(bodies);
        }
    }
    std::size_t size() const { return before_.size(); }
    /// data()[i]: f32 velocity of body i, relative to base()[i] unless base() is null.
    Velocity<F>* data() const { return data_; }
    const Velocity<F>* base() const { return kSplit ? base_.data() : nullptr; }
    /// Sets the world's velocities; called before each begin().
    void refer(std::span<Velocity<S>> world) {
        world_ = world.data();
        if constexpr (kSplit)
            data_ = remainder_.data();
        else
            data_ = world_;
    }
    /// Loads bodies [first, last) before a pass and adds `delta` unless it is null.
    void begin(std::size_t first, std::size_t last, const Velocity<F>* delta) {
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
        if (delta != nullptr) numbers(data_, first, last) += numbers(delta, first, last);
    }
    /// Stores bodies after a pass. made[i] becomes the change by the pass (and `delta`), or is increased by
    /// it. Returns the largest change [m/s or rad/s].
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
    std::vector<Velocity<F>> base_, remainder_;  ///< used if the velocities are split
    std::vector<Velocity<F>> before_;            ///< data() before a pass
};

}  // namespace rigor::engine
