// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The scene at its start, with the ways of the observed bodies: those of the exact solution where it has them, else of
// the first engine that ran.
import { el } from '../../common/elements.ts';
import { scenePicture } from '../../drawing/picture.ts';
import { readScene } from '../../replay/scene.ts';
import type { Vec3 } from '../../replay/vectors.ts';
import { unpack } from '../charts/samples.ts';
import type { BodyCurve, Case } from '../data.ts';
import type { Context } from './context.ts';

function ways(cases: Case[]): Vec3[][] {
  const complete = (b: BodyCurve) => b.position.length > 0 && b.position.every((text) => text !== null);
  const from =
    cases.find((c) => c.curves?.reference?.some(complete)) ?? cases.find((c) => c.curves?.bodies.some(complete));
  const bodies = (from?.curves?.reference?.some(complete) ? from.curves.reference : from?.curves?.bodies) ?? [];
  return bodies.filter(complete).map((body) => {
    const axes = body.position.map((text) => unpack(text) ?? new Float32Array());
    const count = Math.min(...axes.map((a) => a.length));
    const points = Array.from(
      { length: count },
      (_, i): Vec3 => [axes[0]?.[i] ?? 0, axes[1]?.[i] ?? 0, axes[2]?.[i] ?? 0],
    );
    return points.filter((p) => p.every(Number.isFinite));
  });
}

/** Null for a file that the drawing cannot read. */
export function drawing({ data, cases }: Context): HTMLElement | null {
  try {
    const file = JSON.parse(data.text);
    const scene = readScene(file);
    const paths = ways(cases);
    const picture = scenePicture(scene, file, { width: 560, height: 340, paths, labels: true });
    const key = [
      ['velocity', 'first velocity'],
      ['spin', 'first angular velocity'],
      ['gravity', 'gravity'],
    ].filter(([kind]) => picture.querySelector(`.${kind}`));
    const caption = el(
      'figcaption',
      { class: 'muted small' },
      'The scene at its start. ',
      key.map(([kind, text]) => [el('i', { class: `swatch ${kind}` }), ` ${text} `]),
      paths.some((p) => p.length > 1) ? [el('i', { class: 'swatch way' }), ' way of an observed body'] : null,
    );
    return el('figure', { class: 'drawing' }, picture, caption);
  } catch {
    return null;
  }
}
