// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The pages of the handbook in memory: Markdown to documents, with the sources they quote. Files are written by main.ts;
// a test reads the same pages without a program, where no scene has numbers.
import { readFileSync } from 'node:fs';
import { join, posix } from 'node:path';
import { type Contents, hasPage, type Language, languages, pageFile, readContents, words } from './contents.ts';
import type { SceneFence } from './fences.ts';
import { documentHtml, type NavigationItem, rootOf, sceneHtml, sourceHtml } from './layout.ts';
import { type Page, renderPage } from './markup.ts';
import { chineseMetrics } from './metric_titles.ts';
import { type Recorder, scenarioFile } from './record.ts';
import { referenceWords } from './reference_words.ts';

/** Pages that are made from tables of the program: headings in the language, the tables' texts in English. */
export interface GeneratedPage {
  language: Language;
  name: string; // path without language and extension: "reference/metrics"
  title: string;
  html: string;
}

export interface SitePage {
  language: Language;
  name: string; // as in the contents
  path: string; // path from the root of the site
  page: Page;
}

export interface Site {
  contents: Contents;
  pages: SitePage[];
  files: Map<string, string>; // path from the root of the site to document
}

export const versionOf = (root: string): string =>
  readFileSync(join(root, 'CMakeLists.txt'), 'utf8').match(/project\(rigor VERSION ([0-9.]+)/)?.[1] ?? '';

export function makeSite(root: string, recorder: Recorder | null, generated: readonly GeneratedPage[]): Site {
  const contents = readContents(root);
  const sources = new Map<string, string>();
  const readSource = (file: string): string => {
    const known = sources.get(file);
    if (known !== undefined) return known;
    const text = readFileSync(join(root, file), 'utf8');
    sources.set(file, text);
    return text;
  };
  const sourcePath = (file: string) => `source/${file}.html`;

  const pages: SitePage[] = [];
  const errors: string[] = [];
  for (const language of languages)
    for (const name of contents.parts.flatMap((part) => part.pages)) {
      if (!hasPage(root, language, name)) continue;
      const path = `${language}/${name}.html`;
      const scene = (fence: SceneFence) => {
        for (const side of fence.sides) scenarioFile(root, side.run.scenario);
        return sceneHtml(
          fence,
          fence.sides.map((s) => recorder?.result(s.run) ?? null),
          path,
          language,
        );
      };
      try {
        const page = renderPage(readFileSync(pageFile(root, language, name), 'utf8'), {
          readSource,
          siteRoot: rootOf(path),
          sourceLink: (file, line) => `${rootOf(path)}${sourcePath(file)}#L${line}`,
          sceneHtml: scene,
          metric: (metric) =>
            metric in chineseMetrics && !metric.startsWith('mean_')
              ? {
                  href: `${rootOf(path)}${language}/reference/metrics.html#${metric}`,
                  title: language === 'zh' ? (chineseMetrics[metric] ?? '') : '',
                }
              : null,
          words: words[language],
        });
        for (const link of page.links) {
          // A link to a file of the repository leads to its copy on the site.
          const file = posix.normalize(
            posix.join(posix.dirname(`reports/handbook/${language}/${name}`), link.replace(/#.*/, '')),
          );
          if (/^[a-z]+:/.test(link) || link.startsWith('#') || file.startsWith('reports/handbook/')) continue;
          readSource(file);
          page.html = page.html.replaceAll(
            `href="${link.replace(/\.md(?=#|$)/, '.html')}"`,
            `href="${rootOf(path)}${sourcePath(file)}"`,
          );
        }
        pages.push({ language, name, path, page });
      } catch (error) {
        const message = error instanceof Error ? error.message : String(error);
        errors.push(`${language}/${name}.md: ${message.replace(/\nPlease report this to .*/, '')}`);
      }
    }

  if (errors.length > 0) throw new Error(errors.join('\nhandbook: '));

  const version = versionOf(root);
  const items = (language: Language) => {
    const parts = contents.parts.map((part) => ({
      title: part.title[language],
      pages: part.pages.flatMap((name): NavigationItem[] => {
        const found =
          pages.find((p) => p.language === language && p.name === name) ?? pages.find((p) => p.name === name);
        return found ? [{ path: found.path, title: found.page.headings[0]?.html ?? name }] : [];
      }),
    }));
    const more = generated
      .filter((g) => g.language === language)
      .map((g): NavigationItem => ({ path: `${language}/${g.name}.html`, title: g.title }));
    if (more.length > 0) parts.push({ title: referenceWords[language].part, pages: more });
    return parts;
  };
  const navigation = { en: items('en'), zh: items('zh') };
  const frame = (language: Language, path: string, title: string, otherLanguage: string | null) => ({
    language,
    path,
    title,
    name: contents.title[language],
    home: `${language}/index.html`,
    parts: navigation[language],
    otherLanguage,
    version,
  });

  const files = new Map<string, string>();
  for (const { language, name, path, page } of pages) {
    const twin = pages.find((p) => p.language !== language && p.name === name);
    files.set(path, documentHtml(frame(language, path, page.title, twin?.path ?? null), page.html));
  }
  for (const { language, name, title, html } of generated) {
    const path = `${language}/${name}.html`;
    const twin = `${language === 'en' ? 'zh' : 'en'}/${name}.html`;
    files.set(path, documentHtml(frame(language, path, title, twin), html));
  }
  for (const [file, text] of sources) {
    const path = sourcePath(file);
    files.set(path, documentHtml(frame('en', path, file, null), sourceHtml(file, text)));
  }
  files.set(
    'index.html',
    `<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta http-equiv="refresh" content="0; url=en/index.html"><title>${contents.title.en}</title></head><body><p><a href="en/index.html">English</a> · <a href="zh/index.html" lang="zh-Hans">中文</a></p></body></html>\n`,
  );
  return { contents, pages, files };
}
