// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { el } from '../../common/elements.ts';
import { words } from '../../common/format.ts';
import type { Case, Timing } from '../data.ts';
import { labelOf } from '../run.ts';
import { chip, durationCell, headRow, numberCell, panel, scroll } from '../widgets.ts';
import type { Context } from './context.ts';

/** Cost by phase, beside the accuracy of the same run. */
export function caseTiming({ scenario, cases }: Context): HTMLElement | null {
  const timed = cases.filter((c) => c.timings.length);
  if (timed.length === 0) return null;
  const hasInterval = timed.some((c) => c.timings.some((t) => (t.low ?? null) !== null));
  const hasMean = timed.some((c) => c.timings.some((t) => (t.mean ?? null) !== null));
  const main = (c: Case) =>
    c.metrics.find((m) => m.name === scenario.main.name && m.subject === '') ??
    c.metrics.find((m) => m.name === scenario.main.name);
  const row = (c: Case, t: Timing, first: boolean) =>
    el(
      'tr',
      { 'data-spec': c.spec, 'data-phase': t.phase },
      first ? el('th', { class: 'sticky', scope: 'row' }, labelOf(c.spec)) : el('td', { class: 'sticky' }),
      el('td', null, t.phase),
      durationCell(t.median),
      hasInterval ? [durationCell(t.low ?? null), durationCell(t.high ?? null)] : null,
      durationCell(t.p10),
      durationCell(t.p90),
      hasMean
        ? [
            durationCell(t.first ?? null),
            durationCell(t.mean ?? null),
            durationCell(t.p95 ?? null),
            durationCell(t.p99 ?? null),
            durationCell(t.worst ?? null),
            numberCell(t.realTimeFactor ?? null),
          ]
        : null,
      durationCell(t.total),
      el('td', { class: 'num' }, t.samples),
      numberCell(t.meanContacts),
      first ? numberCell(main(c)?.value ?? null, scenario.main.unit) : el('td'),
      el('td', null, first ? chip(c.shown) : ''),
    );
  const interval = hasInterval ? ['95 % from', 'to'] : [];
  const means = hasMean ? ['First', 'Mean', '95 %', '99 %', 'Worst', '× real time'] : [];
  const heads = [
    'Engine',
    'Phase',
    'Median',
    ...interval,
    '10 %',
    '90 %',
    ...means,
    'Total',
    'Samples',
    'Contacts',
    words(scenario.main.name || 'main metric'),
    'Verdict',
  ];
  return panel(
    'case-timing',
    'Cost, beside accuracy',
    hasMean
      ? el(
          'p',
          { class: 'muted small' },
          'Mean, 95 %, 99 % and worst are of all steps but the first, which stands apart; × real time is the time step over the mean.',
        )
      : null,
    scroll(
      el(
        'table',
        { class: 'full' },
        headRow(heads, (i) => i > 1 && i < heads.length - 1),
        el(
          'tbody',
          null,
          timed.map((c) => c.timings.map((t, i) => row(c, t, i === 0))),
        ),
      ),
    ),
  );
}
