// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Velocities and poses of several bodies as registers.
#if defined(RIGOR_BODIES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGOR_BODIES_INL_HPP
#undef RIGOR_BODIES_INL_HPP
#else
#define RIGOR_BODIES_INL_HPP
#endif

#include "engine/math/lanes-inl.hpp"
#include "engine/state/body_arrays.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

/// Velocities, or motions since the step began.
template <class S>
struct Twist {
    LinVec<S> v;
    AngVec<S> w;
};

/// Poses of bodies: the numbers of Pose::q are c, s in 2D and x, y, z, w in 3D.
template <class S>
struct Place {
    LinVec<S> p;
    std::array<Num<S>, S::dim == 3 ? 4 : 2> q;
};

/// Some of eight bodies, as many as a register has lanes.
template <class S>
struct Side {
    using Real = typename S::Real;
    static_assert(sizeof(Velocity<S>) == (S::dim == 3 ? 8 : 4) * sizeof(Real));
    static_assert(sizeof(Pose<S>) == sizeof(Velocity<S>));

    const std::uint32_t* index;
    std::uint32_t moves;  ///< bit of each lane: to be stored

    HWY_INLINE Twist<S> load(const Velocity<S>* from) const {
        const auto q = group(from, 0);
        if constexpr (S::dim == 2) {
            return {{q.x, q.y}, {q.z}};
        } else {
            const auto r = group(from, 1);
            return {{q.x, q.y, q.z}, {r.x, r.y, r.z}};
        }
    }
    HWY_INLINE Place<S> load(const Pose<S>* from) const {
        const auto p = group(from, 0);
        if constexpr (S::dim == 2) {
            return {{p.x, p.y}, {p.z, p.w}};
        } else {
            const auto q = group(from, 1);
            return {{p.x, p.y, p.z}, {q.x, q.y, q.z, q.w}};
        }
    }
    HWY_INLINE void store(const Twist<S>& u, Velocity<S>* to) const {
        const auto zero = hn::Zero(Tag<S>());
        if constexpr (S::dim == 2) {
            setGroup({u.v[0], u.v[1], u.w[0], zero}, to, 0);
        } else {
            setGroup({u.v[0], u.v[1], u.v[2], zero}, to, 0);
            setGroup({u.w[0], u.w[1], u.w[2], zero}, to, 1);
        }
    }
    HWY_INLINE void store(const Place<S>& x, Pose<S>* to) const {
        if constexpr (S::dim == 2) {
            setGroup({x.p[0], x.p[1], x.q[0], x.q[1]}, to, 0);
        } else {
            setGroup({x.p[0], x.p[1], x.p[2], hn::Zero(Tag<S>())}, to, 0);
            setGroup({x.q[0], x.q[1], x.q[2], x.q[3]}, to, 1);
        }
    }

  private:
    /// Numbers 4 g .. 4 g + 3 of each body's entry in an array.
    template <class T>
    HWY_INLINE Quad<Tag<S>> group(const T* from, int g) const {
        return gatherQuads(Tag<S>(), [this, from, g](std::size_t lane) RIGOR_INLINE_LAMBDA {
            return reinterpret_cast<const Real*>(from + index[lane]) + 4 * g;
        });
    }
    template <class T>
    HWY_INLINE void setGroup(const Quad<Tag<S>>& numbers, T* to, int g) const {
        constexpr std::uint32_t all = (1u << hn::MaxLanes(Tag<S>())) - 1;
        const auto at = [this, to, g](std::size_t lane)
                            RIGOR_INLINE_LAMBDA { return reinterpret_cast<Real*>(to + index[lane]) + 4 * g; };
        if ((moves & all) == all) return scatterQuads(Tag<S>(), numbers, at);
        scatterQuads(Tag<S>(), numbers, [this, &at](std::size_t lane) RIGOR_INLINE_LAMBDA {
            return (moves >> lane & 1) ? at(lane) : static_cast<Real*>(nullptr);
        });
    }
};

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
