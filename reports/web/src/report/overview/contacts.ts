// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts over the whole run: those that the runs acted upon, and the results of collision engines for queries.
import { type Child, el } from '../../common/elements.ts';
import { angle, format, full, type Maybe, toNumber } from '../../common/format.ts';
import type { Audit, Column, InRun, Scenario } from '../data.ts';
import { run, scenarioLink } from '../run.ts';
import { chip, headRow, panel, scroll, specHead, stickyHead } from '../widgets.ts';
import { placeOfNormal, placeQuery, worstNormalPlace, worstPlace } from '../worst.ts';
import { worstNormals } from './worst_normals.ts';

const scenarioHead = (name: string) =>
  el('th', { class: 'sticky', scope: 'row' }, el('a', { href: scenarioLink(name) }, name));

/** The worst of several: NaN is worse than any number. */
function worstOf(values: Maybe[]): Maybe {
  let worst: Maybe = null;
  for (const v of values) if (v !== null && (worst === null || !(toNumber(v) <= toNumber(worst)))) worst = v;
  return worst;
}

/** The worst normal, a link to its frame where its place is on record. */
function normalLink(s: Scenario, column: Column, cases: Scenario['cases'], normal: Maybe): Child {
  const at = cases.find((c) => c.inRun?.normal === normal);
  const found = at?.inRun?.normals?.find((n) => n.what === 'normal');
  const place = found ? placeOfNormal(found) : worstNormalPlace(at?.inRun?.worst ?? '');
  if (!at || !place) return angle(normal);
  const href = scenarioLink(s.name, { spec: column.spec, ...placeQuery(place, at.dt) });
  return el('a', { href, title: 'Show this frame' }, angle(normal));
}

function inRunCell(s: Scenario, column: Column): HTMLElement {
  const cases = s.cases.filter((c) => c.spec === column.spec && c.inRun);
  if (cases.length === 0) return el('td', { class: 'num muted' });
  const seen = cases.map((c) => c.inRun as InRun);
  const worst = (key: 'normal' | 'depth' | 'point' | 'normalFlicker' | 'contactFlicker') =>
    worstOf(seen.map((a) => a[key]));
  const sum = (key: 'queries' | 'overlapping' | 'missed' | 'spurious') => seen.reduce((n, a) => n + a[key], 0);
  const wrong = sum('missed') + sum('spurious');
  if (!sum('overlapping') && !wrong)
    return el('td', { class: 'small muted', title: `${sum('queries')} pairs queried` }, 'no overlap');
  if (!wrong && worst('normal') === null)
    return el('td', { class: 'small muted', title: 'shapes for which the oracle has no exact result' }, 'undecided');
  const flicker = toNumber(worst('contactFlicker'));
  const title =
    `${sum('queries')} pairs, ${sum('overlapping')} overlapping; ${sum('missed')} missed, ${sum('spurious')} spurious; ` +
    `worst normal ${full(worst('normal'))} rad, depth ${full(worst('depth'))} m, point ${full(worst('point'))} m off its surface; ` +
    `normals flicker by ${full(worst('normalFlicker'))} rad, ${full(worst('contactFlicker'))} of contacts blink; ` +
    seen
      .map((a) => a.worst)
      .filter(Boolean)
      .join('; ');
  const normal = worst('normal');
  // The place of a run's worst is that of a missed or invented overlap where it has one.
  const wrongLink = (text: Child): Child => {
    const isWrong = (a: InRun | null) => a && a.missed + a.spurious > 0 && worstPlace(a.worst)?.what !== 'normal';
    const at = cases.find((c) => isWrong(c.inRun));
    if (!at) return text;
    const href = scenarioLink(s.name, { spec: column.spec, ...placeQuery(worstPlace(at.inRun?.worst ?? ''), at.dt) });
    return el('a', { href, title: 'Show this frame' }, text);
  };
  return el(
    'td',
    { class: 'num', 'data-wrong': wrong, title },
    wrong ? wrongLink(chip('fail', `${wrong} wrong`)) : null,
    normalLink(s, column, cases, normal),
    el('span', { class: 'bound' }, worst('depth') === null ? '' : `${format(worst('depth'))} m`),
    flicker > 0.01 ? el('span', { class: 'bound' }, `${(100 * flicker).toPrecision(2)} % blink`) : null,
  );
}

