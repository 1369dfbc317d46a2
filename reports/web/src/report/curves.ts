// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Curves of a scenario: positions of a body, and the series of errors, energies, depths, normals, of all engines and
// the reference over each other.
import { inShownUnit, shownUnit, words } from '../common/format.ts';
import { spreadsByDecades, unpack, withGaps } from './charts/samples.ts';
import type { Case } from './data.ts';

export interface Curve {
  spec: string; // "" the reference
  x: ArrayLike<number>;
  y: (number | null)[];
}

export interface CurvePlot {
  key: string; // "p0", "position_error/block"
  title: string;
  unit: string;
  curves: Curve[];
}

export const bodyNames = (cases: Case[]): string[] => [
  ...new Set(cases.flatMap((c) => c.curves?.bodies.map((b) => b.name) ?? [])),
];

/** A recording is not the exact solution, and is not called so. */
export const referenceLabel = (cases: Case[]): string =>
  cases.some((c) => c.metrics.some((m) => m.kind === 'measured')) ? 'recorded motion' : 'exact reference';

const axes = ['x', 'y', 'z'];
const first = ['position_error', 'energy', 'penetration', 'normal_error'];

/** Plots of one body and of the whole scene; those of other bodies are left out, and those that stay at zero. */
export function collectCurves(cases: Case[], observed: string[], body: string): CurvePlot[] {
  const plots = new Map<string, CurvePlot>();
  const others = new Set([...observed, ...bodyNames(cases)].filter((name) => name !== body));
  const add = (key: string, title: string, unit: string, curve: Curve | null) => {
    if (curve === null) return;
    const plot = plots.get(key) ?? { key, title, unit, curves: [] };
    plot.curves.push(curve);
    plots.set(key, plot);
  };
  for (const c of cases) {
    if (c.curves === null) continue;
    const times = unpack(c.curves.t) ?? new Float32Array();
    for (const [list, spec] of [
      [c.curves.reference, ''],
      [c.curves.bodies, c.spec],
    ] as const)
      list
        ?.find((b) => b.name === body)
        ?.position.forEach((packed, k) => {
          const y = unpack(packed);
          add(`p${k}`, `${body}: position ${axes[k]}`, 'm', y && { spec, x: times, y: withGaps(y) });
        });
    for (const s of c.curves.series) {
      if (others.has(s.subject)) continue;
      const title =
        (s.name === 'normal_error' ? 'contact normal error' : words(s.name)) + (s.subject ? `: ${s.subject}` : '');
      const y = withGaps(unpack(s.y) ?? []).map((v) => inShownUnit(v, s.unit) as number | null);
      const curve = { spec: c.spec, x: s.t ? (unpack(s.t) ?? times) : times, y };
      add(`${s.name}/${s.subject}`, title, shownUnit(s.unit), curve);
    }
  }
  const moves = (plot: CurvePlot) => plot.curves.some((c) => c.y.some((y) => y !== null && Math.abs(y) > 1e-12));
  return [...plots.values()].filter(moves).sort((a, b) => rank(a) - rank(b));
}

/** The motion, then the most requested curves, then the rest as stored. */
function rank(plot: CurvePlot): number {
  if (/^p\d$/.test(plot.key)) return -1;
  const place = first.indexOf(plot.key.split('/')[0] as string);
  return place < 0 ? first.length : place;
}

export const wantsLog = (plot: CurvePlot): boolean =>
  /error|drift|residual/.test(plot.key) && spreadsByDecades(plot.curves.flatMap((c) => c.y));
