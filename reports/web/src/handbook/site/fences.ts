// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The fences of a page that are more than code: scenes that run in the page, and exercises.

/** A run that a scene plays: everything that decides the motion. */
export interface RunRequest {
  scenario: string; // name of the library, or path from the root of the repository
  engine: string;
  set: string[];
  dt: string | null;
}

export interface SceneSide {
  label: string;
  run: RunRequest;
}

export interface SceneFence {
  sides: SceneSide[]; // one to three
  metrics: string[]; // "name" or "name@subject"
  contacts: boolean; // contact normals are drawn
  side: boolean; // a scene in 3D is seen from the front
  trail: string[]; // bodies whose paths are drawn
  view: number[] | null; // [m] of what the picture shows: left, bottom, right, top
  seconds: number | null; // the picture ends here
  caption: string;
}

export interface ExerciseFence {
  text: string; // Markdown
  command: string; // in capitals: the place that the reader fills in
  isJudged: boolean; // its exit code judges the answer; else the reader looks at what it prints or draws
  answer: string[]; // commands that end with exit code 0, in order
  wrong: string[]; // commands of wrong answers: their exit codes are others
  solution: string; // Markdown
}

/** Lines "key: value"; a key may stand more than once. */
function fields(body: string): (key: string) => string[] {
  const all = body.split('\n').flatMap((line) => {
    const match = line.match(/^([a-z_]+): ?(.*)$/);
    return match ? [[match[1] as string, (match[2] as string).trim()] as const] : [];
  });
  return (key) => all.flatMap(([k, v]) => (k === key ? [v] : []));
}

const known = ['scenario', 'set', 'dt', 'side', 'metric', 'show', 'trail', 'view', 'seconds', 'caption'];

export function readSceneFence(body: string): SceneFence {
  for (const line of body.split('\n'))
    if (line.trim() && !known.includes(line.split(':')[0] as string)) throw new Error(`scene: "${line}" is not known`);
  const get = fields(body);
  const scenario = get('scenario')[0];
  const sides = get('side').map((line): SceneSide => {
    const [label = '', engine = '', ...own] = line.split(' | ').map((part) => part.trim());
    if (!label || !engine)
      throw new Error(`scene: "side: ${line}" is not "LABEL | ENGINE [| scenario=... | set=... | dt=...]"`);
    const value = (key: string) => own.filter((o) => o.startsWith(`${key}=`)).map((o) => o.slice(key.length + 1));
    const chosen = value('scenario')[0] ?? scenario;
    if (chosen === undefined) throw new Error('scene: no scenario');
    const run = {
      scenario: chosen,
      engine,
      set: [...get('set'), ...value('set')],
      dt: value('dt')[0] ?? get('dt')[0] ?? null,
    };
    return { label, run };
  });
  if (sides.length < 1 || sides.length > 3) throw new Error('scene: one to three lines "side: ..."');
  return {
    sides,
    metrics: get('metric').flatMap((m) => m.split(',').map((part) => part.trim())),
    contacts: get('show').includes('contacts'),
    side: get('show').includes('side'),
    trail: get('trail'),
    view: get('view')[0]?.split(',').map(Number) ?? null,
    seconds: get('seconds')[0] ? Number(get('seconds')[0]) : null,
    caption: get('caption')[0] ?? '',
  };
}

/** Sections of an exercise: its text, then "--- judge" or "--- look", "--- answer", "--- wrong", "--- solution". */
export function readExercise(body: string): ExerciseFence {
  const parts = new Map<string, string>([['text', '']]);
  let now = 'text';
  for (const line of body.split('\n')) {
    const head = line.match(/^--- ([a-z]+)$/);
    if (head) {
      now = head[1] as string;
      parts.set(now, '');
    } else parts.set(now, `${parts.get(now)}${line}\n`);
  }
  const part = (key: string) => (parts.get(key) ?? '').trim();
  const lines = (key: string) => part(key).split('\n').filter(Boolean);
  const command = part('judge') || part('look');
  if (!part('text') || !command || !part('answer') || !part('solution'))
    throw new Error(`an exercise has a text, a judge or a look, an answer and a solution: ${body.slice(0, 80)}`);
  if (part('look') && part('wrong')) throw new Error(`nothing judges a wrong answer here: ${body.slice(0, 80)}`);
  return {
    text: part('text'),
    command,
    isJudged: part('judge') !== '',
    answer: lines('answer'),
    wrong: lines('wrong'),
    solution: part('solution'),
  };
}

/** The command that repeats a run. */
export function commandOf(run: RunRequest): string {
  const quoted = (text: string) => (/^[\w./:=,@-]+$/.test(text) ? text : `'${text}'`);
  const sets = run.set.map((s) => ` --set ${quoted(s)}`).join('');
  return `./rigor run ${run.scenario} --engine ${quoted(run.engine)}${run.dt ? ` --dt ${run.dt}` : ''}${sets}`;
}
