// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { el } from '../../common/elements.ts';
import { format, timeStep, words } from '../../common/format.ts';
import type { BriefCase, Engine, Scenario } from '../data.ts';
import { chip, headRow, panel, scroll } from '../parts.ts';
import { labelOf, run, scenarioLink } from '../run.ts';

/** Cases that deviate as recorded, or end otherwise than by passing; with the reasons. */
export function deviations(engine: Engine): HTMLElement | null {
  const specs = new Set(run.columns.filter((c) => c.engine === engine.name).map((c) => c.spec));
  const cases = run.scenarios.flatMap((s) => s.cases.filter((c) => specs.has(c.spec)).map((c) => ({ s, c })));
  const known = cases.filter(({ c }) => c.shown === 'known_deviation');
  const bad = cases.filter(({ c }) => ['fail', 'crashed', 'timeout', 'non_finite'].includes(c.shown));
  if (known.length + bad.length === 0) return null;
  const row = ({ s, c }: { s: Scenario; c: BriefCase }) =>
    el(
      'tr',
      null,
      el(
        'th',
        { class: 'sticky', scope: 'row' },
        el('a', { href: scenarioLink(s.name, { spec: c.spec, dt: c.dt }) }, s.name),
      ),
      el('td', null, labelOf(c.spec)),
      el('td', { class: 'num' }, timeStep(c.dt)),
      el('td', null, chip(c.shown)),
      el(
        'td',
        { class: 'num' },
        format(c.value),
        el('span', { class: 'bound' }, c.bound === null ? '' : `≤ ${format(c.bound)}`),
      ),
      el('td', { class: 'small' }, words(s.main.name)),
      el('td', { class: 'small' }, c.reason),
    );
  const heads = headRow(
    ['Scenario', 'As', 'Time step', 'Verdict', 'Value', 'Main metric', 'Reason'],
    (i) => i === 2 || i === 4,
  );
  const table = (list: typeof cases) =>
    scroll(el('table', { class: 'full' }, heads.cloneNode(true), el('tbody', null, list.map(row))));
  return panel(
    'deviations',
    'Known deviations and failures',
    bad.length ? [el('h3', null, `Fails, crashes, times out, or is not finite: ${bad.length}`), table(bad)] : null,
    known.length ? [el('h3', null, `Deviates as recorded: ${known.length}`), table(known)] : null,
  );
}
