// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { el } from '../../common/elements.ts';
import type { Engine } from '../data.ts';
import { ledgerTable } from '../ledger.ts';
import { run } from '../run.ts';
import { panel, scroll } from '../widgets.ts';

/** The parity ledger of one engine over all scenarios. */
export function engineLedger(engine: Engine): HTMLElement | null {
  const rows = run.ledger.filter((l) => l.engine === engine.name).map((l) => ({ ...l, label: l.preset }));
  if (rows.length === 0) return null;
  const exact = rows.filter((l) => l.realisation === 'exact');
  const others = rows.filter((l) => l.realisation !== 'exact');
  return panel(
    'engine-ledger',
    'Parity ledger',
    others.length ? scroll(ledgerTable(others, 'Preset')) : el('p', null, 'Every request was met exactly.'),
    exact.length
      ? el(
          'details',
          null,
          el('summary', null, `${exact.length} kinds of requests met exactly`),
          scroll(ledgerTable(exact, 'Preset')),
        )
      : null,
  );
}
