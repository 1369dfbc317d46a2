// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Picking by the pointer: the picture of the canvas, the place in it, and the nearest contact.
import { type Contacts, middleOf } from './frames.ts';

/** Rectangle in pixels of the page, from the upper left corner of the canvas. */
export interface Rect {
  x: number;
  y: number;
  width: number;
  height: number;
}

/**
 * `count` equal pictures that fill the canvas, so that a scene `aspect` times as wide as high is seen as large as
 * possible; rows from the top.
 */
export function tile(count: number, width: number, height: number, aspect = 1.25, gap = 2): Rect[] {
  if (count <= 0) return [];
  let best = 1;
  let most = 0;
  for (let columns = 1; columns <= count; ++columns) {
    const rows = Math.ceil(count / columns);
    const size = Math.min(width / columns / aspect, height / rows);
    if (size > most * (1 + 1e-9)) [best, most] = [columns, size];
  }
  const rows = Math.ceil(count / best);
  const w = (width - gap * (best - 1)) / best;
  const h = (height - gap * (rows - 1)) / rows;
  return Array.from({ length: count }, (_, i) => ({
    x: (i % best) * (w + gap),
    y: Math.floor(i / best) * (h + gap),
    width: w,
    height: h,
  }));
}

/** Parts of a canvas so wide that its rows of pictures leave free: beside each picture, and below each row but the last. */
export function gapsOf(rects: readonly Rect[], width: number): Rect[] {
  return rects.flatMap(({ x, y, width: w, height: h }, i) => {
    const next = rects[i + 1];
    const right = next?.y === y ? next.x : width;
    const beside = { x: x + w, y, width: right - x - w, height: h };
    const below = { x: 0, y: y + h, width, height: next && next.y !== y ? next.y - y - h : 0 };
    return [beside, below].filter((r) => r.width > 1e-6 && r.height > 0);
  });
}

/** Index of the picture that holds the point, or -1. */
export function rectAt(rects: readonly Rect[], x: number, y: number): number {
  return rects.findIndex((r) => x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height);
}

/** Pixels of the canvas to -1 .. 1 in a picture, y upwards. */
export function toDevice(rect: Rect, x: number, y: number): [number, number] {
  return [(2 * (x - rect.x)) / rect.width - 1, 1 - (2 * (y - rect.y)) / rect.height];
}

/**
 * World point to pixels of the canvas by a 4 x 4 view-projection matrix (column by column); null behind the camera.
 */
export function toPixels(rect: Rect, m: ArrayLike<number>, x: number, y: number, z: number): [number, number] | null {
  const row = (k: number) =>
    (m[k] as number) * x + (m[4 + k] as number) * y + (m[8 + k] as number) * z + (m[12 + k] as number);
  const w = row(3);
  if (!(w > 0)) return null;
  return [rect.x + ((row(0) / w + 1) / 2) * rect.width, rect.y + ((1 - row(1) / w) / 2) * rect.height];
}

/** The contact whose middle is nearest to the pointer, within `reach` pixels; -1: none. */
export function nearestContact(
  contacts: Contacts,
  rect: Rect,
  viewProjection: ArrayLike<number>,
  x: number,
  y: number,
  reach: number,
): number {
  let found = -1;
  let least = reach;
  for (let i = 0; i < contacts.count; ++i) {
    const at = toPixels(rect, viewProjection, ...middleOf(contacts, i));
    const distance = at === null ? Number.POSITIVE_INFINITY : Math.hypot(at[0] - x, at[1] - y);
    if (distance < least) [found, least] = [i, distance];
  }
  return found;
}
