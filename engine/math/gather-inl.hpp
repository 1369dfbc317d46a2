// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Groups of four numbers of several bodies into four registers and back: transposes within 128-bit parts,
// which every instruction set has.
#if defined(RIGOR_GATHER_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGOR_GATHER_INL_HPP
#undef RIGOR_GATHER_INL_HPP
#else
#define RIGOR_GATHER_INL_HPP
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Tag of as many lanes as a register has, at most eight.
template <class R>
using LanesTag = hn::CappedTag<R, 8>;

/// Four registers.
template <class D>
struct Quad {
    hn::Vec<D> x, y, z, w;
};

#if HWY_TARGET == HWY_SCALAR

template <class D, class At>
HWY_INLINE Quad<D> gatherQuads(D d, const At& at) {
    const auto* p = at(0);
    return {hn::Set(d, p[0]), hn::Set(d, p[1]), hn::Set(d, p[2]), hn::Set(d, p[3])};
}
template <class D, class At>
HWY_INLINE void scatterQuads(D, const Quad<D>& q, const At& at) {
    if (auto* p = at(0)) {
        p[0] = hn::GetLane(q.x);
        p[1] = hn::GetLane(q.y);
        p[2] = hn::GetLane(q.z);
        p[3] = hn::GetLane(q.w);
    }
}

#else

/// 128-bit parts at(first), at(first + stride), ... next to each other.
template <class D, class At>
HWY_INLINE hn::Vec<D> loadParts(D d, const At& at, std::size_t first, std::size_t stride) {
    if constexpr (sizeof(hn::TFromD<D>) * hn::MaxLanes(D()) <= 16) {
        (void)stride;
        return hn::LoadU(d, at(first));
    } else {
        const hn::Half<D> half;
        constexpr std::size_t parts = sizeof(hn::TFromD<D>) * hn::MaxLanes(D()) / 16;
        return hn::Combine(d, loadParts(half, at, first + parts / 2 * stride, stride),
                           loadParts(half, at, first, stride));
    }
}
template <class D, class At>
HWY_INLINE void storeParts(D d, hn::Vec<D> v, const At& at, std::size_t first, std::size_t stride) {
    if constexpr (sizeof(hn::TFromD<D>) * hn::MaxLanes(D()) <= 16) {
        (void)stride;
        if (auto* p = at(first)) hn::StoreU(v, d, p);
    } else {
        const hn::Half<D> half;
        constexpr std::size_t parts = sizeof(hn::TFromD<D>) * hn::MaxLanes(D()) / 16;
        storeParts(half, hn::LowerHalf(half, v), at, first, stride);
        storeParts(half, hn::UpperHalf(half, v), at, first + parts / 2 * stride, stride);
    }
}

/// Gathers four numbers per lane. at(lane): address of the four numbers of that lane. A part holds all four
/// in 32 bits, two in 64.
template <class D, class At>
HWY_INLINE Quad<D> gatherQuads(D d, const At& at) {
    if constexpr (sizeof(hn::TFromD<D>) == 4) {
        const auto u0 = loadParts(d, at, 0, 4), u1 = loadParts(d, at, 1, 4);
        const auto u2 = loadParts(d, at, 2, 4), u3 = loadParts(d, at, 3, 4);
        const auto s0 = hn::InterleaveLower(d, u0, u2), s1 = hn::InterleaveLower(d, u1, u3);
        const auto s2 = hn::InterleaveUpper(d, u0, u2), s3 = hn::InterleaveUpper(d, u1, u3);
        return {hn::InterleaveLower(d, s0, s1), hn::InterleaveUpper(d, s0, s1),
                hn::InterleaveLower(d, s2, s3), hn::InterleaveUpper(d, s2, s3)};
    } else {
        const auto second = [&at](std::size_t lane) { return at(lane) + 2; };
        const auto u0 = loadParts(d, at, 0, 2), u1 = loadParts(d, at, 1, 2);
        const auto s0 = loadParts(d, second, 0, 2), s1 = loadParts(d, second, 1, 2);
        return {hn::InterleaveLower(d, u0, u1), hn::InterleaveUpper(d, u0, u1),
                hn::InterleaveLower(d, s0, s1), hn::InterleaveUpper(d, s0, s1)};
    }
}
/// The reverse; at(lane) may be null: that lane is not stored.
template <class D, class At>
HWY_INLINE void scatterQuads(D d, const Quad<D>& q, const At& at) {
    if constexpr (sizeof(hn::TFromD<D>) == 4) {
        const auto s0 = hn::InterleaveLower(d, q.x, q.z), s1 = hn::InterleaveLower(d, q.y, q.w);
        const auto s2 = hn::InterleaveUpper(d, q.x, q.z), s3 = hn::InterleaveUpper(d, q.y, q.w);
        storeParts(d, hn::InterleaveLower(d, s0, s1), at, 0, 4);
        storeParts(d, hn::InterleaveUpper(d, s0, s1), at, 1, 4);
        storeParts(d, hn::InterleaveLower(d, s2, s3), at, 2, 4);
        storeParts(d, hn::InterleaveUpper(d, s2, s3), at, 3, 4);
    } else {
        const auto second = [&at](std::size_t lane) {
            auto* p = at(lane);
            return p ? p + 2 : p;
        };
        storeParts(d, hn::InterleaveLower(d, q.x, q.y), at, 0, 2);
        storeParts(d, hn::InterleaveUpper(d, q.x, q.y), at, 1, 2);
        storeParts(d, hn::InterleaveLower(d, q.z, q.w), second, 0, 2);
        storeParts(d, hn::InterleaveUpper(d, q.z, q.w), second, 1, 2);
    }
}

#endif

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
