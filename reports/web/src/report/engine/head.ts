// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { type Child, el } from '../../common/elements.ts';
import { duration, format, ratio } from '../../common/format.ts';
import type { Engine } from '../data.ts';
import { chip, facts, headRow, panel, scroll } from '../parts.ts';
import { engineLink, run, scenarioLink } from '../run.ts';
import { standings } from '../standing.ts';

/** What it is, and how its columns did over all scenarios. */
export function engineHead(engine: Engine): HTMLElement {
  const columns = run.columns.filter((c) => c.engine === engine.name);
  const list = standings(run.scenarios, run.columns).filter((s) => columns.includes(s.column));
  const others = run.engines.filter((e) => e !== engine);
  const rows: [string, Child][] = [
    ['Version', engine.version],
    ['Precision', engine.precision],
    ['Build', engine.buildNotes],
  ];
  const row = (s: (typeof list)[number]) =>
    el(
      'tr',
      null,
      el('th', { class: 'sticky', scope: 'row' }, s.column.label),
      el('td', { class: 'num' }, `${s.scenarios} of ${run.scenarios.length}`),
      el('td', { class: 'num' }, s.bad.length ? chip('fail', s.bad.length) : s.scenarios ? chip('pass', 0) : '—'),
      el('td', { class: 'num' }, s.known.length ? chip('known_deviation', s.known.length) : 0),
      el('td', { class: 'num' }, ratio(s.ratio) || '—'),
      el('td', { class: 'num' }, Number.isFinite(s.inBounds) ? `${format(100 * s.inBounds, 3)} %` : '—'),
      el('td', { class: 'num' }, duration(s.cost)),
      el('td', { class: 'num' }, ratio(s.costRatio) || '—'),
      el(
        'td',
        { class: 'small' },
        s.bad
          .slice(0, 6)
          .map((b, i) => [i ? ', ' : '', el('a', { href: scenarioLink(b.name, { spec: s.column.spec }) }, b.name)]),
        s.bad.length > 6 ? ` and ${s.bad.length - 6} more` : '',
      ),
    );
  const heads = [
    'As',
    'Scenarios it can run',
    'Fails in',
    'Off as recorded in',
    'Error against the best',
    'Error, median of the bound',
    'Median of a step',
    'Against the fastest',
    'Where it fails',
  ];
  return panel(
    'engine',
    null,
    el(
      'p',
      { class: 'small noprint' },
      el('a', { href: '#engines' }, '← overview'),
      others.map((e) => [' · ', el('a', { href: engineLink(e.name) }, e.name)]),
    ),
    el('h1', null, engine.title || engine.name),
    engine.problem ? el('p', { class: 'notice' }, engine.problem) : null,
    engine.name === 'rigor'
      ? el('p', { class: 'notice small' }, 'This is the engine of the authors of this comparison.')
      : null,
    facts(rows.filter(([, v]) => v)),
    list.length
      ? scroll(
          el(
            'table',
            { class: 'full' },
            headRow(heads, (i) => i > 0 && i < 8),
            el('tbody', null, list.map(row)),
          ),
        )
      : el(
          'p',
          { class: 'muted' },
          'It has no column of its own in this run: it takes part as a collision engine, or was not asked.',
        ),
  );
}
