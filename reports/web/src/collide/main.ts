// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page of `rigor collide`: how many results of each engine are right, each case as a table of verdicts, and the chosen
// one in 3D: the two shapes, the engine's normal and points, and the exact ones.
import '../report/style.css';
import '../report/board.css';
import '../report/widths.css';
import '../replay/style.css';
import './style.css';
import { type Child, el } from '../common/elements.ts';
import { angle, counted, format, type Maybe } from '../common/format.ts';
import { followTheme } from '../replay/follow.ts';
import type { Frame, FrameSource } from '../replay/frames.ts';
import { findingRows } from '../replay/inspector.ts';
import { legendNodes } from '../replay/legend.ts';
import { NotesLayer } from '../replay/notes_layer.ts';
import { readScene } from '../replay/scene.ts';
import { NoWebGL, ReplayView } from '../replay/view.ts';
import { themeButton } from '../report/theme.ts';
import type { Answer, CollideCase, CollideRun } from './data.ts';
import { findingOf } from './finding.ts';

const data = JSON.parse(document.getElementById('collide-data')?.textContent ?? '{}') as CollideRun;
const engines = data.summary.map((s) => s.name);
const right = new Set(['ok', 'undecided', 'unsupported']);
const isWrong = (answer: Answer) => !right.has(answer.verdict);
const symbolOf = (answer: Answer) => (isWrong(answer) ? '✗' : answer.verdict === 'ok' ? '✓' : '–');
const mostRows = 200;

const section = (id: string, title: string, ...content: Child[]) =>
  el('section', { class: 'panel', id }, el('h2', null, title), content);
