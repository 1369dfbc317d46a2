// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Requests of the page to `rigor view`: cli/view/README.md has the requests, validation/live/README.md the commands and
// the arrays of a frame.
import { ArrayBundle } from '../common/arrays.ts';
import type { Json } from '../replay/json.ts';

export type InstanceStateName =
  | 'loading'
  | 'ready'
  | 'non_finite'
  | 'unsupported'
  | 'bad_input'
  | 'error'
  | 'crashed'
  | 'timeout';

export interface InstanceState {
  id: number;
  title: string;
  spec: string;
  engine: string;
  options: Record<string, string>;
  state: InstanceStateName;
  message: string;
  step: number;
  start_step: number;
  has_stages: boolean;
  frames: number; // frames that it has made so far
  branch_of?: number;
}

export interface SessionState {
  scenario: string;
  title: string;
  dimension: 2 | 3;
  duration: number;
  dt: number;
  playing: boolean;
  speed: number;
  reached_speed: number;
  step: number;
  stages: boolean;
  instances: InstanceState[];
}

export interface StageState {
  in_step: boolean;
  done: string; // "" none in this step
  next: string;
  substep: number;
}

export interface DragState {
  body: number;
  point: [number, number, number];
  target: [number, number, number];
  force: [number, number, number];
}

export interface FrameHead {
  instance: number;
  step: number;
  time: number;
  counters: Record<string, number>;
  contacts_at_step_end?: boolean; // contacts belong to the poses of the frame; else to those at which its step began
  stage: StageState;
  has_stages: boolean; // the arrays of stages are there
  step_seconds?: number;
  history?: { bytes: number; most: number; every: number }; // snapshots for going back; a snapshot every so many steps
  drag?: DragState;
  broken_joints: number[];
}

export interface News {
  sequence: number;
  session: SessionState;
  frames: FrameHead[];
  line_kinds: string[]; // kinds of drawn lines, by their numbers
  arrays: ArrayBundle;
}

export interface Option {
  key: string;
  values: string[]; // empty: a number
  min: number | null; // null: no limit
  max: number | null;
  integer: boolean;
  presets: Record<string, string>; // value in each preset
  help: string;
}
export interface Engine {
  name: string;
  title: string;
  version: string;
  precisions: string[];
  presets: string[]; // presets; the first is that of a spec that names none
  options: Option[];
}

/** The server said no; the message is for the person. */
export class Refused extends Error {}

async function read(response: Response): Promise<Json> {
  const answer = (await response.json().catch(() => ({}))) as Json;
  if (!response.ok) throw new Refused(String(answer.error ?? `status ${response.status}`));
  return answer;
}

const get = async (path: string): Promise<Json> => read(await fetch(path));

export const engines = (): Promise<Engine[]> => get('/api/engines');
export const scenarios = (): Promise<{ name: string; title: string }[]> => get('/api/scenarios');
export const scene = (instance: number): Promise<{ scenario: Json; description: Json }> =>
  get(`/api/scene?instance=${instance}`);

export async function command(request: { command: string } & Record<string, unknown>): Promise<Json> {
  const headers = { 'Content-Type': 'application/json' };
  return read(await fetch('/api/command', { method: 'POST', headers, body: JSON.stringify(request) }));
}

/** All that is newer than `after`, with lines of these kinds; waits for it. */
export async function news(after: number, lines: readonly string[], signal: AbortSignal): Promise<News> {
  const response = await fetch(`/api/frames?after=${after}&wait=15&lines=${lines.join(',')}`, { signal });
  if (!response.ok) await read(response);
  const arrays = new ArrayBundle(await response.arrayBuffer());
  return { ...(arrays.meta as Omit<News, 'arrays'>), arrays };
}
