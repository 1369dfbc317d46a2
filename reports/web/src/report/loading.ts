// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The cases of a large run, and its lists over all scenarios, stand beside the page and are loaded when something needs
// them, each file once.
import { loadJsonOnce } from '../common/data_files.ts';
import { fileOf, placeCases } from './case_files.ts';
import type { CaseFile, RunLists } from './data.ts';
import { run } from './run.ts';

const loaded = new Map<number, Promise<void>>();

function loadFile(file: number, first: number): Promise<void> {
  let found = loaded.get(file);
  if (found === undefined) {
    found = loadJsonOnce<CaseFile>(`cases-${file}`).then((cases) => placeCases(run.scenarios, first, cases));
    loaded.set(file, found);
    found.catch(() => loaded.delete(file));
  }
  return found;
}

/** Loads the cases of a scenario, or of all. Rejects when a file is missing or damaged. */
export async function loadCases(scenario?: number): Promise<void> {
  const files = run.caseFiles ?? [];
  const own = scenario === undefined ? -1 : fileOf(files, scenario);
  for (const [file, first] of files.entries()) if (own < 0 || file === own) await loadFile(file, first);
}

let lists: Promise<void> | undefined;

/** Loads the audit and the parity ledger of all scenarios. Rejects when the file is missing or damaged. */
export function loadLists(): Promise<void> {
  if (!run.caseFiles) return Promise.resolve();
  lists ??= loadJsonOnce<RunLists>('lists').then((found) => void Object.assign(run, found));
  lists.catch(() => {
    lists = undefined;
  });
  return lists;
}
