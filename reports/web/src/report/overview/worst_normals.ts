// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Frames with the worst contact normals of each engine: of the deepest point of a contact, or of another one that the run
// acted upon.
import { type Child, el } from '../../common/elements.ts';
import { angle, format, full, type Maybe, timeStep, toNumber } from '../../common/format.ts';
import type { Scenario, WrongNormal } from '../data.ts';
import { engineLink, labelOf, run, scenarioLink } from '../run.ts';
import { headRow, metricName, scroll } from '../widgets.ts';
import { type Place, placeOfNormal, placeQuery, worstNormalPlace } from '../worst.ts';

const perEngine = 3;
const noticeable = 1e-4; // [rad], 0.006 degrees: less is rounding

interface Wrong {
  scenario: Scenario;
  spec: string;
  dt: number;
  error: Maybe; // [rad]
  place: Place | null; // null: an older store says no place
  distance: Maybe; // exact signed distance there [m]
}

/** The worse of the two kinds; of a store without places the angle alone, and its place if the run's worst was a normal. */
function worstOf(scenario: Scenario, c: Scenario['cases'][number]): Wrong | null {
  if (!c.inRun) return null;
  const { normals = [], normal, worst } = c.inRun;
  const at = { scenario, spec: c.spec, dt: c.dt };
  const found = normals.reduce<WrongNormal | null>(
    (best, n) => (best === null || toNumber(n.error) > toNumber(best.error) ? n : best),
    null,
  );
  if (found) return { ...at, error: found.error, place: placeOfNormal(found), distance: found.distance };
  return { ...at, error: normal, place: worstNormalPlace(worst), distance: null };
}

/** The worst first, one scenario a line, so that one bad scene does not hide the others. */
function worstScenarios(engine: string): Wrong[] {
  const specs = new Set(run.columns.filter((c) => c.engine === engine).map((c) => c.spec));
  const found = run.scenarios.flatMap((scenario) => {
    const all = scenario.cases.filter((c) => specs.has(c.spec)).flatMap((c) => worstOf(scenario, c) ?? []);
    const wrong = all.filter((w) => toNumber(w.error) > noticeable);
    return wrong.sort((a, b) => toNumber(b.error) - toNumber(a.error)).slice(0, 1);
  });
  return found.sort((a, b) => toNumber(b.error) - toNumber(a.error)).slice(0, perEngine);
}

function row(w: Wrong, head: Child): HTMLElement {
  const href = scenarioLink(w.scenario.name, { spec: w.spec, ...placeQuery(w.place, w.dt) });
  const deep = -toNumber(w.distance);
  return el(
    'tr',
    { 'data-what': w.place?.what },
    head,
    el(
      'td',
      { class: 'num', 'data-label': 'Normal off by', title: `${full(w.error)} rad` },
      el('a', { class: 'frame', href }, angle(w.error)),
      w.place?.what === 'point_normal' ? el('span', { class: 'bound' }, 'one of its points') : null,
    ),
    el(
      'td',
      { class: 'num', 'data-label': 'Overlap there', title: `${full(w.distance)} m` },
      Number.isFinite(deep) ? `${format(1e3 * deep, 3)} mm` : '',
    ),
    el('td', { 'data-label': 'Scene' }, w.scenario.title),
    el('td', { 'data-label': 'Between' }, w.place?.bodies.join(' and ') ?? ''),
    el('td', { 'data-label': 'Run' }, `${labelOf(w.spec)}, ${timeStep(w.dt)}`),
    el('td', { 'data-label': 'Frame' }, w.place ? `t = ${format(w.place.time)} s` : 'in its contact audit'),
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
          el('td', { colspan: 6, class: 'muted' }, `none off by more than ${angle(noticeable)}`),
        ),
      ];
    return worst.map((w, i) =>
      row(w, i === 0 ? el('th', { class: 'sticky', scope: 'rowgroup', rowspan: worst.length }, link) : null),
    );
  });
  const heads = ['Engine', 'Normal off by', 'Overlap there', 'Scene', 'Between', 'Run', 'Frame'];
  return [
    el('h3', null, 'Where normals go wrong'),
    el(
      'p',
      { class: 'muted small' },
      'The angle between a normal that a run acted upon and the nearest exact one. Audited is the deepest point of a pair, in sampled frames; “one of its points” is another point, which the metric ',
      metricName('normal_error'),
      ' found, for pairs with a closed form alone. Deep in each other, two ways out may be nearly as short: the overlap stands beside the angle.',
    ),
    scroll(
      el(
        'table',
        { id: 'worst-normals', class: 'stacked' },
        headRow(heads, (i) => i === 1 || i === 2),
        el('tbody', null, rows),
      ),
    ),
    el('h3', null, 'Every scenario'),
  ];
}
