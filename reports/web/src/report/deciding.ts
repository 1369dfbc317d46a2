// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Names of the numbers in a row of the scoreboard: the metric that decides, and which of the named quantities.
import { words } from '../common/format.ts';
import type { Scenario } from './data.ts';

const mostQuantities = 2; // named in a row

/** "stop time, stop distance": what a metric is largest for in the cases of a scenario. */
function quantitiesText(subjects: (string | undefined)[]): string {
  const named = [...new Set(subjects.filter((x): x is string => Boolean(x)))];
  const text = named.slice(0, mostQuantities).map(words).join(', ');
  return named.length > mostQuantities ? `${text}, …` : text;
}

/** The main metric; of an error of named quantities, which ones. */
export function mainText(s: Scenario): string {
  const which = s.main.name.endsWith('quantity_error') ? quantitiesText(s.cases.map((c) => c.subject)) : '';
  return which ? `error of ${which}` : words(s.main.name);
}

/** "relative error: stop time": the metrics that decide the grades of a row. */
export function decidingText(s: Scenario): string {
  const by = [...new Set(s.cases.map((c) => c.judged.by).filter(Boolean))];
  const parts = by.slice(0, mostQuantities).map((name) => {
    const own = s.cases.filter((c) => c.judged.by === name).map((c) => c.judged.of);
    return (name.endsWith('quantity_error') && quantitiesText(own)) || words(name);
  });
  return `relative error: ${parts.join('; ')}${by.length > mostQuantities ? '; …' : ''}`;
}
