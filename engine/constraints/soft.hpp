// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Position errors as damped springs [Catto2011]. A spring of stiffness k and damping c on C, integrated
// implicitly over h, is the row
//     J v + bias + gamma lambda = 0,   gamma = 1 / (h (c + h k)),   bias = h k gamma C
// With k = m omega^2 and c = 2 m zeta omega for the row's effective mass m = 1/K, both follow from a
// frequency and a damping ratio alone:
//     a = 2 zeta + h omega,   bias = (omega / a) C,   gamma = K / (h omega a)
#pragma once

namespace rigor::engine {

/// A damped spring by its undamped frequency [Hz], > 0, and damping ratio, >= 0 (1: critical).
template <class R>
struct Softness {
    R frequency = 0;
    R dampingRatio = 1;
};

/// Terms that a soft error contributes to its row.
template <class R>
struct SoftTerms {
    R biasRate = 0;  ///< bias per C [1/s]
    R gamma = 0;     ///< Row::softness
};

/// Terms from frequency and damping ratio, for a row of K = J M^-1 J^T over a step of h [s].
template <class R>
SoftTerms<R> softTerms(const Softness<R>& s, R K, R h) {
    const R omega = R(6.283185307179586) * s.frequency;
    const R a = R(2) * s.dampingRatio + h * omega;
    return {omega / a, K / (h * omega * a)};
}

/// Terms from stiffness k >= 0 [N/m] (or [N m/rad]) and damping c >= 0 [N s/m], not both 0.
template <class R>
SoftTerms<R> springTerms(R k, R c, R h) {
    const R gamma = R(1) / (h * (c + h * k));
    return {h * k * gamma, gamma};
}

/// Terms of a spring between midpoints: the row has the bias  biasRate C + velocityRate u,  u = J v before
/// the forces of the step.
template <class R>
struct MidpointTerms {
    R biasRate = 0;      ///< bias per C [1/s]
    R velocityRate = 0;  ///< bias per u
    R gamma = 0;         ///< Row::softness
};

/// Terms from stiffness and damping, not both 0, for a row of K over a step of h [s] from midpoint to
/// midpoint, C being that of the first. Where the spring is slow, h^2 k K + h c K <= 1, the force is that
/// of the mean of C over three midpoints, weighted 1 : 2 : 1 (Newmark's average acceleration
/// [Newmark1959]), and of the mean of u and J v: order 2, and the spring keeps its energy. Where it is
/// fast, from 4 on, it is the implicit one above, and in between a mixture of both.
template <class R>
MidpointTerms<R> midpointSpringTerms(R k, R c, R K, R h) {
    const R speed = h * K * (h * k + c);
    const R mean = speed <= R(1) ? R(1) : speed >= R(4) ? R(0) : (R(4) - speed) / R(3);
    // Force: -k (C + h (end J v - start u)) - c (after J v + before u).
    const R end = R(1) - R(0.75) * mean, start = R(0.25) * mean;
    const R after = R(1) - R(0.5) * mean, before = R(0.5) * mean;
    const R whole = k * h * end + c * after;
    return {k / whole, (c * before - k * h * start) / whole, R(1) / (h * whole)};
}

/// Bias of the velocity rows of a step due to position errors.
template <class R>
struct BiasRule {
    R baumgarte = 0;    ///< hard rows: Baumgarte factor, fraction of the error removed per step; 0: none
    bool soft = false;  ///< rows are damped springs instead
    Softness<R> contact{30, 10};
    Softness<R> joint{60, 2};
    R maxBiasVelocity = 3;  ///< soft contacts: largest bias velocity from penetration [m/s]
};

/// Rule of solvers with soft rows; the world fills in frequencies and damping ratios.
template <class R>
BiasRule<R> softBiasRule() {
    BiasRule<R> rule;
    rule.soft = true;
    return rule;
}

}  // namespace rigor::engine
