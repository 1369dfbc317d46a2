// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Content of a free plot as text for the address: "block~py~t~", "block|floor~depth~t~<spec>", "block~vx~px~".

export interface Choice {
  of: string; // a body, or two as "a|b"
  y: string; // key of a quantity
  x: string; // key of a quantity of the same, "t": time
  spec: string; // "" all engines that are switched on
}

export const encodeChoice = ({ of, y, x, spec }: Choice): string =>
  [of, y, x, spec].map((part) => encodeURIComponent(part).replaceAll('~', '%7E')).join('~');

export function decodeChoice(text: string): Choice | null {
  const parts = text.split('~');
  if (parts.length !== 4 || !parts[0] || !parts[1]) return null;
  try {
    const [of, y, x, spec] = parts.map(decodeURIComponent) as [string, string, string, string];
    return { of, y, x: x || 't', spec };
  } catch {
    return null;
  }
}

/** The address with these plots. */
export function withPlots(hash: string, choices: Choice[]): string {
  const at = hash.indexOf('?');
  const query = new URLSearchParams(at < 0 ? '' : hash.slice(at + 1));
  query.delete('plot');
  for (const choice of choices) query.append('plot', encodeChoice(choice));
  return `${at < 0 ? hash : hash.slice(0, at)}${query.size > 0 ? `?${query}` : ''}`;
}
