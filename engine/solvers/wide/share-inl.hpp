// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The friction of patches shared out among their points, for the next step and for those who read contacts.
#if defined(RIGOR_SHARE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGOR_SHARE_INL_HPP
#undef RIGOR_SHARE_INL_HPP
#else
#define RIGOR_SHARE_INL_HPP
#endif

#include "engine/math/lanes-inl.hpp"
#include "engine/solvers/wide/kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

/// Shares a force and a moment about the normal out among the points, by their normal impulses.
template <class S, class Weight, class Write>
HWY_INLINE void share(const PatchBlock<S>& block, const PatchRest<S>& rest, At<S> at, const LinVec<S>& force,
                      Num<S> twist, const Weight& weightOf, const Write& write) {
    const Num<S> zero = hn::Zero(Tag<S>());
    Num<S> sum = zero;
    for (int i = 0; i < block.points; ++i) sum = sum + weightOf(block.point[i]);
    const Num<S> scale = inverseOrZero(sum);
    if constexpr (S::dim == 2) {
        for (int i = 0; i < block.points; ++i) {
            const Num<S> part = weightOf(block.point[i]) * scale;
            write(i, LinVec<S>{part * force[0], part * force[1]});
        }
        (void)twist;
    } else {
        LinVec<S> mean{zero, zero, zero};
        for (int i = 0; i < block.points; ++i) add(mean, weightOf(block.point[i]) * scale, at(rest.armB[i]));
        const LinVec<S> normal = at(block.normal);
        const Num<S> left = twist - dot(normal, moment(minus(mean, at(block.centre)), force));
        Num<S> spread = zero, size = zero;
        for (int i = 0; i < block.points; ++i) {
            const LinVec<S> side = moment(normal, minus(at(rest.armB[i]), mean));
            spread = spread + weightOf(block.point[i]) * scale * dot(side, side);
            size = hn::Max(size, dot(at(rest.armB[i]), at(rest.armB[i])));
        }
        // Points that rounding alone has parted carry no moment.
        const auto apart = spread > number<S>(typename S::Real(1e-6)) * size;
        const Num<S> turn = hn::IfThenElseZero(apart, left * inverseOrZero(spread));
        for (int i = 0; i < block.points; ++i) {
            const Num<S> part = weightOf(block.point[i]) * scale;
            LinVec<S> own = moment(normal, minus(at(rest.armB[i]), mean));
            for (std::size_t k = 0; k < 3; ++k) own[k] = part * (force[k] + turn * own[k]);
            write(i, own);
        }
    }
}

template <class S>
HWY_INLINE void shareLanes(const PatchBlock<S>& block, const PatchRest<S>& rest, PatchRubs<S>& rubs,
                           At<S> at) {
    const LinVec<S> normal = at(block.normal);
    const auto force = [&](const auto& impulses) RIGOR_INLINE_LAMBDA -> LinVec<S> {
        const Num<S> first = at(impulses[0]);
        if constexpr (S::dim == 2) {
            return {hn::Zero(Tag<S>()) - first * normal[1], first * normal[0]};
        } else {
            const LinVec<S> t = at(block.tangent);
            LinVec<S> sum{first * t[0], first * t[1], first * t[2]};
            add(sum, at(impulses[1]), moment(normal, t));
            return sum;
        }
    };
    Num<S> twist = hn::Zero(Tag<S>()), twistTotal = twist;
    if constexpr (S::dim == 3) {
        twist = at(block.twistImpulse);
        twistTotal = at(block.twistTotal);
    }
    share<S>(
        block, rest, at, force(block.rubImpulse), twist,
        [&](const auto& p) RIGOR_INLINE_LAMBDA { return at(p.impulse); },
        [&](int i, const LinVec<S>& f) RIGOR_INLINE_LAMBDA { at.set(rubs.last[i], f); });
    share<S>(
        block, rest, at, force(block.rubTotal), twistTotal,
        [&](const auto& p) RIGOR_INLINE_LAMBDA { return at(p.total); },
        [&](int i, const LinVec<S>& f) RIGOR_INLINE_LAMBDA { at.set(rubs.total[i], f); });
}

template <class S>
void shareAll(const PatchRange<S>& range) {
    const std::size_t lanes = hn::Lanes(Tag<S>());
    for (std::size_t k = 0; k < range.count; ++k)
        for (std::size_t first = 0; first < kLanes; first += lanes)
            shareLanes(range.blocks[k], range.rests[k], range.rubs[k], At<S>{first});
}

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
