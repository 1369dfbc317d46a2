// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Terms of the report, each with its meaning in one line: shown on hover, and all together under "Glossary". Metrics and
// their formulas are read from the table that computes them.
import metricTable from '../../../../validation/metrics/metrics.def';

export interface Term {
  name: string; // as shown
  meaning: string;
  formula?: string;
}

export const termPrefix = 'term-';
/** Id of the entry of a term or metric in the glossary: its address is "#" and this. */
export const termId = (name: string): string => `${termPrefix}${name.replaceAll(/[^\w]+/g, '-')}`;

/** Words of headings and legends, in lower case where they are looked up. */
export const terms: Term[] = [
  { name: 'Accuracy', meaning: 'How near a run is to the physics; says nothing on whether it changed.' },
  {
    name: 'Grade',
    meaning:
      'Class of accuracy, one bound for all scenarios: A 1e-6, B 1e-4, C 1e-2, D 1e-1 of the scenario’s own scale, E beyond.',
  },
  { name: 'Grades', meaning: 'How many scenarios have which grade, A to E.' },
  {
    name: 'Relative error',
    meaning: 'The worst error over the metrics that the scenario names, each over the scenario’s own scale.',
  },
  {
    name: '× best',
    meaning:
      'Relative error over that of the most accurate engine; errors within grade A, or within what the scenario calls negligible, count as equal.',
  },
  { name: '× ours', meaning: 'Relative error over that of the in-house engine in the same preset.' },
  {
    name: 'Preset',
    meaning: 'Settings of an engine: as it ships (default), as alike as the libraries allow (matched), or for speed.',
  },
  {
    name: 'Ending',
    meaning: 'Whether the run completed and kept the bounds that hold everywhere or that its scenario sets.',
  },
  {
    name: 'Record',
    meaning: 'Stored values of the same version of an engine; a run may be worse (▼) or better (▲) than them.',
  },
  {
    name: 'Against the record',
    meaning: 'Whether the run changed against the stored values of the same version of the engine.',
  },
  { name: 'Known deviation', meaning: 'Wrong physics whose reason is on file.' },
  { name: 'Exact solution', meaning: 'Closed form or converged solution of the physics that a run is compared with.' },
  {
    name: 'Scheme-exact',
    meaning:
      'What a perfect run of the engine’s own time-stepping formula gives at this time step; a distance from it is a bug.',
  },
  { name: 'Mechanism', meaning: 'The one effect of physics or numerics that a scenario isolates.' },
  { name: 'Isolates', meaning: 'The effects of physics or numerics that the scenario isolates.' },
  { name: 'Task', meaning: 'A purpose, such as stacks or joints, and the scenarios that test it.' },
  { name: 'Time step', meaning: 'Simulated time of one step [s].' },
  { name: 'Step', meaning: 'Time that one step takes to compute, the median.' },
  { name: 'Median of a step', meaning: 'Wall time of one step: half of the steps took less.' },
  { name: 'Mean', meaning: 'Mean wall time of a step without the first one.' },
  { name: '95 %', meaning: 'Interval that holds the median with a probability of 95 %.' },
  {
    name: 'Real-time factor',
    meaning: 'Time step over the mean time of computing it: above 1 is faster than real time.',
  },
  { name: 'Order', meaning: 'Observed order of convergence: the slope of ln error over ln time step.' },
  {
    name: 'Parity ledger',
    meaning: 'List of the settings that could not be made the same in all engines, with the reason.',
  },
  {
    name: 'Contact audit',
    meaning: 'Contacts of a run, and of every collision engine at the same poses, against the exact oracle.',
  },
  { name: 'Normal', meaning: 'Unit vector of a contact, from body A to body B.' },
  { name: 'Normal, worst', meaning: 'Largest angle between a contact normal and the nearest exact one [°].' },
  { name: 'Depth', meaning: 'Overlap of two shapes along the normal [m]; exact: the shortest way to part them.' },
  { name: 'Depth, worst', meaning: 'Largest difference between a reported overlap and the exact one [m].' },
  { name: 'Depth, worst [m]', meaning: 'Largest difference between a reported overlap and the exact one.' },
  { name: 'Point, worst [m]', meaning: 'Largest distance of a contact point from the surface that it should be on.' },
  { name: 'Witness points', meaning: 'The two points, one on each body, between which distance or depth is measured.' },
  { name: 'Missed', meaning: 'Overlaps deeper than 1 µm that were reported as none.' },
  { name: 'Spurious', meaning: 'Overlaps that were reported of shapes more than 1 µm apart.' },
  { name: 'Undecided', meaning: 'Pairs of shapes for which no exact method is known.' },
  { name: 'Wrong', meaning: 'Overlaps that were missed or invented.' },
  { name: 'Blink', meaning: 'Share of steps in which a touching pair lost its contact for just that step.' },
  {
    name: 'Order of insertion',
    meaning: 'Order in which bodies, shapes, joints and forces are handed to the engine: it should not matter.',
  },
  { name: 'Fairness', meaning: 'Four ways to compare: as shipped, matched settings, equal time, equal accuracy.' },
  {
    name: 'Angle',
    meaning: 'All angles of the pages are in degrees, angular velocities in rad/s; stored values are in radians.',
  },
];

/** METRIC(name, function, "title", "unit", kind, "formula"): a text may go on over lines. */
function metricsOf(table: string): Map<string, Term> {
  const text = '((?:"[^"]*"\\s*)+)';
  const entry = new RegExp(`METRIC\\(\\s*(\\w+),\\s*\\w+,\\s*${text},\\s*${text},\\s*\\w+,\\s*${text}\\)`, 'g');
  const joined = (parts: string) => [...parts.matchAll(/"([^"]*)"/g)].map((m) => m[1]).join('');
  const found = new Map<string, Term>();
  for (const [, name = '', title = '', , formula = ''] of table.matchAll(entry))
    found.set(name, { name, meaning: joined(title), formula: joined(formula) });
  return found;
}

/** Metrics by name. */
export const metricTerms = metricsOf(metricTable);

const known = new Map(terms.map((t) => [t.name.toLowerCase(), t.meaning]));

/** Meaning of a term or of a metric, in one line; undefined for a word that needs none. */
export function meaningOf(name: string): string | undefined {
  const metric = metricTerms.get(name.replaceAll(' ', '_'));
  return metric ? `${metric.meaning}: ${metric.formula}` : known.get(name.toLowerCase());
}
