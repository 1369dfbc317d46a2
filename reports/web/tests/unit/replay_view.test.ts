// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Color, Matrix4, PerspectiveCamera, Raycaster, Vector2, Vector3 } from 'three';
import { Observable } from '../../src/common/cursor.ts';
import { BodyLayer } from '../../src/replay/body_layer.ts';
import { distinguishable, lightTheme } from '../../src/replay/colours.ts';
import type { Contacts, Frame, FrameSource, ReplayEvent } from '../../src/replay/frames.ts';
import { frameScene, sampled } from '../../src/replay/framing.ts';
import { roundNumber } from '../../src/replay/ground.ts';
import { fade, gridLines } from '../../src/replay/ground_lines.ts';
import { findIslands, UnionFind } from '../../src/replay/islands.ts';
import {
  contactEvent,
  describe,
  firstDivergence,
  largestError,
  neighbourTime,
  worstNormal,
} from '../../src/replay/jumps.ts';
import { defaultOptions } from '../../src/replay/layers.ts';
import { decodeLink, encodeLink, viewOfHash, withView } from '../../src/replay/link.ts';
import { crossesBox, occludingBodies } from '../../src/replay/occluder_fade.ts';
import { Overlays } from '../../src/replay/overlays.ts';
import { gapsOf, nearestContact, rectAt, tile, toDevice, toPixels } from '../../src/replay/picking.ts';
import { chosenNext, contactOf } from '../../src/replay/pinned.ts';
import { Player } from '../../src/replay/player.ts';
import { readScene, type Scene } from '../../src/replay/scene.ts';
import { TemplateCache } from '../../src/replay/shape_meshes.ts';

test('islands are joined by contacts and joints, never through what stands still', () => {
  const moves = [false, true, true, true, true, true];
  const contacts = { count: 3, bodyA: [0, 0, 1], bodyB: [1, 3, 2] };
  const out = new Int32Array(6);
  const sets = new UnionFind(6);
  findIslands(
    moves,
    contacts,
    [
      { a: 4, b: 5 },
      { a: -1, b: 3 },
    ],
    sets,
    out,
  );
  assert.deepEqual([...out], [-1, 1, 1, 3, 4, 4]);
  findIslands(moves, null, [], sets, out);
  assert.deepEqual([...out], [-1, 1, 2, 3, 4, 5], 'nothing is left of the frame before');
});

test('union-find keeps the smallest as the root, whatever the order', () => {
  const sets = new UnionFind(1000);
  for (let i = 999; i > 0; --i) sets.join(i, i - 1);
  for (let i = 0; i < 1000; ++i) assert.equal(sets.find(i), 0);
});

test('pictures fill the canvas', () => {
  for (const n of [1, 2, 3, 4, 5, 8]) {
    const rects = tile(n, 1000, 600, 1.25, 2);
    assert.equal(rects.length, n);
    for (const r of rects) {
      assert.ok(r.x >= 0 && r.y >= 0 && r.x + r.width <= 1000.001 && r.y + r.height <= 600.001);
      assert.equal(rectAt(rects, r.x + r.width / 2, r.y + r.height / 2), rects.indexOf(r));
    }
  }
  assert.equal(
    tile(4, 1000, 600, 0.3).every((r) => r.y === 0),
    true,
    'towers stand in a row',
  );
  assert.equal(
    tile(4, 1000, 600, 4).every((r) => r.x === 0),
    true,
    'what is flat lies above each other',
  );
  assert.equal(rectAt(tile(1, 100, 100), 500, 5), -1);
});

test('pixels to device coordinates and back through a camera', () => {
  const rect = { x: 100, y: 50, width: 400, height: 200 };
  assert.deepEqual(toDevice(rect, 100, 50), [-1, 1]);
  assert.deepEqual(toDevice(rect, 300, 150), [0, 0]);
  const camera = new PerspectiveCamera(40, 2, 0.1, 100);
  camera.position.set(3, 4, 9);
  camera.lookAt(0, 1, 0);
  camera.updateMatrixWorld();
  const m = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
  const at = toPixels(rect, m, 0.7, 1.1, -0.4);
  assert.ok(at);
  const caster = new Raycaster();
  caster.setFromCamera(new Vector2(...toDevice(rect, at[0], at[1])), camera);
  assert.ok(caster.ray.distanceToPoint(new Vector3(0.7, 1.1, -0.4)) < 1e-9);
  assert.equal(toPixels(rect, m, 6, 8, 30), null, 'behind the camera');
});

