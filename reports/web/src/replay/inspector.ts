// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Numbers of what the pointer is on, or of a body that was clicked: as they are stored, not as they are drawn.
import { el } from '../common/elements.ts';
import { angleBetween, type ContactFinding, nearestExact } from '../common/finding.ts';
import { degrees } from './finding_overlay.ts';
import type { Frame, FrameSource } from './frames.ts';
import type { Scene } from './scene.ts';

/** Seven digits: what single precision holds. */
const text = (x: number) => (Number.isFinite(x) ? String(Number(x.toPrecision(7))).replace(/^-/, '−') : String(x));
const three = (list: ArrayLike<number>, i: number, n = 3) =>
  Array.from({ length: n }, (_, k) => text(list[n * i + k] as number)).join(', ');

export interface Inspected {
  source: FrameSource;
  frame: Frame;
  body: number;
  shape: number;
  contact: number;
  island: number;
}

const row = (name: string, value: string, unit: string, key: string) => [
  el('dt', {}, name),
  el('dd', { 'data-quantity': key }, value, unit ? el('span', { class: 'unit' }, ` ${unit}`) : null),
];

function contactRows(scene: Scene, { frame, contact }: Inspected): HTMLElement[] {
  const c = frame.contacts;
  if (!c || contact < 0) return [];
  const name = (body: number, shape: number) =>
    `${scene.bodies[body]?.name ?? body}${shape > 0 ? ` (shape ${shape})` : ''}`;
  const side = (bodies: ArrayLike<number>, shapes: ArrayLike<number>) =>
    name(bodies[contact] as number, shapes[contact] as number);
  return [
    ...row('contact', `${contact} of ${c.count}`, '', 'contact'),
    ...row('found', c.instant ?? 'at these poses, where a step begins', '', 'found'),
    ...row('A', side(c.bodyA, c.shapeA), '', 'a'),
    ...row('B', side(c.bodyB, c.shapeB), '', 'b'),
    ...row('point on A', three(c.pointA, contact), 'm', 'pointA'),
    ...row('normal', three(c.normal, contact), '', 'normal'),
    ...row('depth', text(c.depth[contact] as number), 'm', 'depth'),
    ...row('normal impulse', text(c.normalImpulse[contact] as number), 'N s', 'normalImpulse'),
    ...row('friction', three(c.frictionImpulse, contact), 'N s', 'frictionImpulse'),
  ];
}

const findingTitles: Record<ContactFinding['what'], string> = {
  normal: 'Wrong normal',
  point_normal: 'Wrong normal',
  depth: 'Wrong depth',
  missed: 'Missed contact',
  spurious: 'False contact',
};

/** The engine's numbers beside the exact ones. */
export function findingRows(finding: ContactFinding, withTitle = true): HTMLElement[] {
  const { what, said, exact } = finding;
  const nearest = nearestExact(finding);
  const names = finding.names.map((name, i) => {
    const shape = finding.shapes[i] as number;
    return `${name}${shape > 0 ? ` (shape ${shape})` : ''}`;
  });
  const mm = (x: number) => text(1000 * x);
  const pair = (name: string, key: string, engine: string | null, exactly: string | null, unit = '') => [
    ...row(name, engine ?? 'none', engine === null ? '' : unit, `${key}Engine`),
    ...row('exact', exactly ?? 'unknown', exactly === null ? '' : unit, `${key}Exact`),
  ];
  const angle = said && nearest ? degrees(angleBetween(said.normal, nearest)) : null;
  const depth = said?.depth ?? finding.depth;
  const apart = exact ? -exact.distance : null;
  const ties = exact?.normals.length ?? 0;
  return [
    ...(withTitle
      ? [
          el('dt', { class: 'finding' }, findingTitles[what]),
          el('dd', { class: 'finding', 'data-quantity': 'finding' }, names.join(' and ')),
        ]
      : []),
    ...(angle ? row('angle between', angle, '', 'angle') : []),
    ...pair('normal', 'normal', said && three(said.normal, 0), nearest && three(nearest, 0)),
    ...(ties > 1 ? row('', `nearest of ${ties} exact normals`, '', 'ties') : []),
    ...pair('depth', 'depth', depth === undefined ? null : mm(depth), apart === null ? null : mm(apart), 'mm'),
    ...pair('point on A', 'witnessA', said && three(said.pointA, 0), exact && three(exact.pointA, 0), 'm'),
    ...pair('point on B', 'witnessB', said && three(said.pointB, 0), exact && three(exact.pointB, 0), 'm'),
  ];
}

function bodyRows(scene: Scene, { frame, body, shape, island }: Inspected): HTMLElement[] {
  const b = scene.bodies[body];
  if (!b) return [];
  const shapes = b.shapes.length > 1 ? `${b.shapes.length} shapes` : (b.shapes[0]?.name ?? 'no shape');
  return [
    ...row('body', `${b.name} (${body})`, '', 'body'),
    ...row('kind', `${b.type}, ${shapes}`, '', 'kind'),
    ...(shape >= 0 && b.shapes.length > 1 ? row('shape', `${shape}: ${b.shapes[shape]?.name}`, '', 'shape') : []),
    ...row('position', three(frame.position, body), 'm', 'position'),
    ...row('orientation', three(frame.orientation, body, 4), '', 'orientation'),
    ...(frame.velocity ? row('velocity', three(frame.velocity, body), 'm/s', 'velocity') : []),
    ...(frame.angularVelocity ? row('spin', three(frame.angularVelocity, body), 'rad/s', 'angularVelocity') : []),
    ...(island >= 0 ? row('island', scene.bodies[island]?.name ?? String(island), '', 'island') : []),
  ];
}

export class Inspector {
  readonly element: HTMLElement;
  readonly #scene: Scene;

  /** `floating`: over the picture, while the pointer rests on something; else beside it. */
  constructor(scene: Scene, floating: boolean) {
    this.#scene = scene;
    const kind = floating ? 'floating' : 'pinned';
    this.element = el('aside', { class: `inspector ${kind}`, hidden: true, 'aria-live': 'off' });
  }

  show(what: Inspected | null, finding: ContactFinding | null = null): void {
    this.element.hidden = what === null;
    if (what === null) {
      this.element.replaceChildren();
      return;
    }
    const { source, frame } = what;
    const time = row('time', text(frame.time), `s, step ${frame.step}`, 'time');
    const rows = what.contact >= 0 ? contactRows(this.#scene, what) : bodyRows(this.#scene, what);
    const numbers = finding
      ? [
          el('dl', {}, time, findingRows(finding)),
          el(
            'details',
            {},
            el('summary', {}, `contact as ${finding.by ? `${source.label} stored it` : 'stored'}`),
            el('dl', {}, rows),
          ),
        ]
      : [el('dl', {}, time, rows)];
    this.element.replaceChildren(
      el(
        'div',
        { class: 'who' },
        el('i', { style: `background:${source.colour}` }),
        finding?.by ? `${finding.by}, queried at the poses of ${source.label}` : source.label,
      ),
      ...numbers,
    );
  }
}
