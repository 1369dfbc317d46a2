// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/integrators/block_motion.hpp"

#include "engine/integrators/integrator.hpp"
#include "engine/state/numbers.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kBlockGrain = 16;  ///< least number of blocks for a task: some microseconds of work

/// Blocks of the bodies [first, last); first is a multiple of kLanes.
constexpr std::size_t blocksIn(std::size_t first, std::size_t last) {
    return (last - first + kLanes - 1) / kLanes;
}

/// The inertia is that of a sphere, to rounding: the velocity stays as it is.
template <class S>
bool isRound(const typename S::Inertia& inertia) {
    if constexpr (S::dim == 2) {
        (void)inertia;
        return true;
    } else {
        using Real = typename S::Real;
        const Real mean = inertia.trace() / Real(3);
        const typename S::Mat rest = inertia - mean * S::Mat::Identity();
        return rest.cwiseAbs().maxCoeff() <= Real(4) * std::numeric_limits<Real>::epsilon() * mean;
    }
}

/// xx xy xz yy yz zz
template <class R>
void putSymmetric(Lanes<R>* to, std::size_t lane, const Eigen::Matrix<R, 3, 3>& m) {
    for (int row = 0; row < 3; ++row)
        for (int column = row; column < 3; ++column) (*to++)[lane] = m(row, column);
}

}  // namespace

template <class S>
void BlockMotion<S>::begin(const BodyArrays<S>& bodies, const typename S::Vec& gravity, Real h,
                           const Tasks& tasks) {
    const std::size_t n = bodies.size(), blocks = (n + kLanes - 1) / kLanes;
    kept_.resize(n);
    add_.resize(n);
    moving_.resize(blocks);
    tumbling_.resize(S::dim == 3 && gyroscopic_ ? blocks : 0);
    twisted_.clear();
    tasks.forEach(blocks, kBlockGrain, [&](std::size_t k) {
        moving_[k].moves = 0;
        if (!tumbling_.empty()) tumbling_[k].moves = 0;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const std::size_t i = kLanes * k + lane;
            const auto index = static_cast<std::uint32_t>(i < n ? i : 0);
            moving_[k].index[lane] = index;
            if (!tumbling_.empty()) tumbling_[k].index[lane] = index;
            if (i >= n) continue;
            const bool moves = bodies.constants[i].type != BodyType::Static && !bodies.asleep[i];
            moving_[k].moves |= static_cast<std::uint32_t>(moves) << lane;
            addKick(bodies, i, gravity, h);
        }
    });
    if (gyroscopic_) return;
    for (std::uint32_t i = 0; i < n; ++i)
        if (bodies.invMass[i] > 0 && dotAng(bodies.wrench[i].torque, bodies.wrench[i].torque) > 0 &&
            !isRound<S>(bodies.constants[i].inertia))
            twisted_.push_back(i);
}

/// Computes the velocity change by forces in a sub-step, except by torques on bodies whose inertia is not
/// isotropic.
template <class S>
void BlockMotion<S>::addKick(const BodyArrays<S>& bodies, std::size_t i, const typename S::Vec& gravity,
                             Real h) {
    using Vec = typename S::Vec;
    using Ang = typename S::Ang;
    const auto all = [](Real x) {
        if constexpr (S::dim == 2)
            return x;
        else
            return Ang(Ang::Constant(x));
    };
    kept_[i] = {Vec::Ones(), all(Real(1))};
    add_[i] = {};
    if (bodies.invMass[i] == 0) return;
    const BodyConstants<S>& body = bodies.constants[i];
    const DampedStep<Real> linear = dampedStep(body.linearVelocityKept, h);
    const DampedStep<Real> angular = dampedStep(body.angularVelocityKept, h);
    kept_[i] = {Vec::Constant(linear.kept), all(angular.kept)};
    add_[i].v = linear.kick * Vec(body.gravityScale * gravity + bodies.invMass[i] * bodies.wrench[i].force);
    if (isRound<S>(body.inertia))
        add_[i].w = angular.kick * Ang(bodies.invInertia[i] * bodies.wrench[i].torque);
    else if (gyroscopic_)
        addTumbling(bodies, i, angular.kick);
}

template <class S>
void BlockMotion<S>::addTumbling(const BodyArrays<S>& bodies, std::size_t i, Real kick) {
    if constexpr (S::dim == 3) {
        TumblingBlock<S>& block = tumbling_[i / kLanes];
        const std::size_t lane = i % kLanes;
        block.moves |= 1u << lane;
        putSymmetric<Real>(block.inertia, lane, bodies.constants[i].inertia);
        putSymmetric<Real>(block.invInertia, lane, bodies.invInertiaLocal[i]);
        for (int k = 0; k < 3; ++k) block.kick[k][lane] = kick * bodies.wrench[i].torque[k];
    } else {
        (void)bodies;
        (void)i;
        (void)kick;
    }
}

template <class S>
void BlockMotion<S>::kick(BodyArrays<S>& bodies, Real h, const Tasks& tasks) {
    tasks.forChunks(bodies.size(), kBodyGrain, [&](std::size_t first, std::size_t last) {
        auto u = numbers(bodies.velocity.data(), first, last);
        u = numbers(kept_.data(), first, last) * u + numbers(add_.data(), first, last);
        if constexpr (S::dim == 3)
            if (!tumbling_.empty())
                predictTumbling<S>(tumbling_.data() + first / kLanes, blocksIn(first, last),
                                   bodies.pose.data(), bodies.velocity.data(), h);
    });
    for (const std::uint32_t i : twisted_) {
        const Real kick = dampedStep(bodies.constants[i].angularVelocityKept, h).kick;
        bodies.velocity[i].w += kick * typename S::Ang(bodies.invInertia[i] * bodies.wrench[i].torque);
    }
}

template <class S>
void BlockMotion<S>::move(BodyArrays<S>& bodies, std::span<Velocity<S>> used, Real h,
                          const Tasks& tasks) const {
    tasks.forChunks(bodies.size(), kBodyGrain, [&](std::size_t first, std::size_t last) {
        numbers(used.data(), first, last) = numbers(bodies.velocity.data(), first, last);
        moveBodies<S>(moving_.data() + first / kLanes, blocksIn(first, last), bodies.pose.data(),
                      bodies.velocity.data(), h);
    });
}

template <class S>
void BlockMotion<S>::finish(BodyArrays<S>& bodies, const Tasks& tasks) const {
    if constexpr (S::dim == 3) {
        if (tumbling_.empty()) return;
        tasks.forChunks(bodies.size(), kBodyGrain, [&](std::size_t first, std::size_t last) {
            finishTumbling<S>(tumbling_.data() + first / kLanes, blocksIn(first, last), bodies.pose.data(),
                              bodies.velocity.data());
        });
    } else {
        (void)bodies;
        (void)tasks;
    }
}

RIGOR_INSTANTIATE_CLASS(BlockMotion)

}  // namespace rigor::engine