test('the nearest contact within reach', () => {
  const rect = { x: 0, y: 0, width: 200, height: 200 };
  const identity = new Matrix4().elements;
  const pointA = [0, 0, 0, 0.5, 0, 0];
  const contacts = { count: 2, pointA, pointB: pointA } as unknown as Contacts;
  assert.equal(nearestContact(contacts, rect, identity, 103, 100, 9), 0);
  assert.equal(nearestContact(contacts, rect, identity, 148, 104, 9), 1);
  assert.equal(nearestContact(contacts, rect, identity, 20, 20, 9), -1);
});

const twoBodies = readScene({
  dimension: 3,
  gravity: [0, -10, 0],
  duration: 1,
  bodies: [
    { name: 'ball', shapes: [{ sphere: { radius: 0.5 } }] },
    { name: 'box', shapes: [{ box: { half_extents: [1, 1, 1] }, position: [0, 0, 1] }] },
  ],
});
const frameAt = (position: number[]): Frame => ({
  time: 0,
  step: 0,
  position,
  orientation: [1, 0, 0, 0, 1, 0, 0, 0],
  velocity: null,
  angularVelocity: null,
  contacts: null,
});

test('a ray hits the instance that stands there, after it has moved', () => {
  const layer = new BodyLayer(twoBodies, new TemplateCache());
  const caster = new Raycaster(new Vector3(0, 0, 50), new Vector3(0, 0, -1));
  const hitAt = (x: number) => {
    caster.ray.origin.setX(x);
    const hit = caster.intersectObjects(layer.targets, false)[0];
    return hit ? { body: layer.shapeOf(hit.object, hit.instanceId ?? -1)?.body, z: hit.point.z } : null;
  };
  layer.place(frameAt([0, 0, 0, 10, 0, 0]));
  assert.equal(hitAt(0)?.body, 0);
  assert.deepEqual(hitAt(10.5), { body: 1, z: 2 }, 'the shape lies off the body');
  assert.equal(hitAt(5), null);
  layer.place(frameAt([5, 0, 0, Number.NaN, 0, 0]));
  assert.equal(hitAt(5)?.body, 0);
  assert.equal(hitAt(10.5), null, 'what is not finite is nowhere');
});

test('shapes of all kinds are two meshes, what is seen through two more, and chains are lines', () => {
  const shapes = [
    { sphere: { radius: 1 } },
    { box: { half_extents: [1, 1, 1] } },
    { capsule: { radius: 1, half_length: 1 } },
    { cylinder: { radius: 1, half_length: 1 } },
  ];
  const bodies = Array.from({ length: 12 }, (_, i) => ({ name: `b${i}`, shapes: [shapes[i % 4]] }));
  const many = readScene({ dimension: 3, gravity: [0, -10, 0], duration: 1, bodies });
  const meshes = (scene: Scene, glass = (_: number) => false) =>
    new BodyLayer(scene, new TemplateCache(), undefined, glass).group.children.length;
  assert.equal(meshes(many), 2);
  assert.equal(
    meshes(many, (b) => b < 4),
    4,
  );
  const chain = {
    chain: {
      vertices: [
        [0, 0],
        [1, 0],
        [2, 0],
      ],
    },
  };
  const flat = [
    { name: 'line', type: 'static', shapes: [chain] },
    { name: 'disc', shapes: [{ sphere: { radius: 1 } }] },
  ];
  assert.equal(meshes(readScene({ dimension: 2, gravity: [0, -10], duration: 1, bodies: flat })), 3);

  // Each copy has the place and the colour of its own body.
  const layer = new BodyLayer(many, new TemplateCache());
  layer.place({
    ...frameAt(Array.from({ length: 36 }, (_, k) => k)),
    orientation: Array.from({ length: 48 }, (_, k) => (k % 4 === 0 ? 1 : 0)),
  });
  assert.equal(layer.drawn.length, 12);
  for (const { body, matrix } of layer.drawn)
    assert.deepEqual(matrix.slice(12, 15), [3 * body, 3 * body + 1, 3 * body + 2]);
});

