// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { type Bounds, boundsOf, reachOf } from '../../src/replay/bounds.ts';
import { composeInto, stretchInto } from '../../src/replay/matrices.ts';
import { type Geometry, readScene } from '../../src/replay/scene.ts';
import { hull2d, TemplateCache } from '../../src/replay/shape_meshes.ts';
import { type Quat, rotate, type Vec3 } from '../../src/replay/vectors.ts';

const close = (a: ArrayLike<number>, b: ArrayLike<number>, tolerance = 1e-6) => {
  assert.equal(a.length, b.length);
  for (let i = 0; i < a.length; ++i)
    assert.ok(Math.abs((a[i] as number) - (b[i] as number)) <= tolerance, `${i}: ${a[i]} and ${b[i]}`);
};
const h = Math.SQRT1_2;

test('bodies, shapes and joints of a file', () => {
  const scene = readScene({
    dimension: 3,
    gravity: [0, -9.81, 0],
    duration: 2,
    bodies: [
      { name: 'floor', type: 'static', shapes: [{ half_space: { normal: [0, 2, 0], offset: -1 } }] },
      {
        name: 'rod',
        position: [1, 2, 3],
        axis_angle_deg: { axis: [0, 0, 1], angle_deg: 90 },
        shapes: [{ capsule: { radius: 0.1, half_length: 0.5 }, position: [0, 1, 0] }],
      },
    ],
    joints: [{ name: 'pin', type: 'hinge', a: 'world', b: 'rod', anchor: [1, 4, 3], axis: [0, 0, 1] }],
  });
  const [floor, rod] = scene.bodies;
  assert.ok(floor && rod);
  assert.deepEqual(floor.shapes[0]?.geometry, { kind: 'half_space', normal: [0, 1, 0], offset: -1 });
  close(rod.first.orientation, [h, 0, 0, h]);
  assert.deepEqual(rod.center, [0, 1, 0]);
  const pin = scene.joints[0];
  assert.ok(pin);
  assert.equal(pin.a, -1);
  close(pin.anchorA, [1, 4, 3]);
  close(pin.anchorB, [2, 0, 0], 1e-12);
  close(pin.axis ?? [], [0, 0, 1], 1e-12);
});

test('generators make bodies and joints in the order of the loader', () => {
  const scene = readScene({
    dimension: 2,
    gravity: [0, -9.81],
    duration: 1,
    bodies: [{ name: 'a' }],
    generators: [
      { grid: { name: 'g', counts: [2, 2], spacing: [1, 3], origin: [5, 0], body: {} } },
      { pyramid: { name: 'p', rows: 2, spacing: [2, 1], body: {} } },
      { pile: { name: 'h', count: 3, columns: 2, seed: 1, spacing: [1, 1], bodies: [{ mass: 1 }, { mass: 2 }] } },
      {
        chain: {
          name: 'c',
          links: 2,
          link_length: 0.5,
          direction: [2, 0],
          joint: 'hinge',
          body: {},
          end_body: { type: 'static' },
        },
      },
    ],
  });
  assert.deepEqual(
    scene.bodies.map((b) => b.name),
    ['a', 'g_0_0', 'g_1_0', 'g_0_1', 'g_1_1', 'p_0_0', 'p_0_1', 'p_1_0', 'h_0', 'h_1', 'h_2', 'c_0', 'c_1'],
  );
  assert.deepEqual(scene.bodies[4]?.first.position, [6, 3, 0]);
  assert.deepEqual(scene.bodies[7]?.first.position, [0, 1, 0]);
  assert.equal(scene.bodies[12]?.type, 'static');
  assert.deepEqual(
    scene.joints.map((j) => [j.name, j.a, j.b]),
    [
      ['c_joint_0', -1, 11],
      ['c_joint_1', 11, 12],
    ],
  );
  close(scene.joints[1]?.anchorA ?? [], [0.25, 0, 0]);
  close(scene.joints[1]?.anchorB ?? [], [-0.25, 0, 0]);
});

