// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Scenario } from '../../src/report/data.ts';
import { decidingText, mainText } from '../../src/report/deciding.ts';

const scenario = (main: string, cases: [by: string, of: string, subject?: string][]): Scenario =>
  ({
    main: { name: main, unit: '1', kind: 'exact' },
    cases: cases.map(([by, of, subject = '']) => ({ subject, judged: { by, of } })),
  }) as unknown as Scenario;

test('an error of named quantities says which', () => {
  const s = scenario('quantity_error', [
    ['quantity_error', 'stop_time', 'stop_time'],
    ['quantity_error', 'stop_distance', 'stop_distance'],
    ['quantity_error', 'stop_time', 'stop_time'],
  ]);
  assert.equal(decidingText(s), 'relative error: stop time, stop distance');
  assert.equal(mainText(s), 'error of stop time, stop distance');
});

test('of many two are named', () => {
  const s = scenario('quantity_error', [
    ['quantity_error', 'a', 'a'],
    ['quantity_error', 'b', 'b'],
    ['quantity_error', 'c', 'c'],
  ]);
  assert.equal(decidingText(s), 'relative error: a, b, …');
});

test('other metrics go by their names, and runs that were not graded by none', () => {
  const s = scenario('position_max', [
    ['position_max', 'block'],
    ['velocity_final', 'block'],
    ['', ''],
  ]);
  assert.equal(decidingText(s), 'relative error: position max; velocity final');
  assert.equal(mainText(s), 'position max');
  const old = scenario('quantity_error', [['quantity_error', '']]);
  assert.equal(decidingText(old), 'relative error: quantity error', 'a run that does not say it');
});