test('bodies that are seen by their faces can do without edges', () => {
  const layer = new BodyLayer(twoBodies, new TemplateCache());
  const look = { faces: true, outlines: true, ghost: false, behind: false, ink: '#000000', dark: false };
  const edges = () => layer.group.children.filter(({ type }) => type === 'LineSegments').map(({ visible }) => visible);
  layer.look(look, new Color());
  assert.deepEqual(edges(), [true]);
  layer.edged = false;
  assert.deepEqual(edges(), [false]);
  layer.look(look, new Color());
  assert.deepEqual(edges(), [false], 'a frame later as well');
  for (const outlined of [
    { ...look, ghost: true },
    { ...look, faces: false },
  ]) {
    layer.look(outlined, new Color());
    assert.deepEqual(edges(), [true], 'nothing else shows where they are');
  }
  layer.look(look, new Color());
  layer.edged = true;
  assert.deepEqual(edges(), [true]);
});

const source = (spec: string, times: number[], events: ReplayEvent[] = [], positions?: number[][]): FrameSource => ({
  label: spec,
  spec,
  colour: 'red',
  ghost: false,
  note: '',
  events,
  times,
  frame: (i) => frameAt(positions?.[i] ?? [0, 0, 0, 0, 0, 0]),
});

test('the camera frames what moves, not what has flown away', () => {
  const positions = Array.from({ length: 20 }, (_, i) => [i / 20, 0, 0, i === 19 ? 1e7 : 3, 0, 0]);
  const { center, radius } = frameScene(twoBodies, [
    source(
      'a',
      positions.map((_, i) => i),
      [],
      positions,
    ),
  ]);
  assert.ok(radius < 10 && radius > 1, String(radius));
  assert.ok(Math.abs(center[0] - 1.9) < 2, String(center));
  const nothing = frameScene(twoBodies, []);
  assert.ok(Number.isFinite(nothing.radius));
  assert.deepEqual(sampled(5), [0, 1, 2, 3, 4]);
  assert.equal(sampled(1000).length, 48);
  assert.equal(sampled(1000).at(-1), 999);
});

test('jumps', () => {
  const a = source(
    'a:preset=matched',
    [0, 1, 2, 3],
    [
      { time: 1, kind: 'contact_begin', subject: 'ball|box' },
      { time: 2, kind: 'largest', what: 'energy', value: 9 },
      { time: 2.5, kind: 'largest', what: 'position_max', value: 1, unit: 'm' },
      { time: 3, kind: 'largest', what: 'position_max', subject: 'ball', value: 7 },
      { time: 3, kind: 'audit', what: 'b', value: 2 },
      { time: 1, kind: 'audit', what: 'a', value: 0.5, subject: 'ball|box' },
      { time: 1, kind: 'audit', what: 'oracle', value: 3 },
    ],
  );
  const b = source(
    'b',
    [0, 0.5],
    [
      { time: 0.5, kind: 'divergence', subject: 'ball', value: 0.02, unit: 'm', threshold: 0.01 },
      { time: 0.25, kind: 'engine_divergence', what: 'a' },
      { time: 0.1, kind: 'contact_end', subject: 'ball|box' },
    ],
  );
  assert.equal(firstDivergence([a, b])?.event.time, 0.5, 'the reference comes before other engines');
  assert.equal(firstDivergence([a]), null);
  assert.equal(largestError([a, b], ['position_max', 'energy'])?.event.time, 2.5, 'the whole scene before a body');
  assert.equal(largestError([a], ['nothing'])?.event.what, 'energy');
  assert.equal(contactEvent([a, b], 0.1, true)?.event.time, 1);
  assert.equal(contactEvent([a, b], 0.5, false)?.event.time, 0.1);
  assert.equal(contactEvent([a, b], 1, true), null);
  assert.equal(worstNormal([a, b])?.event.what, 'a', 'results of the engine itself come first');
  assert.equal(describe(b.events[0] as ReplayEvent), 'leaves the reference, ball: 0.02 m (more than 0.01 m)');
  const inRun: ReplayEvent = { time: 1, kind: 'audit', what: 'in_run', subject: 'ball|box', value: 0.5, unit: 'rad' };
  assert.equal(describe(inRun), 'worst contact geometry of its own run, ball and box: 28.65°');
  const normal = { ...inRun, text: 'normal' };
  assert.equal(describe(normal), 'worst normal of its own run, ball and box: 28.65°');
  assert.equal(describe({ ...normal, what: 'fcl' }), 'worst normal by fcl, ball and box: 28.65°');
  assert.equal(neighbourTime([a, b], 0, true), 0.5);
  assert.equal(neighbourTime([a, b], 1, false), 0.5);
  assert.equal(neighbourTime([a], 3, true), null);
});

