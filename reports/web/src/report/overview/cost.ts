// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cost of a step beside the accuracy of the same run, as a table of all scenarios.
import { el } from '../../common/elements.ts';
import { duration, format, full, timeStep, words } from '../../common/format.ts';
import { cellOf } from '../cells.ts';
import type { Column, Scenario } from '../data.ts';
import { isFirstOfEngine, run, scenarioLink, verdictText } from '../run.ts';
import { specHead, stickyHead } from '../widgets.ts';

function cell(s: Scenario, column: Column, first: boolean): HTMLElement {
  const found = cellOf(s, column, 'finest')?.at;
  const side = first ? ' first' : '';
  if (!found?.step) return el('td', { class: `num muted${side}` }, found ? verdictText(found.shown).symbol : '');
  const t = found.step;
  const interval =
    t.low !== undefined && t.low !== null
      ? `95 % interval ${duration(t.low)} to ${duration(t.high)}`
      : `10 % ${duration(t.p10)}, 90 % ${duration(t.p90)}`;
  const mean =
    t.mean !== undefined && t.mean !== null
      ? `mean ${duration(t.mean)}, 95 % ${duration(t.p95 ?? null)}, 99 % ${duration(t.p99 ?? null)}, worst ${duration(t.worst ?? null)}, first step apart ${duration(t.first ?? null)}, ${format(t.realTimeFactor ?? null, 3)} × real time, `
      : '';
  const title =
    `median ${full(t.median)} s per step, ${interval}, ${mean}${t.samples} steps, ${format(t.contacts)} contacts on average; ` +
    `${s.main.name} ${full(found.value)} ${s.main.unit}`;
  const accuracy = el(
    'span',
    { class: 'bound' },
    found.judged.grade || verdictText(found.shown).symbol,
    ' ',
    format(found.value, 3),
  );
  const beside = mean ? el('span', { class: 'bound' }, `mean ${duration(t.mean)}`) : null;
  return el('td', { class: `num${side}`, title }, duration(t.median), beside, accuracy);
}

export function costTable(): HTMLElement {
  const rows = run.scenarios.filter((s) => s.cases.some((c) => c.step));
  return el(
    'table',
    { class: 'full' },
    specHead([stickyHead('Scenario'), el('th', { scope: 'col' }, 'Step, error')], run.columns),
    el(
      'tbody',
      null,
      rows.map((s) =>
        el(
          'tr',
          null,
          el('th', { class: 'sticky', scope: 'row' }, el('a', { href: scenarioLink(s.name) }, s.name)),
          el(
            'td',
            { class: 'small' },
            timeStep(Math.min(...s.cases.map((c) => c.dt))),
            el('span', { class: 'bound' }, words(s.main.name)),
          ),
          run.columns.map((c, i) => cell(s, c, isFirstOfEngine(run.columns, i))),
        ),
      ),
    ),
  );
}
