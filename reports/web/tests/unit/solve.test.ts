// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { SolveAnswer, SolveStep } from '../../src/solve/data.ts';
import { residualLine, solved } from '../../src/solve/lines.ts';

const step = (done: number, seconds: number, residual: number | null): SolveStep => ({
  allowed: done,
  done,
  seconds,
  residual,
  residual_own_model: residual,
  penetration_velocity: 0,
  cone_violation: 0,
  velocity_error: 0,
  gave_up: false,
});
const answer = (solver: string, ...steps: SolveStep[]): SolveAnswer => ({
  solver,
  friction: 'cone',
  outcome: 'solved',
  message: '',
  steps,
});

test('solvers without a residual, and the stored solution, have no curve', () => {
  const all = [
    answer('stored', step(0, 0, 1e-9)),
    answer('none'),
    answer('nan', step(3, 1, null)),
    answer('pgs', step(1, 1, 0.1)),
  ];
  assert.deepEqual(
    solved(all).map((a) => a.solver),
    ['pgs'],
  );
});

test('a curve goes from few iterations to many, over time also where more of them took less', () => {
  const a = answer('pgs', step(10, 3, 0.1), step(100, 2, 1e-20));
  const iterations = residualLine(a, 0, 'done', 1e-16);
  assert.deepEqual(
    [iterations.x, iterations.y],
    [
      [10, 100],
      [0.1, 1e-16],
    ],
  );
  assert.equal(iterations.joined, undefined);
  const time = residualLine(a, 0, 'seconds', 1e-16);
  assert.deepEqual(
    [time.x, time.y],
    [
      [2, 3],
      [1e-16, 0.1],
    ],
  );
  assert.deepEqual(time.joined, { x: [3, 2], y: [0.1, 1e-16] });
});