test('a link restores the view', () => {
  const options = defaultOptions();
  options.layers.trails = true;
  options.layers.faces = false;
  options.overlaid = true;
  options.colouring = 'island';
  options.exaggeration = 64;
  const state = {
    time: 0.123456789,
    shown: ['ode:preset=matched,stepper=quickstep', 'rigor'],
    options,
    camera: { position: [1.5, -2, 3e-4], target: [0, 0, 1], zoom: 2 } as const,
    speed: 0.25,
    body: 3,
  };
  const mutable = {
    ...state,
    camera: {
      ...state.camera,
      position: [1.5, -2, 3e-4] as [number, number, number],
      target: [0, 0, 1] as [number, number, number],
    },
  };
  assert.deepEqual(decodeLink(encodeLink(mutable)), mutable);
  assert.deepEqual(decodeLink(encodeLink({ time: 100.016666666666, step: 6001 })).step, 6001);
  assert.equal(decodeLink('n=1.5').step, undefined);
  const pinned = { body: 2, of: 'ode:preset=matched', contact: 0 };
  assert.deepEqual(decodeLink(encodeLink(pinned)), pinned);
  assert.equal(decodeLink('c=-1').contact, undefined);
  assert.deepEqual(decodeLink('t=abc&cam=1_2&on=&by=unknown&x=-4&s=nan').options?.exaggeration, 1);
  assert.equal(decodeLink('t=abc').time, undefined);
  assert.equal(decodeLink('cam=1_2').camera, undefined);
  const hash = withView('#/scenario/pile?dt=0.01&t=7&contact=3', 't=1&on=faces');
  assert.equal(viewOfHash(hash), 't=1&on=faces');
  assert.ok(hash.startsWith('#/scenario/pile?dt=0.01&view='));
  assert.equal(viewOfHash('#/scenario/pile'), '');
});

