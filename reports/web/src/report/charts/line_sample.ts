// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A piece of a plot's line for its legend: colour and dashes.
import { svg } from '../../common/elements.ts';

export function lineSample(colour: string, dash: number[], width: number): SVGElement {
  const line = {
    x1: 0,
    y1: 5,
    x2: 26,
    y2: 5,
    stroke: colour,
    'stroke-width': width,
    'stroke-dasharray': dash.join(' '),
  };
  return svg('svg', { width: 26, height: 10, 'aria-hidden': 'true' }, svg('line', line));
}
