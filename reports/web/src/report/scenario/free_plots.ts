// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Plots of one's own: any quantity of any body, or of the contacts of two, of any engine, over time or against another.
// They are added by clicks and stand in the address.
import { loadData } from '../../common/data_files.ts';
import { el } from '../../common/elements.ts';
import type { FrameSource } from '../../replay/frames.ts';
import { bodyQuantities, pairQuantities, type Quantity, samplesOf } from '../../replay/quantities.ts';
import { type Replay, readReplay } from '../../replay/replay_file.ts';
import type { Line } from '../charts/line.ts';
import { dropPlots } from '../charts/live_plots.ts';
import { plotCard } from '../charts/plot.ts';
import { columnOf, engineColour, labelOf } from '../run.ts';
import { panel, select } from '../widgets.ts';
import { aboutOf, type Context } from './context.ts';
import { type Choice, decodeChoice, withPlots } from './free_choice.ts';

const isPair = (of: string) => of.includes('|');
const quantitiesOf = (of: string): Quantity[] => (isPair(of) ? pairQuantities : bodyQuantities);
const quantityOf = (of: string, key: string) => quantitiesOf(of).find((q) => q.key === key);

/** Bodies, then pairs that touch in any run. */
function subjects({ head, sources }: Replay): string[] {
  const touching = sources.flatMap((s) =>
    s.events.filter((e) => e.kind === 'contact_begin').map((e) => e.subject ?? ''),
  );
  return [...head.bodies, ...new Set(touching.filter(Boolean))];
}

/** The line of one run; null where it has no sample of it. */
function lineOf(source: FrameSource, choice: Choice, bodies: string[]): Line | null {
  const [a = -1, b = -1] = choice.of.split('|').map((name) => bodies.indexOf(name));
  const quantity = quantityOf(choice.of, choice.y);
  if (a < 0 || !quantity) return null;
  const y = samplesOf(source, quantity, a, b);
  if (y.every((v) => v === null)) return null;
  const style = source.ghost
    ? { label: 'exact reference', colour: '--reference', dash: [], width: 5 }
    : {
        label: labelOf(source.spec),
        colour: engineColour(columnOf(source.spec)?.engine ?? source.spec),
        dash: columnOf(source.spec)?.dash ?? [],
        width: 1.5,
      };
  const line = { key: source.spec, ...style };
  const over = choice.x === 't' ? null : quantityOf(choice.of, choice.x);
  if (!over) return { ...line, x: source.times, y };
  const xs = samplesOf(source, over, a, b);
  const both = xs.flatMap((x, i) => (x === null || y[i] === null ? [] : [{ x, y: y[i] as number }]));
  const sorted = [...both].sort((p, q) => p.x - q.x);
  const joined = { x: both.map((p) => p.x), y: both.map((p) => p.y) };
  return { ...line, joined, x: sorted.map((p) => p.x), y: sorted.map((p) => p.y) };
}

function card(context: Context, replay: Replay, choice: Choice, remove: () => void): HTMLElement {
  const sources = [...(replay.reference ? [replay.reference] : []), ...replay.sources];
  const shown = sources.filter((s) => s.times.length > 0 && (!choice.spec || s.ghost || s.spec === choice.spec));
  const lines = shown.map((s) => lineOf(s, choice, replay.head.bodies)).filter((line) => line !== null);
  const quantity = quantityOf(choice.of, choice.y);
  const over = choice.x === 't' ? null : quantityOf(choice.of, choice.x);
  const subject = choice.of.replace('|', ' and ');
  const unit = (q: Quantity | null | undefined) => (q?.unit ? ` [${q.unit}]` : '');
  const title = `${subject}: ${quantity?.title ?? choice.y}${over ? ` over ${over.title}` : ''}`;
  const node = plotCard({
    title,
    name: title,
    about: aboutOf(context),
    yTitle: `${subject}: ${quantity?.title ?? choice.y}`,
    unit: quantity?.unit ?? '',
    xTitle: over ? `${over.title}${unit(over)}` : 't [s]',
    xUnit: over?.unit ?? 's',
    lines,
    ...(over ? {} : { cursor: context.cursor }),
  });
  node
    .querySelector('.tools')
    ?.append(el('button', { class: 'button noprint', 'aria-label': `Remove ${title}`, onclick: remove }, '×'));
  return node;
}

export function freePlots(context: Context): HTMLElement | null {
  if (!context.cases.some((c) => c.trajectoryFile)) return null;
  const query = new URLSearchParams(location.hash.split('?')[1] ?? '');
  let choices = query.getAll('plot').flatMap((text) => decodeChoice(text) ?? []);
  const grid = el('div', { class: 'charts' });
  const form = el('div', { class: 'controls' });
  let replay: Replay | null = null;
  const keep = () => history.replaceState(history.state, '', withPlots(location.hash, choices));
  const draw = () => {
    const known = replay;
    if (!known) return;
    dropPlots(grid);
    grid.replaceChildren(
      ...choices.map((choice) =>
        card(context, known, choice, () => {
          choices = choices.filter((c) => c !== choice);
          keep();
          draw();
        }),
      ),
    );
  };
  const showForm = (known: Replay, at: Choice) => {
    const change = (part: Partial<Choice>) => {
      const next = { ...at, ...part };
      const keys = quantitiesOf(next.of).map((q) => q.key);
      if (!keys.includes(next.y)) next.y = keys[0] as string;
      if (next.x !== 't' && !keys.includes(next.x)) next.x = 't';
      showForm(known, next);
    };
    const options = quantitiesOf(at.of).map((q): [string, string] => [q.key, q.title]);
    const able = known.sources.filter((s) => s.times.length > 0);
    const add = () => {
      choices = [...choices, at];
      keep();
      draw();
    };
    form.replaceChildren(
      select(
        'Of',
        subjects(known).map((s) => [s, s.replace('|', ' and ')]),
        at.of,
        (of) => change({ of }),
      ),
      select('Quantity', options, at.y, (y) => change({ y })),
      select('Over', [['t', 'time'], ...options], at.x, (x) => change({ x })),
      select('Engine', [['', 'all'], ...able.map((s): [string, string] => [s.spec, s.label])], at.spec, (spec) =>
        change({ spec }),
      ),
      el('button', { class: 'button', 'data-action': 'add-plot', onclick: add }, 'Add plot'),
    );
  };
  const open = async () => {
    if (replay) return;
    const data = await loadData(`replay-${context.index}-${context.steps.indexOf(context.dt)}`);
    replay = readReplay(data, (spec) => engineColour(columnOf(spec)?.engine ?? spec));
    const first = subjects(replay).find((s) => !isPair(s) && context.scenario.observed.includes(s));
    showForm(replay, { of: first ?? replay.head.bodies[0] ?? '', y: 'py', x: 't', spec: '' });
    draw();
  };
  const body = el(
    'details',
    { open: choices.length > 0 },
    el('summary', null, 'Add plots of any quantity'),
    form,
    grid,
  );
  const start = () => void open().catch((error) => form.replaceChildren(String(error.message ?? error)));
  body.addEventListener('toggle', start, { once: true });
  if (choices.length > 0) start();
  return panel('free-plots', 'Plots of your own', body);
}
