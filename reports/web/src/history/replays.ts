// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The runs of one case side by side: one clock and one camera for all of them.
import { newCursor } from '../common/cursor.ts';
import { loadData, loadJson } from '../common/data_files.ts';
import { el } from '../common/elements.ts';
import type { Json } from '../replay/json.ts';
import { mountTogether, type ReplayHandle } from '../replay/mount.ts';
import type { HistoryRun, Pair, Series } from './data.ts';
import { caseAt, caseKey, firstMoment, ownName } from './series.ts';

/** Runs of a case that have a replay with its frames. */
const replaysOf = (s: Series) =>
  s.replay.flatMap((name, run) => (name === null || s.outcome[run] === 'unsupported' ? [] : [{ name, run }]));

/** Cases of which two runs have a replay. */
export const replayable = (all: readonly Series[]): Series[] =>
  all.filter((s) => s.scene !== null && replaysOf(s).length > 1);

let current: ReplayHandle | null = null;

export function closeReplay(): void {
  current?.dispose();
  current = null;
}

export interface Shown {
  runs: readonly HistoryRun[];
  pair: Pair;
  colours: readonly string[];
}

/** Shows the runs of a case in an element, in place of a replay that is shown elsewhere. */
async function show(at: HTMLElement, s: Series, { runs, pair, colours }: Shown) {
  closeReplay();
  const own = (run: number) => {
    const name = ownName(s, run, pair);
    return name ? `, ${name}` : '';
  };
  const found = replaysOf(s);
  const parts = found.map(({ name, run }) => ({
    label: `run ${run + 1}, ${runs[run]?.name}: ${s.label}${own(run)}`,
    spec: caseAt(s, run).spec,
    load: () => loadData(name),
  }));
  const scenario = await loadJson<Json>(s.scene as string);
  const moment = firstMoment(
    s,
    found.map(({ run }) => run),
  );
  current = mountTogether(
    at,
    {
      name: s.scenario,
      scenario,
      index: 0,
      step: 0,
      cursor: newCursor(moment),
      colourOf: (_, i) => colours[Math.max(0, i) % colours.length] as string,
      state: '',
      onState: () => {},
    },
    parts,
  );
}

/**
 * The choice of a case among the series of a scenario, and its replays; null where there are none. `chosen`: the case that is shown at
 * once; `changed` gets another one.
 */
export function replayBox(
  all: readonly Series[],
  nameOf: (s: Series) => string,
  shown: Shown,
  chosen: string | null,
  changed: (key: string | null) => void,
): HTMLElement | null {
  const cases = replayable(all);
  if (cases.length === 0) return null;
  const holder = el('div', null);
  const select = el(
    'select',
    { 'aria-label': 'Case to replay' },
    el('option', { value: '' }, 'Replay side by side …'),
    cases.map((s) => el('option', { value: caseKey(s) }, nameOf(s))),
  );
  const showChosen = () => {
    const found = cases.find((s) => caseKey(s) === select.value);
    if (found) void show(holder, found, shown);
    else closeReplay();
  };
  select.addEventListener('change', () => {
    changed(select.value || null);
    showChosen();
  });
  if (cases.some((s) => caseKey(s) === chosen)) {
    select.value = chosen as string;
    showChosen();
  }
  return el('div', null, el('div', { class: 'controls' }, select), holder);
}
