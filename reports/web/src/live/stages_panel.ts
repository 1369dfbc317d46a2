// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Inside a step: which stages it has, which one was run, and what each has made: boxes and pairs, manifolds, rows,
// the impulses of the rows and the residual after every iteration, islands.
import { el } from '../common/elements.ts';
import { format } from '../common/format.ts';
import type { Scene } from '../replay/scene.ts';
import { ImpulsePlot } from './impulse_plot.ts';
import type { InstanceSource } from './instance_source.ts';
import { type Row, type ShapeRef, type StageData, stageData } from './stage_data.ts';

const mostRows = 200; // most rows of a table; the rest is counted
const words = (name: string) => name.replaceAll('_', ' ');

export class StagesPanel {
  readonly element: HTMLElement;
  readonly #instance = el('select', { 'aria-label': 'Instance' });
  readonly #steps = el('ol', { class: 'stages' });
  readonly #made = el('div', { class: 'made' });
  readonly #plot = new ImpulsePlot();
  #names: string[] = []; // names of the stages of a step, as far as they have occurred
  #instances: InstanceSource[] = [];
  #shown: unknown = null;
  scene: Scene | null = null;

  constructor(watch: (on: boolean) => void) {
    const always = el('input', { type: 'checkbox', 'data-action': 'watch' });
    always.addEventListener('change', () => watch(always.checked));
    this.#instance.addEventListener('change', () => this.#draw(true));
    this.element = el(
      'section',
      { class: 'panel', 'data-panel': 'stages' },
      el('h2', {}, 'Inside the step'),
      el('div', { class: 'line' }, this.#instance, el('label', { class: 'check' }, always, 'also after whole steps')),
      this.#steps,
      this.#plot.element,
      this.#made,
    );
  }

  /** Instances whose engines show their stages. */
  setInstances(instances: InstanceSource[]): void {
    this.#instances = instances;
    const before = this.#instance.value;
    this.#instance.replaceChildren(
      ...instances.map((instance) => el('option', { value: instance.id }, instance.label)),
    );
    if (instances.some((instance) => String(instance.id) === before)) this.#instance.value = before;
    this.element.hidden = instances.length === 0;
    this.#draw(true);
  }

  refresh(): void {
    this.#draw(false);
  }

