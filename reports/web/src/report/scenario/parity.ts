// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { el } from '../../common/elements.ts';
import { ledgerTable } from '../ledger.ts';
import { labelOf } from '../run.ts';
import { chip, headRow, numberCell, panel, scroll } from '../widgets.ts';
import type { Context } from './context.ts';

/** The parity ledger of these cases, and what was read back from the engines. */
export function parity({ cases }: Context): HTMLElement | null {
  const rows = cases.flatMap((c) => c.ledger.map((l) => ({ ...l, label: labelOf(c.spec) })));
  const read = cases.filter((c) => c.readBack.compared);
  if (rows.length === 0 && read.length === 0) return null;
  const exact = rows.filter((l) => l.realisation === 'exact');
  const others = rows.filter((l) => l.realisation !== 'exact');
  const differing = read.flatMap((c) => c.readBack.differing.map((r) => ({ ...r, label: labelOf(c.spec) })));
  const compared = read.reduce((sum, c) => sum + c.readBack.compared, 0);
  const bad = read.reduce((sum, c) => sum + c.readBack.bad, 0);
  const readBack = [
    el('h3', null, 'Read back from the engines'),
    el(
      'p',
      null,
      `${compared} values compared (mass, inertia, pose, velocity, gravity, pair coefficients), `,
      bad ? chip('fail', `${bad} differ`) : chip('pass', 'all as the scenario says'),
    ),
  ];
  const differences = () =>
    el(
      'tbody',
      null,
      differing.map((r) =>
        el(
          'tr',
          null,
          el('th', { class: 'sticky', scope: 'row' }, r.label),
          el('td', null, r.quantity),
          el('td', null, r.subject),
          numberCell(r.expected),
          numberCell(r.found),
          numberCell(r.error),
        ),
      ),
    );
  return panel(
    'parity',
    'Parity: requested and realised',
    rows.length
      ? others.length
        ? scroll(ledgerTable(others, 'Engine'))
        : el('p', null, 'Every request was met exactly.')
      : null,
    exact.length
      ? el(
          'details',
          null,
          el('summary', null, `${exact.length} requests met exactly`),
          scroll(ledgerTable(exact, 'Engine')),
        )
      : null,
    read.length ? readBack : null,
    differing.length
      ? scroll(
          el(
            'table',
            null,
            headRow(['Engine', 'Quantity', 'Of', 'Expected', 'Found', 'Error'], (i) => i > 2),
            differences(),
          ),
        )
      : null,
  );
}
