// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Declared features of the engine, and its settings in each of its presets, as the run stored them.
import { type Child, el } from '../../common/elements.ts';
import { format, words } from '../../common/format.ts';
import type { Capability, Engine, EngineOption } from '../data.ts';
import { chip, facts, headRow, panel, scroll } from '../widgets.ts';

function said(value: Capability): Child {
  if (value === null) return '—';
  if (value === true) return chip('pass', 'yes');
  if (value === false) return chip('unsupported', 'no');
  if (Array.isArray(value))
    return value.length
      ? value.map((v) => el('span', { class: 'tag' }, String(v)))
      : el('span', { class: 'muted' }, 'none');
  if (typeof value !== 'object') return String(value);
  if (Object.keys(value).length === 0) return el('span', { class: 'muted' }, 'nothing');
  return Object.entries(value).map(([name, text]) =>
    el('div', null, el('span', { class: 'tag' }, name), ` ${typeof text === 'string' ? text : JSON.stringify(text)}`),
  );
}

/** The value in each preset; one that differs from the first preset's stands out. */
function optionRow(o: EngineOption, presets: string[]): HTMLElement {
  const range = o.values.length ? o.values.join(', ') : `${format(o.min)} … ${format(o.max)}`;
  const values = presets.map((preset) => o.presets[preset] ?? '—');
  return el(
    'tr',
    null,
    el('th', { class: 'sticky', scope: 'row' }, el('code', null, o.key)),
    values.map((value, i) =>
      el(
        'td',
        null,
        i === 0
          ? value
          : el(value === values[0] ? 'span' : 'b', { class: value === values[0] ? 'muted' : null }, value),
      ),
    ),
    el('td', { class: 'small' }, range),
    el('td', { class: 'small' }, o.help),
  );
}

export function capabilities({ described }: Engine): HTMLElement | null {
  if (!described) return null;
  const { capabilities, options, presets } = described;
  const settings = el(
    'table',
    { class: 'full' },
    headRow(['Setting', ...presets.map((preset) => el('code', null, preset)), 'Values', 'Meaning']),
    el(
      'tbody',
      null,
      options.map((o) => optionRow(o, presets)),
    ),
  );
  return panel(
    'capabilities',
    'Capabilities',
    el(
      'p',
      { class: 'muted' },
      'As the engine’s adapter says, and as the run stored it. What a scenario needs beyond this is “unsupported”: not in the library where its documentation is named here, else not in our adapter yet.',
    ),
    facts(Object.entries(capabilities).map(([key, value]) => [words(key), said(value)])),
    options.length
      ? [
          el(
            'h3',
            null,
            `Settings, in ${presets.length === 1 ? 'its one preset' : `each of ${presets.length} presets`}`,
          ),
          scroll(settings),
        ]
      : null,
  );
}
