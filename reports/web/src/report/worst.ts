// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors

export interface Place {
  pair: string; // "block|floor"; "" where none is named
  bodies: string[];
  time: number; // [s]
  what: string; // "missed", "spurious" or "normal"; "" where it is not told
  spec: string; // "" where none is named
}

const kinds = new Set(['missed', 'spurious', 'normal']);

/**
 * Where the worst of an audit was: "block|floor at t=0.25 (normal)"; gathered over runs, the spec of the run stands in
 * a second pair of brackets.
 */
export function worstPlace(text: string): Place | null {
  const match = /^(.*?)\s*at t=([-+0-9.eE]+)((?: \([^()]*\))*)$/.exec(text.trim());
  const time = Number(match?.[2]);
  if (match === null || !Number.isFinite(time)) return null;
  const pair = match[1] ?? '';
  const notes = [...(match[3] ?? '').matchAll(/\(([^()]*)\)/g)].map((note) => note[1] as string);
  const spec = notes.find((note) => !kinds.has(note)) ?? '';
  const what = notes.find((note) => kinds.has(note)) ?? '';
  return { pair, bodies: pair ? pair.split('|') : [], time, what, spec };
}
