// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { el } from '../../common/elements.ts';
import { words } from '../../common/format.ts';
import { metricTerms, type Term, termId, terms } from '../glossary_terms.ts';
import { run } from '../run.ts';
import { panel } from '../widgets.ts';

const entry = ({ name, meaning, formula }: Term) => [
  el('dt', { id: termId(name), tabindex: -1 }, words(name)),
  el('dd', null, meaning, formula ? el('div', { class: 'small muted formula' }, formula) : null),
];

/** All terms, then the metrics that this run has, then the others. */
export function glossary(): HTMLElement {
  const used = new Set(run.scenarios.flatMap((s) => s.metrics));
  const metrics = [...metricTerms.values()];
  const named = [...terms].sort((a, b) => a.name.localeCompare(b.name));
  const list = (of: Term[]) => el('dl', { class: 'glossary' }, of.map(entry));
  return panel(
    'glossary',
    'Glossary',
    el('p', { class: 'muted' }, 'The same lines are shown where the pointer rests on a term with dots below it.'),
    list(named),
    el('h3', null, 'Metrics that scenarios of this run name'),
    list(metrics.filter((m) => used.has(m.name))),
    el('h3', null, 'Other metrics'),
    list(metrics.filter((m) => !used.has(m.name))),
  );
}
