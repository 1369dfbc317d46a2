// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The search field of the header: opens the scenario, engine or tab of that name, and the scoreboard with the scenarios that
// contain the words for anything else. "/" goes to it from everywhere.
import { el } from '../common/elements.ts';
import { allScenarios, scoreboardLink } from './overview/filters.ts';
import { tabs } from './overview/page.ts';
import { engineLink, run, scenarioLink } from './run.ts';

/** Addresses by what one may type, as it is shown. */
function targets(): Map<string, string> {
  const found = new Map<string, string>();
  for (const s of run.scenarios) found.set(s.name, scenarioLink(s.name));
  for (const engine of new Set(run.columns.map((c) => c.engine))) found.set(engine, engineLink(engine));
  for (const tab of tabs) found.set(tab.title, `#${tab.id}`);
  return found;
}

export function searchField(): HTMLElement {
  const known = targets();
  const field = el('input', {
    type: 'search',
    placeholder: 'Search',
    'aria-label': 'Scenario, engine or words',
    title: 'Scenario, engine, part of the report or words (key: /)',
    list: 'search-known',
    autocomplete: 'off',
  }) as HTMLInputElement;
  const go = (address: string) => {
    field.value = '';
    field.blur();
    location.hash = address;
  };
  field.addEventListener('input', (e) => {
    // A choice from the list is no typing.
    const address = known.get(field.value);
    if (address !== undefined && (e as InputEvent).inputType !== 'insertText') go(address);
  });
  field.addEventListener('keydown', (e) => {
    if (e.key !== 'Enter' || !field.value.trim()) return;
    go(known.get(field.value.trim()) ?? scoreboardLink({ ...allScenarios, text: field.value.trim() }));
  });
  addEventListener('keydown', (e) => {
    const typing = e.target instanceof Element && e.target.closest('input, select, textarea');
    if (e.key !== '/' || typing || e.ctrlKey || e.metaKey || e.altKey) return;
    e.preventDefault();
    field.focus();
  });
  const options = [...known.keys()].map((name) => el('option', { value: name }));
  return el('search', { class: 'search noprint' }, field, el('datalist', { id: 'search-known' }, options));
}
