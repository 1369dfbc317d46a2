// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors

export interface Place {
  pair: string; // "block|floor"; "" where none is named
  bodies: string[];
  time: number; // [s]
  spec: string; // "" where none is named
}

/** Where the worst of an audit was: "block|floor at t=0.25", gathered over runs with " (spec)" behind it. */
export function worstPlace(text: string): Place | null {
  const match = /^(.*?)\s*at t=([-+0-9.eE]+)(?: \((.*)\))?$/.exec(text.trim());
  const time = Number(match?.[2]);
  if (match === null || !Number.isFinite(time)) return null;
  const pair = match[1] ?? '';
  return { pair, bodies: pair ? pair.split('|') : [], time, spec: match[3] ?? '' };
}
