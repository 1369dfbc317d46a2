// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pages of all commands by the rules of axe-core.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { axeFindings } from '../axe.ts';
import {
  makeBench,
  makeCollide,
  makeHistory,
  makeSolve,
  makeSynthetic,
  type Opened,
  reportOf,
  skip,
  smokeRun,
} from '../browser.ts';

/** Findings of a part of a report. */
async function findings(it: Opened, hash: string): Promise<string[]> {
  await (hash ? it.follow(hash) : it.open());
  return axeFindings(it.page);
}

describe('a run has no finding of axe-core', { skip }, () => {
  const it = reportOf(smokeRun);
  const tabs = ['', '#scoreboard', '#cost', '#contacts', '#ledger', '#method', '#glossary'];
  for (const hash of [...tabs, '#/scenario/free_flight', '#/scenario/box_stack', '#/engine/rigor', '#/engine/box2d'])
    test(hash || 'the overview', async () => assert.deepEqual(await findings(it, hash), []));
});

describe('a run with every bad ending has none', { skip }, () => {
  const it = reportOf(makeSynthetic);
  test('the overview', async () => assert.deepEqual(await findings(it, ''), []));
});

describe('a bench has none', { skip }, () => {
  const it = reportOf(makeBench);
  test('the overview', async () => assert.deepEqual(await findings(it, ''), []));
});

describe('a history has none', { skip }, () => {
  const it = reportOf(makeHistory);
  test('the page', async () => assert.deepEqual(await findings(it, ''), []));
});

describe('a page of collision queries has none', { skip }, () => {
  const it = reportOf(makeCollide);
  test('the page', async () => assert.deepEqual(await findings(it, ''), []));
});

describe('a page of contact problems has none', { skip }, () => {
  const it = reportOf(() => makeSolve().folder);
  test('the page', async () => assert.deepEqual(await findings(it, ''), []));
});
