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
