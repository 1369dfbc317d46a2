// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Runs in the browser for replay_speed.mjs: many bodies of all kinds that move in every frame, drawn as fast as it goes.
import type { Contacts, Frame, FrameSource } from '../src/replay/frames.ts';
import { readScene } from '../src/replay/scene.ts';
import { ReplayView } from '../src/replay/view.ts';

export interface Measured {
  bodies: number;
  contacts: number;
  pictures: number; // beside each other, each with the reference as a ghost if there are several
  frames: number;
  own: number[]; // seconds of each drawing: placing, colouring, overlays
  all: number[]; // all threads, with three.js and the driver
  calls: number; // draw calls of one drawing
  played: number; // frames that the browser showed in a second
  heap: number; // bytes more after all drawings; negative: garbage was collected
}

const shapes = [
  { sphere: { radius: 0.4 } },
  { box: { half_extents: [0.3, 0.4, 0.5] } },
  { capsule: { radius: 0.2, half_length: 0.3 } },
  { cylinder: { radius: 0.3, half_length: 0.3 } },
  {
    hull: {
      vertices: [
        [0.5, 0, 0],
        [-0.5, 0, 0],
        [0, 0.5, 0],
        [0, -0.5, 0],
        [0, 0, 0.5],
        [0, 0, -0.5],
      ],
    },
  },
];

function sceneOf(count: number) {
  const bodies: unknown[] = [
    { name: 'ground', type: 'static', shapes: [{ half_space: { normal: [0, 1, 0], offset: 0 } }] },
  ];
  for (let i = 0; i < count; ++i) bodies.push({ name: `b${i}`, shapes: [shapes[i % shapes.length]] });
  return readScene({ dimension: 3, gravity: [0, -9.81, 0], duration: 10, bodies });
}

/** Frames that are written into the same memory. */
function sourceOf(count: number, frames: number, spec: string, late: number): FrameSource {
  const n = count + 1;
  const side = Math.ceil(Math.cbrt(count));
  const three = () => new Float32Array(3 * count);
  const contacts: Contacts = {
    count,
    bodyA: new Int32Array(count),
    bodyB: Int32Array.from({ length: count }, (_, i) => i + 1),
    shapeA: new Int32Array(count),
    shapeB: new Int32Array(count),
    pointA: three(),
    pointB: three(),
    normal: three().map((_, i) => (i % 3 === 1 ? 1 : 0)),
    depth: new Float32Array(count),
    normalImpulse: new Float32Array(count).fill(1),
    frictionImpulse: three(),
  };
  const position = new Float32Array(3 * n);
  const orientation = new Float32Array(4 * n).map((_, i) => (i % 4 === 0 ? 1 : 0));
  const frame: Frame = { time: 0, step: 0, position, orientation, velocity: null, angularVelocity: null, contacts };
  return {
    label: spec,
    spec,
    colour: '#0072b2',
    ghost: spec === '',
    note: '',
    events: [],
    times: Float64Array.from({ length: frames }, (_, i) => i / 60),
    frame(index) {
      frame.time = index / 60;
      frame.step = index;
      for (let i = 0; i < count; ++i) {
        const [x, y, z] = [i % side, Math.floor(i / side) % side, Math.floor(i / side / side)];
        const a = (index - late) / 20 + i;
        position[3 * (i + 1)] = x + 0.2 * Math.sin(a);
        position[3 * (i + 1) + 1] = y + 0.5;
        position[3 * (i + 1) + 2] = z + 0.2 * Math.cos(a);
        orientation[4 * (i + 1)] = Math.cos(a / 2);
        orientation[4 * (i + 1) + 2] = Math.sin(a / 2);
        for (let k = 0; k < 3; ++k) {
          const p = (position[3 * (i + 1) + k] as number) - (k === 1 ? 0.4 : 0);
          (contacts.pointA as Float32Array)[3 * i + k] = p;
          (contacts.pointB as Float32Array)[3 * i + k] = p;
        }
      }
      return frame;
    },
  };
}

const heap = () => (performance as unknown as { memory?: { usedJSHeapSize: number } }).memory?.usedJSHeapSize ?? 0;

async function measure(bodies: number, frames: number, pictures: number, withContacts: boolean): Promise<Measured> {
  const element = document.createElement('div');
  element.style.cssText = 'width:1200px;height:700px';
  document.body.replaceChildren(element);
  const view = new ReplayView(element, sceneOf(bodies));
  const { layers } = view.options;
  view.setOptions({ layers: { ...layers, contacts: withContacts, normals: withContacts } });
  const engines = Array.from({ length: pictures }, (_, i) => sourceOf(bodies, frames, `engine ${i + 1}`, i));
  view.setSources(pictures > 1 ? [...engines, sourceOf(bodies, frames, '', 0)] : engines);
  const contacts = withContacts ? bodies : 0;
  const out: Measured = { bodies, contacts, pictures, frames, own: [], all: [], calls: 0, played: 0, heap: 0 };
  let start = 0;
  const warm = 10;
  for (let i = 0; i < frames; ++i) {
    if (i === warm) {
      out.heap = heap();
      start = performance.now();
    }
    view.setTime(i / 60);
    view.draw();
    if (i >= warm) {
      out.own.push(view.spent.own);
      out.all.push(view.spent.all);
    }
    await new Promise((resolve) => requestAnimationFrame(resolve));
  }
  out.played = (1e3 * (frames - warm)) / (performance.now() - start);
  out.heap = heap() - out.heap;
  out.calls = view.spent.calls;
  view.dispose();
  return out;
}

(globalThis as unknown as { measure: typeof measure }).measure = measure;
