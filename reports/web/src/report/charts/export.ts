// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A plot as a file: the samples as CSV, the figure as SVG or PNG.
import type uPlot from 'uplot';
import { csvText, download, pngOf, saveText } from '../../common/download.ts';
import { type Axis, figureSvg, hasSamples, yTitleOf } from './figure.ts';
import type { Plot } from './line.ts';

const fileName = (plot: Plot) =>
  [plot.about, plot.name]
    .filter(Boolean)
    .join(' ')
    .replaceAll(/[^\w.-]+/g, '-')
    .toLowerCase();

/** A row for each sample: line, x, y. */
export function plotCsv(plot: Plot): string {
  const rows: (string | number)[][] = [['line', plot.xTitle || 'x', yTitleOf(plot)]];
  for (const line of plot.lines)
    line.y.forEach((y, i) => {
      if (y !== null) rows.push([line.label, line.x[i] as number, y]);
    });
  return csvText(rows);
}

const axisOf = (u: uPlot, key: 'x' | 'y', log: boolean): Axis => ({
  min: u.scales[key]?.min ?? 0,
  max: u.scales[key]?.max ?? 1,
  log,
});

const pixelsOfOne = 2; // pixels of a PNG for one of the figure, in each direction

/** Paints an SVG image. */
async function painted(text: string): Promise<HTMLCanvasElement> {
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(text)}`;
  await image.decode();
  const canvas = document.createElement('canvas');
  canvas.width = pixelsOfOne * image.naturalWidth;
  canvas.height = pixelsOfOne * image.naturalHeight;
  canvas.getContext('2d')?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvas;
}

/** Saves a plot that is made: the lines that are shown and have samples, as it is zoomed. */
export async function savePlot(kind: 'csv' | 'svg' | 'png', plot: Plot, u: uPlot, log: boolean): Promise<void> {
  u.batch(() => {}); // scales of a plot that was made just now are set with the next task
  const logX = plot.logX ?? false;
  const lines = plot.lines.filter((line, i) => u.series[i + 1]?.show && hasSamples(line, logX, log));
  const shown = { ...plot, lines };
  const name = fileName(plot);
  if (kind === 'csv') return saveText(`${name}.csv`, plotCsv(shown), 'text/csv');
  const text = figureSvg(shown, axisOf(u, 'x', logX), axisOf(u, 'y', log));
  if (kind === 'svg') saveText(`${name}.svg`, text, 'image/svg+xml');
  else download(`${name}.png`, await pngOf(await painted(text)));
}
