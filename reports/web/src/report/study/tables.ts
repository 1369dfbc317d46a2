// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { type Child, el } from '../../common/elements.ts';
import { format, full, inShownUnit, type Maybe, shownUnit, timeStep, words } from '../../common/format.ts';
import type { Finding, Study, StudyRow } from '../data.ts';
import { run, scenarioLink } from '../run.ts';
import { chip, looseHeadRow, numberCell, scroll } from '../widgets.ts';

const plain = (heads: string[], rows: HTMLElement[]) =>
  scroll(el('table', { class: 'full' }, looseHeadRow(heads), el('tbody', null, rows)));

/** Columns: what varies, the variant, the metrics, and how the run ended where it did not end well. */
export function rowsTable(rows: StudyRow[]): HTMLElement {
  const varies = (get: (r: StudyRow) => unknown) => new Set(rows.map((r) => JSON.stringify(get(r)))).size > 1;
  const first = rows[0] as StudyRow;
  const ways: [name: string, get: (r: StudyRow) => Child][] = [
    ...(varies((r) => r.base) ? [['Scenario', (r: StudyRow) => r.base] as [string, (r: StudyRow) => Child]] : []),
    ...Object.keys(first.parameters).map((key): [string, (r: StudyRow) => Child] => [
      key,
      (r) => said(r.parameters[key]),
    ]),
    ...(varies((r) => r.dt)
      ? [['Time step', (r: StudyRow) => timeStep(r.dt)] as [string, (r: StudyRow) => Child]]
      : []),
  ];
  const metrics = Object.keys(first.metrics);
  const ended = rows.some((r) => !r.ran || r.outcome !== 'completed');
  const unitOf = (m: string) => rows.map((r) => r.metrics[m]?.unit).find((u) => u && u !== '1');
  const known = new Set(run.scenarios.map((s) => s.name));
  const variant = (r: StudyRow): Child =>
    known.has(r.scenario)
      ? el('a', { href: scenarioLink(r.scenario, { dt: r.dt, spec: r.spec }), title: r.spec }, r.variant)
      : r.variant;
  const cell = (r: StudyRow, m: string) => {
    const found = r.metrics[m];
    const title = `${full(found?.value)} ${found?.unit ?? ''}`;
    const note = found?.note ? el('span', { class: 'bound' }, found.note) : null;
    return el(
      'td',
      { class: 'num', title, 'data-value': full(found?.value) },
      format(inShownUnit(found?.value, found?.unit ?? '')),
      note,
    );
  };
  const head = el(
    'tr',
    null,
    ['Variant', ...ways.map(([name]) => name)].map((t, i) => el('th', { class: i ? null : 'sticky', scope: 'col' }, t)),
    metrics.map((m) =>
      el('th', { class: 'num', scope: 'col' }, words(m), unitOf(m) ? ` [${shownUnit(unitOf(m) ?? '')}]` : ''),
    ),
    ended ? el('th', { scope: 'col' }, 'Outcome') : null,
  );
  const row = (r: StudyRow) =>
    el(
      'tr',
      null,
      el('th', { class: 'sticky', scope: 'row' }, variant(r)),
      ways.map(([, get]) => el('td', null, get(r))),
      metrics.map((m) => cell(r, m)),
      ended ? el('td', { class: 'small' }, r.ran ? r.outcome : 'not run') : null,
    );
  return scroll(el('table', { class: 'full' }, el('thead', null, head), el('tbody', null, rows.map(row))));
}
const said = (value: unknown): string => (typeof value === 'object' ? JSON.stringify(value) : String(value));

const range = (least: Maybe, most: Maybe): string => {
  if (least === null && most === null) return '—';
  if (least === null) return `≤ ${format(most)}`;
  if (most === null) return `≥ ${format(least)}`;
  return least === most ? format(least) : `${format(least)} … ${format(most)}`;
};
const where = (f: Finding) =>
  [f.variant, ...Object.entries(f.where).map(([k, v]) => (k === 'scenario' ? said(v) : `${k}=${said(v)}`))].join(', ');

export function findings(study: Study): HTMLElement | null {
  if (study.findings.length === 0) return null;
  const rows = study.findings.map((f) =>
    el(
      'tr',
      null,
      el('th', { scope: 'row' }, f.statement),
      el('td', null, where(f)),
      el('td', null, f.metric),
      el('td', null, range(f.at_least, f.at_most)),
      el('td', null, range(f.least, f.greatest)),
      el('td', null, chip(f.holds ? 'pass' : 'fail', f.holds ? 'holds' : 'does not hold')),
      el('td', { class: 'small' }, f.source),
    ),
  );
  return el(
    'div',
    { id: 'findings' },
    el('h3', null, 'Findings'),
    plain(['Finding', 'Where', 'Column', 'Expected', 'Found', 'Verdict', 'Source'], rows),
  );
}

/** A link to the replay of the run of a variant in the part of a symptom. */
function variantLink(study: Study, part: string, variant: string): Child {
  const rows = study.parts.find((p) => p.name === part)?.rows ?? [];
  const row = rows.find((r) => r.variant === variant && run.scenarios.some((s) => s.name === r.scenario));
  if (!row) return variant;
  const href = scenarioLink(row.scenario, { dt: row.dt, spec: row.spec, t: 0, step: 0 });
  return el('a', { href, title: 'Replay of this run' }, variant);
}

export function symptoms(study: Study): HTMLElement | null {
  if (study.symptoms.length === 0) return null;
  const rows = study.symptoms.map((s) =>
    el(
      'tr',
      null,
      el('th', { scope: 'row' }, s.name),
      el('td', null, s.metric + (s.growth ? ' ~ N^p' : '')),
      el('td', null, variantLink(study, s.name, s.fault)),
      numberCell(s.fault_value),
      el('td', null, variantLink(study, s.name, s.cure)),
      numberCell(s.cure_value),
      el('td', { class: 'small' }, s.switched.join('; ')),
      el(
        'td',
        null,
        chip(
          s.shown && s.cured ? 'pass' : 'fail',
          `${s.shown ? 'shown' : 'not shown'}, ${s.cured ? 'cured' : 'not cured'}`,
        ),
      ),
    ),
  );
  return el(
    'div',
    { id: 'symptoms' },
    el('h3', null, 'Symptoms'),
    plain(['Symptom', 'Column', 'Fault', 'Value', 'Cure', 'Value', 'Switched', 'Verdict'], rows),
  );
}
