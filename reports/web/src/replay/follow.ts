// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Inputs that a picture follows, in the replay and in the live view: the pointer, and the light or dark theme. Each
// function returns the one that ends it.
import { darkTheme, lightTheme } from './colours.ts';
import type { Pick, ReplayView } from './view.ts';

export interface PointerActions {
  cursor: string; // CSS, over what can be picked
  hover(pick: Pick | null): void; // once a frame at most; null: nothing is there, or a button is down
  click(pick: Pick | null): void; // called for a click, not after a drag
}

const dragged = 4; // [CSS px] between press and click

export function followPointer(view: ReplayView, actions: PointerActions): () => void {
  const { canvas } = view;
  const leaving = new AbortController(); // the canvas may serve another view later
  const { signal } = leaving;
  let requested = 0;
  let last: PointerEvent | null = null;
  const look = () => {
    requested = 0;
    const pick = last ? view.pick(last.clientX, last.clientY) : null;
    canvas.style.cursor = pick ? actions.cursor : '';
    actions.hover(pick);
  };
  const later = (event: PointerEvent | null) => {
    last = event;
    if (requested === 0) requested = requestAnimationFrame(look);
  };
  canvas.addEventListener('pointermove', (event) => later(event.buttons === 0 ? event : null), { signal });
  canvas.addEventListener('pointerleave', () => later(null), { signal });
  let down: [number, number] = [0, 0];
  const press = (event: PointerEvent) => {
    down = [event.clientX, event.clientY];
  };
  canvas.addEventListener('pointerdown', press, { signal });
  const click = (event: MouseEvent) => {
    if (Math.hypot(event.clientX - down[0], event.clientY - down[1]) > dragged) return;
    actions.click(view.pick(event.clientX, event.clientY));
  };
  canvas.addEventListener('click', click, { signal });
  return () => {
    leaving.abort();
    cancelAnimationFrame(requested);
  };
}

/** The page's own choice, else that of the system. */
export function followTheme(view: ReplayView): () => void {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const themed = () => {
    const requested = document.documentElement.dataset.theme;
    view.setTheme((requested ? requested === 'dark' : dark.matches) ? darkTheme : lightTheme);
  };
  const observer = new MutationObserver(themed);
  observer.observe(document.documentElement, { attributes: true, attributeFilter: ['data-theme'] });
  dark.addEventListener('change', themed);
  themed();
  return () => {
    observer.disconnect();
    dark.removeEventListener('change', themed);
  };
}
