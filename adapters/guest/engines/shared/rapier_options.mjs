// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import * as rg from '../../sdk/rigor_guest.mjs';

export const options = [
    rg.number('solver_iterations', 1, 1000, 4, 4, 'sub-steps of the solver, numSolverIterations', true),
    rg.number('internal_pgs_iterations', 1, 1000, 1, 4, 'sweeps in each sub-step, numInternalPgsIterations', true),
    rg.choice('sleeping', ['on', 'off'], 'on', 'off', 'bodies at rest are put to sleep'),
    rg.number('allowed_linear_error', 0, 1, 0.005, 0, 'overlap that is left alone [m], normalizedAllowedLinearError'),
    rg.number('prediction_distance', 0, 1, 0.02, 0.02, 'contacts are found so far ahead [m]'),
    rg.number('contact_frequency', 1, 1e6, 30, 30, 'natural frequency of the soft contacts [Hz]'),
    rg.choice('internal_edges', ['as_they_are', 'fixed'], 'as_they_are', 'fixed', 'fixed: inner edges of meshes and fields are not felt'),
];
