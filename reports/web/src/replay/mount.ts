// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The replay of one scenario at one time step, as the scenario's page and `rigor view` show it:
//
//   const replay = mountReplay(element, {scenario, index, step, cursor, colourOf});
//   replay.focus({spec: 'bullet:preset=default', bodies: ['block', 'floor'], contact: null});
//
// The cursor is shared with the curves; the address is kept up to date, so that a link restores the view.
import type { Focus } from '../common/cursor.ts';
import { loadData } from '../common/data_files.ts';
import { el } from '../common/elements.ts';
import { distinguishable } from './colours.ts';
import type { ReplayContext } from './context.ts';
import type { FrameSource } from './frames.ts';
import { fetchFrames, fullSource } from './full_frames.ts';
import { type Replay, readReplay } from './replay_file.ts';
import { readScene, type Scene } from './scene.ts';
import { ReplayStage } from './stage.ts';
import { NoWebGL } from './view.ts';
import './style.css';

export interface ReplayHandle {
  /** Settled when everything is there, or a sentence says why not. */
  ready: Promise<void>;
  setTime(seconds: number): void;
  /** Shows one engine, lights two bodies up and moves the camera to them. */
  focus(on: Focus): void;
  dispose(): void;
}

/** The element of a replay gives its stage to tests and the browser's tools. */
interface ReplayElement extends HTMLElement {
  stage?: ReplayStage;
}

/** Bodies in the order of the stored frames; one that the file does not name is a point. */
function inOrder(scene: Scene, names: readonly string[]): Scene {
  const known = new Map(scene.bodies.map((body, i) => [body.name, i]));
  const place = new Map(names.map((name, i) => [name, i]));
  const moved = (old: number) => (old < 0 ? -1 : (place.get(scene.bodies[old]?.name ?? '') ?? -1));
  return {
    ...scene,
    bodies: names.map((name) => {
      const body = scene.bodies[known.get(name) ?? -1];
      if (body) return body;
      const first = {
        position: [0, 0, 0] as [number, number, number],
        orientation: [1, 0, 0, 0] as [number, number, number, number],
      };
      return { name, type: 'dynamic', first, center: [0, 0, 0], shapes: [], collides: false };
    }),
    joints: scene.joints.map((joint) => ({ ...joint, a: moved(joint.a), b: moved(joint.b) })),
  };
}

/** Runs that a replay shows, before they are drawn. */
interface Content {
  replay: Replay;
  thinned: Map<FrameSource, () => Promise<FrameSource>>;
}

async function readOne(context: ReplayContext): Promise<Content> {
  const load = context.load ?? (() => loadData(`replay-${context.index}-${context.step}`));
  const replay = readReplay(await load(), context.colourOf);
  const lastFirst = [...replay.sources].reverse(); // matched settings come last and keep the engine's colour
  const own = distinguishable(lastFirst.map((source) => source.colour));
  lastFirst.forEach((source, i) => {
    source.colour = own[i] as string;
  });
  const served = location.protocol.startsWith('http');
  const get = context.frames ?? (served ? fetchFrames : null);
  const thinned = new Map<FrameSource, () => Promise<FrameSource>>();
  replay.sources.forEach((source, i) => {
    const { id, frames, stored } = replay.head.cases[i] as (typeof replay.head.cases)[number];
    if (get && frames < (stored ?? 0)) thinned.set(source, () => fullSource(source, get(id)));
  });
  return { replay, thinned };
}

/** One engine's run in a replay file, and what it is called among those of other files. */
export interface Part {
  label: string;
  spec: string;
  load: () => Promise<ArrayBuffer>;
}

/** The runs of several files; the reference is that of the last one. */
async function readParts(context: ReplayContext, parts: readonly Part[]): Promise<Content> {
  const replays = await Promise.all(parts.map(async ({ load }) => readReplay(await load(), context.colourOf)));
  const last = replays.at(-1) as Replay;
  const sources = parts.map(({ label, spec }, i) => {
    const { head, sources } = replays[i] as Replay;
    if (head.bodies.join('\n') !== last.head.bodies.join('\n')) throw new Error('the runs have other bodies');
    const source = sources.find((s) => s.spec === spec);
    if (!source) throw new Error(`no frames of ${label} are stored`);
    source.label = label;
    source.spec = `${i + 1}|${spec}`;
    source.colour = context.colourOf(spec, i);
    return source;
  });
  return { replay: { ...last, sources }, thinned: new Map() };
}

export const mountReplay = (element: HTMLElement, context: ReplayContext): ReplayHandle =>
  mount(element, context, () => readOne(context));

/** Runs of several replay files of a scenario side by side, by one clock and one camera. */
export const mountTogether = (element: HTMLElement, context: ReplayContext, parts: readonly Part[]): ReplayHandle =>
  mount(element, context, () => readParts(context, parts));

function mount(element: HTMLElement, context: ReplayContext, read: () => Promise<Content>): ReplayHandle {
  let stage: ReplayStage | null = null;
  let disposed = false;
  const root: ReplayElement = el('div', { class: 'replay' }, el('p', { class: 'replay-note' }, 'Loading the frames …'));
  element.append(root);
  const say = (text: string) => root.replaceChildren(el('p', { class: 'replay-note' }, text));

  const start = async () => {
    let content: Content;
    try {
      content = await read();
    } catch (error) {
      say(`There is no replay: ${error instanceof Error ? error.message : String(error)}.`);
      return;
    }
    if (disposed) return;
    const { replay, thinned } = content;
    const sources: FrameSource[] = [...replay.sources];
    if (replay.reference) sources.push(replay.reference);
    try {
      root.replaceChildren();
      const scene = inOrder(readScene(context.scenario), replay.head.bodies);
      root.stage = stage = new ReplayStage(root, scene, sources, { dt: replay.head.dt, ...context }, thinned);
    } catch (error) {
      if (!(error instanceof NoWebGL)) console.error(error);
      say(
        error instanceof NoWebGL
          ? 'This browser shows no WebGL, which the replay needs. Curves and tables are complete without it.'
          : `The replay cannot be shown: ${error instanceof Error ? error.message : String(error)}.`,
      );
    }
  };
  const ready = start();
  return {
    ready,
    setTime: (seconds) => context.cursor.time.set(seconds),
    focus: (on) => {
      void ready.then(() => stage?.focus(on));
    },
    dispose: () => {
      disposed = true;
      stage?.dispose();
      root.remove();
    },
  };
}
