// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Chromium with the network cut, and reports to open in it. Tests that need it are skipped where it is not installed.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before } from 'node:test';
import { type Browser, type BrowserContextOptions, chromium, type Page } from 'playwright-core';

const binaries = process.env.RIGOR_BINARY_DIR ?? '';
const found = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find((path) =>
  existsSync(path),
);
/** Reason why browser tests cannot run; false if they can. */
export const skip: string | false =
  found === undefined ? 'Chromium is not installed' : binaries === '' ? 'RIGOR_BINARY_DIR is not set' : false;

export const launch = (): Promise<Browser> =>
  chromium.launch({
    executablePath: found ?? '',
    args: ['--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });

export const screenshots = join(binaries, 'screenshots');

/** Runs a built program and returns what it prints. */
export const program = (name: string, ...args: string[]): string =>
  execFileSync(join(binaries, name), args, { encoding: 'utf8', maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'pipe'] });

/** A run of a suite or of scenarios by the built program, in a folder of the test's own. */
export function makeRunOf(name: string, ...what: string[]): string {
  const folder = join(binaries, 'web_runs', name);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(join(binaries, 'web_runs'), { recursive: true });
  program('bin/rigor', 'validate', ...what, '--out', folder, '-j2');
  return folder;
}

/** This call of the test runner, which starts a process for each file of tests. */
const session = (): string => {
  const stat = readFileSync(`/proc/${process.ppid}/stat`, 'utf8');
  // start time of the process, since ids are used again
  return `${process.ppid}-${stat.slice(stat.lastIndexOf(')') + 2).split(' ')[19]}`;
};

/**
 * A run of the smoke suite, made once for all files of tests: by the one that comes first, while the others wait. Tests
 * read it only.
 */
export async function smokeRun(): Promise<string> {
  const folder = join(binaries, 'web_runs', 'smoke');
  const made = join(binaries, 'web_runs', 'smoke.made');
  const [mine, failed] = [session(), `failed ${session()}`];
  mkdirSync(join(binaries, 'web_runs'), { recursive: true });
  try {
    mkdirSync(join(binaries, 'web_runs', `smoke-${mine}.lock`));
  } catch {
    for (;;) {
      const now = existsSync(made) ? readFileSync(made, 'utf8') : '';
      if (now === mine) return folder;
      assert.notEqual(now, failed, 'the smoke suite could not be run: another file of tests says why');
      await new Promise((go) => setTimeout(go, 200));
    }
  }
  for (const name of readdirSync(join(binaries, 'web_runs')))
    if (/^smoke-.*\.lock$/.test(name) && name !== `smoke-${mine}.lock`)
      rmSync(join(binaries, 'web_runs', name), { recursive: true });
  try {
    makeRunOf('smoke', 'smoke');
    writeFileSync(made, mine);
  } catch (error) {
    writeFileSync(made, failed);
    throw error;
  }
  return folder;
}

/** The report of a synthetic run with every bad ending, broken off, and of a study. */
export function makeSynthetic(name: string): string {
  const folder = join(binaries, 'web_runs', name);
  rmSync(folder, { recursive: true, force: true });
  program('tests/report_tool', 'synthetic', folder);
  return folder;
}

/** The report of a synthetic bench: growth, threads, an invalid timing, a crash, a baseline. */
export function makeBench(name: string): string {
  const folder = join(binaries, 'web_runs', name);
  rmSync(folder, { recursive: true, force: true });
  program('tests/report_tool', 'bench', folder);
  return folder;
}

/** The history of three synthetic runs, the last one with one worse case. */
export function makeHistory(name: string): string {
  const folder = join(binaries, 'web_runs', name);
  rmSync(folder, { recursive: true, force: true });
  program('tests/report_tool', 'history', folder);
  return folder;
}

/** The collision cases of the library that have closed forms. */
export function makeCollide(name: string): string {
  const folder = join(binaries, 'web_runs', name);
  rmSync(folder, { recursive: true, force: true });
  try {
    program('bin/rigor', 'collide', 'analytic', '--engines', 'rigor,fcl', '--out', folder, '-q');
  } catch {
    // an engine may be wrong: the files are written all the same
  }
  return folder;
}

/** A contact problem by two solvers, and what `rigor solve` prints of it. */
export function makeSolve(name: string): { folder: string; json: string } {
  const folder = join(binaries, 'web_runs', name);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const file = join(folder, 'stack.hdf5');
  program('bin/rigor', 'freeze', 'stack_forces', '--engine', 'rigor', '--step', '30', '--out', file);
  const options = ['--solvers', 'rigor:solver=pgs,rigor:solver=nsgs', '--iterations', '1,10,100'];
  return { folder, json: program('bin/rigor', 'solve', file, ...options, '--out', folder, '--json', '-q') };
}

/** Rows of a run's store. */
export const query = (run: string, sql: string): unknown[][] =>
  JSON.parse(program('tests/report_tool', 'query', join(run, 'results.sqlite'), sql)) as unknown[][];

export interface Watched {
  page: Page;
  faults: string[]; // errors of the console and of the page, and all network requests
  close: () => Promise<void>;
}

/** A page that can reach only allowed addresses, and its faults: errors, and other requests. */
export async function faultsOf(browser: Browser, options: BrowserContextOptions, mayRequest: (url: string) => boolean) {
  const context = await browser.newContext({ viewport: { width: 1400, height: 1000 }, ...options });
  const faults: string[] = [];
  await context.route('**/*', (route) => {
    const url = route.request().url();
    if (mayRequest(url)) return route.continue();
    faults.push(`fetched ${url}`);
    return route.abort();
  });
  const page = await context.newPage();
  page.on('console', (message) => {
    if (message.type() === 'error') faults.push(`console: ${message.text()}`);
  });
  page.on('pageerror', (error) => faults.push(`error: ${error.message}`));
  return { page, context, faults };
}

/** A page that can reach files alone, and reports every error. */
export async function watched(browser: Browser, options: BrowserContextOptions = {}): Promise<Watched> {
  const mayRequest = (url: string) => /^(file|data|blob):/.test(url);
  const { page, context, faults } = await faultsOf(browser, { offline: true, ...options }, mayRequest);
  page.on('requestfailed', (request) => {
    // Leaving a page breaks off what it still loads: no fault of the page.
    if (request.failure()?.errorText !== 'net::ERR_ABORTED') faults.push(`failed: ${request.url()}`);
  });
  return { page, faults, close: () => context.close() };
}

/** Tools of a suite about one report; ready before its first test. */
export interface Opened extends Watched {
  run: string;
  browser: Browser;
  open: (hash?: string) => Promise<void>;
  text: (selector: string) => Promise<string>; // text of the first one
  clean: () => void; // asserts that there were no faults
}

/** Makes a report before the suite's tests and closes its page after them. */
export function reportOf(make: () => string | Promise<string>): Opened {
  const it = {
    open: (hash = '') => open(it.page, it.run, hash),
    text: async (selector: string) => (await it.page.locator(selector).first().textContent()) ?? '',
    clean: () => assert.deepEqual(it.faults, []),
  } as Opened;
  before(async () => {
    it.run = await make();
    mkdirSync(screenshots, { recursive: true });
    it.browser = await launch();
    Object.assign(it, await watched(it.browser));
  });
  after(async () => {
    await it.close?.();
    await it.browser?.close();
  });
  return it;
}

/** Opens a part of a report and waits until it is drawn. */
export async function open(page: Page, run: string, hash = ''): Promise<void> {
  await page.goto('about:blank');
  await page.goto(`file://${run}/index.html${hash}`);
  await page.waitForSelector('#page[data-shown]');
}
