// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The state of a body as a row of numbers, for arrays over bodies and worlds.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/pipeline/world.hpp"

namespace rigor::engine {

/// Numbers of a body's state: position of the body frame [m], orientation (quaternion w, x, y, z; 2D: angle [rad],
/// -pi .. pi), velocity of the centre of mass [m/s], angular velocity [rad/s], all in the world frame.
template <class S>
inline constexpr std::size_t kBodyState = S::dim == 2 ? 6 : 13;

template <class S>
using BodyNumbers = std::array<typename S::Real, kBodyState<S>>;

template <class S>
inline constexpr std::size_t kPoseNumbers = S::dim == 2 ? 3 : 7;

template <class S>
BodyNumbers<S> numbersOf(const Pose<S>& pose, const typename S::Vec& v, const typename S::Ang& w) {
    if constexpr (S::dim == 2)
        return {pose.p[0], pose.p[1], pose.q.angle(), v[0], v[1], w};
    else
        return {pose.p[0], pose.p[1], pose.p[2], pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z(),
                v[0],      v[1],      v[2],      w[0],       w[1],       w[2]};
}

template <class S>
Pose<S> poseOf(const BodyNumbers<S>& x) {
    if constexpr (S::dim == 2)
        return {{x[0], x[1]}, S::Rot::fromAngle(x[2])};
    else
        return {{x[0], x[1], x[2]}, {x[3], x[4], x[5], x[6]}};
}
template <class S>
typename S::Vec vecAt(const typename S::Real* x) {
    if constexpr (S::dim == 2)
        return {x[0], x[1]};
    else
        return {x[0], x[1], x[2]};
}
template <class S>
typename S::Ang angAt(const typename S::Real* x) {
    if constexpr (S::dim == 2)
        return x[0];
    else
        return {x[0], x[1], x[2]};
}

template <class S>
BodyNumbers<S> readBody(const World<S>& world, BodyId body) {
    return numbersOf<S>(world.pose(body), world.velocity(body), world.angularVelocity(body));
}

/// Puts a body into a state. One whose numbers are those that readBody() gives is left as it is, to the bit. Throws
/// EngineError as World::setPose and setVelocity.
template <class S>
void writeBody(World<S>& world, BodyId body, const typename S::Real* numbers) {
    const BodyNumbers<S> now = readBody(world, body);
    BodyNumbers<S> next;
    std::copy_n(numbers, next.size(), next.begin());
    const auto poseEnd = static_cast<std::ptrdiff_t>(kPoseNumbers<S>);
    if (!std::equal(now.begin(), now.begin() + poseEnd, next.begin())) world.setPose(body, poseOf<S>(next));
    const typename S::Real* velocity = next.data() + poseEnd;
    if (!std::equal(now.begin() + poseEnd, now.end(), velocity))
        world.setVelocity(body, vecAt<S>(velocity), angAt<S>(velocity + S::dim));
}

}  // namespace rigor::engine
