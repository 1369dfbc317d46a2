// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/embedding/frame_stepper.hpp"

#include <algorithm>
#include <cmath>

#include "engine/math/rotation.hpp"
#include "engine/pipeline/require.hpp"

namespace rigor::engine {

template <class S>
FrameStepper<S>::FrameStepper(World<S>& world, const FrameSettings& settings)
    : world_(world), settings_(settings) {
    require(settings.step > 0 && std::isfinite(settings.step), "frame_settings",
            "a step must be positive and finite");
    require(settings.mostSteps >= 1, "frame_settings", "a frame needs one step at least");
}

/// Returns the number of steps that are due, and keeps the rest of the time.
template <class S>
int FrameStepper<S>::takeTime(double elapsed) {
    require(elapsed >= 0 && std::isfinite(elapsed), "frame_time", "frame time must be >= 0 and finite");
    remainder_ += elapsed;
    // Sums of frame times that mean whole steps fall short of them by rounding.
    const double due = std::floor(remainder_ / settings_.step + 1e-9);
    const double run = std::min(due, static_cast<double>(settings_.mostSteps));
    remainder_ = std::max(0.0, remainder_ - due * settings_.step);
    skipped_ += (due - run) * settings_.step;
    return static_cast<int>(run);
}

template <class S>
void FrameStepper<S>::rememberPoses() {
    before_.clear();
    for (const BodyId body : world_.bodies()) {
        if (body.index >= before_.size()) before_.resize(body.index + 1);
        before_[body.index] = {body, world_.pose(body)};
    }
}

template <class S>
Pose<S> FrameStepper<S>::pose(BodyId body) const {
    using Real = typename S::Real;
    const Pose<S> now = world_.pose(body);
    if (body.index >= before_.size() || before_[body.index].body != body) return now;
    const Pose<S>& then = before_[body.index].pose;
    const auto s = static_cast<Real>(fraction());
    const typename S::Vec center = world_.constants(body).centerOfMass;
    const typename S::Vec from = toWorld<S>(then, center), to = toWorld<S>(now, center);
    // Rotation vectors are of the world frame: now = exp(turn) then.
    const typename S::Ang turn = logMap(compose(now.q, inverse(then.q)));
    const typename S::Rot q = rotatedBy(then.q, typename S::Ang(s * turn));
    return {typename S::Vec(from + s * (to - from) - rotate(q, center)), q};
}

template <class S>
void FrameStepper<S>::restart() {
    remainder_ = 0;
    before_.clear();
}

RIGOR_INSTANTIATE_CLASS(FrameStepper)

}  // namespace rigor::engine
