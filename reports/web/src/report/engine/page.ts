// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page of one engine. A section is one file and one line here, where it shall stand.
import { el } from '../../common/elements.ts';
import type { Engine } from '../data.ts';
import { run } from '../run.ts';
import { panel } from '../widgets.ts';
import { engineAudit } from './audit.ts';
import { capabilities } from './capabilities.ts';
import { deviations } from './deviations.ts';
import { engineHead } from './head.ts';
import { engineLedger } from './ledger.ts';
import { strengths } from './strengths.ts';

const sections: ((engine: Engine) => HTMLElement | null)[] = [
  engineHead,
  strengths,
  deviations,
  engineAudit,
  engineLedger,
  capabilities,
];

export function enginePage(name: string): HTMLElement[] {
  const engine = run.engines.find((e) => e.name === name);
  if (!engine) return [panel('missing', 'No such engine', el('p', null, `This run has no engine “${name}”.`))];
  return sections.map((section) => section(engine)).filter((node) => node !== null);
}
