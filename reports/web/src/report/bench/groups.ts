// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Comparisons in a bench and the numbers of its curves: pure functions of its data.
import { toNumber } from '../../common/format.ts';
import type { BenchCase } from '../data.ts';

/** Everything of one name: a scene at all its sizes, with all engines. */
export interface Subject {
  part: string;
  name: string;
  sizes: { size: number; cases: BenchCase[] }[]; // rising
}

export function subjectsOf(cases: BenchCase[]): Subject[] {
  const subjects: Subject[] = [];
  for (const c of cases) {
    let subject = subjects.find((s) => s.part === c.part && s.name === c.name);
    if (!subject) {
      subject = { part: c.part, name: c.name, sizes: [] };
      subjects.push(subject);
    }
    const size = toNumber(c.size);
    const at = subject.sizes.find((s) => s.size === size);
    if (at) at.cases.push(c);
    else subject.sizes.push({ size, cases: [c] });
  }
  for (const s of subjects) s.sizes.sort((a, b) => a.size - b.size);
  return subjects;
}

export const engineOf = (c: BenchCase): string => c.engine.split(':')[0] as string;
export const labelOf = (c: BenchCase): string => c.label + (c.threads > 1 ? `, ${c.threads} threads` : '');

/** Label and spec of those that differ, once each. */
export function specKey(cases: BenchCase[]): [string, string][] {
  const key = new Map(cases.filter((c) => c.label !== c.engine).map((c) => [c.label, c.engine]));
  return [...key].sort(([a], [b]) => (a < b ? -1 : 1));
}

/** Dashes for each of the curves: those of one engine have its colour. */
export function dashesOf(curves: BenchCase[]): number[][] {
  const dashes = [[], [6, 4], [2, 3], [12, 4], [8, 3, 2, 3]];
  return curves.map((c, i) => {
    const before = curves.slice(0, i).filter((other) => engineOf(other) === engineOf(c)).length;
    return dashes[before % dashes.length] as number[];
  });
}

/** Contact points of an operation, or another measure of its work; 0 where nothing does. */
export function workOf(c: BenchCase): number {
  for (const name of ['contacts', 'pairs', 'touching_pairs']) {
    const value = toNumber(c.counts[name]);
    if (value > 0) return value;
  }
  return 0;
}

export interface CurvePoint {
  x: number;
  y: number;
  low: number;
  high: number;
}
/** Time per contact point over size, a curve per engine and threads; points that are no timing are left out. */
export function growthCurves(subject: Subject): { of: BenchCase; points: CurvePoint[] }[] {
  const curves: { of: BenchCase; points: CurvePoint[] }[] = [];
  for (const { size, cases } of subject.sizes)
    for (const c of cases) {
      const work = workOf(c) || size;
      if (!c.valid || !(work > 0)) continue;
      let curve = curves.find((k) => k.of.engine === c.engine && k.of.threads === c.threads);
      if (!curve) {
        curve = { of: c, points: [] };
        curves.push(curve);
      }
      const per = (v: BenchCase['time']) => toNumber(v) / work;
      curve.points.push({ x: size, y: per(c.time), low: per(c.low), high: per(c.high) });
    }
  return curves.filter((k) => k.points.length > 1);
}

/** The curve of each engine that is lowest at its largest size: broad phases by the dozen would hide each other. */
export function leaders<C extends { of: BenchCase; points: CurvePoint[] }>(curves: C[]): C[] {
  const best = new Map<string, C>();
  const last = (c: C) => c.points.at(-1) as CurvePoint;
  for (const curve of curves) {
    const other = best.get(engineOf(curve.of));
    const [own, its] = [last(curve), other ? last(other) : null];
    if (!its || own.x > its.x || (own.x === its.x && own.y < its.y)) best.set(engineOf(curve.of), curve);
  }
  return curves.filter((c) => best.get(engineOf(c.of)) === c);
}

/** The fastest of each engine's cases whose times count. */
export function fastest(cases: BenchCase[]): Map<string, BenchCase> {
  const best = new Map<string, BenchCase>();
  for (const c of cases) {
    const other = best.get(engineOf(c));
    if (c.valid && !(other && toNumber(other.time) <= toNumber(c.time))) best.set(engineOf(c), c);
  }
  return best;
}

/** Fastest first, what is no timing last. */
export const byTime = (cases: BenchCase[]): BenchCase[] => {
  const key = (c: BenchCase) => (c.valid ? toNumber(c.time) : Infinity);
  return [...cases].sort((a, b) => (key(a) === key(b) ? 0 : key(a) - key(b)));
};

/** Rate per second: "3.4 M". */
export function rate(seconds: BenchCase['time']): string {
  let perSecond = 1 / toNumber(seconds);
  if (!Number.isFinite(perSecond)) return '—';
  const prefixes = ['', ' k', ' M', ' G'];
  let thousands = 0;
  for (; thousands < 3 && perSecond >= 999.5; thousands++) perSecond /= 1000;
  return Number(perSecond.toPrecision(3)) + (prefixes[thousands] as string);
}

/** Speed-up over one thread by wall time; NaN if one of the two is no timing. */
export function speedUp(c: BenchCase, cases: BenchCase[]): number {
  const single = cases.find((o) => o.engine === c.engine && o.threads === 1);
  if (c.threads === 1 || !single?.valid || !c.valid) return NaN;
  return toNumber(single.wall) / toNumber(c.wall);
}
