// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One finding of the contact audit, as validation/runner/audit_findings.cpp writes it: what an engine said of two shapes
// at one moment, and the exact solution. World frame, SI units.

export type Point = [number, number, number];

export interface ContactFinding {
  what: 'normal' | 'point_normal' | 'depth' | 'missed' | 'spurious'; // point_normal: of any point, not the deepest one
  error: number; // in `unit`
  unit: 'rad' | 'm';
  time: number; // [s]
  step: number; // steps up to the frame
  bodies: [a: number, b: number]; // places in the scenario
  names: [a: string, b: string];
  shapes: [a: number, b: number];
  contact: number; // place among the stored contacts of the frame, -1: none of them
  /** The engine's deepest contact; null: it found none. */
  said: { normal: Point; depth: number; pointA: Point; pointB: Point } | null;
  /** Depth that it reported without a normal and points [m]. */
  depth?: number;
  /** Engine that was queried at the poses of the run; none where the contact is the run's own. */
  by?: string;
  /** Null where no exact method is known. */
  exact: { distance: number; normals: Point[]; pointA: Point; pointB: Point } | null;
}

/** Name of a finding in addresses: auditor and kind. */
export const findingKey = (auditor: string, what: ContactFinding['what']): string => `${auditor}~${what}`;

/** Name of what reported the contact, in sentences. */
export const speaker = (finding: ContactFinding | null): string => finding?.by ?? 'the engine';

/** Angle of two directions [rad]. */
export function angleBetween(a: Point, b: Point): number {
  const cross = Math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  return Math.atan2(cross, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/** The exact normal nearest to the engine's; the first one where it reported none. */
export function nearestExact({ said, exact }: ContactFinding): Point | null {
  const normals = exact?.normals ?? [];
  if (said === null) return normals[0] ?? null;
  return normals.reduce<Point | null>(
    (best, n) => (best === null || angleBetween(n, said.normal) < angleBetween(best, said.normal) ? n : best),
    null,
  );
}

/** Point at which a finding is drawn: the middle between the engine's points, or the exact ones [m]. */
export function placeOf({ said, exact }: ContactFinding): Point | null {
  const points = said ?? exact;
  if (points === null) return null;
  return [0, 1, 2].map((k) => ((points.pointA[k] as number) + (points.pointB[k] as number)) / 2) as Point;
}
