// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Strengths and weaknesses, computed from the run: by mechanism, where the engine is among the best without a failure,
// and where it fails or is far from the best.
import { el } from '../../common/elements.ts';
import { duration, ratio } from '../../common/format.ts';
import type { Engine } from '../data.ts';
import { missText } from '../overview/trust.ts';
import { chip, panel } from '../parts.ts';
import { run } from '../run.ts';
import { type Summary, standings, within } from '../standing.ts';

const nearBest = 1.5; // times the best one's error: as good as the best for the choice of an engine
const farFromBest = 10;

interface Found {
  name: string;
  scenarios: number;
  summary: Summary;
}

function of(engine: Engine): Found[] {
  return run.mechanisms.flatMap((m) => {
    const scenarios = run.scenarios.filter((s) => m.scenarios.includes(s.name));
    return standings(scenarios, run.columns)
      .filter((s) => s.column.engine === engine.name && s.scenarios > 0)
      .map((summary) => ({ name: m.name, scenarios: scenarios.length, summary }));
  });
}

function text({ summary: s }: Found): string {
  const parts = [`${s.scenarios - s.bad.length - s.known.length} of ${s.scenarios} within all bounds`];
  if (Number.isFinite(s.ratio)) parts.push(`error ${ratio(s.ratio)} the best one’s`);
  if (Number.isFinite(s.cost)) parts.push(`${duration(s.cost)} a step`);
  return parts.join(', ');
}

export function strengths(engine: Engine): HTMLElement | null {
  const found = of(engine);
  if (found.length === 0) return null;
  const strong = found.filter((f) => within(f.summary) === 1 && f.summary.ratio < nearBest && f.summary.scenarios > 1);
  const weak = found.filter((f) => within(f.summary) < 1 || f.summary.ratio > farFromBest);
  const failing = (f: Found) => f.summary.bad.length / f.summary.scenarios;
  weak.sort(
    (a, b) => failing(b) - failing(a) || within(a.summary) - within(b.summary) || b.summary.ratio - a.summary.ratio,
  );
  strong.sort((a, b) => b.summary.scenarios - a.summary.scenarios);
  const presets = [...new Set(found.map((f) => f.summary.column))];
  const list = (items: Found[], isWeak: boolean) =>
    items.slice(0, 12).map((f) => {
      const miss = isWeak ? missText(f.summary) : null;
      const where = miss ? [', ', miss] : null;
      return el(
        'li',
        null,
        chip(f.summary.bad.length ? 'fail' : isWeak ? 'known_deviation' : 'pass', f.name),
        text(f),
        where,
      );
    });
  const more = (items: Found[]) =>
    items.length > 12 ? el('p', { class: 'small muted' }, `and ${items.length - 12} more`) : null;
  return panel(
    'strengths',
    'Strengths and weaknesses found',
    el(
      'p',
      { class: 'muted small' },
      `From this run alone, by mechanism. Strong: within all bounds in two scenarios or more, and typical errors within ×${nearBest} of the best engine. `,
      `Weak: a failure, a recorded deviation, or typical errors more than ×${farFromBest} the best one’s.`,
    ),
    presets.map((column) => {
      const mine = (items: Found[]) => items.filter((f) => f.summary.column === column);
      return el(
        'div',
        null,
        el('h3', null, column.label),
        el(
          'div',
          { class: 'split' },
          el(
            'div',
            null,
            el('div', { class: 'muted small' }, 'Strong'),
            el('ul', { class: 'plain' }, list(mine(strong), false)),
            mine(strong).length ? more(mine(strong)) : el('p', { class: 'empty' }, 'nothing stands out'),
          ),
          el(
            'div',
            null,
            el('div', { class: 'muted small' }, 'Weak'),
            el('ul', { class: 'plain' }, list(mine(weak), true)),
            mine(weak).length ? more(mine(weak)) : el('p', { class: 'empty' }, 'nothing found'),
          ),
        ),
      );
    }),
  );
}
