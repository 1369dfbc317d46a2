// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor view` as it was built, and a page that may reach it alone.
import { spawn } from 'node:child_process';
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import type { Browser, BrowserContext, Page } from 'playwright-core';
import { faultsOf, screenshots } from './browser.ts';

const binaries = process.env.RIGOR_BINARY_DIR ?? '';

export async function shoot(page: Page, name: string): Promise<void> {
  mkdirSync(screenshots, { recursive: true });
  await page.screenshot({ path: join(screenshots, `${name}.png`) });
}

export interface Program {
  url: string;
  origin: string;
  /** Ends it as Ctrl-C does; its exit code. */
  end: () => Promise<number | null>;
}

export function view(args: string[], environment: Record<string, string> = {}): Promise<Program> {
  const program = spawn(join(binaries, 'bin/rigor'), ['view', ...args, '--json'], {
    stdio: ['ignore', 'pipe', 'inherit'],
    env: { ...process.env, ...environment },
  });
  const ended = new Promise<number | null>((resolve) => program.once('exit', resolve));
  const end = () => {
    program.kill('SIGINT');
    return ended;
  };
  return new Promise((resolve, reject) => {
    program.once('exit', (code) => reject(new Error(`rigor view ended with ${code}`)));
    createInterface({ input: program.stdout }).once('line', (line) => {
      const url = String(JSON.parse(line).url);
      resolve({ url, origin: new URL(url).origin, end });
    });
  });
}

export interface Watched {
  page: Page;
  context: BrowserContext;
  faults: string[]; // errors of the console and of the page, and requests to any other host
}

export const watched = (browser: Browser, program: Program): Promise<Watched> =>
  faultsOf(browser, {}, (url) => url.startsWith(program.origin) || /^(data|blob):/.test(url));