test('the lines of a live run are drawn in place of those reckoned here', () => {
  const overlays = new Overlays(twoBodies);
  const bodies = new BodyLayer(twoBodies, new TemplateCache());
  const shown: FrameSource = source('a', [0], [], [[0, 0, 0, 10, 0, 0]]);
  const scales = { size: 10, body: 1, speed: 3, spin: 1, impulse: 2 };
  const options = defaultOptions();
  Object.assign(options.layers, { velocities: true, impulses: true, islands: true });
  const plain: Frame = { ...frameAt([0, 0, 0, 10, 0, 0]), velocity: [0, 0, 0, 1, 0, 0] };
  const draw = (frame: Frame) => {
    bodies.place(frame);
    overlays.draw(shown, frame, bodies, options, lightTheme, scales, new Float32Array(6));
  };
  draw(plain);
  assert.equal(overlays.arrows.length, 1, 'a velocity, reckoned');
  const kinds = ['outline', 'box', 'contact', 'normal', 'impulse', 'velocity', 'joint', 'island'];
  const kind = (name: string) => kinds.indexOf(name);
  const drawn: Frame = {
    ...plain,
    lines: {
      kinds,
      ends: [
        [0, 0, 0, 0, 1, 0],
        [1, 0, 0, 1, 2, 0],
        [2, 0, 0, 5, 0, 0],
        [3, 0, 0, 3, 3, 3],
        [4, 0, 0, 4, 4, 4],
        [5, 0, 0, 5, 5, 5],
      ].flat(),
      lineNames: ['normal', 'impulse', 'velocity', 'joint', 'island', 'box'].flatMap((name) => [kind(name), 0]),
      points: [7, 8, 9],
      pointNames: [kind('contact'), 1],
    },
  };
  draw(drawn);
  const lengths = overlays.arrows.map(({ from, to }) => Math.hypot(...to.map((v, k) => v - (from[k] as number))));
  // 0.9 of a body; 0.35 of the picture for 2 N s; 0.3 of it for 3 m/s
  const expected = [0.9, 3.5, 3];
  assert.equal(lengths.length, expected.length);
  for (const [i, length] of lengths.entries())
    assert.ok(Math.abs(length - (expected[i] as number)) < 1e-6, `${lengths}`);
  assert.deepEqual(overlays.lines, [3, 0, 0, 3, 3, 3, 4, 0, 0, 4, 4, 4], 'boxes are off');
  assert.deepEqual(overlays.dots, [7, 8, 9]);
  Object.assign(options.layers, { velocities: false, contacts: false, joints: false, bounds: true });
  draw(drawn);
  assert.equal(overlays.arrows.length, 2);
  assert.deepEqual(overlays.lines, [4, 0, 0, 4, 4, 4, 5, 0, 0, 5, 5, 5]);
  assert.deepEqual(overlays.dots, []);
});

test('speeds go up and down in steps', () => {
  const player = new Player(new Observable(0), () => {});
  player.shift(1);
  assert.equal(player.speed, 2);
  player.shift(-2);
  assert.equal(player.speed, 0.5);
  for (let i = 0; i < 20; ++i) player.shift(-1);
  assert.equal(player.speed, 0.01);
});

test('round numbers for grids', () => {
  assert.deepEqual([0.3, 0.7, 1.4, 2.4, 30].map(roundNumber), [0.2, 0.5, 1, 2, 20]);
});

test('a wall before the scene is seen through, the floor and the wall behind are not', () => {
  const box = (name: string, position: number[], half_extents: number[]) => ({
    name,
    type: 'static',
    position,
    shapes: [{ box: { half_extents } }],
  });
  const scene = readScene({
    dimension: 3,
    gravity: [0, -10, 0],
    duration: 1,
    bodies: [
      box('front', [0, 1, 3], [3, 1, 0.1]),
      box('back', [0, 1, -3], [3, 1, 0.1]),
      box('floor', [0, -0.5, 0], [9, 0.5, 9]),
      { name: 'ball', position: [0, 0.5, 0], shapes: [{ sphere: { radius: 0.5 } }] },
    ],
  });
  const framing = { center: [0, 0.5, 0], radius: 1, low: [-1, 0, -1], high: [1, 1, 1] } as Parameters<
    typeof occludingBodies
  >[1];
  assert.deepEqual([...occludingBodies(scene, framing, [0, 1, 20])], [0]);
  assert.deepEqual([...occludingBodies(scene, framing, [0, 20, 0])], []);
  assert.equal(crossesBox([0, 0, 5], [0, 0, -5], [1, 1, 1]), true);
  assert.equal(crossesBox([0, 2, 5], [0, 2, -5], [1, 1, 1]), false);
  assert.equal(crossesBox([0, 0, 5], [0, 0, 2], [1, 1, 1]), false, 'it ends before');
});