test('matrices are the pose of the shape in the world', () => {
  const q: Quat = [0.5, 0.5, -0.5, 0.5];
  const local = [0.3, 0, 0, h, h, 0, 0];
  const rigid = new Float32Array(16);
  assert.ok(composeInto(rigid, 0, [9, 9, 9, 1, 2, 3], [1, 0, 0, 0, ...q], 1, local, 0));
  const point: Vec3 = [0.1, -0.2, 0.7];
  const inner = rotate([h, h, 0, 0], point);
  const outer = rotate(q, [inner[0] + 0.3, inner[1], inner[2]]);
  const by = [0, 1, 2].map((k) =>
    [0, 1, 2].reduce((sum, c) => sum + (rigid[4 * c + k] as number) * (point[c] as number), rigid[12 + k] as number),
  );
  close(by, [outer[0] + 1, outer[1] + 2, outer[2] + 3]);
  const stretched = new Float32Array(16);
  stretchInto(stretched, 0, rigid, 0, [2, 3, 4], 0);
  close(
    [stretched[0] as number, stretched[5] as number, stretched[14] as number],
    [2 * (rigid[0] as number), 3 * (rigid[5] as number), rigid[14] as number],
  );
});

test('a pose that is not finite draws nothing', () => {
  const rigid = new Float32Array(16).fill(5);
  assert.equal(composeInto(rigid, 0, [0, Number.NaN, 0], [1, 0, 0, 0], 0, [0, 0, 0, 1, 0, 0, 0], 0), false);
  assert.ok(rigid.every((v) => v === 0));
});

/** Points all over the surface of a shape, as its mesh has them. */
function surfacePoints(geometry: Geometry): Vec3[] {
  const sized = new TemplateCache().of(geometry, 3);
  assert.ok(sized?.template.faces);
  const p = sized.template.faces.getAttribute('position');
  return Array.from({ length: p.count }, (_, i) => [
    p.getX(i) * sized.scale[0],
    p.getY(i) * sized.scale[1],
    p.getZ(i) * sized.scale[2],
  ]);
}

test('boxes hold the shape and touch it', () => {
  const shapes: Geometry[] = [
    { kind: 'sphere', radius: 0.7 },
    { kind: 'box', half: [0.3, 0.5, 0.9] },
    { kind: 'capsule', radius: 0.2, halfLength: 0.6 },
    { kind: 'cylinder', radius: 0.4, halfLength: 0.5 },
    { kind: 'cone', radius: 0.4, halfLength: 0.5 },
    {
      kind: 'hull',
      vertices: [
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ],
    },
  ];
  const q: Quat = [0.8, 0.36, -0.48, 0];
  for (const geometry of shapes) {
    const rigid = new Float32Array(16);
    composeInto(rigid, 0, [1, 2, 3], q, 0, [0, 0, 0, 1, 0, 0, 0], 0);
    const box: Bounds = [0, 0, 0, 0, 0, 0];
    assert.ok(boundsOf(geometry, rigid, 0, box));
    const points = surfacePoints(geometry).map((p) => rotate(q, p).map((v, k) => v + k + 1));
    for (let k = 0; k < 3; ++k) {
      const values = points.map((p) => p[k] as number);
      const size = (box[3 + k] as number) - (box[k] as number);
      // a mesh of chords stays inside of what is round
      assert.ok(Math.min(...values) >= (box[k] as number) - 1e-5, `${geometry.kind} ${k}`);
      assert.ok(Math.min(...values) <= (box[k] as number) + 0.02 * size, `${geometry.kind} ${k}`);
      assert.ok(Math.max(...values) <= (box[3 + k] as number) + 1e-5, `${geometry.kind} ${k}`);
      assert.ok(Math.max(...values) >= (box[3 + k] as number) - 0.02 * size, `${geometry.kind} ${k}`);
    }
    const reach = Math.max(...surfacePoints(geometry).map((p) => Math.hypot(...p)));
    assert.ok(Math.abs(reachOf(geometry) - reach) < 0.02, geometry.kind);
  }
  assert.equal(
    boundsOf({ kind: 'half_space', normal: [0, 1, 0], offset: 0 }, new Float32Array(16), 0, [0, 0, 0, 0, 0, 0]),
    false,
  );
});

