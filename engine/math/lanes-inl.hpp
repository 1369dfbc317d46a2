// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Vectors whose numbers are registers: the same number of several things side by side.
#if defined(RIGOR_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGOR_LANES_INL_HPP
#undef RIGOR_LANES_INL_HPP
#else
#define RIGOR_LANES_INL_HPP
#endif

#include <array>
#include <limits>

#include "engine/math/gather-inl.hpp"
#include "engine/math/lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

template <class S>
using Tag = LanesTag<typename S::Real>;
template <class S>
using Num = hn::Vec<Tag<S>>;
template <class S>
using LinVec = std::array<Num<S>, S::dim>;
template <class S>
using AngVec = std::array<Num<S>, S::dim == 3 ? 3 : 1>;

/// The numbers of a block from lane `first` on.
template <class S>
struct At {
    std::size_t first;
    HWY_INLINE Num<S> operator()(const Lanes<typename S::Real>& x) const {
        return hn::Load(Tag<S>(), x + first);
    }
    template <std::size_t n>
    HWY_INLINE std::array<Num<S>, n> operator()(const Lanes<typename S::Real> (&x)[n]) const {
        std::array<Num<S>, n> v;
        for (std::size_t k = 0; k < n; ++k) v[k] = (*this)(x[k]);
        return v;
    }
    HWY_INLINE void set(Lanes<typename S::Real>& x, Num<S> v) const { hn::Store(v, Tag<S>(), x + first); }
    template <std::size_t n>
    HWY_INLINE void set(Lanes<typename S::Real> (&x)[n], const std::array<Num<S>, n>& v) const {
        for (std::size_t k = 0; k < n; ++k) set(x[k], v[k]);
    }
};

template <class S>
HWY_INLINE Num<S> number(typename S::Real x) {
    return hn::Set(Tag<S>(), x);
}

template <class V, std::size_t n>
HWY_INLINE V dot(const std::array<V, n>& a, const std::array<V, n>& b) {
    V sum = a[0] * b[0];
    for (std::size_t k = 1; k < n; ++k) sum = sum + a[k] * b[k];
    return sum;
}
template <class V, std::size_t n>
HWY_INLINE std::array<V, n> minus(const std::array<V, n>& a, const std::array<V, n>& b) {
    std::array<V, n> c;
    for (std::size_t k = 0; k < n; ++k) c[k] = a[k] - b[k];
    return c;
}
/// a += x b
template <class V, std::size_t n>
HWY_INLINE void add(std::array<V, n>& a, V x, const std::array<V, n>& b) {
    for (std::size_t k = 0; k < n; ++k) a[k] = a[k] + x * b[k];
}
/// a -= x b
template <class V, std::size_t n>
HWY_INLINE void subtract(std::array<V, n>& a, V x, const std::array<V, n>& b) {
    for (std::size_t k = 0; k < n; ++k) a[k] = a[k] - x * b[k];
}
/// r x f: the moment of f at r; 3D and 2D.
template <class V>
HWY_INLINE std::array<V, 3> moment(const std::array<V, 3>& r, const std::array<V, 3>& f) {
    return {r[1] * f[2] - r[2] * f[1], r[2] * f[0] - r[0] * f[2], r[0] * f[1] - r[1] * f[0]};
}
template <class V>
HWY_INLINE std::array<V, 1> moment(const std::array<V, 2>& r, const std::array<V, 2>& f) {
    return {r[0] * f[1] - r[1] * f[0]};
}

/// x > 0, and large enough for 1 / x to be finite.
template <class V>
HWY_INLINE auto invertible(V x) {
    const hn::DFromV<V> d;
    return x > hn::Set(d, 4 * std::numeric_limits<hn::TFromV<V>>::min());
}
/// 1 / x, 0 where x is 0 or next to it.
template <class V>
HWY_INLINE V inverseOrZero(V x) {
    const hn::DFromV<V> d;
    const auto some = invertible(x);
    const V one = hn::Set(d, 1);
    return hn::IfThenElseZero(some, one / hn::IfThenElse(some, x, one));
}

/// w x r: the velocity that a turning w gives to a point at r; 3D and 2D.
template <class V>
HWY_INLINE std::array<V, 3> turning(const std::array<V, 3>& w, const std::array<V, 3>& r) {
    return moment(w, r);
}
template <class V>
HWY_INLINE std::array<V, 2> turning(const std::array<V, 1>& w, const std::array<V, 2>& r) {
    return {hn::Zero(hn::DFromV<V>()) - w[0] * r[1], w[0] * r[0]};
}
/// A symmetric matrix from its upper triangle (a number in 2D) times a vector.
template <class V>
HWY_INLINE std::array<V, 3> times(const std::array<V, 6>& m, const std::array<V, 3>& v) {
    return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[1] * v[0] + m[3] * v[1] + m[4] * v[2],
            m[2] * v[0] + m[4] * v[1] + m[5] * v[2]};
}
template <class V>
HWY_INLINE std::array<V, 1> times(const std::array<V, 1>& m, const std::array<V, 1>& v) {
    return {m[0] * v[0]};
}

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
