// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Head of a scenario: its statement, the exact solution, the time steps, and the results of the engines.
import { type Child, el } from '../../common/elements.ts';
import { format, timeStep } from '../../common/format.ts';
import { formula } from '../formula.ts';
import { labelOf, run, scenarioLink, verdictText } from '../run.ts';
import { changeMark, facts, panel } from '../widgets.ts';
import type { Context } from './context.ts';
import { drawing } from './drawing.ts';
import { saveSingleFile } from './single_file.ts';

const tags = (names: string[]) => names.map((t) => el('span', { class: 'tag' }, t));

/** The scenario file; null for a text that is none, which is shown as it is stored. */
function parsed(text: string): Record<string, unknown> | null {
  try {
    return JSON.parse(text);
  } catch {
    return null;
  }
}

function prettyText(text: string): string {
  const file = parsed(text);
  return file === null ? text : JSON.stringify(file, null, 2);
}

/** "relative errors up to 1e-4: reason"; "" where the scenario names none. */
function negligibleText(text: string): string {
  const negligible = parsed(text)?.negligible_error as { value?: number; reason?: string } | undefined;
  return negligible ? `relative errors up to ${negligible.value} count as equal: ${negligible.reason}` : '';
}

function neighbours(index: number): Child {
  if (run.single) return null;
  const link = (offset: number, text: string) => {
    const s = run.scenarios[index + offset];
    return s ? [' · ', el('a', { href: scenarioLink(s.name), title: s.name }, text)] : null;
  };
  return el(
    'p',
    { class: 'small noprint' },
    el('a', { href: '#scoreboard' }, '← scoreboard'),
    link(-1, 'previous'),
    link(1, 'next'),
  );
}

function stepChoice({ scenario, steps, dt, spec }: Context): HTMLElement {
  const button = (step: number) =>
    el(
      'a',
      {
        class: 'button',
        role: 'button',
        'aria-pressed': String(step === dt),
        href: scenarioLink(scenario.name, { dt: step, spec }),
      },
      timeStep(step),
    );
  return el(
    'div',
    { class: 'controls' },
    el('span', { class: 'muted small' }, 'Time step'),
    el('span', { class: 'seg', role: 'group', 'aria-label': 'Time step' }, steps.map(button)),
  );
}

const saveButton = (context: Context): HTMLElement =>
  el(
    'button',
    {
      class: 'button',
      title: 'Save this scenario with its replay and all numbers as one file, to send or to keep',
      'data-action': 'save-page',
      onclick: () => void saveSingleFile(context),
    },
    '⤓ one file',
  );

export function head(context: Context): HTMLElement {
  const { scenario, data, index, dt, spec, cases } = context;
  const reference = scenario.reference
    ? [scenario.referenceTitle || scenario.reference, el('span', { class: 'muted' }, ` (${scenario.reference})`)]
    : 'none: engines are compared with each other';
  const rows: [string, Child][] = [
    ['Isolates', tags(scenario.isolates)],
    ['Reference', reference],
    ['Source', scenario.source],
    ['Of the reference', scenario.referenceSource === scenario.source ? '' : scenario.referenceSource],
    ['Negligible', negligibleText(data.text)],
    ['Observed', scenario.observed.join(', ')],
    ['Scene', `${scenario.dimension}D, ${format(scenario.duration)} s`],
    ['Tags', tags(scenario.tags)],
  ];
  const present = rows.filter(([, v]) => v && (v as { length?: number }).length !== 0);
  const math = formula(scenario.referenceTex ?? '', scenario.referenceFormula);
  return panel(
    'scenario',
    null,
    neighbours(index),
    el('h1', null, scenario.title || scenario.name),
    el('p', { class: 'muted' }, el('code', null, scenario.name), ` at ${timeStep(dt)}`),
    scenario.description ? el('p', null, scenario.description) : null,
    el(
      'div',
      { class: 'split' },
      el('div', null, facts(present), math ? [el('div', { class: 'muted small' }, 'Exact solution'), math] : null),
      drawing(context),
    ),
    scenario.referenceProblem
      ? el('p', { class: 'notice' }, `Run without a reference: ${scenario.referenceProblem}`)
      : null,
    el('div', { class: 'controls noprint' }, stepChoice(context), saveButton(context)),
    el(
      'div',
      { class: 'stats' },
      cases.map((c) =>
        el(
          'span',
          {
            class: `stat v ${c.judged.grade ? `g-${c.judged.grade}` : `v-${c.shown === 'pass' ? 'no_bound' : c.shown}`}${c.spec === spec ? ' focus' : ''}`,
            title: c.judged.says,
          },
          c.judged.grade || verdictText(c.shown).symbol,
          changeMark(c.judged.regression),
          ' ',
          labelOf(c.spec),
        ),
      ),
    ),
    el('details', null, el('summary', null, 'Scenario file as run'), el('pre', null, prettyText(data.text))),
  );
}
