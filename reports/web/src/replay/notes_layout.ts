// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Places of texts over the pictures, in pixels: beside their points, and moved up or down where one would cover another.
import type { Note } from './finding_overlay.ts';
import type { FrameSource } from './frames.ts';
import type { Vec3 } from './vectors.ts';
import type { ReplayView } from './view.ts';

export interface NotesOf {
  source: FrameSource;
  notes: Note[];
  lines?: [from: Vec3, to: Vec3][];
}

/** A text with the left and upper end of its box. */
export interface PlacedNote {
  text: string;
  kind: Note['kind'];
  left: number;
  top: number;
  width: number;
}

export const noteFont = '600 12.5px system-ui, sans-serif';
export const noteHeight = 16;
export const notePadding = 4; // left and right of the text
const gap = 6; // distance of the text from its point
const mostMoves = 6; // heights that a text may be moved by

let context: CanvasRenderingContext2D | null = null;
const widths = new Map<string, number>();
function measured(text: string): number {
  let width = widths.get(text);
  if (width === undefined) {
    context ??= document.createElement('canvas').getContext('2d');
    if (context) context.font = noteFont;
    width = Math.ceil(context?.measureText(text).width ?? 7 * text.length);
    if (widths.size > 2000) widths.clear(); // measures change with every frame
    widths.set(text, width);
  }
  return width;
}

/** Share of its width by which a text begins to the left of its point. */
const shift: Record<Note['kind'], number> = { engine: 1, exact: 0, angle: 0, body: 0, measure: 0.5 };

const overlap = (a: PlacedNote, b: PlacedNote): boolean =>
  a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + noteHeight && b.top < a.top + noteHeight;

/** The nearest free height above or below; where there is none, that of the point. */
function freed(note: PlacedNote, others: readonly PlacedNote[]): PlacedNote {
  for (let i = 0; i <= 2 * mostMoves; ++i) {
    const moves = i % 2 ? (i + 1) / 2 : -i / 2;
    const moved = { ...note, top: note.top + moves * noteHeight };
    if (!others.some((other) => overlap(moved, other))) return moved;
  }
  return note;
}

/** All texts whose points are seen. Names of bodies stay where their bodies are. */
export function placedNotes(
  view: Pick<ReplayView, 'panels' | 'project'>,
  all: readonly NotesOf[],
  widthOf: (text: string) => number = measured,
): PlacedNote[] {
  const placed: PlacedNote[] = [];
  for (const { source, notes } of all) {
    const panel = view.panels.find((p) => p.sources.includes(source))?.rect;
    if (!panel) continue;
    for (const { at, text, kind } of notes) {
      const place = view.project(source, at);
      if (place === null) continue;
      const [x, y] = place;
      if (x < panel.x || y < panel.y || x > panel.x + panel.width || y > panel.y + panel.height) continue;
      const width = widthOf(text) + 2 * notePadding;
      const aside = kind === 'body' || kind === 'measure' ? 0 : kind === 'engine' ? -gap : gap;
      const wanted = x + aside - shift[kind] * width;
      const left = Math.max(panel.x, Math.min(wanted, panel.x + panel.width - width));
      const note = { text, kind, left, top: y - noteHeight / 2, width };
      placed.push(kind === 'body' ? note : freed(note, placed));
    }
  }
  return placed;
}
