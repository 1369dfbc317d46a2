// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Vectors whose numbers are registers, and the bodies of a block as such.
#if defined(RIGOR_VECTORS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGOR_VECTORS_INL_HPP
#undef RIGOR_VECTORS_INL_HPP
#else
#define RIGOR_VECTORS_INL_HPP
#endif

#include <array>
#include <limits>

#include "engine/solvers/wide/gather-inl.hpp"
#include "engine/solvers/wide/patch.hpp"
#include "engine/state/body_arrays.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

template <class S>
using Tag = LanesTag<typename S::Real>;
template <class S>
using Num = hn::Vec<Tag<S>>;
template <class S>
using LinVec = std::array<Num<S>, PatchSize<S>::lin>;
template <class S>
using AngVec = std::array<Num<S>, PatchSize<S>::ang>;

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

/// Velocities, or motions since the step began.
template <class S>
struct Twist {
    LinVec<S> v;
    AngVec<S> w;
};

/// The bodies of one side of a block, from its lane `first` on.
template <class S>
struct Side {
    using Real = typename S::Real;
    const std::uint32_t* index;
    std::uint32_t moves;  ///< bit of each lane: to be stored

    HWY_INLINE Twist<S> load(const Velocity<S>* from) const {
        const auto group = [&](int g) {
            return [this, from, g](std::size_t lane) {
                return reinterpret_cast<const Real*>(from + index[lane]) + 4 * g;
            };
        };
        const auto q = gatherQuads(Tag<S>(), group(0));
        if constexpr (S::dim == 2) {
            return {{q.x, q.y}, {q.z}};
        } else {
            const auto r = gatherQuads(Tag<S>(), group(1));
            return {{q.x, q.y, q.z}, {r.x, r.y, r.z}};
        }
    }
    HWY_INLINE void store(const Twist<S>& u, Velocity<S>* to) const {
        constexpr std::uint32_t all = (1u << hn::MaxLanes(Tag<S>())) - 1;
        const auto group = [&](int g) {
            return [this, to, g](std::size_t lane) { return reinterpret_cast<Real*>(to + index[lane]) + 4 * g; };
        };
        if ((moves & all) == all) return storeAt(u, group);
        storeAt(u, [&](int g) {
            return [this, at = group(g)](std::size_t lane) {
                return (moves >> lane & 1) ? at(lane) : static_cast<Real*>(nullptr);
            };
        });
    }

  private:
    template <class Group>
    HWY_INLINE void storeAt(const Twist<S>& u, const Group& group) const {
        const auto zero = hn::Zero(Tag<S>());
        if constexpr (S::dim == 2) {
            scatterQuads(Tag<S>(), Quad<Tag<S>>{u.v[0], u.v[1], u.w[0], zero}, group(0));
        } else {
            scatterQuads(Tag<S>(), Quad<Tag<S>>{u.v[0], u.v[1], u.v[2], zero}, group(0));
            scatterQuads(Tag<S>(), Quad<Tag<S>>{u.w[0], u.w[1], u.w[2], zero}, group(1));
        }
    }
};

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
