// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Chromium with the network cut, and reports to open in it. Tests that need it are skipped where it is not installed.
// CMake bundles all files of tests into one (build.mjs), so that they share one Chromium and each report is made once.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, rmSync } from 'node:fs';
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

let browser: Promise<Browser> | undefined;

/** The Chromium of all tests: started by the first one that needs it, closed after the last one. */
export function sharedBrowser(): Promise<Browser> {
  browser ??= chromium.launch({
    executablePath: found ?? '',
    // Debian starts it with GPU rasterization, which SwiftShader computes slower than the rasterizer of the processor.
    args: [
      '--headless=new',
      '--no-sandbox',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
      '--disable-gpu-rasterization',
    ],
  });
  return browser;
}
after(async () => (await browser)?.close());

export const screenshots = join(binaries, 'screenshots');

/** Runs a built program and returns what it prints. */
export const program = (name: string, ...args: string[]): string =>
  execFileSync(join(binaries, name), args, { encoding: 'utf8', maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'pipe'] });

/** A folder of this name that is empty or is not there. */
function emptyFolder(name: string): string {
  const folder = join(binaries, 'web_runs', name);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(join(binaries, 'web_runs'), { recursive: true });
  return folder;
}

/** A maker whose folder is made at its first call. All tests share the folder and only read it. */
const once = <T>(make: () => T): (() => T) => {
  let made: { value: T } | undefined;
  return () => {
    made ??= { value: make() };
    return made.value;
  };
};

/** A run of a suite or of scenarios by the built program. */
export function makeRunOf(name: string, ...what: string[]): string {
  const folder = emptyFolder(name);
  program('bin/rigor', 'validate', ...what, '--out', folder, '-j2');
  return folder;
}

/** A folder that `report_tool` writes. */
function synthetic(kind: string): string {
  const folder = emptyFolder(kind);
  program('tests/report_tool', kind, folder);
  return folder;
}

/** A run of the smoke suite on the engines of Debian 12, whatever else is installed: pages grow with each engine. */
export const smokeRun = once(() => makeRunOf('smoke', 'smoke', '--engines', 'rigor,bullet,box2d,ode,fcl'));

/** The report of a synthetic run with every bad ending, broken off, and of a study. */
export const makeSynthetic = once(() => synthetic('synthetic'));

/** Two reports of the synthetic run: `whole`, and `beside`, whose cases stand beside the page as those of a large run. */
export const makeLarge = once(() => synthetic('large'));

/** The report of a synthetic bench: growth, threads, an invalid timing, a crash, a baseline. */
export const makeBench = once(() => synthetic('bench'));

/** The history of three synthetic runs, the last one with one worse case. */
export const makeHistory = once(() => synthetic('history'));

/** The history of a run beside itself. */
export const makeTwoRuns = once(() => {
  const run = smokeRun();
  const [folder, again] = [join(run, '..', 'two_runs'), join(run, '..', 'smoke_again')];
  cpSync(run, again, { recursive: true });
  program('bin/rigor', 'history', run, again, '--out', folder);
  return folder;
});

/** The collision cases of the library that have closed forms. */
export const makeCollide = once(() => {
  const folder = emptyFolder('collide');
  try {
    program('bin/rigor', 'collide', 'analytic', '--engines', 'rigor,fcl,box2d', '--out', folder, '-q');
  } catch {
    // an engine may be wrong: the files are written all the same
  }
  return folder;
});

/** A contact problem by two solvers, and what `rigor solve` prints of it. */
export const makeSolve = once((): { folder: string; json: string } => {
  const folder = emptyFolder('solve');
  mkdirSync(folder);
  const file = join(folder, 'stack.hdf5');
  program('bin/rigor', 'freeze', 'stack_forces', '--engine', 'rigor', '--step', '30', '--out', file);
  const options = ['--solvers', 'rigor:solver=pgs,rigor:solver=nsgs', '--iterations', '1,10,100'];
  return { folder, json: program('bin/rigor', 'solve', file, ...options, '--out', folder, '--json', '-q') };
});