  #draw(anew: boolean): void {
    const instance = this.#instances.find(({ id }) => String(id) === this.#instance.value) ?? this.#instances[0];
    if (!instance?.head || !instance.arrays || (!anew && instance.head === this.#shown)) return;
    this.#shown = instance.head;
    const { stage } = instance.head;
    this.#follow(stage.done, stage.next);
    const past = this.#names.indexOf(stage.done);
    this.#steps.replaceChildren(
      ...this.#names.map((name, i) =>
        el(
          'li',
          {
            class: stage.in_step && i <= past ? 'done' : null,
            'aria-current': name === stage.done ? 'step' : null,
            'data-stage': name,
          },
          words(name),
        ),
      ),
    );
    const data = stageData(instance.head, instance.arrays);
    this.#plot.show(data, (row) => this.#rowName(row));
    if (!data) {
      this.#made.replaceChildren(
        el('p', { class: 'hint' }, 'Press Stage to stop inside the step. The picture shows what is there so far.'),
      );
      return;
    }
    const substep = stage.substep > 0 ? `, sub-step ${stage.substep + 1}` : '';
    const ended = stage.in_step ? '' : ' (the step has ended)';
    const parts = [
      el(
        'p',
        { class: 'hint' },
        stage.done === '' ? 'After a whole step.' : `After ${words(stage.done)}${substep}${ended}.`,
      ),
      this.#part(
        'Broad phase',
        `boxes: ${data.boxes}, pairs: ${data.pairs.length}`,
        () => this.#pairs(data),
        stage.done === 'broad_phase',
      ),
      this.#part('Manifolds', this.#countPoints(data), () => this.#manifolds(data), stage.done === 'narrow_phase'),
      this.#part(
        'Rows',
        `${data.rows.length}`,
        () => this.#rows(data),
        stage.done === 'rows' || stage.done === 'solve',
      ),
      this.#part('Islands', `${data.islands.length}`, () => this.#islands(data), false),
    ];
    this.#made.replaceChildren(...parts);
  }

  /** The order of the stages is learnt from the engine. */
  #follow(done: string, next: string): void {
    for (const name of [done, next]) if (name !== '' && !this.#names.includes(name)) this.#names.push(name);
    if (done !== '' && next !== '') {
      const [at, to] = [this.#names.indexOf(done), this.#names.indexOf(next)];
      if (to !== at + 1 && to > at && at >= 0) return;
    }
  }

  readonly #open = new Map<string, boolean>();
  #part(title: string, count: string, table: () => HTMLElement, now: boolean): HTMLElement {
    const open = this.#open.get(title) ?? now;
    const part = el('details', { open, 'data-part': title }, el('summary', {}, el('b', {}, title), ` ${count}`));
    if (open) part.append(table());
    part.addEventListener('toggle', () => {
      if (part.open && part.children.length === 1) part.append(table());
    });
    part.querySelector('summary')?.addEventListener('click', () => this.#open.set(title, !part.open));
    return part;
  }

  #body(index: number): string {
    return index < 0 ? 'world' : (this.scene?.bodies[index]?.name ?? String(index));
  }
  #ref({ body, shape }: ShapeRef): string {
    const several = (this.scene?.bodies[body]?.shapes.length ?? 1) > 1;
    return several ? `${this.#body(body)} [${shape}]` : this.#body(body);
  }
  #rowName(row: Row): string {
    const joint = row.joint >= 0 ? (this.scene?.joints[row.joint]?.name ?? `joint ${row.joint}`) : null;
    return `${row.kind} ${joint ?? `${this.#body(row.a)}–${this.#body(row.b)}`}`;
  }

  #countPoints(data: StageData): string {
    return `${data.manifolds.length}, points: ${data.manifolds.reduce((sum, m) => sum + m.points.length, 0)}`;
  }

  #pairs(data: StageData): HTMLElement {
    return table(
      ['A', 'B'],
      data.pairs.map(([a, b]) => [this.#ref(a), this.#ref(b)]),
    );
  }

  #manifolds(data: StageData): HTMLElement {
    return table(
      ['A', 'B', 'normal', 'depth [m]', 'starts with [N s]'],
      data.manifolds.flatMap((m) =>
        m.points.map((p) => [
          this.#ref(m.a),
          this.#ref(m.b),
          m.normal.map((v) => format(v, 3)).join(', '),
          format(p.depth, 3),
          format(p.impulse, 4),
        ]),
      ),
    );
  }

  #rows(data: StageData): HTMLElement {
    return table(
      ['row', 'of', 'impulse', 'bias', 'error', 'effective mass'],
      data.rows.map((r, i) => [
        String(i),
        this.#rowName(r),
        format(r.impulse, 5),
        format(r.bias, 3),
        format(r.error, 3),
        format(r.effectiveMass, 3),
      ]),
    );
  }

  #islands(data: StageData): HTMLElement {
    return table(
      ['bodies', 'who'],
      data.islands.map((bodies) => [
        String(bodies.length),
        bodies
          .slice(0, 8)
          .map((b) => this.#body(b))
          .join(', ') + (bodies.length > 8 ? ', …' : ''),
      ]),
    );
  }
}

function table(head: string[], rows: string[][]): HTMLElement {
  const left = rows.length - mostRows;
  return el(
    'div',
    { class: 'scroll' },
    el(
      'table',
      {},
      el(
        'thead',
        {},
        el(
          'tr',
          {},
          head.map((text) => el('th', {}, text)),
        ),
      ),
      el(
        'tbody',
        {},
        rows.slice(0, mostRows).map((row) =>
          el(
            'tr',
            {},
            row.map((text) => el('td', {}, text)),
          ),
        ),
      ),
    ),
    left > 0 ? el('p', { class: 'hint' }, `and ${left} more`) : null,
  );
}
