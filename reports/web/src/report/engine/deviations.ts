// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { el } from '../../common/elements.ts';
import { timeStep } from '../../common/format.ts';
import type { BriefCase, Engine, Scenario } from '../data.ts';
import { labelOf, run, scenarioLink } from '../run.ts';
import { chip, gradeChip, headRow, panel, scroll } from '../widgets.ts';

/** Cases of wrong physics with their reasons, and those that make the run red. */
export function deviations(engine: Engine): HTMLElement | null {
  const specs = new Set(run.columns.filter((c) => c.engine === engine.name).map((c) => c.spec));
  const cases = run.scenarios.flatMap((s) => s.cases.filter((c) => specs.has(c.spec)).map((c) => ({ s, c })));
  const known = cases.filter(({ c }) => c.shown === 'known_deviation');
  const bad = cases.filter(({ c }) => c.judged.red || ['fail', 'crashed', 'timeout', 'non_finite'].includes(c.shown));
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
      el('td', null, c.judged.grade ? gradeChip(c.judged.grade) : chip(c.shown)),
      el('td', { class: 'small' }, c.judged.says, c.judged.change ? ` ${c.judged.change}` : ''),
      el('td', { class: 'small' }, c.reason),
    );
  const heads = headRow(['Scenario', 'As', 'Time step', 'Grade', 'What is claimed', 'Reason'], (i) => i === 2);
  const table = (list: typeof cases) =>
    scroll(el('table', { class: 'full' }, heads.cloneNode(true), el('tbody', null, list.map(row))));
  return panel(
    'deviations',
    'Wrong physics, and what is red',
    bad.length
      ? [el('h3', null, `Red, crashed, timed out, not finite or a bound missed: ${bad.length}`), table(bad)]
      : null,
    known.length ? [el('h3', null, `Wrong physics with a reason on file: ${known.length}`), table(known)] : null,
  );
}