/** Rows of a run's store. */
export const query = (run: string, sql: string): unknown[][] =>
  JSON.parse(program('tests/report_tool', 'query', join(run, 'results.sqlite'), sql)) as unknown[][];

/** Longest wait of a test [ms]: on a busy machine a click alone may take ten seconds. */
const longestWait = 120_000;

export interface Watched {
  page: Page;
  faults: string[]; // errors of the console and of the page, and all network requests
  close: () => Promise<void>;
}

/** A page that can reach only allowed addresses, and its faults: errors, and other requests. */
export async function faultsOf(browser: Browser, options: BrowserContextOptions, mayRequest: (url: string) => boolean) {
  const context = await browser.newContext({ viewport: { width: 1400, height: 1000 }, ...options });
  context.setDefaultTimeout(longestWait);
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
  open: (hash?: string) => Promise<void>; // loads it anew
  follow: (hash: string) => Promise<void>; // as a link within the page does, which is quicker
  text: (selector: string) => Promise<string>; // text of the first one
  clean: () => void; // asserts that there were no faults
}

/** Has a report made before the suite's tests and closes its page after them. */
export function reportOf(make: () => string): Opened {
  const it = {
    open: (hash = '') => open(it.page, it.run, hash),
    follow: (hash: string) => follow(it.page, it.run, hash),
    text: async (selector: string) => (await it.page.locator(selector).first().textContent()) ?? '',
    clean: () => assert.deepEqual(it.faults, []),
  } as Opened;
  before(async () => {
    it.run = make();
    mkdirSync(screenshots, { recursive: true });
    it.browser = await sharedBrowser();
    Object.assign(it, await watched(it.browser));
  });
  after(() => it.close?.());
  return it;
}

/** Parts of a saved figure. */
export const figureOf = (page: Page, text: string) =>
  page.evaluate((svg) => {
    const parsed = new DOMParser().parseFromString(svg, 'image/svg+xml');
    const all = (selector: string) => [...parsed.querySelectorAll(selector)];
    const number = (node: Element | null | undefined, name: string) => Number(node?.getAttribute(name));
    const dashOf = (node: Element) => node.getAttribute('stroke-dasharray');
    const frame = parsed.querySelector('clipPath rect');
    return {
      fault: parsed.querySelector('parsererror')?.textContent ?? undefined,
      width: number(parsed.documentElement, 'width'),
      texts: all('text').map((node) => node.textContent ?? ''),
      lines: all('[data-line]').map((node) => node.getAttribute('data-line') ?? ''),
      samples: all('[data-line]').map((node) => node.querySelectorAll('circle').length),
      dashes: all('[data-line] > path:first-child').map(dashOf),
      legend: all('.legend path').map(dashOf),
      legendAt: Math.min(...all('.legend text').map((node) => number(node, 'x'))),
      frameEnd: number(frame, 'x') + number(frame, 'width'),
    };
  }, text);

/** Waits until what was requested so far is drawn. */
export const drawn = (page: Page): Promise<unknown> =>
  page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));

/** Opens a part of a report and waits until it is drawn. */
export async function open(page: Page, run: string, hash = ''): Promise<void> {
  await page.goto('about:blank');
  await page.goto(`file://${run}/index.html${hash}`);
  await page.waitForSelector('#page[data-shown]');
}

/** Goes to a part of a report without loading the page again, unless another page is open. */
async function follow(page: Page, run: string, hash: string): Promise<void> {
  const [address, now] = page.url().split('#');
  if (address !== `file://${run}/index.html` || `#${now ?? ''}` === hash) {
    await open(page, run, hash);
    return;
  }
  const before = await page.getAttribute('#page', 'data-shown');
  await page.evaluate((to) => {
    location.hash = to;
  }, hash);
  await page.waitForFunction((old) => document.querySelector('#page')?.getAttribute('data-shown') !== old, before);
}
