// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Colours of engines and bodies. Engines take the palette of Okabe and Ito, which colour-blind readers distinguish.
import { Color } from 'three';

const palette = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#8a6fd1', '#a0791a'];

/** Colour of the engine at a place in the list of those that take part. */
export const engineColour = (index: number): string => palette[index % palette.length] as string;

const golden = 0.618033988749895;
/** Neighbouring numbers get hues far apart. */
export function distinctColour(index: number, light: number, out: Color): Color {
  const hue = (0.58 + index * golden) % 1;
  const lighter = (index % 3) * 0.045;
  return out.setHSL(hue, 0.6, light + lighter);
}

/** Lighter for each one before it in the list that has the same colour: presets of one engine in one picture. */
export function distinguishable(colours: readonly string[]): string[] {
  const seen = new Map<string, number>();
  return colours.map((colour) => {
    const before = seen.get(colour) ?? 0;
    seen.set(colour, before + 1);
    const lighter = new Color(colour).lerp(new Color('#ffffff'), 1 - 0.78 ** before);
    return before === 0 ? colour : `#${lighter.getHexString()}`;
  });
}

export interface Theme {
  dark: boolean;
  background: string;
  gap: string; // colour between pictures
  ground: string;
  ink: string; // colour of outlines
  still: string; // colour of bodies that never move
  ghost: string;
  contact: string;
  normal: string;
  exact: string; // colour of the exact solution
  angle: string; // angle between a normal and the exact one
  impulse: string;
  penetration: string;
  velocity: string;
  spin: string;
  joint: string;
  bounds: string;
}

export const lightTheme: Theme = {
  dark: false,
  background: '#f7f9fb',
  gap: '#d5dbe3',
  ground: '#8b98a8',
  ink: '#1d2733',
  still: '#d3d9e0',
  ghost: '#5d6b7c',
  contact: '#d7263d',
  normal: '#d7263d',
  exact: '#00795c',
  angle: '#1d2733',
  impulse: '#f08a00',
  penetration: '#b5179e',
  velocity: '#0077c8',
  spin: '#7b2cbf',
  joint: '#1b8a5a',
  bounds: '#7d8794',
};

export const darkTheme: Theme = {
  dark: true,
  background: '#161c24',
  gap: '#343e4b',
  ground: '#73808f',
  ink: '#070a0e',
  still: '#4a5563',
  ghost: '#c3ccd8',
  contact: '#ff6b7d',
  normal: '#ff6b7d',
  exact: '#4fe0b0',
  angle: '#f2f5f9',
  impulse: '#ffb347',
  penetration: '#ff7be5',
  velocity: '#6ec6ff',
  spin: '#c79bff',
  joint: '#5fe0a4',
  bounds: '#93a0b0',
};
