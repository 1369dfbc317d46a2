// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { el } from '../../common/elements.ts';
import { type Maybe, shownUnit, toNumber, words } from '../../common/format.ts';
import { labelOf } from '../run.ts';
import { headRow, numberCell, panel, scroll } from '../widgets.ts';
import type { Context } from './context.ts';

const difference = (a: Maybe, b: Maybe): Maybe => (a === null || b === null ? null : toNumber(a) - toNumber(b));

/** The exact number beside what each engine measured and what its own scheme should have given. */
export function quantities({ cases }: Context): HTMLElement | null {
  const names = [...new Set(cases.flatMap((c) => c.quantities.map((q) => q.name)))];
  if (names.length === 0) return null;
  const group = (name: string) => {
    const rows = cases.flatMap((c) => c.quantities.filter((q) => q.name === name).map((q) => ({ spec: c.spec, q })));
    const unit = rows[0]?.q.unit ?? '';
    const head = words(name) + (unit && unit !== '1' ? ` [${shownUnit(unit)}]` : '');
    const never = el('td', { class: 'num muted', title: 'did not happen in this run' }, 'never');
    return el(
      'tbody',
      { 'data-quantity': name },
      el('tr', { class: 'sub' }, el('th', { colspan: 6 }, head)),
      rows.map(({ spec, q }) =>
        el(
          'tr',
          { 'data-spec': spec },
          el('th', { class: 'sticky', scope: 'row' }, labelOf(spec)),
          numberCell(q.exact, unit),
          q.measured === null ? never.cloneNode(true) : numberCell(q.measured, unit),
          numberCell(difference(q.measured, q.exact), unit),
          numberCell(q.schemeExact, unit),
          numberCell(difference(q.measured, q.schemeExact), unit),
        ),
      ),
    );
  };
  const heads = ['Engine', 'Exact', 'Measured', 'Measured − exact', 'Scheme-exact', 'Measured − scheme-exact'];
  return panel(
    'quantities',
    'Quantities: exact, scheme-exact, measured',
    el(
      'p',
      { class: 'muted' },
      'Exact is the physics. Scheme-exact is what a perfect run of the engine’s own time-stepping formula gives at this time step, where that has a closed form.',
    ),
    scroll(
      el(
        'table',
        null,
        headRow(heads, (i) => i > 0),
        names.map(group),
      ),
    ),
  );
}
