// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The files beside the page of a large run that have the cases of its scenarios: which one has what.
import type { CaseFile, Scenario } from './data.ts';

/** The file that has the cases of a scenario; `files`: the first scenario of each. */
export const fileOf = (files: readonly number[], scenario: number): number =>
  files.filter((first) => first <= scenario).length - 1;

/** Puts the cases of a file, whose first scenario is `first`, in their places. */
export function placeCases(scenarios: Scenario[], first: number, cases: CaseFile): void {
  cases.forEach((list, i) => {
    const scenario = scenarios[first + i];
    if (scenario) scenario.cases = list;
  });
}
