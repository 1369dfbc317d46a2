// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The frame that a link of the contact audit opens is the frame that was measured: of every audited contact that the
// page links to, the normal that is drawn and the number agree. Exact values are computed here, from the poses of a run
// of its own: bodies on a plank that turns by 0.05 rad a step roll over its edge, so that another frame has another
// normal.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, describe, test } from 'node:test';
import { makeRunOf, program, query, reportOf, skip } from '../browser.ts';

type Vec = [number, number, number];
type Shape = { at: Vec; radius: number } | { at: Vec; half: Vec };
interface Pose {
  p: Vec;
  q: [number, number, number, number];
}

const agree = 1e-6; // [rad]
const spin = 3; // [rad/s]
const plank: Vec = [3, 0.2, 3]; // half extents [m]
const radius = 0.3;

const ball = { at: [0, 0, 0] as Vec, radius };
const shapesOf: Record<string, Shape[]> = {
  ball: [ball],
  bell: [
    { at: [-0.35, 0, 0], radius },
    { at: [0.35, 0, 0], radius },
  ],
  box: [{ at: [0, 0, 0], half: [radius, radius, 0] }],
};

function scene(name: string, dimension: 2 | 3, bodies: [string, Vec][]): string {
  const vector = (v: Vec) => v.slice(0, dimension);
  const shape = (s: Shape) => ({
    ...('half' in s
      ? { box: { half_extents: vector(s.half) } }
      : { [dimension === 2 ? 'circle' : 'sphere']: { radius: s.radius } }),
    ...(Math.hypot(...s.at) > 0 ? { position: vector(s.at) } : {}),
    material: 'wood',
  });
  return JSON.stringify({
    rigor: 1,
    name,
    title: 'Bodies on a plank that turns',
    source: 'none',
    description: 'A plank is turned at 3 rad/s under bodies that rest on it.',
    isolates: ['contact normals'],
    dimension,
    gravity: vector([0, -9.81, 0]),
    duration: 0.5,
    dt: [1 / 60],
    materials: { wood: { friction: 0.6, restitution: 0 } },
    bodies: [
      {
        name: 'plank',
        type: 'kinematic',
        angular_velocity: dimension === 2 ? spin : [0, 0, spin],
        shapes: [{ box: { half_extents: vector(plank) }, material: 'wood' }],
      },
      ...bodies.map(([body, at]) => ({
        name: body,
        mass: 1,
        position: vector(at),
        shapes: (shapesOf[body] as Shape[]).map(shape),
      })),
    ],
    observe: bodies.map(([body]) => body),
  });
}

const add = (a: Vec, b: Vec, k = 1): Vec => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const dot = (a: Vec, b: Vec) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vec, b: Vec): Vec => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const angleOf = (a: Vec, b: Vec) => Math.atan2(Math.hypot(...cross(a, b)), dot(a, b));
const unit = (v: Vec): Vec => v.map((x) => x / Math.hypot(...v)) as Vec;

function turned([w, ...u]: Pose['q'], v: Vec): Vec {
  const t = cross(u as Vec, v).map((x) => 2 * x) as Vec;
  return add(add(v, t, w), cross(u as Vec, t));
}
const inFrame = ({ p, q: [w, x, y, z] }: Pose, v: Vec): Vec => turned([w, -x, -y, -z], add(v, p, -1));

/** Normal from the plank to a sphere whose centre is outside of it: away from the nearest point of the plank. */
function fromPlank(of: Pose, center: Vec): Vec {
  const local = inFrame(of, center);
  const nearest = local.map((x, k) => Math.min(plank[k] as number, Math.max(-(plank[k] as number), x))) as Vec;
  return turned(of.q, unit(add(local, nearest, -1)));
}

/** Normals of the sides along which two overlapping 2D boxes overlap least. */
function leastOverlap(of: Pose, pose: Pose, half: Vec): Vec[] {
  const corners = (h: Vec, place: (v: Vec) => Vec) =>
    [0, 1, 2, 3].map((i) => place([i & 1 ? h[0] : -h[0], i & 2 ? h[1] : -h[1], 0]));
  const own = corners([plank[0], plank[1], 0], (v) => add(of.p, turned(of.q, v)));
  const others = corners(half, (v) => add(pose.p, turned(pose.q, v)));
  const sides: Vec[] = [
    [1, 0, 0],
    [-1, 0, 0],
    [0, 1, 0],
    [0, -1, 0],
  ];
  const axes = [...sides.map((v) => turned(of.q, v)), ...sides.map((v) => turned(pose.q, v))];
  const gaps = axes.map((n) => Math.min(...others.map((v) => dot(n, v))) - Math.max(...own.map((v) => dot(n, v))));
  return axes.filter((_, i) => (gaps[i] as number) > Math.max(...gaps) - 1e-12);
}

