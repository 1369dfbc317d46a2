// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { type Child, el } from '../../common/elements.ts';
import { duration, ratio } from '../../common/format.ts';
import type { Engine } from '../data.ts';
import { wrongText } from '../overview/trust.ts';
import { type Placed, placed } from '../ranking.ts';
import { engineLink, run } from '../run.ts';
import { chip, facts, gradeBar, headRow, panel, scroll } from '../widgets.ts';

/** Identity of an engine, and the results of its columns over all scenarios. */
export function engineHead(engine: Engine): HTMLElement {
  const list = placed(run.overall, run.columns).filter((s) => s.column.engine === engine.name);
  const others = run.engines.filter((e) => e !== engine);
  const rows: [string, Child][] = [
    ['Version', engine.version],
    ['Precision', engine.precision],
    ['Build', engine.buildNotes],
  ];
  const row = (s: Placed) =>
    el(
      'tr',
      null,
      el('th', { class: 'sticky', scope: 'row' }, s.column.label),
      el('td', { class: 'num' }, `${s.scenarios} of ${run.scenarios.length}`),
      el('td', null, gradeBar(s.grades)),
      el('td', { class: 'num' }, s.lost ? chip('fail', s.lost) : 0),
      el('td', { class: 'num' }, s.known ? chip('known_deviation', s.known) : 0),
      el('td', { class: 'num' }, s.farther),
      el('td', { class: 'num' }, ratio(s.toBest) || '—'),
      el('td', { class: 'num' }, ratio(s.toOurs) || '—'),
      el('td', { class: 'num' }, duration(s.cost)),
      el('td', { class: 'num' }, ratio(s.costRatio) || '—'),
      el('td', { class: 'small' }, wrongText(run.overall, s)),
    );
  const heads = [
    'As',
    'Scenarios it can run',
    'Grades of accuracy',
    'Lost',
    'Wrong physics, explained',
    'Farther than its scheme',
    'Error × the best',
    'Error × ours',
    'Median of a step',
    'Cost × the fastest',
    'Grade E, or lost',
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
    engine.name === run.inHouse
      ? el('p', { class: 'notice small' }, 'This is the engine of the authors of this comparison.')
      : null,
    facts(rows.filter(([, v]) => v)),
    list.length
      ? scroll(
          el(
            'table',
            { class: 'full' },
            headRow(heads, (i) => i > 0 && i !== 2 && i < 10),
            el('tbody', null, list.map(row)),
          ),
        )
      : el(
          'p',
          { class: 'muted' },
          'It has no column of its own in this run: it takes part as a collision engine, or was not requested.',
        ),
  );
}
