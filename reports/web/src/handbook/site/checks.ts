// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Checks of the whole site: links lead somewhere, nothing is loaded from elsewhere, and both languages have
// the same structure.
import { posix } from 'node:path';
import { commandOf } from './fences.ts';
import type { Page } from './markup.ts';
import type { Site } from './site.ts';

/** Links and sources of a document that lead nowhere. `others`: files that the build adds (scripts, pictures). */
export function brokenLinks(files: ReadonlyMap<string, string>, others: (path: string) => boolean): string[] {
  const ids = new Map<string, Set<string>>();
  for (const [path, html] of files)
    ids.set(path, new Set([...html.matchAll(/ id="([^"]+)"/g)].map((m) => m[1] as string)));
  const broken: string[] = [];
  for (const [path, html] of files)
    for (const [, target = ''] of html.matchAll(/ (?:href|src)="([^"]*)"/g)) {
      if (/^(https?|mailto|data):/.test(target)) continue;
      const [file = '', anchor = ''] = target.split('#');
      const to = file === '' ? path : posix.normalize(posix.join(posix.dirname(path), file));
      const known = ids.get(to);
      if (!known && !others(to)) broken.push(`${path}: ${target}`);
      else if (anchor && known && !known.has(anchor)) broken.push(`${path}: ${target}, no such place`);
    }
  return broken;
}

/** Whatever a browser would load by itself from another place than the site. */
export function externalRequests(files: ReadonlyMap<string, string>): string[] {
  const found: string[] = [];
  for (const [path, text] of files) {
    const tags = text.matchAll(
      /<(?:img|script|link|iframe|source|video|audio|object|embed)\b[^>]*?(?:src|href|data)="((?:https?:)?\/\/[^"]*)"/g,
    );
    const styles = text.matchAll(/(?:url\(|@import )\s*['"]?((?:https?:)?\/\/[^'")\s]*)/g);
    for (const match of [...tags, ...styles]) found.push(`${path}: ${match[1]}`);
  }
  return found;
}

const runsOf = (page: Page) =>
  page.scenes.map((s) => [...s.sides.map((side) => commandOf(side.run)), ...s.metrics].join(' | '));

/** Everything that both languages of a page have in common, as text that can be compared. */
export function structureOf(page: Page): Record<string, string[]> {
  return {
    headings: page.headings.map((h) => `h${h.level}`),
    quotes: page.quotes.map((q) => `${q.file}: ${q.from} .. ${q.to ?? '}'}`),
    formulas: page.formulas.map((f) => f.replace(/\\text\{[^}]*\}/g, '\\text{}').replace(/\s+/g, ' ')),
    scenes: runsOf(page),
    exercises: page.exercises.map((e) =>
      [e.isJudged ? 'judge' : 'look', e.command, ...e.answer, ...e.wrong].join(' | '),
    ),
    commands: page.commands.map((c) => c.replace(/ +#.*$/, '')),
    code: page.code.map((c) => c.lang),
  };
}

/** Pages that a language lacks, and differences of structure. */
export function translationErrors(site: Site): string[] {
  const errors: string[] = [];
  for (const name of site.contents.parts.flatMap((part) => part.pages)) {
    const [en, zh] = (['en', 'zh'] as const).map((l) => site.pages.find((p) => p.language === l && p.name === name));
    if (!en || !zh) {
      errors.push(`${name}: ${en ? 'no Chinese' : 'no English'} page`);
      continue;
    }
    const [a, b] = [structureOf(en.page), structureOf(zh.page)];
    for (const key of Object.keys(a))
      if (JSON.stringify(a[key]) !== JSON.stringify(b[key]))
        errors.push(`${name}: ${key} differ: ${JSON.stringify(a[key])} and ${JSON.stringify(b[key])}`);
  }
  return errors;
}
