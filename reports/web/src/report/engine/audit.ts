// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Comparison of an engine's contacts with the exact oracle over the whole run: those it acted upon, and its results
// when it is queried as a collision engine.
import { type Child, el } from '../../common/elements.ts';
import { angle, format, type Maybe, toNumber } from '../../common/format.ts';
import type { Engine } from '../data.ts';
import { labelOf, run, scenarioLink } from '../run.ts';
import { chip, headRow, panel, scroll } from '../widgets.ts';
import { placeQuery, worstPlace } from '../worst.ts';

interface Row {
  scenario: string;
  label: string;
  auditor: string;
  spec: string;
  dt: number | undefined;
  wrong: number;
  normal: Maybe;
  depth: Maybe;
  worst: string;
}

function rowsOf(engine: Engine): { acted: Row[]; requested: Row[] } {
  const acted = run.scenarios.flatMap((s) =>
    s.cases
      .filter((c) => c.inRun && run.columns.some((x) => x.spec === c.spec && x.engine === engine.name))
      .map((c): Row => {
        const a = c.inRun as NonNullable<typeof c.inRun>;
        return {
          scenario: s.name,
          label: labelOf(c.spec),
          auditor: 'in_run',
          spec: c.spec,
          dt: c.dt,
          wrong: a.missed + a.spurious,
          normal: a.normal,
          depth: a.depth,
          worst: a.worst,
        };
      }),
  );
  const requested = run.audit.flatMap((a) =>
    a.rows
      .filter((r) => r.auditor === engine.name || r.auditor.startsWith(`${engine.name}:`))
      .map((r): Row => {
        const spec = worstPlace(r.worst)?.spec ?? '';
        return {
          scenario: a.scenario,
          label: r.auditor,
          auditor: r.auditor,
          spec,
          dt: undefined,
          wrong: r.missed + r.spurious,
          normal: r.normalErrorMax,
          depth: r.depthErrorMax,
          worst: r.worst,
        };
      }),
  );
  return { acted, requested };
}

const shown = 8;

function table(rows: Row[]): Child {
  const byNormal = [...rows].sort((a, b) => (toNumber(b.normal) || 0) - (toNumber(a.normal) || 0) || b.wrong - a.wrong);
  const wrong = rows.reduce((n, r) => n + r.wrong, 0);
  const body = byNormal.slice(0, shown).map((r) => {
    const place = worstPlace(r.worst);
    const href = scenarioLink(r.scenario, { spec: r.spec, ...placeQuery(place, r.dt, r.auditor) });
    return el(
      'tr',
      null,
      el('th', { class: 'sticky', scope: 'row' }, el('a', { href: scenarioLink(r.scenario) }, r.scenario)),
      el('td', null, r.label),
      el('td', { class: 'num' }, angle(r.normal)),
      el('td', { class: 'num' }, r.depth === null ? '—' : `${format(r.depth)} m`),
      el('td', { class: 'num' }, r.wrong ? chip('fail', r.wrong) : 0),
      el('td', { class: 'small' }, place ? el('a', { href }, r.worst) : r.worst),
    );
  });
  return [
    el(
      'p',
      null,
      `${rows.length} audits, `,
      wrong ? chip('fail', `${wrong} overlaps missed or invented`) : chip('pass', 'no overlap missed or invented'),
      rows.length > shown ? ` The ${shown} with the worst normals:` : '',
    ),
    scroll(
      el(
        'table',
        null,
        headRow(
          ['Scenario', 'As', 'Normal, worst', 'Depth, worst', 'Wrong', 'Worst at: show this frame'],
          (i) => i > 1 && i < 5,
        ),
        el('tbody', null, body),
      ),
    ),
  ];
}

export function engineAudit(engine: Engine): HTMLElement | null {
  const { acted, requested } = rowsOf(engine);
  if (acted.length + requested.length === 0) return null;
  return panel(
    'engine-audit',
    'Contacts against the exact oracle',
    acted.length ? [el('h3', null, 'Contacts that its runs acted upon'), table(acted)] : null,
    requested.length ? [el('h3', null, 'Queried at the poses of all runs'), table(requested)] : null,
  );
}