test('equal shapes share a template, sizes are instances', () => {
  const cache = new TemplateCache();
  const ball = (radius: number) => cache.of({ kind: 'sphere', radius }, 3);
  assert.equal(ball(1)?.template, ball(2)?.template);
  assert.deepEqual(ball(2)?.scale, [2, 2, 2]);
  const capsule = (radius: number, halfLength: number) =>
    cache.of({ kind: 'capsule', radius, halfLength }, 3)?.template;
  assert.equal(capsule(1, 2), capsule(2, 4));
  assert.notEqual(capsule(1, 2), capsule(1, 3));
  assert.equal(cache.of({ kind: 'half_space', normal: [0, 1, 0], offset: 0 }, 3), null);
});

test('every kind of shape has faces or lines in its dimension', () => {
  const round = { radius: 0.5, halfLength: 1 };
  const both: Geometry[] = [
    { kind: 'sphere', radius: 1 },
    { kind: 'box', half: [1, 2, 3] },
    { kind: 'capsule', ...round },
  ];
  const solid: Geometry[] = [
    { kind: 'cylinder', ...round },
    { kind: 'cone', ...round },
    {
      kind: 'triangle_mesh',
      vertices: [
        [0, 0, 0],
        [1, 0, 0],
        [0, 0, 1],
      ],
      triangles: [[0, 2, 1]],
    },
    {
      kind: 'height_field',
      spacing: [1, 1],
      heights: [
        [0, 1],
        [1, 0],
      ],
    },
  ];
  const flat: Geometry[] = [
    {
      kind: 'hull',
      vertices: [
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
      ],
    },
    {
      kind: 'segment',
      vertices: [
        [0, 0, 0],
        [1, 0, 0],
      ],
      loop: false,
    },
    {
      kind: 'chain',
      vertices: [
        [0, 0, 0],
        [1, 0, 0],
        [1, 1, 0],
      ],
      loop: true,
    },
  ];
  for (const [dimension, list] of [
    [3, [...both, ...solid]],
    [2, [...both, ...flat]],
  ] as const)
    for (const geometry of list) {
      const made = new TemplateCache().of(geometry, dimension);
      assert.ok(made, geometry.kind);
      assert.ok(made.template.edges.getAttribute('position').count >= 2, geometry.kind);
      const lineOnly = geometry.kind === 'segment' || geometry.kind === 'chain';
      assert.equal(made.template.faces === null, lineOnly, geometry.kind);
    }
  const chain = new TemplateCache().of(flat[2] as Geometry, 2);
  assert.equal(chain?.template.edges.getAttribute('position').count, 6, 'a loop of three has three segments');
});

test('circles in 2D stay round, however many there are', () => {
  const cache = new TemplateCache(1000, true);
  const corners = (dimension: 2 | 3) =>
    cache.of({ kind: 'sphere', radius: 1 }, dimension)?.template.edges.getAttribute('position').count ?? 0;
  assert.ok(corners(2) >= 2 * 40);
  assert.ok(corners(3) < 3 * 2 * 24, 'balls have fewer lines there');
});

test('the hull of points in 2D', () => {
  assert.deepEqual(
    hull2d([
      [0, 0, 0],
      [2, 0, 0],
      [1, 0.5, 0],
      [2, 2, 0],
      [0, 2, 0],
      [1, 1, 0],
    ]),
    [
      [0, 0, 0],
      [2, 0, 0],
      [2, 2, 0],
      [0, 2, 0],
    ],
  );
});
