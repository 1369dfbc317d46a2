// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Residual of impulses in a contact problem, by the criterion of Siconos and of the papers on FCLIB:
//     e(r) = || r - P_K( r - (u + mu |u_T| e_N) ) ||_2,   u = W r + q,   relative: e / max(|q|, |r|, |u|)
// with P_K the projection onto K = {|r_T| <= mu r_N}, contact by contact: zero exactly where the contact law
// holds (the natural map of its variational inequality after De Saxce's change of variable). It mixes
// impulses with velocities, so that the absolute value depends on the units: compare relative values.
// Source: Acary, Bremond, Huber, 2018, section 4; Acary, Cadoux, 2013.
#pragma once

#include <vector>

#include "adapters/interface/contact_problem.hpp"

namespace rigor::validation {

struct ContactResidual {
    double relative = 0.0;
    double absolute = 0.0;
    double penetration = 0.0;  ///< largest speed at which surfaces come nearer, max (-u_N)+ [as u]
    double cone = 0.0;         ///< largest (|r_T| - mu r_N)+, relative to the largest |r_N|
    /// Relative natural map of the law with the friction that the solver says it solves for: normal and
    /// friction by themselves, r_N - (r_N - u_N)+ and r_T - P(r_T - u_T), P onto the section of its pyramid.
    /// The same as `relative` for the cone. The excess of `relative` over it is the error of the model.
    double own = 0.0;
};

/// A NaN anywhere makes all of the residuals infinite.
ContactResidual contactResidual(const adapter::ContactProblem& problem, const std::vector<double>& r,
                                const adapter::FrictionModel& model = {});

}  // namespace rigor::validation
