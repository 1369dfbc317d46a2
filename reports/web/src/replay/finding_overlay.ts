// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A finding of the contact audit in the picture: the engine's normal and witness points, the exact ones, and the angle
// between the normals in true size. Seen through everything.
import { Color, Group } from 'three';
import { angleBetween, type ContactFinding, nearestExact, placeOf, speaker } from '../common/finding.ts';
import type { Theme } from './colours.ts';
import { type Arrow, Dots, FatLines } from './line_batch.ts';
import type { Vec3 } from './vectors.ts';

/** A text at a point of the world. */
export interface Note {
  at: Vec3; // [m]
  text: string;
  kind: 'engine' | 'exact' | 'angle' | 'body' | 'measure';
}

const arcSteps = 24;
const noticeable = 1e-4; // [rad] smaller angles are a line

/** Length with a fitting unit, four digits. */
export function lengthText(metres: number): string {
  const size = Math.abs(metres);
  const digits = (x: number) => String(Number(x.toPrecision(4)));
  if (size > 0 && size < 1e-4) return `${digits(1e6 * metres)} µm`;
  return size < 0.1 ? `${digits(1e3 * metres)} mm` : `${digits(metres)} m`;
}

const along = (at: Vec3, d: Vec3, length: number): Vec3 => [
  at[0] + d[0] * length,
  at[1] + d[1] * length,
  at[2] + d[2] * length,
];

/** Points of the arc from one unit direction to another, around a point. */
export function arc(at: Vec3, from: Vec3, to: Vec3, radius: number, steps = arcSteps): Vec3[] {
  const angle = angleBetween(from, to);
  if (!(angle > noticeable) || angle > Math.PI - noticeable) return [];
  return Array.from({ length: steps + 1 }, (_, i) => {
    const share = i / steps;
    const a = Math.sin((1 - share) * angle) / Math.sin(angle);
    const b = Math.sin(share * angle) / Math.sin(angle);
    const d = [0, 1, 2].map((k) => a * (from[k] as number) + b * (to[k] as number)) as Vec3;
    return along(at, d, radius);
  });
}

const exactLength = 0.8; // length of the exact normal, so that both heads are seen where the normals agree

/** Angle in degrees, three digits; what is smaller than rounding is none. */
export const degrees = (radians: number): string =>
  radians < 1e-9 ? '0°' : `${Number(((180 / Math.PI) * radians).toPrecision(3))}°`;

/** Texts of a finding whose arrows are `length` long [m]. */
export function findingNotes(finding: ContactFinding, length: number): Note[] {
  const at = placeOf(finding);
  if (at === null) return [];
  const { said } = finding;
  const exact = nearestExact(finding);
  const notes: Note[] = [];
  if (said) notes.push({ at: along(at, said.normal, length), text: finding.by ?? 'engine', kind: 'engine' });
  if (exact) notes.push({ at: along(at, exact, exactLength * length), text: 'exact', kind: 'exact' });
  const missing = (finding.depth ?? 0) > 0 ? 'normal' : 'contact';
  if (!said) notes.push({ at, text: `no ${missing} of ${speaker(finding)}`, kind: 'engine' });
  if (said && exact && finding.what === 'depth') {
    const apart = -(finding.exact?.distance ?? Number.NaN);
    const kind = apart < 0 ? 'distance' : 'depth';
    const [own, exactly] = [said.depth, apart].map((x) => lengthText(apart < 0 ? -x : x));
    const text = `${kind} ${own}, exact ${exactly}`;
    notes.push({ at: along(at, exact, -0.25 * length), text, kind: 'measure' });
  } else if (said && exact) {
    const bow = arc(at, said.normal, exact, 0.62 * length);
    const middle = bow[bow.length >> 1] ?? along(at, exact, 0.62 * length);
    notes.push({ at: middle, text: degrees(angleBetween(said.normal, exact)), kind: 'angle' });
  }
  return notes;
}

export class FindingOverlay {
  readonly group = new Group();
  readonly #lines = new FatLines(9, 3.2);
  readonly #faint = new FatLines(8, 1.6);
  readonly #dots = new Dots(10, 11);
  readonly #c = new Color();

  constructor() {
    this.group.add(this.#faint.object, this.#faint.heads, this.#lines.object, this.#lines.heads, this.#dots.object);
  }

  /** The arrows: the engine's normal first, then the nearest exact one. */
  get arrows(): Arrow[] {
    return this.group.visible ? this.#lines.arrows : [];
  }

  /** The witness points, on A and on B: the engine's first, then the exact ones. */
  get points(): Vec3[] {
    return this.group.visible ? this.#dots.places : [];
  }

  set pixels(value: number) {
    this.#dots.pixels = value;
  }

  /** Draws it with arrows of this length [m]; null: nothing. */
  draw(finding: ContactFinding | null, theme: Theme, length: number): void {
    const batches = [this.#lines, this.#faint, this.#dots];
    for (const batch of batches) batch.begin();
    const at = finding && placeOf(finding);
    this.group.visible = at !== null;
    if (finding && at) this.#drawAt(finding, at, theme, length);
    for (const batch of batches) batch.end();
  }

  #drawAt(finding: ContactFinding, at: Vec3, theme: Theme, length: number): void {
    const { said, exact } = finding;
    const nearest = nearestExact(finding);
    const arrow = (batch: FatLines, d: Vec3, colour: string, long = length) =>
      batch.arrow(...at, d[0] * long, d[1] * long, d[2] * long, 0.14 * length, this.#c.set(colour));
    if (said) {
      arrow(this.#lines, said.normal, theme.normal);
      this.#witness(said.pointA, said.pointB, theme.normal);
    }
    if (nearest) arrow(this.#lines, nearest, theme.exact, exactLength * length);
    for (const n of exact?.normals ?? []) if (n !== nearest) arrow(this.#faint, n, theme.exact, exactLength * length);
    if (exact) this.#witness(exact.pointA, exact.pointB, theme.exact);
    if (!said || !nearest) return;
    this.#c.set(theme.angle);
    const bow = arc(at, said.normal, nearest, 0.62 * length);
    for (let i = 1; i < bow.length; ++i) this.#lines.line(...(bow[i - 1] as Vec3), ...(bow[i] as Vec3), this.#c);
  }

  /** Points of one side on both bodies, and the overlap between them. */
  #witness(a: Vec3, b: Vec3, colour: string): void {
    if (![...a, ...b].every(Number.isFinite)) return;
    this.#c.set(colour);
    this.#lines.line(...a, ...b, this.#c);
    this.#dots.dot(...a, this.#c);
    this.#dots.dot(...b, this.#c);
  }

  dispose(): void {
    this.#lines.dispose();
    this.#faint.dispose();
    this.#dots.dispose();
  }
}
