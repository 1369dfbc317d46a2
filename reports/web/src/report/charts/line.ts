// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import type { Cursor } from '../../common/cursor.ts';
import type { Child } from '../../common/elements.ts';

export interface Line {
  key: string; // spec; "" is always shown
  label: string;
  colour: string; // CSS, or the name of a CSS variable
  dash: number[];
  width: number;
  points?: boolean; // marks at the samples
  bare?: boolean; // marks alone
  x: ArrayLike<number>; // ascending
  y: (number | null)[];
  low?: (number | null)[]; // bound of an interval around y
  high?: (number | null)[];
  marked?: number[]; // samples with a ring
  notes?: string[]; // said of each sample when it is read out
  joined?: { x: number[]; y: (number | null)[] }; // order in which samples are joined, where that is not by x
}

export interface Plot {
  title: Child;
  name: string; // name for screen readers and tests
  about?: string; // scenario and time step, for the plot as a file
  yTitle: string; // quantity, without its unit
  unit: string;
  xTitle: string;
  xUnit: string;
  lines: Line[];
  wholeX?: boolean; // ticks at whole numbers
  logX?: boolean;
  logY?: boolean;
  tall?: boolean;
  zeroY?: boolean; // the axis includes zero
  cursor?: Cursor; // cursor of a plot over time
  focus?: string | null; // spec of the line that stands out
}
