// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The plots of the page that is shown. A plot is made when it scrolls into view, and gone with its page.

export interface LivePlot {
  node: HTMLElement;
  make(): void; // once; again after drop()
  drop(): void;
}

let plots: LivePlot[] = [];
const watcher =
  typeof IntersectionObserver === 'undefined'
    ? null
    : new IntersectionObserver(
        (entries) => {
          for (const entry of entries) {
            if (!entry.isIntersecting || !entry.target.isConnected) continue;
            plots.find((plot) => plot.node === entry.target)?.make();
          }
        },
        { rootMargin: '300px' },
      );

export function addPlot(plot: LivePlot): HTMLElement {
  plots.push(plot);
  if (watcher) watcher.observe(plot.node);
  else requestAnimationFrame(() => plot.node.isConnected && plot.make());
  return plot.node;
}

/** Drops the plots of a page that is left, or of a part of it that is drawn anew. */
export function dropPlots(within: HTMLElement): void {
  const gone = plots.filter((plot) => within.contains(plot.node));
  for (const plot of gone) {
    watcher?.unobserve(plot.node);
    plot.drop();
  }
  plots = plots.filter((plot) => !gone.includes(plot));
}

/** Draws all plots, as for printing: also those out of view, in the current colours. */
export function drawAllPlots(): void {
  for (const plot of plots) {
    plot.drop();
    if (plot.node.isConnected) plot.make();
  }
}
