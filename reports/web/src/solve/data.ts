// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page's data as validation/contact_problems/print.cpp writes them.

export interface SolveStep {
  allowed: number; // iterations
  done: number;
  seconds: number; // median wall time
  residual: number | null; // residual of the natural map, relative
  residual_own_model: number | null; // residual with the solver's own model of friction
  penetration_velocity: number | null; // [m/s]
  cone_violation: number | null;
  velocity_error: number | null; // distance from the stored solution, relative
  gave_up: boolean;
}

export interface SolveAnswer {
  solver: string; // "stored": the solution in the file
  friction: string; // model of the solver: "cone", "box", ...
  outcome: string;
  message: string;
  steps: SolveStep[];
}

export interface SolveProblem {
  name?: string;
  file?: string;
  contacts?: number;
  velocities?: number;
  answers: SolveAnswer[];
}
