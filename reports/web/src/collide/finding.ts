// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An engine's result for a case beside the exact solution, as the picture draws it.
import type { ContactFinding, Point } from '../common/finding.ts';
import type { Answer, CollideCase } from './data.ts';

const isPoint = (p: Point | null | undefined): p is Point => Array.isArray(p) && p.length === 3;

/** Null where there is nothing to draw: neither a normal with its points, nor an exact solution with them. */
export function findingOf(c: CollideCase, answer: Answer): ContactFinding | null {
  const { truth } = c;
  const [a, b] = [answer.witness_a, answer.witness_b];
  const distance = answer.signed_distance ?? Number.NaN;
  const said =
    isPoint(answer.normal) && isPoint(a) && isPoint(b)
      ? { normal: answer.normal, depth: -distance, pointA: a, pointB: b }
      : null;
  const [exactA, exactB] = [truth.witness_a ?? a, truth.witness_b ?? b];
  const exact =
    truth.signed_distance !== undefined && isPoint(exactA) && isPoint(exactB)
      ? { distance: truth.signed_distance, normals: truth.normals ?? [], pointA: exactA, pointB: exactB }
      : null;
  if (said === null && exact === null) return null;
  const isWrongOverlap = answer.verdict === 'wrong overlap';
  const what = isWrongOverlap
    ? truth.overlap
      ? 'missed'
      : 'spurious'
    : answer.verdict === 'wrong depth'
      ? 'depth'
      : 'normal';
  return {
    what,
    error: (what === 'normal' ? answer.normal_angle : answer.distance_error) ?? 0,
    unit: what === 'normal' ? 'rad' : 'm',
    time: 0,
    step: 0,
    bodies: [0, 1],
    names: ['A', 'B'],
    shapes: [0, 0],
    contact: -1,
    said,
    ...(said === null && Number.isFinite(distance) ? { depth: -distance } : {}),
    by: answer.engine,
    exact,
  };
}
