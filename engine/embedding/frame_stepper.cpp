// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/embedding/frame_stepper.hpp"

#include "engine/math/rotation.hpp"
#include "engine/pipeline/require.hpp"

namespace rigor::engine {
namespace {

template <class S>
bool isSame(const Pose<S>& a, const Pose<S>& b) {
    if constexpr (S::dim == 2)
        return a.p == b.p && a.q.c == b.q.c && a.q.s == b.q.s;
    else
        return a.p == b.p && a.q.coeffs() == b.q.coeffs();
}

}  // namespace

template <class S>
FrameStepper<S>::FrameStepper(World<S>& world, const FrameSettings& settings)
    : world_(world), clock_(settings.step), mostSteps_(settings.mostSteps) {
    require(mostSteps_ >= 1, "frame_settings", "a frame needs one step at least");
}

template <class S>
void FrameStepper<S>::rememberPoses(Poses& poses) const {
    poses.clear();
    for (const BodyId body : world_.bodies()) {
        if (body.index >= poses.size()) poses.resize(body.index + 1);
        poses[body.index] = {body, world_.pose(body)};
    }
}

/// Pose of a body, or null if it was not in the world then.
template <class S>
const Pose<S>* FrameStepper<S>::find(const Poses& poses, BodyId body) {
    if (body.index >= poses.size() || poses[body.index].body != body) return nullptr;
    return &poses[body.index].pose;
}

template <class S>
Pose<S> FrameStepper<S>::pose(BodyId body) const {
    using Real = typename S::Real;
    const Pose<S> now = world_.pose(body);
    const Pose<S>*start = find(before_, body), *end = find(after_, body);
    if (start == nullptr || end == nullptr || !isSame<S>(*end, now)) return now;
    const Pose<S>& then = *start;
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
    clock_.restart();
    before_.clear();
    after_.clear();
}

RIGOR_INSTANTIATE_CLASS(FrameStepper)

}  // namespace rigor::engine
