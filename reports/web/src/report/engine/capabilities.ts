// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What the engine says that it can do, as the run stored it.
import { type Child, el } from '../../common/elements.ts';
import { words } from '../../common/format.ts';
import type { Capability, Engine } from '../data.ts';
import { facts, panel } from '../parts.ts';

function said(value: Capability): Child {
  if (value === null) return '—';
  if (value === true) return 'yes';
  if (value === false) return 'no';
  if (Array.isArray(value))
    return value.every((v) => typeof v !== 'object' || v === null)
      ? value.map((v) => el('span', { class: 'tag' }, String(v)))
      : value.map((v) => el('div', null, said(v)));
  if (typeof value === 'object') return facts(Object.entries(value).map(([k, v]) => [words(k), said(v)]));
  return String(value);
}

export function capabilities(engine: Engine): HTMLElement | null {
  const found = engine.capabilities;
  if (found === null || found === undefined || typeof found !== 'object' || Array.isArray(found)) return null;
  const entries = Object.entries(found);
  if (entries.length === 0) return null;
  return panel('capabilities', 'Capabilities', facts(entries.map(([k, v]) => [words(k), said(v)])));
}
