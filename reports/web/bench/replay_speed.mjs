// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// node bench/replay_speed.mjs [bodies] [frames] What a frame of the replay costs the processor, in Chromium without a
// graphics card: medians and 95th percentiles of the page's own part (placing, colouring, overlays) and of the whole
// drawing, which here includes the pixels.
import { existsSync } from 'node:fs';
import { build } from 'esbuild';
import { chromium } from 'playwright-core';

const bodies = Number(process.argv[2] ?? 2000);
const frames = Number(process.argv[3] ?? 120);
const found = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
if (found === undefined) throw new Error('Chromium is not installed');

const bundle = await build({
  entryPoints: ['bench/replay_page.ts'],
  bundle: true,
  write: false,
  format: 'iife',
  minify: true,
});
const browser = await chromium.launch({
  executablePath: found,
  args: [
    '--headless=new',
    '--no-sandbox',
    '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader',
    '--enable-precise-memory-info',
  ],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
page.on('pageerror', (error) => console.error(error));
await page.setContent('<!doctype html><body></body>');
await page.addScriptTag({ content: bundle.outputFiles[0].text });

const quantile = (list, q) => [...list].sort((a, b) => a - b)[Math.floor(q * (list.length - 1))];
const ms = (seconds) => `${(seconds * 1e3).toFixed(2)} ms`;
for (const contacts of [true, false]) {
  const m = await page.evaluate(([b, f, c]) => globalThis.measure(b, f, c), [bodies, frames, contacts]);
  console.log(
    `${m.bodies} bodies, ${m.contacts} contacts, ${m.calls} draw calls: own script ${ms(quantile(m.own, 0.5))} ` +
      `(95 %: ${ms(quantile(m.own, 0.95))}), with three.js and software rendering ${ms(quantile(m.all, 0.5))} ` +
      `(95 %: ${ms(quantile(m.all, 0.95))}), heap ${(m.heap / m.frames / 1024).toFixed(0)} KiB a frame`,
  );
}
await browser.close();
