// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { type Child, el } from '../../common/elements.ts';
import { duration, toNumber } from '../../common/format.ts';
import type { Case } from '../data.ts';
import { labelOf } from '../run.ts';
import { chip, command, facts, panel } from '../widgets.ts';
import type { Context } from './context.ts';

/** The command behind each number, with the settings that the engine resolved. */
export function commands({ cases, spec }: Context): HTMLElement {
  const process = (c: Case): [string, Child][] => [
    ['Spec', c.spec],
    ['Outcome', c.outcome + (c.reason ? `: ${c.reason}` : '')],
    ['Steps', c.steps],
    ['Wall, CPU time', `${duration(c.wallSeconds)}, ${duration(c.cpuSeconds)}`],
    ['Peak memory', `${(toNumber(c.peakMemoryKiB) / 1024).toFixed(1)} MiB`],
    ['Final state hash', c.stateHash || '—'],
    ['Trajectory', c.trajectoryFile || 'none'],
    ...Object.entries(c.settings),
  ];
  const item = (c: Case) =>
    el(
      'div',
      { class: 'case', 'data-spec': c.spec },
      el('h3', null, labelOf(c.spec), ' ', chip(c.shown)),
      c.command ? command(c.command) : el('p', { class: 'empty' }, 'No command was stored.'),
      el('details', { open: c.spec === spec }, el('summary', null, 'Settings and process'), facts(process(c))),
    );
  return panel('commands', 'Reproduce each number', cases.map(item));
}
