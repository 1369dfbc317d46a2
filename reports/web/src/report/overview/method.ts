// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Method: the measurements, the meaning of the verdicts, the differences that cannot be matched, and the authors.
import { el } from '../../common/elements.ts';
import type { Shown } from '../data.ts';
import { run } from '../run.ts';
import { chip, gradeChip, panel } from '../widgets.ts';

const item = (head: string, text: string) => el('li', null, el('b', null, head), ' ', text);
const verdict = (shown: Shown, text: string) => el('li', null, chip(shown), text);

const measured: [string, string][] = [
  [
    'One scenario, all engines.',
    'A scenario is written once, in SI units. Each engine is given the same bodies, masses, pair friction and restitution; after the build, what it says it was given is read back and compared.',
  ],
  [
    'Presets.',
    '“default” is the engine as it ships, with the scenario’s pair values. “matched” turns sleeping, damping, clamps and margins off or down and uses the same friction and restitution law as nearly as the library allows. A preset that an engine offers for speed is a column of its own, with its errors beside its cost.',
  ],
  [
    'Exact and scheme-exact.',
    'Exact errors are distances from the physics: they measure accuracy. Scheme-exact errors are distances from what a perfect run of the engine’s own time-stepping formula gives at that time step: they find bugs. A simulator may be far from the first and on the second; the two are never mixed.',
  ],
  [
    'Recorded motions.',
    'Errors against a recorded motion of a real body are apart from both: the model, its coefficients and the instrument are in them.',
  ],
  [
    'Same measure.',
    'Energy, momentum and all errors are computed from the recorded states by one implementation, in double precision, for all engines.',
  ],
  [
    'Contacts.',
    'At sampled frames all collision engines and an exact oracle are queried at the same poses; the contacts that a run itself acted upon are held to the same oracle. Equally good normals count as equal.',
  ],
  ['One process per case.', 'An engine that aborts, hangs or returns NaN costs one cell of the table.'],
  [
    'Time.',
    'Wall time of a step by the monotonic clock: the median with its 95 % interval, always beside the accuracy of the same run.',
  ],
  [
    'Every number can be checked.',
    'The page holds thinned curves; full trajectories, every metric and every setting are in the run folder (results.sqlite, trajectories, results.csv), and each case shows the command that reproduces it. A number shows all its digits on hover.',
  ],
];

const cannot: [string, string][] = [
  [
    'Precision.',
    'A library built in single precision stays so. Grade A is what single precision can hold, so it is not graded down for that.',
  ],
  [
    'Laws.',
    'Some libraries know only a friction pyramid, a collision skin, a velocity clamp or their own restitution rule. The nearest setting is used and the difference is written into the parity ledger, which stands beside the numbers on every page.',
  ],
  [
    'Schemes.',
    'Engines integrate differently at the same time step; their work per step differs, too. So there are four ways to compare (engine defaults, matched settings, equal time, equal accuracy), and each is labelled.',
  ],
  [
    'Chaos.',
    'After many impacts two correct runs part. Such scenarios are compared by what is conserved, not by position.',
  ],
];

export function method(): HTMLElement {
  return panel(
    'method',
    'Method',
    el('h3', null, 'What is measured, and how'),
    el(
      'ul',
      null,
      measured.map(([head, text]) => item(head, text)),
    ),
    el('h3', null, 'Accuracy: the grade'),
    el(
      'p',
      null,
      'Every metric that compares with an exact solution or a known zero is divided by the scenario’s own scale of it: the distance gone, the angle turned, the largest speed, the energy turned over, ',
      'the time to the event, the size of the smallest body for gaps and overlaps. Scales come from the scenario and its exact solution, never from a run, and are the same for every engine and time step. ',
      'The worst of the metrics that the scenario names is its grade. Scenes without an exact solution have none.',
    ),
    el(
      'ul',
      { class: 'plain' },
      run.grades.map((g) => el('li', null, gradeChip(g.name), g.meaning)),
    ),
    el(
      'p',
      null,
      'Beside it stands the same number for an ideal run of the engine’s own time-stepping scheme, where that has a closed form. The error of a run is at most the ideal’s plus the distance between the two, so above twice the ideal’s ',
      'more of it is the engine’s own: “farther off than its scheme”. Up to that it is “as good as its scheme allows”; below half of it the run is not the scheme’s and happens to lie nearer.',
    ),
    el('h3', null, 'Regression: the record'),
    el(
      'p',
      null,
      'Each version of each engine has its numbers on record. A run is unchanged within 1 % of them and the rounding of its precision, else better or worse; of scenes without an exact solution the ending is compared. ',
      'A run is red where the in-house engine became worse, another engine lost a grade or an ending, or a case crashed, timed out or was not finite. This says nothing of accuracy.',
    ),
    el('h3', null, 'How a case ended'),
    el(
      'ul',
      { class: 'plain' },
      verdict('no_bound', 'it ran: how near it is to the physics is its grade'),
      verdict(
        'pass',
        'it ran within the bounds that its scenario sets; the library sets none, users may set their own',
      ),
      verdict(
        'known_deviation',
        'wrong physics (grade E: another law, another outcome), with the reason on file and whether that was isolated by experiment or is inferred',
      ),
      verdict(
        'no_reference',
        'it ran, but its reference did not finish, ran out of memory or crashed: neither a pass nor the engine’s fault',
      ),
      verdict('fail', 'a bound of the scenario was missed, or the built world is not the requested one'),
      verdict('non_finite', 'a state became NaN or infinite'),
      verdict('timeout', 'no end within the time limit'),
      verdict('crashed', 'the process died or ran out of memory'),
      verdict(
        'unsupported',
        'refused before it ran: what the scenario needs is not in the adapter yet (“not yet”), or the library does not have it by its own documentation, which is named (“n/a”)',
      ),
    ),
    el('h3', null, 'What cannot be matched'),
    el(
      'ul',
      null,
      cannot.map(([head, text]) => item(head, text)),
    ),
    el('h3', null, 'Conflict of interest'),
    el(
      'p',
      null,
      `The hosts of this comparison are the authors of one of the engines in it, ${run.inHouse}. Scenarios, references, adapters and presets were chosen by them. `,
      'Grades have the same limits for every engine, and none of them was taken from a result. Everything is in ',
      'the repository, and every column can be rerun and challenged with the commands given.',
    ),
  );
}
