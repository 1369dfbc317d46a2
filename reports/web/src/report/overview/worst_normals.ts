// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Frames with the worst contact normals of each engine.
import { type Child, el } from '../../common/elements.ts';
import { angle, format, full, type Maybe, timeStep, toNumber } from '../../common/format.ts';
import type { Scenario } from '../data.ts';
import { engineLink, labelOf, run, scenarioLink } from '../run.ts';
import { headRow, scroll } from '../widgets.ts';
import { type Place, placeQuery, worstPlace } from '../worst.ts';

const perEngine = 3;
const noticeable = 1e-4; // [rad], 0.006 degrees: less is rounding

interface Wrong {
  scenario: Scenario;
  spec: string;
  dt: number;
  normal: Maybe; // [rad]
  place: Place | null; // null: the run's worst error is a missed or false contact, whose place is the one on record
}

/** Contacts that runs acted upon, the worst first. */
function wrongNormals(engine: string): Wrong[] {
  const specs = new Set(run.columns.filter((c) => c.engine === engine).map((c) => c.spec));
  const found: Wrong[] = [];
  for (const scenario of run.scenarios)
    for (const c of scenario.cases) {
      if (!specs.has(c.spec) || !(toNumber(c.inRun?.normal) > noticeable)) continue;
      const place = worstPlace(c.inRun?.worst ?? '');
      found.push({
        scenario,
        spec: c.spec,
        dt: c.dt,
        normal: c.inRun?.normal ?? null,
        place: place?.what === 'normal' ? place : null,
      });
    }
  return found.sort((a, b) => toNumber(b.normal) - toNumber(a.normal));
}

/** One scenario a line, so that one bad scene does not hide the others. */
function worstScenarios(engine: string): Wrong[] {
  const seen = new Set<string>();
  const worst: Wrong[] = [];
  for (const w of wrongNormals(engine)) {
    if (seen.has(w.scenario.name) || worst.length === perEngine) continue;
    seen.add(w.scenario.name);
    worst.push(w);
  }
  return worst;
}

function row(w: Wrong, head: Child): HTMLElement {
  const href = scenarioLink(w.scenario.name, { spec: w.spec, ...placeQuery(w.place, w.dt) });
  return el(
    'tr',
    null,
    head,
    el('td', { class: 'num', 'data-label': 'Normal off by', title: `${full(w.normal)} rad` }, angle(w.normal)),
    el('td', { 'data-label': 'Scene' }, w.scenario.title),
    el('td', { 'data-label': 'Between' }, w.place?.bodies.join(' and ') ?? ''),
    el('td', { 'data-label': 'Run' }, `${labelOf(w.spec)}, ${timeStep(w.dt)}`),
    el(
      'td',
      null,
      el('a', { class: 'frame', href }, w.place ? `show t = ${format(w.place.time)} s` : 'its contact audit'),
    ),
  );
}

/** Null where no engine that could be judged was noticeably wrong. */
export function worstNormals(): Child {
  const engines = [...new Set(run.columns.map((c) => c.engine))].map((name) => ({ name, worst: worstScenarios(name) }));
  if (engines.every((e) => e.worst.length === 0)) return null;
  const rows = engines.flatMap(({ name, worst }) => {
    const link = el('a', { href: engineLink(name) }, name);
    if (worst.length === 0)
      return [
        el(
          'tr',
          null,
          el('th', { class: 'sticky', scope: 'row' }, link),
          el('td', { colspan: 5, class: 'muted' }, `none off by more than ${angle(noticeable)}`),
        ),
      ];
    return worst.map((w, i) =>
      row(w, i === 0 ? el('th', { class: 'sticky', scope: 'rowgroup', rowspan: worst.length }, link) : null),
    );
  });
  const heads = ['Engine', 'Normal off by', 'Scene', 'Between', 'Run', 'Frame'];
  return [
    el('h3', null, 'Where normals go wrong'),
    scroll(
      el(
        'table',
        { id: 'worst-normals', class: 'stacked' },
        headRow(heads, (i) => i === 1),
        el('tbody', null, rows),
      ),
    ),
    el('h3', null, 'Every scenario'),
  ];
}