/** States of a run of its own: by step and body. */
function statesOf(file: string, spec: string, csv: string): Map<string, Pose> {
  program('bin/rigor', 'run', file, '--engine', spec, '--csv', csv);
  const lines = readFileSync(csv, 'utf8').trim().split('\n').slice(1);
  return new Map(
    lines.map((line) => {
      const [t, body, ...n] = line.split(',');
      const [x, y, z, ...q] = n.slice(0, 7).map(Number);
      return [`${Math.round(Number(t) * 60)} ${body}`, { p: [x, y, z] as Vec, q: q as Pose['q'] }];
    }),
  );
}

/** Values of a contact in the inspector and the picture. */
interface Seen {
  step: number;
  body: string;
  shape: number;
  normal: Vec;
  pointA: Vec;
  depth: number;
  drawn: { bodies: { body: number; shape: number; matrix: number[] }[]; arrows: { from: Vec; to: Vec }[] };
}

describe('links of the contact audit', { skip }, () => {
  const folder = join(process.env.RIGOR_BINARY_DIR ?? '', 'web_runs', 'linked_frame_scenes');
  const names = ['linked_frame', 'linked_frame_2d'];
  const fileOf = (name: string) => join(folder, `${name}.json`);
  const it = reportOf(() => {
    rmSync(folder, { recursive: true, force: true });
    mkdirSync(folder, { recursive: true });
    const inSpace: [string, Vec][] = [
      ['ball', [2, 0.499, 0]],
      ['bell', [1.8, 0.499, 1.5]],
    ];
    const inPlane: [string, Vec][] = [
      ['bell', [2, 0.499, 0]],
      ['box', [0.9, 0.499, 0]],
    ];
    writeFileSync(fileOf('linked_frame'), scene('linked_frame', 3, inSpace));
    writeFileSync(fileOf('linked_frame_2d'), scene('linked_frame_2d', 2, inPlane));
    return makeRunOf('linked_frame', ...names.map(fileOf));
  });
  before(async () => {
    await it.page.setViewportSize({ width: 800, height: 600 });
  });

  /** Inspected values once the frame of a step is drawn. */
  async function seen(spec: string, step: number): Promise<Seen> {
    await it.page.waitForSelector('.replay canvas');
    await it.page.waitForFunction(
      (text) => document.querySelector('.replay .inspector dd[data-quantity="time"]')?.textContent?.endsWith(text),
      `step ${step}`,
    );
    const cells = await it.page
      .locator('.replay .inspector dd')
      .evaluateAll((list) =>
        Object.fromEntries(list.map((dd) => [(dd as HTMLElement).dataset.quantity, dd.textContent ?? ''])),
      );
    const numbers = (key: string) => (cells[key] ?? '').replaceAll('−', '-').split(',').map(Number.parseFloat);
    const [, body, shape] = /^(\w+)(?: \(shape (\d+)\))?/.exec(cells.b ?? '') ?? [];
    const drawn = await it.page.evaluate((of) => {
      const root = document.querySelector('.replay') as unknown as {
        stage: { view: { drawn: (of: string) => Seen['drawn'] } };
      };
      return root.stage.view.drawn(of);
    }, spec);
    return {
      step,
      body: body ?? '',
      shape: Number(shape ?? 0),
      normal: numbers('normal') as Vec,
      pointA: numbers('pointA') as Vec,
      depth: numbers('depth')[0] as number,
      drawn,
    };
  }

  /** Angle between what is inspected and the nearest exact normal [rad]. */
  function wrongBy(saw: Seen, states: Map<string, Pose>): number {
    const shape = (shapesOf[saw.body] as Shape[])[saw.shape] as Shape;
    const [of, pose] = ['plank', saw.body].map((body) => states.get(`${saw.step} ${body}`)) as [Pose, Pose];
    const exact =
      'half' in shape ? leastOverlap(of, pose, shape.half) : [fromPlank(of, add(pose.p, turned(pose.q, shape.at)))];
    return Math.min(...exact.map((n) => angleOf(n, saw.normal)));
  }

  /** The arrow of the contact begins between the surfaces of the bodies that are drawn, and points along its normal. */
  function assertDrawnThere(saw: Seen, place: number, slack: number): void {
    const at = add(saw.pointA, saw.normal, -saw.depth / 2);
    const arrow = saw.drawn.arrows.find(({ from }) => Math.hypot(...add(from, at, -1)) < slack);
    assert.ok(arrow, `an arrow begins at ${at}: ${JSON.stringify(saw.drawn.arrows)}`);
    assert.ok(angleOf(add(arrow.to, arrow.from, -1), saw.normal) < 1e-5, 'along the normal');
    const local = (body: number, shape: number, v: Vec): Vec => {
      const m = saw.drawn.bodies.find((b) => b.body === body && b.shape === shape)?.matrix as number[];
      const column = (k: number) => m.slice(4 * k, 4 * k + 3) as Vec;
      const away = add(v, m.slice(12, 15) as Vec, -1);
      return [0, 1, 2].map((k) => dot(unit(column(k)), away)) as Vec;
    };
    const outside = (v: Vec, half: Vec) => {
      const q = v.map((x, k) => Math.abs(x) - (half[k] as number)) as Vec;
      return Math.hypot(...q.map((x) => Math.max(0, x))) + Math.min(0, Math.max(...q));
    };
    const shape = (shapesOf[saw.body] as Shape[])[saw.shape] as Shape;
    const there = local(place, saw.shape, arrow.from);
    const gap =
      'half' in shape ? outside(there, [shape.half[0], shape.half[1], 9]) : Math.hypot(...there) - shape.radius;
    const gaps = [outside(local(0, 0, arrow.from), plank), gap];
    for (const g of gaps)
      assert.ok(
        g < slack && g > -saw.depth / 2 - slack,
        `${gaps} m from the surfaces, depth ${saw.depth}, slack ${slack}`,
      );
  }

  test('the worst normal is three clicks away and is the exact one of that instant', async () => {
    await it.open('#contacts');
    const link = it.page.locator('#in-run > .scroll tbody td a:not([href*="point_normal"])').first();
    const href = (await link.getAttribute('href')) ?? '';
    const requested = new URLSearchParams(href.split('?')[1]);
    const name = names.find((one) => href.includes(`/${one}?`)) ?? '';
    await link.click();
    const [spec, step] = [requested.get('spec') ?? '', Number(requested.get('step'))];
    const saw = await seen(spec, step);
    const states = statesOf(fileOf(name), spec, join(folder, 'clicked.csv'));
    const number = query(
      it.run,
      `SELECT a.normal_error_max FROM audit a JOIN cases c ON c.id = a.case_id WHERE a.auditor = 'in_run'
       AND c.scenario = '${name}' AND c.spec = '${spec}'`,
    ).flat()[0] as number;
    assert.ok(
      Math.abs(wrongBy(saw, states) - number) < agree,
      `${wrongBy(saw, states)} is drawn, ${number} is reported`,
    );
    it.clean();
  });

  for (const name of names)
    test(`every audited contact that the page links to is the one that was measured: ${name}`, async () => {
      await it.open('#contacts');
      const own = 'a[href*="step="]:not([href*="point_normal"])';
      const hrefs = await it.page
        .locator(`#in-run ${own}`)
        .evaluateAll((list) => list.map((a) => a.getAttribute('href')));
      await it.open(`#/scenario/${name}`);
      hrefs.push(
        ...(await it.page
          .locator(`#case-audit tr.own ${own}:not([data-finding="depth"])`)
          .evaluateAll((list) => list.map((a) => a.getAttribute('href')))),
      );
      const rows = query(
        it.run,
        `SELECT c.spec, a.normal_error_max, a.point_error_max, a.worst FROM audit a JOIN cases c ON c.id = a.case_id
         WHERE a.auditor = 'in_run' AND c.scenario = '${name}' AND a.normal_error_max IS NOT NULL
         AND a.missed = 0 AND a.spurious = 0`, // the links of other findings lead elsewhere
      ) as [string, number, number, string][];
      assert.ok(rows.length >= 7, `${rows.length} engines`);
      const bodies = JSON.parse(readFileSync(fileOf(name), 'utf8')).bodies.map((b: { name: string }) => b.name);
      const wanted = (key: string) => (href: string | null) => new URLSearchParams((href ?? '').split('?')[1]).get(key);
      let largest = 0;
      for (const [spec, number, pointError, worst] of rows) {
        const mine = hrefs.filter((href) => href?.includes(`/${name}?`) && wanted('spec')(href) === spec);
        assert.ok(mine.length >= 2, `overview and page link to ${spec}`);
        const places = new Set(mine.map((href) => `${wanted('step')(href)} ${wanted('contact')(href)}`));
        assert.equal(places.size, 1, `all to the same contact: ${[...places]}`);
        const step = Number(wanted('step')(mine[0] as string));
        await it.follow(mine[0] as string);
        const saw = await seen(spec, step);
        const states = statesOf(fileOf(name), spec, join(folder, `${name}.csv`));
        const angle = wrongBy(saw, states);
        assert.ok(Math.abs(angle - number) < agree, `${spec}, ${worst}: ${angle} is drawn, ${number} is reported`);
        assertDrawnThere(saw, bodies.indexOf(saw.body), 2e-4 + pointError);
        largest = Math.max(largest, angle);
      }
      assert.ok(largest > 1e-3, 'an engine is wrong here, and is shown to be as wrong as measured');
      it.clean();
    });
});
