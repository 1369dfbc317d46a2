// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Lines of the parity ledger: requested value, realised value, reason.
import { el } from '../common/elements.ts';
import type { LedgerLine, Shown } from './data.ts';
import { scenarioLink } from './run.ts';
import { chip, looseHeadRow } from './widgets.ts';

const mark: Record<string, Shown> = { exact: 'pass', approximate: 'known_deviation', unsupported: 'unsupported' };

export interface LabelledLine extends LedgerLine {
  label: string; // label of the line's column
  scenarios?: string[]; // scenarios of a line gathered over a run
}

export function ledgerTable(rows: LabelledLine[], columnHead: string): HTMLElement {
  const gathered = rows.some((l) => l.scenarios);
  const heads = [columnHead, 'Topic', 'Requested', 'Resolved', 'How', 'Why', ...(gathered ? ['Scenarios'] : [])];
  const where = (names: string[]) =>
    el(
      'td',
      { class: 'small' },
      names.length > 3
        ? el(
            'details',
            null,
            el('summary', null, names.length),
            names.map((n) => el('div', null, el('a', { href: scenarioLink(n) }, n))),
          )
        : names.map((n, i) => [i ? ', ' : '', el('a', { href: scenarioLink(n) }, n)]),
    );
  return el(
    'table',
    { class: 'full' },
    looseHeadRow(heads),
    el(
      'tbody',
      null,
      rows.map((l) =>
        el(
          'tr',
          null,
          el('th', { scope: 'row' }, l.label),
          el('td', null, l.topic),
          el('td', null, l.requested),
          el('td', null, l.resolved),
          el('td', null, chip(mark[l.realisation] ?? 'no_bound', l.realisation)),
          el('td', { class: 'small claim' }, l.reason),
          gathered ? where(l.scenarios ?? []) : null,
        ),
      ),
    ),
  );
}
