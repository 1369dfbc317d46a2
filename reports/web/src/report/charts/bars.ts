// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bars with long names beside them, as elements: read aloud, printed and copied like a table.
import { el } from '../../common/elements.ts';

export interface Bar {
  label: string;
  value: number; // NaN: none
  low?: number;
  high?: number;
  text: string; // the value as it is said
  title?: string;
  colour?: string;
}

/** Logarithmic bars start at the decade below the least positive value. */
export function barScale(bars: Bar[], logarithmic: boolean): (value: number) => number {
  const ends = bars.flatMap((b) => [b.value, b.high ?? NaN]).filter(Number.isFinite);
  const most = Math.max(...ends, 0);
  if (!logarithmic) {
    const least = Math.min(...ends, ...bars.map((b) => b.low ?? NaN).filter(Number.isFinite), 0);
    return (v) => (most > least ? (v - least) / (most - least) : 0);
  }
  const start = 10 ** (Math.ceil(Math.log10(Math.min(...ends.filter((v) => v > 0)))) - 1);
  return (v) => (v > start && most > start ? Math.min(1, Math.log(v / start) / Math.log(most / start)) : 0);
}

export function barList(bars: Bar[], logarithmic: boolean, colour: string): HTMLElement {
  const place = barScale(bars, logarithmic);
  const percent = (v: number) => `${(100 * place(v)).toFixed(2)}%`;
  const row = (b: Bar) => {
    const from = percent(logarithmic ? 0 : Math.min(0, b.value));
    const to = percent(logarithmic ? b.value : Math.max(0, b.value));
    const fill = `left:${from};right:calc(100% - ${to});background:${b.colour ?? colour}`;
    const interval =
      Number.isFinite(b.low) && Number.isFinite(b.high)
        ? el('i', {
            class: 'interval',
            style: `left:${percent(b.low as number)};right:calc(100% - ${percent(b.high as number)})`,
          })
        : null;
    const track = el(
      'td',
      { class: 'track' },
      el('div', null, Number.isFinite(b.value) ? el('i', { style: fill }) : null, interval),
    );
    return el('tr', { title: b.title }, el('th', { scope: 'row' }, b.label), track, el('td', { class: 'num' }, b.text));
  };
  return el('table', { class: 'bars' }, el('tbody', null, bars.map(row)));
}