/** Contacts that each run acted upon, the worst over its time steps. */
export function contactsActedUpon(): HTMLElement | null {
  const rows = run.scenarios.filter((s) => s.cases.some((c) => c.inRun?.overlapping));
  if (rows.length === 0) return null;
  const body = rows.map((s) =>
    el(
      'tr',
      null,
      scenarioHead(s.name),
      run.columns.map((c) => inRunCell(s, c)),
    ),
  );
  return panel(
    'in-run',
    'Contacts acted upon',
    el(
      'p',
      { class: 'muted' },
      'The contacts that each run itself acted upon, at sampled steps, against the exact oracle at the poses that they were found at. Shown: the worst ',
      'angle to the nearest exact normal, and the worst depth error; “wrong” counts overlaps that were missed or invented. A link opens the frame that its text is about. “Blink” is ',
      'the share of steps in which a touching pair had lost its contact for just that step.',
    ),
    worstNormals(),
    scroll(el('table', null, specHead([stickyHead('Scenario')], run.columns), el('tbody', null, body))),
  );
}

function queryCell(scenario: string, rows: Audit[], auditor: string): HTMLElement {
  const r = rows.find((x) => x.auditor === auditor);
  if (!r) return el('td', { class: 'num muted' });
  if (r.outcome !== 'completed' && !r.queries) return el('td', { class: 'small muted', title: r.note }, r.outcome);
  const wrong = r.missed + r.spurious;
  const title =
    `${r.queries} pairs in ${r.frames} frames; ${r.overlapping} overlapping; ${r.missed} missed, ${r.spurious} spurious, ${r.undecided} undecided; ` +
    `worst normal ${full(r.normalErrorMax)} rad, depth ${full(r.depthErrorMax)} m; ${r.worst}`;
  const place = worstPlace(r.worst);
  const href = place ? scenarioLink(scenario, { spec: place.spec, ...placeQuery(place, undefined, auditor) }) : null;
  const link = (here: boolean, text: Child) =>
    href && here ? el('a', { href, title: 'Show these poses' }, text) : text;
  const ofNormal = place?.what === 'normal';
  return el(
    'td',
    { class: 'num', title },
    wrong ? link(!ofNormal, chip('fail', `${wrong} wrong`)) : null,
    link(ofNormal, angle(r.normalErrorMax)),
    el('span', { class: 'bound' }, r.depthErrorMax === null ? '' : `${format(r.depthErrorMax)} m`),
  );
}

export function contactQueries(): HTMLElement | null {
  if (run.audit.length === 0) return null;
  const named = new Set(run.audit.flatMap((a) => a.rows.map((r) => r.auditor)));
  const auditors = [...named].filter((name) => name !== 'oracle' && name !== 'in_run' && !name.includes('|'));
  return panel(
    'audit',
    'Contact queries',
    el(
      'p',
      { class: 'muted' },
      'At sampled frames of every run, each collision engine is queried at the same poses and compared with an exact oracle. Shown: the worst angle between ',
      'its contact normal and the nearest exact one, and the worst penetration error below; “wrong” counts overlaps that were missed or invented. A link shows the poses queried and draws the result of the query beside the exact one.',
    ),
    scroll(
      el(
        'table',
        null,
        headRow(['Poses of', ...auditors], (i) => i > 0),
        el(
          'tbody',
          null,
          run.audit.map((a) =>
            el(
              'tr',
              null,
              scenarioHead(a.scenario),
              auditors.map((name) => queryCell(a.scenario, a.rows, name)),
            ),
          ),
        ),
      ),
    ),
  );
}
