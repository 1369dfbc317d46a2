// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { el } from '../../common/elements.ts';
import { engineLink, run } from '../run.ts';
import { chip, facts, headRow, panel, scroll } from '../widgets.ts';

export function engines(): HTMLElement {
  const rows = run.engines.map((e) =>
    el(
      'tr',
      null,
      el(
        'th',
        { class: 'sticky', scope: 'row' },
        el('a', { href: engineLink(e.name) }, e.name),
        e.title && e.title !== e.name ? el('span', { class: 'bound' }, e.title) : null,
      ),
      el('td', null, e.version),
      el('td', null, e.precision),
      el('td', { class: 'small' }, e.buildNotes),
      el('td', null, e.problem ? chip('crashed', e.problem) : ''),
    ),
  );
  return panel(
    'engines',
    'Engines and environment',
    scroll(
      el(
        'table',
        { class: 'full' },
        headRow(['Engine', 'Version', 'Precision', 'Build', 'Problem']),
        el('tbody', null, rows),
      ),
    ),
    el('h3', null, 'Environment'),
    facts(Object.entries(run.environment)),
  );
}
