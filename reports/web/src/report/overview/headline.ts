// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { type Child, el } from '../../common/elements.ts';
import { counted } from '../../common/format.ts';
import { labelOf, run, scenarioLink } from '../run.ts';
import { commandInText, panel } from '../widgets.ts';

/** Links to the first red cases. */
function redCases(): Child {
  const links = run.redCases.map(({ scenario, spec, dt }, i): Child => {
    const href = scenarioLink(scenario, { dt, spec });
    return [i ? ', ' : '', el('a', { href }, `${scenario} by ${labelOf(spec)}`)];
  });
  return [links, run.red > links.length ? ` and ${run.red - links.length} more` : ''];
}

/** Title, totals, unfinished parts, and authors. */
export function headline(): HTMLElement {
  const engines = new Set(run.columns.map((c) => c.engine));
  const program = run.command.split(' ')[0] || './rigor';
  const unfinished = run.planned > run.total || !run.finished;
  const graded = run.grades.filter((g) => g.name);
  const all = graded.reduce((sum, g) => sum + g.count, 0);
  const near = graded.filter((g) => g.name <= 'C').reduce((sum, g) => sum + g.count, 0);
  const stat = (key: string, ...children: Child[]) => el('span', { class: `stat v ${key}` }, children);
  return panel(
    'summary',
    null,
    el('h1', null, 'Rigor report', run.title ? `: ${run.title}` : ''),
    el(
      'div',
      { class: 'muted said' },
      run.started,
      run.finished ? ` – ${run.finished}` : '',
      run.command ? commandInText(run.command) : '',
    ),
    unfinished
      ? el('p', { class: 'notice' }, `This run is unfinished: ${run.total} of ${run.planned} cases are stored.`)
      : null,
    el(
      'p',
      null,
      `${counted(engines.size, 'engine')} in ${counted(run.columns.length, 'configuration')} ran ${counted(run.scenarios.length, 'scenario')}, each against the same reference. `,
      el('b', null, `${near} of ${all} graded runs are within a hundredth of the scenario’s own scale. `),
      run.red
        ? [
            `${counted(run.red, 'case')} ${run.red === 1 ? 'is' : 'are'} red, worse than on record or without an end: `,
            redCases(),
            '.',
          ]
        : run.symbols.unsupported?.count === run.total
          ? 'Nothing was judged: every case is unsupported.'
          : 'No case is red.',
    ),
    el(
      'div',
      { class: 'stats', 'data-count': 'accuracy' },
      el('span', { class: 'muted small' }, 'Accuracy'),
      run.grades.map((g) =>
        g.count ? stat(`g-${g.name || 'none'}`, el('b', null, g.name || '–', ' ', g.count), g.meaning) : null,
      ),
    ),
    el(
      'div',
      { class: 'stats', 'data-count': 'regression' },
      el('span', { class: 'muted small' }, 'Against the record of each version'),
      Object.entries(run.regressions).map(([name, count]) =>
        count ? stat(`r-${name.replace(' ', '-')}`, el('b', null, count), name) : null,
      ),
    ),
    el(
      'div',
      { class: 'stats', 'data-count': 'endings' },
      el('span', { class: 'muted small' }, 'Endings'),
      Object.entries(run.symbols)
        .filter(([, v]) => v.count)
        .map(([key, v]) =>
          el(
            'span',
            { class: `stat v v-${key}` },
            el('span', { 'aria-hidden': 'true' }, v.symbol),
            el('b', null, v.count),
            v.word,
            v.detail ? el('span', { class: 'muted' }, ` (${v.detail})`) : null,
          ),
        ),
    ),
    el(
      'p',
      { class: 'notice small' },
      `The authors of this comparison wrote one of the engines in it (${run.inHouse}). Every number comes with the command that `,
      'reproduces it; what could not be matched between engines is in the ',
      el('a', { href: '#ledger' }, 'parity ledger'),
      '; how everything is measured stands under ',
      el('a', { href: '#method' }, 'method'),
      '.',
    ),
    el(
      'p',
      { class: 'muted small' },
      'Two runs on one page, with what changed and their replays side by side: ',
      el('code', null, `${program} history EARLIER LATER --out FOLDER`),
      '. An engine of your own in this report: ',
      el('code', null, `${program} new engine NAME`),
      '.',
    ),
  );
}
