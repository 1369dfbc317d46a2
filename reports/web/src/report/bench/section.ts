// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The bench: what it means, what became of it since a baseline, and everything that was timed.
import { type Child, el } from '../../common/elements.ts';
import { duration, format } from '../../common/format.ts';
import type { Bench, BenchChange } from '../data.ts';
import { run } from '../run.ts';
import { commandInText, facts, folded, headRow, panel, scroll } from '../widgets.ts';
import { labelOf, specKey } from './groups.ts';
import { subjectsNode } from './subject.ts';

function changes(bench: Bench): Child {
  if (bench.changes.length === 0) return null;
  const order = ['slower', 'faster', 'same', 'not compared'];
  const sorted = [...bench.changes].sort((a, b) => order.indexOf(a.verdict) - order.indexOf(b.verdict));
  const row = (change: BenchChange) => {
    const c = bench.cases.find((x) => x.id === change.id);
    const compared = change.verdict !== 'not compared';
    const cells = compared
      ? [
          duration(change.before),
          duration(change.after),
          format(change.ratio, 4),
          `${format(change.low, 4)} … ${format(change.high, 4)}`,
          format(change.p, 2),
        ]
      : ['—', '—', '—', '—', '—'];
    return el(
      'tr',
      { class: `change-${change.verdict.replace(' ', '-')}` },
      el('th', { class: 'sticky', scope: 'row' }, c ? `${c.name}, ${format(c.size)}: ${labelOf(c)}` : change.id),
      cells.map((text) => el('td', { class: 'num' }, text)),
      el('td', null, change.verdict + (change.reason ? `: ${change.reason}` : '')),
    );
  };
  return [
    el('h3', null, 'Since ', el('code', null, bench.settings.baseline ?? 'the baseline')),
    el(
      'p',
      { class: 'muted' },
      'Ratio of the medians, after / before, with its 95 % interval by bootstrap; p of Mann and Whitney’s test, corrected for the number of cases (Holm).',
    ),
    scroll(
      el(
        'table',
        { class: 'full' },
        headRow(['What', 'Before', 'After', 'Ratio', '95 %', 'p', 'Verdict'], (i) => i > 0 && i < 6),
        el('tbody', null, sorted.map(row)),
      ),
    ),
  ];
}

function meaning(bench: Bench): Child {
  const { settings } = bench;
  const width = format(100 * Number(settings.width ?? NaN), 3);
  const slow = settings.build && settings.build !== 'optimised';
  return [
    slow
      ? el('p', { class: 'notice' }, `This program was ${settings.build}: these times say nothing about the engines.`)
      : null,
    el(
      'p',
      { class: 'notice small' },
      `The authors of this bench wrote one of the engines in it, ${run.inHouse}. Every time comes with the command that takes it again, and is struck out where the run it was taken from was not good enough.`,
    ),
    el(
      'p',
      null,
      'Every repetition is a process of its own, and no other one runs beside it. In each round every engine runs once, in an order drawn by lot (seed ',
      settings.seed ?? '?',
      `); rounds go on until the 95 % interval of each median is narrower than ${width} % of it, or the budget is used up (then: wide). `,
      'Median: over the repetitions, of the median step of each. CPU time of all threads for one thread, wall time for more. ',
      'Ratio: time over the base’s time in the same round, the median over rounds with its interval; invalid times enter none. ',
      'Memory: what the process grew by since the engine began to build its world. Allocations: calls of the C library’s allocator in a step, counted in a repetition of its own; ',
      'pools inside an engine are not seen. Contacts and pairs are what the engine reports for the timed steps: engines that keep fewer points for the same scene do less work, and those with bodies asleep leave these out of their steps.',
    ),
    bench.cases.some((c) => c.part !== 'scene')
      ? el(
          'p',
          null,
          'Isolated parts run apart from the rest of their engine: the same boxes, pairs and exported contacts for all, in the engine’s own numbers, conversions outside of the clock. ',
          'What they find is checked after the clock has stopped: pairs against those of all boxes, depths against an exact oracle, impulses against the contact law. ',
          'Broad phases do their work in bursts: theirs are means over the updates of a repetition.',
        )
      : null,
  ];
}

const fewSpecs = 12;

/** Legend of the short names. */
function specs(bench: Bench): Child {
  const key = specKey(bench.cases);
  const list = () => facts(key.map(([label, spec]): [string, Child] => [label, el('code', null, spec)]));
  if (key.length === 0) return null;
  return key.length > fewSpecs ? folded('Engines in full', list) : [el('h3', null, 'Engines in full'), list()];
}

export function benchSection(): HTMLElement | null {
  const { bench } = run;
  if (!bench) return null;
  return panel(
    'bench',
    null,
    el('h1', null, 'Rigor bench'),
    run.command ? el('div', { class: 'muted said' }, run.started, commandInText(run.command)) : null,
    meaning(bench),
    el('h2', null, 'Times and work'),
    specs(bench),
    changes(bench),
    subjectsNode(bench),
    el('p', { class: 'muted' }, 'Machine and builds: ', el('a', { href: '#engines' }, 'engines and environment'), '.'),
  );
}
