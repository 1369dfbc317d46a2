// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { el } from '../../common/elements.ts';
import { mountReplay, type ReplayHandle } from '../../replay/mount.ts';
import { columnOf, engineColour, run } from '../run.ts';
import { panel } from '../widgets.ts';
import { type Context, findingOf } from './context.ts';

/** The replay of this time step; made when it comes into view, gets the focus, or when a link names a moment. */
export function replay(context: Context): HTMLElement | null {
  const { data, scenario, cases, cursor } = context;
  if (!cases.some((c) => c.trajectoryFile)) return null;
  const times = [...new Set(data.cases.map((c) => c.dt))].sort((a, b) => b - a);
  // It has the focus until there is a picture, which then gets it: keys come here before there is anything to come to.
  const holder = el('div', { class: 'replay-place', tabindex: 0, role: 'group', 'aria-label': 'Replay' });
  let handle: ReplayHandle | null = null;
  const mount = () => {
    if (handle) return;
    handle = mountReplay(holder, {
      scenario: JSON.parse(data.text),
      name: scenario.name,
      index: context.index,
      step: times.indexOf(context.dt),
      cursor,
      colourOf: (spec) => (spec === '' ? '#808890' : engineColour(columnOf(spec)?.engine ?? spec)),
      isPreferred: (spec) => columnOf(spec)?.preset === run.likeForLike,
      metrics: scenario.metrics,
      findingOf: (spec, key) => findingOf(cases, spec, key),
    });
    void handle.ready.then(() => {
      const canvas = holder.querySelector('canvas');
      if (!canvas) holder.classList.remove('replay-place'); // a sentence says why there is none
      // Before it can no longer have the focus: a browser may take it away at once.
      if (document.activeElement === holder) canvas?.focus();
      holder.removeAttribute('tabindex');
    });
    const wanted = cursor.focus.value;
    if (wanted) handle.focus(wanted);
  };
  const node = panel('replay', 'Replay', holder);
  const watcher = new IntersectionObserver(
    (entries) => {
      if (node.isConnected && entries.some((e) => e.isIntersecting)) mount();
    },
    { rootMargin: '200px' },
  );
  watcher.observe(node);
  holder.addEventListener('focus', mount);
  cursor.focus.follow(mount); // once it is there it follows by itself
  context.leaving.push(() => {
    watcher.disconnect();
    handle?.dispose();
  });
  return node;
}
