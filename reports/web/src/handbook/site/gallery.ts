// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The gallery: scenes of the library as `rigor draw` shows them (reports/handbook/gallery.json), and the reference
// report of this version where it has been made.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import type { Json } from '../../replay/json.ts';
import type { Language } from './contents.ts';
import { escaped, withOptions } from './markup.ts';
import { scenarioFile } from './record.ts';
import { referenceWords } from './reference_words.ts';
import { type GeneratedPage, versionOf } from './site.ts';

interface Picture {
  scenario: string;
  zh: string; // title in Chinese
  engine: string;
  at: number; // [s]
  show?: string;
  turn?: number;
  lift?: number;
}

export const readGallery = (root: string): Picture[] =>
  JSON.parse(readFileSync(join(root, 'reports/handbook/gallery.json'), 'utf8')) as Picture[];

const drawing = (p: Picture, file: string, out: string): string[] => [
  'draw',
  file,
  '--engine',
  p.engine,
  '--at',
  String(p.at),
  '--show',
  p.show ?? 'outline,joint',
  ...(p.turn === undefined ? [] : ['--turn', String(p.turn)]),
  ...(p.lift === undefined ? [] : ['--lift', String(p.lift)]),
  '--width',
  '520',
  '--out',
  out,
];

export function galleryPage(root: string, program: string, folder: string, language: Language): GeneratedPage {
  const w = referenceWords[language];
  mkdirSync(folder, { recursive: true });
  const cards = readGallery(root).map((picture) => {
    const source = scenarioFile(root, picture.scenario);
    const name = `${picture.scenario}.png`;
    const out = join(folder, name);
    const newest = Math.max(statSync(source).mtimeMs, statSync(program).mtimeMs);
    if (!existsSync(out) || statSync(out).mtimeMs < newest) {
      const ended = spawnSync(program, drawing(picture, source, out), { encoding: 'utf8', timeout: 120_000 });
      if (ended.status !== 0) throw new Error(`gallery: ${picture.scenario}: ${ended.stderr}`);
    }
    const scenario = JSON.parse(readFileSync(source, 'utf8')) as Json;
    const command = `./rigor ${drawing(picture, picture.scenario, name).join(' ')}`;
    const title = escaped(language === 'zh' ? picture.zh : scenario.title);
    return `<article class="card"><img src="../pictures/${name}" alt="${title}"><div class="below"><h2>${title}</h2><p class="muted"><a href="reference/scenarios.html#${picture.scenario}"><code>${picture.scenario}</code></a> · ${escaped(picture.engine)} · ${picture.at} s</p><details><summary>${w.command}</summary><code>${withOptions(escaped(command))}</code></details></div></article>`;
  });
  const report = existsSync(join(folder, '../report/index.html'))
    ? `<p><a href="../report/index.html">${w.report}</p>`
    : `<p>${w.noReport}</p>`;
  return {
    language,
    name: 'gallery',
    title: w.gallery,
    html: `<h1>${w.gallery}</h1>\n<p>${w.galleryText(escaped(versionOf(root)))}</p>\n${report}\n<div class="cards">${cards.join('\n')}</div>`,
  };
}