const scroll = (table: HTMLElement) =>
  el('div', { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': 'Table, scrolls sideways' }, table);
const head = (titles: [text: string, isNumber: boolean][]) =>
  el(
    'thead',
    null,
    el(
      'tr',
      null,
      titles.map(([text, n]) => el('th', { scope: 'col', class: n ? 'num' : null }, text)),
    ),
  );
const numbers = (...values: Child[]) => values.map((v) => el('td', { class: 'num' }, v));
const metres = (value: Maybe | undefined) => (value === null || value === undefined ? '—' : `${format(value)} m`);

/** Difference from the exact solution up to which a result is right. */
function toleranceText(): string {
  const { touch, relative, angle: radians, single } = data.tolerance;
  const singles = data.summary.filter((s) => s.precision === 'f32').map((s) => s.name);
  const few = (value: number) => value.toExponential(1).replace('.0e', 'e');
  return (
    `A result is right within ${few(touch)} m or ${few(relative)} of the distance, and a normal of an overlap within ` +
    `${few(radians)} rad of an exact one, or where no more depth is lost along it. Overlap or not is judged beyond ` +
    `${few(touch)} m of touching; normals and depths in the table are those of deeper overlaps.` +
    (singles.length > 0
      ? ` ${singles.join(', ')}: single precision, so within ${few(single)} of the largest coordinate, and ${few(single)} rad.`
      : '')
  );
}

function summary(): HTMLElement {
  const titles = [
    'Answered',
    'Unsupported',
    'Wrong',
    'Missed',
    'False',
    'Wrong depth',
    'Wrong normal',
    'Normal of overlaps, worst',
    'Depth of overlaps, worst',
    'Median',
  ];
  const rows = data.summary.map((s) =>
    el(
      'tr',
      null,
      el('th', { scope: 'row' }, s.name),
      ...numbers(s.answered, s.unsupported, s.failed, s.missed, s.spurious, s.wrong_depth, s.wrong_normal),
      ...numbers(angle(s.normal_angle_max ?? null), metres(s.depth_error_max), `${format(s.microseconds_median)} µs`),
    ),
  );
  const heads: [string, boolean][] = [['Engine', false], ...titles.map((t): [string, boolean] => [t, true])];
  const table = el('table', { class: 'full' }, head(heads), el('tbody', null, rows));
  return section('summary', 'Engines', scroll(table), el('p', { class: 'small muted' }, toleranceText()));
}

/** One frame in which nothing moves. */
function still(c: CollideCase, label: string): FrameSource {
  const frame: Frame = {
    time: 0,
    step: 0,
    position: new Float64Array(6),
    orientation: Float64Array.from([1, 0, 0, 0, 1, 0, 0, 0]),
    velocity: null,
    angularVelocity: null,
    contacts: null,
  };
  return {
    label: `${label}, ${c.name}`,
    spec: label,
    colour: '#0072B2',
    ghost: false,
    note: '',
    events: [],
    times: [0],
    frame: () => frame,
  };
}

/** The picture and the numbers of a case. */
class Picture {
  readonly element = el('div', { class: 'replay' });
  readonly #stage = el('div', { class: 'stage' });
  readonly #numbers = el('aside', { class: 'inspector pinned' });
  readonly #legend = el('p', { class: 'colour-legend' });
  #view: ReplayView | null = null;
  #end = () => {};

  constructor() {
    this.element.append(el('div', { class: 'stage-row' }, this.#stage, this.#numbers), this.#legend);
  }

  show(c: CollideCase, answer: Answer): void {
    this.drop();
    const finding = findingOf(c, answer);
    const verdict = el(
      'p',
      null,
      el('b', null, answer.engine),
      `: ${answer.verdict}`,
      answer.message ? `, ${answer.message}` : '',
    );
    const more = [
      ...(c.truth.continuum ? ['the exact normals are a continuum: some are drawn'] : []),
      ...(c.truth.source === 'none' ? ['no exact solution is known'] : []),
    ];
    this.#numbers.replaceChildren(
      verdict,
      el('dl', {}, finding ? findingRows(finding, false) : null),
      el('p', { class: 'small muted' }, more.join('; ')),
    );
    try {
      this.#draw(c, answer, finding);
    } catch (error) {
      const why = error instanceof NoWebGL ? 'This browser shows no WebGL.' : String(error);
      this.#stage.replaceChildren(el('p', { class: 'replay-note' }, why));
    }
  }

  #draw(c: CollideCase, answer: Answer, finding: ReturnType<typeof findingOf>): void {
    const bodies = [
      { name: 'A', shapes: [c.a] },
      { name: 'B', shapes: [c.b] },
    ];
    const view = new ReplayView(this.#stage, readScene({ dimension: c.dimension, gravity: [0, -1, 0], bodies }));
    const source = still(c, answer.engine);
    const notes = new NotesLayer();
    this.#stage.append(notes.element);
    view.onDraw = () => {
      const found = view.findingNotes;
      notes.place(view, found ? [found] : []);
      this.#legend.replaceChildren(...(legendNodes(view.legend) as Node[]));
    };
    view.setSources([source]);
    view.setTime(0);
    view.setOptions({ overlaid: true, colouring: 'body' });
    view.setFinding(finding ? { spec: answer.engine, finding } : null);
    view.draw();
    view.lookAtFinding(true);
    this.#end = followTheme(view);
    this.#view = view;
  }

  /** The view, read by tests and the browser's tools. */
  get view(): ReplayView | null {
    return this.#view;
  }

  drop(): void {
    this.#end();
    this.#end = () => {};
    this.#view?.dispose();
    this.#view = null;
    this.#stage.replaceChildren();
  }
}

function cases(): HTMLElement {
  const query = new URLSearchParams(location.hash.slice(1));
  const picture = new Picture();
  Object.assign(picture.element, { picture });
  const title = el('h3', { hidden: true }); // until it names a case
  const choice = el('div', { class: 'chips', role: 'group', 'aria-label': 'Engines' });
  const body = el('tbody', null);
  const status = el('p', { class: 'muted small', role: 'status' });
  const text = el('input', { type: 'search', placeholder: 'case, tag', 'aria-label': 'Case' });
  const wrong = el('input', {
    type: 'checkbox',
    checked: query.get('all') !== '1' && data.cases.some((c) => c.answers.some(isWrong)),
  });
  let shown = data.cases[0];
  const show = (c: CollideCase, engine: string, remember = true) => {
    const answer = c.answers.find((a) => a.engine === engine) ?? c.answers[0];
    if (!answer) return;
    shown = c;
    title.hidden = false;
    title.replaceChildren(c.name, el('span', { class: 'muted small' }, ` ${c.tags.join(', ')}`));
    choice.replaceChildren(
      ...c.answers.map((a) =>
        el(
          'button',
          {
            type: 'button',
            'aria-pressed': String(a === answer),
            'data-engine': a.engine,
            title: a.verdict,
            onclick: () => show(c, a.engine),
          },
          `${symbolOf(a)} ${a.engine}`,
        ),
      ),
    );
    picture.show(c, answer);
    if (!remember) return;
    history.replaceState(null, '', `#${new URLSearchParams({ case: c.name, engine: answer.engine })}`);
  };
  const cell = (c: CollideCase, engine: string) => {
    const answer = c.answers.find((a) => a.engine === engine);
    if (!answer) return el('td', null, '—');
    const open = () => {
      show(c, engine);
      picture.element.scrollIntoView({ block: 'nearest' });
    };
    const off = answer.verdict === 'wrong normal' ? ` ${angle(answer.normal_angle ?? null)}` : '';
    const depth = answer.verdict === 'wrong depth' ? ` ${metres(answer.distance_error)}` : '';
    return el(
      'td',
      null,
      el(
        'button',
        { type: 'button', class: `verdict ${isWrong(answer) ? 'wrong' : ''}`, onclick: open },
        answer.verdict,
        off,
        depth,
      ),
    );
  };
  const draw = () => {
    const words = text.value.toLowerCase();
    const list = data.cases.filter(
      (c) =>
        (!wrong.checked || c.answers.some(isWrong)) && `${c.name} ${c.tags.join(' ')}`.toLowerCase().includes(words),
    );
    body.replaceChildren(
      ...list.slice(0, mostRows).map((c) =>
        el(
          'tr',
          { 'data-case': c.name },
          el('th', { scope: 'row', class: 'sticky' }, c.name),
          el('td', { class: 'num' }, metres(c.truth.signed_distance)),
          engines.map((e) => cell(c, e)),
        ),
      ),
    );
    const left = data.left_out ? `; ${counted(data.left_out, 'right case')} more in collide.json` : '';
    status.textContent = `${list.length} of ${counted(data.cases.length, 'case')}${list.length > mostRows ? `, the first ${mostRows} are listed` : ''}${left}`;
  };
  text.addEventListener('input', draw);
  wrong.addEventListener('change', draw);
  draw();
  const heads: [string, boolean][] = [
    ['Case', false],
    ['Exact distance', true],
    ...engines.map((e): [string, boolean] => [e, false]),
  ];
  const node = section(
    'cases',
    'Cases',
    title,
    choice,
    picture.element,
    el('div', { class: 'controls' }, text, el('label', null, wrong, ' wrong ones only')),
    status,
    scroll(el('table', { class: 'full' }, head(heads), body)),
  );
  const wanted =
    data.cases.find((c) => c.name === query.get('case')) ?? data.cases.find((c) => c.answers.some(isWrong)) ?? shown;
  const engine = query.get('engine') ?? wanted?.answers.find(isWrong)?.engine ?? '';
  requestAnimationFrame(() => {
    if (wanted) show(wanted, engine, query.has('case'));
  });
  return node;
}

document.getElementById('top')?.append(
  el(
    'div',
    { class: 'bar' },
    el('span', { class: 'brand' }, 'Rigor collide'),
    themeButton(() => {}),
  ),
);
const page = document.getElementById('page') as HTMLElement;
page.replaceChildren(el('h1', { class: 'read-aloud' }, 'Collision queries'), summary(), cases());
page.dataset.shown = '1';
