// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Input of the sections of a scenario's page, and the links that show a moment of it.
import type { Cursor, Focus } from '../../common/cursor.ts';
import { type Child, el } from '../../common/elements.ts';
import { type ContactFinding, findingKey } from '../../common/finding.ts';
import { format, timeStep } from '../../common/format.ts';
import { stepAt } from '../../common/steps.ts';
import type { Case, Scenario, ScenarioData } from '../data.ts';
import { run, scenarioLink } from '../run.ts';

export interface Context {
  scenario: Scenario;
  index: number; // index in the run
  data: ScenarioData;
  steps: number[]; // coarsest first [s]
  dt: number; // the one shown
  cases: Case[]; // cases at this time step
  spec: string | null; // selection of the link that led here
  cursor: Cursor; // shared by curves, tables and the replay
  leaving: (() => void)[]; // called when the page is left
}

/** Scenario and time step, as a plot says them in its file. */
export const aboutOf = ({ scenario, dt }: Context): string => `${scenario.name}, time step ${timeStep(dt)}`;

/** A section returns null when it has nothing to say. */
export type Section = (context: Context) => HTMLElement | null;

/** A link that sets the shared time, the engine and the bodies looked at, and brings them into view. */
export function moment(
  context: Context,
  spec: string,
  time: number,
  bodies: string[],
  text: Child,
  contact: number | null = null,
  finding: string | null = null,
): HTMLElement {
  const { scenario, dt, cursor } = context;
  const href = scenarioLink(scenario.name, {
    dt,
    spec,
    t: time,
    step: stepAt(time, dt),
    pair: bodies.join('|'),
    contact,
    finding,
  });
  const show = (e: Event) => {
    e.preventDefault();
    history.replaceState(history.state, '', href);
    showMoment(cursor, time, { spec, bodies, contact, finding });
  };
  return el(
    'a',
    { href, class: 'moment', title: `Show t = ${format(time)} s in curves and replay`, onclick: show },
    text,
  );
}

/** Links to the files of a folder beside the page; null where there are none, as for a page that was sent alone. */
export function fileLinks({ data }: Context, folder: 'tables' | 'plots', what: string): HTMLElement | null {
  const files = run.single ? [] : (data.files ?? []).filter((file) => file.startsWith(`${folder}/`));
  if (files.length === 0) return null;
  const formats: Record<string, string> = {
    csv: 'CSV',
    md: 'Markdown',
    tex: 'LaTeX',
    gz: 'CSV (gzip)',
    svg: 'SVG',
    pdf: 'PDF',
  };
  const ending = (file: string) => file.slice(file.lastIndexOf('.') + 1);
  const link = (file: string, i: number) => [i ? ' · ' : '', el('a', { href: file }, formats[ending(file)] ?? file)];
  return el('p', { class: 'small noprint', 'data-files': folder }, `${what}: `, files.map(link));
}

/** The finding of a key in the audit of a run at the time step that is shown. */
export function findingOf(cases: Case[], spec: string, key: string): ContactFinding | null {
  const rows = cases.find((c) => c.spec === spec)?.audit ?? [];
  for (const { auditor, findings = [] } of rows)
    for (const found of findings)
      if (findingKey(auditor, found.what) === key) return auditor === 'in_run' ? found : { ...found, by: auditor };
  return null;
}

export function showMoment(cursor: Cursor, time: number, focus: Focus): void {
  const hidden = new Set(cursor.hidden.value);
  if (hidden.delete(focus.spec)) cursor.hidden.set(hidden);
  cursor.time.set(time);
  cursor.focus.set(focus);
  const stage = document.getElementById('replay') ?? document.getElementById('curves');
  stage?.scrollIntoView();
  // Keys reach the picture from here on; before there is one, the place of it gets the focus.
  stage?.querySelector<HTMLElement>('canvas, .replay-place')?.focus({ preventScroll: true });
}