test('presets of one engine are distinguished by lightness', () => {
  const [a, b, c, d] = distinguishable(['#0072b2', '#0072b2', '#d55e00', '#0072b2']);
  assert.equal(a, '#0072b2');
  assert.equal(c, '#d55e00');
  assert.match(b ?? '', /^#[0-9a-f]{6}$/);
  assert.equal(new Set([a, b, d]).size, 3);
});

test('pictures and the gaps between them fill the canvas once', () => {
  const [width, height] = [1000, 600];
  for (const n of [1, 2, 3, 4, 5, 7]) {
    const rects = tile(n, width, height, 1.25, 2);
    const all = [...rects, ...gapsOf(rects, width)];
    const area = all.reduce((sum, r) => sum + r.width * r.height, 0);
    assert.ok(Math.abs(area - width * height) < 1e-6 * area, `${n}: ${area}`);
    for (const [x, y] of [1, 2, 3, 4, 5, 6, 7].map((k) => [(k * 137.3) % width, (k * 83.7) % height] as const))
      assert.equal(all.filter((r) => x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height).length, 1);
  }
});

test('lines of the ground stand at whole cells of the world, and end where they are not seen', () => {
  const [cell, near, reach, shift] = [0.5, 4, 9, [0.2, -0.7]] as const;
  const { position, strength } = gridLines(cell, near, reach, shift);
  assert.equal(position.length, 3 * strength.length);
  let strong = 0;
  for (let i = 0; i < strength.length; i += 2) {
    const [x0, y0, , x1, y1] = position.slice(3 * i, 3 * i + 6) as [number, number, number, number, number];
    const away = x0 === x1 ? x0 + shift[0] : y0 + shift[1];
    assert.ok(x0 === x1 || y0 === y1);
    assert.ok(Math.abs(away / cell - Math.round(away / cell)) < 1e-9, String(away));
    assert.ok(Math.hypot(x0, y0) <= reach + 1e-9 && Math.hypot(x1, y1) <= reach + 1e-9);
    if (Math.round(away / cell) % 5 === 0) ++strong;
  }
  assert.ok(strong > 0 && strong < strength.length / 2);
  assert.deepEqual([fade(0), fade(1), fade(2)], [1, 0, 0]);
  assert.ok(strength.every((s) => s >= 0 && s <= 0.9));
});

test('keys go through the bodies that move and through the contacts of a frame, in both directions', () => {
  const bodies = [{ name: 'ground', type: 'static' }, { name: 'a' }, { name: 'wall', type: 'static' }, { name: 'b' }];
  const scene = readScene({ dimension: 3, gravity: [0, -9.81, 0], bodies });
  const contacts = { count: 2, bodyA: [0, 1], bodyB: [3, 2], depth: [0, 0] } as unknown as Contacts;
  const frame = { time: 0, step: 4, contacts } as unknown as Frame;
  const walk = (what: 'body' | 'contact', forward: boolean, times: number) => {
    let now = null;
    for (let i = 0; i < times; ++i) now = chosenNext(what, forward, now, 'e', frame, scene);
    return now;
  };
  assert.deepEqual(
    [1, 2, 3].map((n) => walk('body', true, n)?.body),
    [1, 3, 1],
  );
  assert.deepEqual(
    [1, 2, 3].map((n) => walk('body', false, n)?.body),
    [3, 1, 3],
  );
  assert.deepEqual(walk('contact', true, 1), { spec: 'e', body: 3, other: 0, contact: { index: 0, step: 4 } });
  assert.deepEqual(walk('contact', true, 2), { spec: 'e', body: 1, other: 2, contact: { index: 1, step: 4 } });
  assert.equal(walk('contact', true, 3)?.contact?.index, 0);
  assert.equal(walk('contact', false, 1)?.contact?.index, 1);
  const late = { ...frame, step: 5 };
  assert.equal(chosenNext('contact', true, walk('contact', true, 2), 'e', late, scene)?.contact?.index, 0);
  const chosen = walk('contact', true, 2);
  assert.equal(chosen && contactOf(chosen, frame), 1);
  assert.equal(chosenNext('contact', true, null, 'e', { ...frame, contacts: null }, scene), null);
});
