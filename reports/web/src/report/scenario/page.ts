// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page of one scenario: its data is loaded when it is opened. A section is one file and one line here, where it shall
// stand.
import { newCursor } from '../../common/cursor.ts';
import { loadJson } from '../../common/data_files.ts';
import { el } from '../../common/elements.ts';
import type { ScenarioData } from '../data.ts';
import { loadCases } from '../loading.ts';
import { run } from '../run.ts';
import { panel } from '../widgets.ts';
import { caseAudit } from './audit.ts';
import { commands } from './commands.ts';
import { contents } from './contents.ts';
import { type Context, type Section, showMoment } from './context.ts';
import { curves } from './curves.ts';
import { freePlots } from './free_plots.ts';
import { head } from './head.ts';
import { metrics } from './metrics.ts';
import { outcomes, verdicts } from './outcomes.ts';
import { parity } from './parity.ts';
import { quantities } from './quantities.ts';
import { refinement } from './refinement.ts';
import { replay } from './replay.ts';
import { caseTiming } from './timing.ts';

const sections: Section[] = [
  head,
  verdicts,
  outcomes,
  replay,
  curves,
  freePlots,
  metrics,
  caseAudit,
  refinement,
  quantities,
  parity,
  caseTiming,
  commands,
];

let hidden: ReadonlySet<string> = new Set(); // engines that are switched off stay so on the next page

function contextOf(index: number, data: ScenarioData, query: URLSearchParams): Context {
  const scenario = run.scenarios[index] as Context['scenario'];
  const steps = [...new Set(data.cases.map((c) => c.dt))].sort((a, b) => b - a);
  const requested = Number(query.get('dt'));
  const dt = steps.includes(requested) ? requested : (steps.at(-1) ?? 0);
  const step = query.has('step') && requested === dt ? Number(query.get('step')) : Number.NaN;
  const time = step >= 0 ? step * dt : Number(query.get('t') ?? 0);
  const cursor = newCursor(Math.max(0, time || 0));
  cursor.hidden.set(hidden);
  cursor.hidden.follow((now) => {
    hidden = now;
  });
  const cases = data.cases.filter((c) => c.dt === dt);
  return { scenario, index, data, steps, dt, cases, spec: query.get('spec'), cursor, leaving: [] };
}

export interface ShownPage {
  nodes: HTMLElement[];
  shown: () => void; // called when they are in the document
  left: () => void; // called when the page is left
}

export async function scenarioPage(name: string, query: URLSearchParams): Promise<ShownPage> {
  const index = run.scenarios.findIndex((s) => s.name === name);
  const nothing = () => {};
  const sorry = (text: string) => ({
    nodes: [panel('missing', 'Nothing to show', el('p', null, text))],
    shown: nothing,
    left: nothing,
  });
  if (index < 0) return sorry(`This run has no scenario “${name}”.`);
  let data: ScenarioData;
  try {
    data = await loadJson<ScenarioData>(`scenario-${index}`);
    await loadCases(index);
  } catch (error) {
    return sorry((error as Error).message);
  }
  const context = contextOf(index, data, query);
  const nodes = sections.map((section) => section(context)).filter((node) => node !== null);
  const list = contents(nodes);
  if (list) nodes.unshift(list);
  const { spec } = context;
  const shown = () => {
    if (query.has('view')) document.getElementById('replay')?.scrollIntoView();
    if (spec === null || !query.has('t')) return;
    const bodies = (query.get('pair') ?? '').split('|').filter(Boolean);
    const contact = query.has('contact') ? Number(query.get('contact')) : null;
    showMoment(context.cursor, context.cursor.time.value, { spec, bodies, contact, finding: query.get('finding') });
  };
  const left = () => {
    for (const leave of context.leaving) leave();
  };
  return { nodes, shown, left };
}
