// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Moments as numbers of steps: what a link says, since the digits of a time may end before its frame begins.

/** Steps of length dt from the start to a moment [s]; null where none ends there. */
export function stepAt(time: number, dt: number): number | null {
  const steps = Math.round(time / dt);
  return dt > 0 && steps >= 0 && Math.abs(time / dt - steps) < 1e-6 ? steps : null;
}
