// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The time at which two bodies in flight touch.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/ccd/flight_impacts.hpp"
#include "engine/contacts/moving_shape.hpp"

namespace rigor::engine {
namespace {

/// Smaller positive s with  d = u s + a s^2 / 2;  none: a negative number.
template <class R>
R timeToClose(R d, R u, R a) {
    const R root = u * u + R(2) * a * d;
    if (!(root >= 0)) return R(-1);
    const R sum = u + std::sqrt(root);
    return sum > 0 ? R(2) * d / sum : R(-1);
}

}  // namespace

template <class S>
typename S::Real touchingDistance(const Pose<S>& A, const Pose<S>& B, const ClosestPoints<S>& closest) {
    using Real = typename S::Real;
    const Real scale =
        std::max({closest.pointA.cwiseAbs().maxCoeff(), closest.pointB.cwiseAbs().maxCoeff(),
                  (closest.pointA - A.p).norm() < Real(1e6) ? A.p.cwiseAbs().maxCoeff() : Real(0),
                  (closest.pointB - B.p).norm() < Real(1e6) ? B.p.cwiseAbs().maxCoeff() : Real(0)});
    return std::max(Real(1e-10), Real(64) * std::numeric_limits<Real>::epsilon()) *
           std::max(scale, Real(1e-3));
}

template <class S>
ClosestPoints<S> FlightImpacts<S>::look(const MovedWorld<S>& world, const Pair& pair, Real t) const {
    const ShapeRecord<S>&a = world.contacts.shapes()[pair.a], &b = world.contacts.shapes()[pair.b];
    return closestPoints<S>(a.shape, compose<S>(ways_[a.body].at(t), a.local), b.shape,
                            compose<S>(ways_[b.body].at(t), b.local));
}

/// Closing speed of the closest points.
template <class S>
typename S::Real FlightImpacts<S>::closingSpeed(const Pair& pair, const MovedWorld<S>& world,
                                                const ClosestPoints<S>& closest, Real t) const {
    const Way &A = ways_[world.contacts.shapes()[pair.a].body],
              &B = ways_[world.contacts.shapes()[pair.b].body];
    const Vec uA = A.linearAt(t) + cross(A.turning, Vec(closest.pointA - A.at(t).p));
    const Vec uB = B.linearAt(t) + cross(B.turning, Vec(closest.pointB - B.at(t).p));
    return closest.normal.dot(uA - uB);
}

/// The speed along n that turning gives points of two shapes, at most.
template <class S>
typename S::Real FlightImpacts<S>::turningAlong(const MovedWorld<S>& world, const Pair& pair,
                                                const Vec& n) const {
    const ShapeRecord<S>&a = world.contacts.shapes()[pair.a], &b = world.contacts.shapes()[pair.b];
    return turningAcross(n, ways_[a.body].turning) * a.boundingRadius +
           turningAcross(n, ways_[b.body].turning) * b.boundingRadius;
}

/// The speed of shapes towards each other along n, at most, from t to the end of the step.
template <class S>
typename S::Real FlightImpacts<S>::fastestAlong(const MovedWorld<S>& world, const Pair& pair, const Vec& n,
                                                Real t) const {
    const Way &A = ways_[world.contacts.shapes()[pair.a].body],
              &B = ways_[world.contacts.shapes()[pair.b].body];
    const Real gains = n.dot(A.acceleration - B.acceleration);
    return n.dot(A.linearAt(t) - B.linearAt(t)) + std::max(gains, Real(0)) * (world.h - t) +
           turningAlong(world, pair, n);
}

/// False: the two shapes cannot touch from `from` on.
template <class S>
bool FlightImpacts<S>::comesNear(const MovedWorld<S>& world, const Pair& pair, Real from) const {
    const ClosestPoints<S> closest = look(world, pair, from);
    const Real near = touchingDistance<S>(ways_[world.contacts.shapes()[pair.a].body].start,
                                          ways_[world.contacts.shapes()[pair.b].body].start, closest);
    const Real fastest = fastestAlong(world, pair, closest.normal, from);
    return closest.distance <= Real(2) * near + std::max(fastest, Real(0)) * (world.h - from);
}

/// The first time in [from, h] at which the shapes touch and approach each other: Newton's iteration on the
/// distance, which for spheres and planes is exact at once, as long as it does not lead into an overlap, then
/// bisection; where it does not come nearer, conservative advancement (time_of_impact.cpp).
template <class S>
typename FlightImpacts<S>::Touch FlightImpacts<S>::firstTouch(const MovedWorld<S>& world, const Pair& pair,
                                                              Real from) const {
    const ShapeRecord<S>&sa = world.contacts.shapes()[pair.a], &sb = world.contacts.shapes()[pair.b];
    const Way &A = ways_[sa.body], &B = ways_[sb.body];
    constexpr int kMaxLooks = 100;
    const Real slowest = slowestImpact(
        world, world.contacts.materials().pair(sa.material, sb.material).restitution, sa.body, sb.body);
    const Real sunk = pair.sunk > 0 ? sinkingDepth(pair) * thicknessOf<S>(sa, sb) : Real(0);
    Touch touch;
    Real t = from;
    ClosestPoints<S> closest = look(world, pair, t);
    for (int i = 0; i < kMaxLooks; ++i) {
        const Vec& n = closest.normal;
        const Real d = closest.distance, rest = world.h - t;
        const Real near = touchingDistance<S>(A.start, B.start, closest);
        const Real u = closingSpeed(pair, world, closest, t), a = n.dot(A.acceleration - B.acceleration);
        // The tolerance of an earlier touch was that of other poses.
        if (d < -Real(2) * near - sunk && i == 0) {
            touch.overlapped = true;
            return touch;
        }
        const Real fastest = fastestAlong(world, pair, n, t);
        if (!(fastest > 0)) return touch;
        Real step;
        if (d <= near) {
            if (u > 0 && u <= slowest) {
                touch.overlapped = true;  // a contact rather than an impact
                return touch;
            }
            if (u > 0) {
                // An impact at the very end of the step is the next one's.
                touch.hit = t + near / u + Real(1e-9) * world.h < world.h;
                touch.time = t;
                touch.closest = closest;
                return touch;
            }
            // They part. They meet again after twice the time to where they are furthest apart.
            step = a > 0 ? -u / a : rest;
            if (turningAlong(world, pair, n) > 0) step = std::min(step, Real(0.125) * rest);
            step = std::max(step, Real(1e-6) * world.h);
        } else {
            const Real safe = d / fastest;
            if (safe > rest) return touch;
            step = safe;
            const Real newton = timeToClose(d, u, a);
            if (newton > 0 && newton <= rest) {
                const ClosestPoints<S> then = look(world, pair, t + newton);
                if (then.distance < d && then.distance >= -near) {
                    t += newton;
                    closest = then;
                    continue;
                }
                if (then.distance < -near) {
                    Real lo = t, hi = t + newton;
                    for (int k = 0; k < 60 && hi - lo > Real(1e-15) * world.h; ++k) {
                        const Real mid = Real(0.5) * (lo + hi);
                        closest = look(world, pair, mid);
                        (closest.distance > 0 ? lo : hi) = mid;
                        if (std::abs(closest.distance) <= near) {
                            lo = mid;
                            break;
                        }
                    }
                    t = lo;
                    closest = look(world, pair, t);
                    continue;
                }
            }
        }
        t += step;
        if (!(t < world.h)) return touch;
        closest = look(world, pair, t);
    }
    return touch;
}

template <class S>
typename S::Real thicknessOf(const ShapeRecord<S>& a, const ShapeRecord<S>& b) {
    return std::min({a.inscribedRadius, b.inscribedRadius, typename S::Real(1)});
}

/// The first time after `from` at which two bodies in contact, which turn about what they touch, have sunk in by kSinks:
/// among samples, then bisection, which ends where they are less deep.
template <class S>
typename FlightImpacts<S>::Touch FlightImpacts<S>::nextSinking(const MovedWorld<S>& world, const Pair& pair,
                                                               Real from) const {
    constexpr int kSamples = 8, kBisections = 12;
    const ShapeSet<S>& shapes = world.contacts.shapes();
    const Real deep = sinkingDepth(pair) * thicknessOf<S>(shapes[pair.a], shapes[pair.b]);
    const auto isDeep = [&](Real t) { return look(world, pair, t).distance < -deep; };
    Touch touch;
    Real lo = from, hi = from;
    for (int k = 1; k <= kSamples && !touch.sinks; ++k) {
        lo = hi;
        hi = from + (world.h - from) * static_cast<Real>(k) / Real(kSamples);
        touch.sinks = isDeep(hi);
    }
    if (!touch.sinks) return touch;
    for (int k = 0; k < kBisections; ++k) {
        const Real mid = Real(0.5) * (lo + hi);
        (isDeep(mid) ? hi : lo) = mid;
    }
    touch.hit = lo < world.h;
    touch.time = lo;
    touch.closest = look(world, pair, lo);
    return touch;
}

#define RIGOR_INSTANTIATE(S)                                                                          \
    template S::Real touchingDistance<S>(const Pose<S>&, const Pose<S>&, const ClosestPoints<S>&);    \
    template ClosestPoints<S> FlightImpacts<S>::look(const MovedWorld<S>&, const Pair&, Real) const;  \
    template S::Real thicknessOf<S>(const ShapeRecord<S>&, const ShapeRecord<S>&);                    \
    template bool FlightImpacts<S>::comesNear(const MovedWorld<S>&, const Pair&, Real) const;         \
    template typename FlightImpacts<S>::Touch FlightImpacts<S>::nextSinking(const MovedWorld<S>&,     \
                                                                            const Pair&, Real) const; \
    template typename FlightImpacts<S>::Touch FlightImpacts<S>::firstTouch(const MovedWorld<S>&,      \
                                                                           const Pair&, Real) const;
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
