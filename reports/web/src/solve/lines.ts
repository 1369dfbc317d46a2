// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Curves of a contact problem: the residual of each solver over its iterations or over its time, joined in the order of
// the iterations.
import type { Line } from '../report/charts/line.ts';
import type { SolveAnswer, SolveStep } from './data.ts';

const palette = ['#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9', '#8C6D1F'];
const dashes = [[], [6, 4], [2, 3], [10, 4]];

export const colourOf = (index: number): string => palette[index % palette.length] as string;

export const dashOf = (index: number): number[] =>
  dashes[Math.floor(index / palette.length) % dashes.length] as number[];

/** Steps of a solver that did iterate and have a residual above zero. */
const stepsOf = (answer: SolveAnswer): SolveStep[] =>
  answer.steps.filter((s) => s.done > 0 && s.residual !== null && Number.isFinite(s.residual));

/** Solvers that have a curve. */
export const solved = (answers: SolveAnswer[]): SolveAnswer[] =>
  answers.filter((a) => a.solver !== 'stored' && stepsOf(a).length > 0);

export function residualLine(answer: SolveAnswer, index: number, over: 'done' | 'seconds', least: number): Line {
  const steps = stepsOf(answer);
  // a residual of zero has no place on a logarithmic axis but its end
  const points = steps.map((s) => ({ x: s[over], y: Math.max(least, s.residual ?? 0) }));
  const sorted = [...points].sort((a, b) => a.x - b.x);
  const inOrder = points.every((p, i) => p === sorted[i]);
  return {
    key: '',
    label: answer.solver,
    colour: colourOf(index),
    dash: dashOf(index),
    width: 1.5,
    points: true,
    x: sorted.map((p) => p.x),
    y: sorted.map((p) => p.y),
    ...(inOrder ? {} : { joined: { x: points.map((p) => p.x), y: points.map((p) => p.y) } }),
  };
}
