// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The study that a run was made for: what was found, and each part as charts and as a table.
import { el } from '../../common/elements.ts';
import type { Study } from '../data.ts';
import { study } from '../run.ts';
import { panel } from '../widgets.ts';
import { studyChart } from './charts.ts';
import { findings, rowsTable, symptoms } from './tables.ts';

function partNode(all: Study, part: Study['parts'][number]): HTMLElement | null {
  if (part.rows.length === 0) return null;
  const charts = all.charts.filter((c) => c.part === part.name).map(studyChart);
  return el(
    'div',
    { class: 'study-part', 'data-part': part.name, id: `part-${part.name}` },
    el('h3', null, part.title || part.name),
    part.description ? el('p', { class: 'muted' }, part.description) : null,
    el('div', { class: 'charts' }, charts),
    el(
      'details',
      { open: charts.length === 0 },
      el('summary', null, `Table: ${part.rows.length} runs`),
      rowsTable(part.rows),
    ),
  );
}

export function studySection(): HTMLElement | null {
  if (study === null) return null;
  const all = study;
  return panel(
    'study',
    all.title || all.name,
    all.description ? el('p', null, all.description) : null,
    findings(all),
    symptoms(all),
    all.parts.map((part) => partNode(all, part)),
  );
}
