// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Engines to be shown on the scoreboard, and those that come first; modules and guests apart.
import { el } from '../../common/elements.ts';
import { engineColour, kinds, run } from '../run.ts';
import { type Filters, namesIn, toggled } from './filters.ts';

let isOpen = false; // also after the filters were drawn anew

function engineNode(name: string, f: Filters, set: (changes: Partial<Filters>) => void): HTMLElement {
  const isPinned = namesIn(f.pin).includes(name);
  const box = el('input', {
    type: 'checkbox',
    checked: !namesIn(f.hide).includes(name),
    onchange: () => set({ hide: toggled(f.hide, name) }),
  });
  const swatch = el('i', { class: 'swatch', style: `background:${engineColour(name)}` });
  const pin = el(
    'button',
    {
      class: 'pin',
      type: 'button',
      'aria-pressed': String(isPinned),
      'aria-label': `${name} first`,
      title: isPinned ? 'comes first' : 'put first',
      onclick: () => set({ pin: toggled(f.pin, name) }),
    },
    isPinned ? '★' : '☆',
  );
  return el('span', { class: 'engine' }, el('label', null, box, swatch, name), pin);
}

/** A fold with a line for modules and one for guests; its summary says how many are shown. */
export function engineChoice(f: Filters, set: (changes: Partial<Filters>) => void): HTMLElement {
  const all = [...new Set(run.columns.map((c) => c.engine))];
  const hidden = all.filter((name) => namesIn(f.hide).includes(name));
  // The choice is drawn anew by its own clicks, where other filters leave the bar as it is.
  const own = (changes: Partial<Filters>) => {
    (document.activeElement as HTMLElement | null)?.blur();
    set(changes);
  };
  const lines = kinds(run.columns).map(({ title, columns }) => {
    const names = [...new Set(columns.map((c) => c.engine))];
    const others = all.filter((name) => !names.includes(name));
    return el(
      'div',
      { class: 'kind', role: 'group', 'aria-label': title || 'Engines' },
      title ? el('b', null, title) : null,
      names.map((name) => engineNode(name, f, own)),
      title
        ? el(
            'button',
            { class: 'button', type: 'button', onclick: () => own({ hide: others.join(',') }) },
            'only these',
          )
        : null,
    );
  });
  const fold = el(
    'details',
    { class: 'engines', open: isOpen },
    el('summary', null, `Engines: ${all.length - hidden.length} of ${all.length}`),
    lines,
    el('button', { class: 'button', type: 'button', onclick: () => own({ hide: '', pin: '' }) }, 'All engines'),
  );
  fold.addEventListener('toggle', () => {
    isOpen = (fold as HTMLDetailsElement).open;
  });
  return fold;
}
