// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { el } from '../../common/elements.ts';
import type { Shown } from '../data.ts';
import { panel } from '../parts.ts';
import { run } from '../run.ts';

/** Title, totals, what is unfinished, and who wrote this. */
export function headline(): HTMLElement {
  const engines = new Set(run.columns.map((c) => c.engine));
  const count = (shown: Shown) => run.symbols[shown]?.count ?? 0;
  const judged = run.total - count('unsupported') - count('no_bound');
  const unfinished = run.planned > run.total || !run.finished;
  const known = count('known_deviation');
  const verdict =
    judged > 0
      ? [
          el('b', null, `${count('pass')} of ${judged} judged cases are within their bounds`),
          known ? `, ${known} more deviate as recorded and explained.` : '.',
        ]
      : 'nothing was demanded of them, so errors can be compared but nothing passes or fails.';
  return panel(
    'summary',
    null,
    el('h1', null, 'Rigor report', run.suite ? `: ${run.suite}` : ''),
    el(
      'p',
      { class: 'muted' },
      run.started,
      run.finished ? ` – ${run.finished}` : '',
      run.command ? [' · ', el('code', null, run.command)] : '',
    ),
    unfinished
      ? el('p', { class: 'notice' }, `This run is unfinished: ${run.total} of ${run.planned} cases are stored.`)
      : null,
    el(
      'p',
      null,
      `${engines.size} engines in ${run.columns.length} configurations ran ${run.scenarios.length} scenarios, each against the same reference: `,
      verdict,
    ),
    el(
      'div',
      { class: 'stats' },
      Object.entries(run.symbols)
        .filter(([, v]) => v.count)
        .map(([key, v]) =>
          el(
            'span',
            { class: `stat v v-${key}` },
            el('span', { 'aria-hidden': 'true' }, v.symbol),
            el('b', null, v.count),
            v.word,
            v.detail ? el('span', { class: 'muted' }, ` (${v.detail})`) : null,
          ),
        ),
    ),
    el(
      'p',
      { class: 'notice small' },
      'The authors of this comparison wrote one of the engines in it (rigor). Every number comes with the command that ',
      'reproduces it; what could not be matched between engines is in the ',
      el('a', { href: '#ledger' }, 'parity ledger'),
      '; how everything is measured stands under ',
      el('a', { href: '#method' }, 'method'),
      '.',
    ),
  );
}
