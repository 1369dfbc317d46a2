// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// node bench/replay_speed.mjs [bodies] [frames] [pictures] What a frame of the replay costs, in Chromium without a
// graphics card: medians and 95th percentiles of the page's own part (placing, colouring, overlays) and of the whole
// script; processor time of all of the browser, with the pixels; and frames that were shown in a second.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { build } from 'esbuild';
import { chromium } from 'playwright-core';

const bodies = Number(process.argv[2] ?? 2000);
const frames = Number(process.argv[3] ?? 120);
const pictures = Number(process.argv[4] ?? 1);
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

/** Processor time of this process and all below it [s]. */
function spent() {
  const known = new Map();
  for (const id of readdirSync('/proc').filter((name) => /^[0-9]+$/.test(name)))
    try {
      const stat = readFileSync(`/proc/${id}/stat`, 'utf8');
      const fields = stat
        .slice(stat.lastIndexOf(')') + 2)
        .split(' ')
        .map(Number);
      known.set(Number(id), { parent: fields[1], ticks: fields[11] + fields[12] });
    } catch {
      // it has ended
    }
  const below = (id) => {
    for (let at = id; at !== undefined; at = known.get(at)?.parent) if (at === process.pid) return true;
    return false;
  };
  return [...known].reduce((sum, [id, { ticks }]) => sum + (below(id) ? ticks : 0), 0) / 100;
}

const quantile = (list, q) => [...list].sort((a, b) => a - b)[Math.floor(q * (list.length - 1))];
const ms = (seconds) => `${(seconds * 1e3).toFixed(2)} ms`;
for (const contacts of [true, false]) {
  const before = spent();
  const m = await page.evaluate((all) => globalThis.measure(...all), [bodies, frames, pictures, contacts]);
  const each = (spent() - before) / m.frames;
  console.log(
    `${m.pictures} x ${m.bodies} bodies, ${m.contacts} contacts, ${m.calls} draw calls: own script ` +
      `${ms(quantile(m.own, 0.5))} (95 %: ${ms(quantile(m.own, 0.95))}), with three.js ${ms(quantile(m.all, 0.5))} ` +
      `(95 %: ${ms(quantile(m.all, 0.95))}), heap ${(m.heap / m.frames / 1024).toFixed(0)} KiB a frame; ` +
      `${m.played.toFixed(1)} frames/s, ${ms(each)} of processor time each`,
  );
}
await browser.close();
