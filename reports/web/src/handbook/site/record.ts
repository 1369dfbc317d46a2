// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Runs of the scenes: `rigor run` writes the motion and the metrics, which become a script that a page loads. A run
// that stands in the folder already is not made again unless the program or its scenario is newer.
import { spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  writeFileSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Json } from '../../replay/json.ts';
import type { Recording } from '../recording.ts';
import type { RunRequest } from './fences.ts';

export interface RunResult {
  id: string;
  metrics: { name: string; subject: string; value: number | null; unit: string }[];
}

const mostFrames = 200;

/** Path of a scenario file, by its name in the library or its path. */
export function scenarioFile(root: string, scenario: string): string {
  if (scenario.endsWith('.json')) {
    const path = join(root, scenario);
    if (!existsSync(path)) throw new Error(`no scenario file ${scenario}`);
    return path;
  }
  for (const folder of readdirSync(join(root, 'scenarios/library'))) {
    const path = join(root, 'scenarios/library', folder, `${scenario}.json`);
    if (existsSync(path)) return path;
  }
  throw new Error(`no scenario ${scenario} in the library`);
}

/** KEY=VALUE as of `--set`: names stand for entries of lists that have them. */
export function overridden(file: Json, set: readonly string[]): Json {
  const copy = structuredClone(file);
  for (const item of set) {
    const at = item.indexOf('=');
    const keys = item.slice(0, at).split('.');
    const last = keys.pop() as string;
    let place: Json = copy;
    for (const key of keys)
      place = Array.isArray(place)
        ? (place.find((entry: Json) => entry.name === key) ?? place[Number(key)])
        : place?.[key];
    const text = item.slice(at + 1);
    let value: Json = text;
    try {
      value = JSON.parse(text);
    } catch {
      // a word
    }
    if (place !== undefined && place !== null) place[last] = value;
  }
  return copy;
}

export const idOf = (run: RunRequest): string =>
  createHash('sha256')
    .update(JSON.stringify([run.scenario, run.engine, run.set, run.dt]))
    .digest('hex')
    .slice(0, 12);

const rounded = (text: string): number | null => {
  const value = Number(text);
  return Number.isFinite(value) ? Number(value.toFixed(5)) : null;
};

/** Poses of the bodies that move, from the table that the program wrote. */
function readMotion(csv: string, scenario: Json): Recording {
  const lines = csv.trimEnd().split('\n');
  const frames = new Map<string, string[][]>();
  for (const line of lines.slice(1)) {
    const cells = line.split(',');
    const rows = frames.get(cells[0] as string);
    if (rows) rows.push(cells);
    else frames.set(cells[0] as string, [cells]);
  }
  const all = [...frames.entries()];
  const stride = Math.max(1, Math.ceil((all.length - 1) / mostFrames));
  const kept = all.filter((_, i) => i % stride === 0 || i === all.length - 1);
  const first = all[0]?.[1] ?? [];
  const bodies = first.map((cells) => cells[1] as string);
  const poseOf = (cells: string[] | undefined) => (cells ?? []).slice(2, 9).map(rounded);
  const moves = bodies.map((_, b) => {
    const start = JSON.stringify(poseOf(first[b]));
    return kept.some(([, rows]) => JSON.stringify(poseOf(rows[b])) !== start);
  });
  return {
    scenario,
    bodies,
    still: bodies.map((_, b) => (moves[b] ? null : poseOf(first[b]))),
    times: kept.map(([t]) => Number(Number(t).toFixed(5))),
    poses: kept.map(([, rows]) => rows.filter((_, b) => moves[b]).flatMap((cells) => poseOf(cells))),
    contacts: null,
  };
}

/** Deepest points of the contacts of each frame, from the lines of `--log contacts`. */
function readContacts(log: string, times: number[]): number[][] {
  const at = new Map<string, number[]>();
  for (const line of log.split('\n')) {
    const value = (key: string) =>
      line
        .match(new RegExp(` ${key}=\\(([^)]*)\\)`))?.[1]
        ?.split(',')
        .map(Number);
    const time = line.match(/^t=(\S+) /)?.[1];
    const [point, normal] = [value('p'), value('n')];
    if (time === undefined || !point || !normal || !/ (begin|persist) contact /.test(line)) continue;
    const key = Number(time).toFixed(4);
    const list = at.get(key) ?? [];
    list.push(...[...point, ...normal].map((v) => Number(v.toFixed(4))));
    at.set(key, list);
  }
  return times.map((t) => at.get(t.toFixed(4)) ?? []);
}

export class Recorder {
  readonly #root: string;
  readonly #program: string;
  readonly #folder: string;
  readonly #done = new Map<string, RunResult>();
  made = 0;

  constructor(root: string, program: string, folder: string) {
    this.#root = root;
    this.#program = program;
    this.#folder = folder;
    mkdirSync(folder, { recursive: true });
  }

  result(run: RunRequest): RunResult {
    const id = idOf(run);
    const known = this.#done.get(id);
    if (known) return known;
    const [script, numbers] = [join(this.#folder, `${id}.js`), join(this.#folder, `${id}.metrics.json`)];
    const file = scenarioFile(this.#root, run.scenario);
    const newest = Math.max(statSync(file).mtimeMs, statSync(this.#program).mtimeMs);
    if (!existsSync(numbers) || statSync(numbers).mtimeMs < newest) this.#run(run, file, id, script, numbers);
    const result: RunResult = { id, metrics: JSON.parse(readFileSync(numbers, 'utf8')) };
    this.#done.set(id, result);
    return result;
  }

  #run(run: RunRequest, file: string, id: string, script: string, numbers: string): void {
    const temporary = mkdtempSync(join(tmpdir(), 'rigor-handbook-'));
    try {
      const csv = join(temporary, 'motion.csv');
      const given = ['run', file, '--engine', run.engine, '--json', '--csv', csv, '--log', 'contacts'];
      if (run.dt) given.push('--dt', run.dt);
      for (const item of run.set) given.push('--set', item);
      const ended = spawnSync(this.#program, given, { encoding: 'utf8', maxBuffer: 1 << 28, timeout: 300_000 });
      if (!existsSync(csv) || !ended.stdout?.trim())
        throw new Error(`${run.scenario} with ${run.engine} did not run: ${ended.stderr?.slice(0, 600)}`);
      const motion = readMotion(readFileSync(csv, 'utf8'), overridden(JSON.parse(readFileSync(file, 'utf8')), run.set));
      const contacts = readContacts(ended.stderr, motion.times);
      if (contacts.some((list) => list.length > 0)) motion.contacts = contacts;
      writeFileSync(script, `rigorScene(${JSON.stringify(id)},${JSON.stringify(motion)});\n`);
      writeFileSync(numbers, JSON.stringify(JSON.parse(ended.stdout).metrics));
      ++this.made;
    } finally {
      rmSync(temporary, { recursive: true });
    }
  }
}
