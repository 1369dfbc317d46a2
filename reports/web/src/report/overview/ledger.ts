// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { el } from '../../common/elements.ts';
import { ledgerTable } from '../ledger.ts';
import { run } from '../run.ts';
import { panel, scroll } from '../widgets.ts';

/** The parity ledger over all scenarios. */
export function ledgerSummary(): HTMLElement {
  const holder = el('div');
  let all = false;
  const draw = () => {
    const rows = run.ledger
      .filter((l) => all || l.realisation !== 'exact')
      .map((l) => ({ ...l, label: `${l.engine} ${l.preset}` }));
    button.setAttribute('aria-pressed', String(all));
    holder.replaceChildren(
      rows.length
        ? scroll(ledgerTable(rows, 'Engine'))
        : el('p', { class: 'empty' }, 'Nothing: every request was met exactly.'),
    );
  };
  const toggle = () => {
    all = !all;
    draw();
  };
  const button = el('button', { class: 'button noprint', onclick: toggle }, 'Show what was matched exactly too');
  draw();
  const exact = run.ledger.filter((l) => l.realisation === 'exact').length;
  return panel(
    'ledger',
    'Parity ledger',
    el(
      'p',
      { class: 'muted' },
      'Requests of the scenarios that an engine could not meet, or met differently. Read it before comparing two columns. ',
      `${exact} of ${run.ledger.length} entries are exact.`,
    ),
    button,
    holder,
  );
}
