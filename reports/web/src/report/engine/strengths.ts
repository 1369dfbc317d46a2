// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Strengths and weaknesses, from the run's own rankings: by mechanism, where the engine is near the exact solutions and
// among the best, and where it is wrong or far from the best.
import { el } from '../../common/elements.ts';
import { duration, ratio, toNumber } from '../../common/format.ts';
import type { Engine, Mechanism } from '../data.ts';
import { wrongText } from '../overview/trust.ts';
import { type Placed, placed, wrongCount as wrong } from '../ranking.ts';
import { run } from '../run.ts';
import { gradeChip, panel } from '../widgets.ts';

const nearBest = 1.5; // times the best one's error: as good as the best for the choice of an engine
const farFromBest = 10;

interface Found {
  mechanism: Mechanism;
  ranking: Placed;
}

const of = (engine: Engine): Found[] =>
  run.mechanisms.flatMap((mechanism) =>
    placed(mechanism, run.columns)
      .filter((s) => s.column.engine === engine.name)
      .map((ranking) => ({ mechanism, ranking })),
  );

function text({ ranking: s }: Found): string {
  const parts = [`${s.within} of ${s.scenarios} within a hundredth`];
  if (ratio(s.toBest)) parts.push(`error ${ratio(s.toBest)} the best one’s, ${ratio(s.toOurs) || 'unknown'} ours`);
  if (toNumber(s.cost) > 0) parts.push(`${duration(s.cost)} a step`);
  return parts.join(', ');
}

export function strengths(engine: Engine): HTMLElement | null {
  const found = of(engine);
  if (found.length === 0) return null;
  const strong = found.filter(
    ({ ranking: s }) => s.within === s.scenarios && s.scenarios > 1 && toNumber(s.toBest) < nearBest,
  );
  const weak = found.filter(({ ranking: s }) => wrong(s) > 0 || toNumber(s.toBest) > farFromBest);
  weak.sort(
    ({ ranking: a }, { ranking: b }) =>
      wrong(b) / b.scenarios - wrong(a) / a.scenarios || toNumber(b.toBest) - toNumber(a.toBest),
  );
  strong.sort((a, b) => b.ranking.scenarios - a.ranking.scenarios);
  const presets = [...new Set(found.map((f) => f.ranking.column))];
  const list = (items: Found[], isWeak: boolean) =>
    items.slice(0, 12).map((f) => {
      const miss = isWeak ? wrongText(f.mechanism, f.ranking) : null;
      const where = miss ? [', ', miss] : null;
      return el('li', null, gradeChip(wrong(f.ranking) ? 'E' : isWeak ? 'D' : 'A', f.mechanism.name), text(f), where);
    });
  const more = (items: Found[]) =>
    items.length > 12 ? el('p', { class: 'small muted' }, `and ${items.length - 12} more`) : null;
  return panel(
    'strengths',
    'Strengths and weaknesses found',
    el(
      'p',
      { class: 'muted small' },
      `From this run alone, by mechanism. Strong: grade C or better in all of two scenarios or more, and typical errors within ×${nearBest} of the best engine’s. `,
      `Weak: a run of grade E or lost, or typical errors more than ×${farFromBest} the best one’s.`,
    ),
    presets.map((column) => {
      const mine = (items: Found[]) => items.filter((f) => f.ranking.column === column);
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
