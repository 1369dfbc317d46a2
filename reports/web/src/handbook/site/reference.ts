// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pages of the reference, from the tables of the program (`rigor list ... --json`, `--help`) and from documents that
// stand beside the code they describe.
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import katex from 'katex';
import type { Json } from '../../replay/json.ts';
import { apiHtml } from './api.ts';
import { type Language, languages, words } from './contents.ts';
import { escaped, renderPage } from './markup.ts';
import { chineseMetrics } from './metric_titles.ts';
import { chineseHeadings, referenceWords } from './reference_words.ts';
import type { GeneratedPage } from './site.ts';

/** A document of the repository that is a page as it stands. */
interface Document {
  file: string;
  page: string;
  title?: string; // else the first heading of the file
}

const documents: Document[] = [
  { file: 'scenarios/FORMAT.md', page: 'scenario-format' },
  { file: 'adapters/guest/PROTOCOL.md', page: 'protocol' },
  { file: 'reports/FORMATS.md', page: 'report-formats' },
  { file: 'validation/results/README.md', page: 'results', title: 'The store of results' },
  { file: 'validation/accuracy/README.md', page: 'accuracy' },
  { file: 'engine/LIMITS.md', page: 'limits' },
  { file: 'scenarios/exchange/README.md', page: 'models' },
  { file: 'scenarios/exchange/MODELS.md', page: 'models-tried' },
  { file: 'reports/python/README.md', page: 'python' },
];

/** Output of the program by its arguments: both languages show the same tables. */
const outputs = new Map<string, string>();

function output(program: string, given: string[]): string {
  const known = outputs.get(given.join(' '));
  if (known !== undefined) return known;
  const ended = spawnSync(program, given, { encoding: 'utf8', maxBuffer: 1 << 26, timeout: 120_000 });
  if (ended.status !== 0) throw new Error(`${given.join(' ')} ended with ${ended.status}: ${ended.stderr}`);
  outputs.set(given.join(' '), ended.stdout);
  return ended.stdout;
}

const list = (program: string, what: string): Json[] => JSON.parse(output(program, ['list', what, '--json'])) as Json[];

const filter = (language: Language) =>
  `<p><input class="filter" type="search" aria-label="${words[language].filter}" placeholder="${words[language].filter}"></p>\n`;
const entry = (id: string, name: string, body: string) =>
  `<section class="entry" data-entry id="${escaped(id)}"><h2><code>${escaped(name)}</code></h2>${body}</section>\n`;
const paragraph = (text: string, kind = '') => (text ? `<p${kind ? ` class="${kind}"` : ''}>${escaped(text)}</p>` : '');

function formulaHtml(tex: string, plain: string): string {
  if (tex)
    return `<div class="formula" tabindex="0">${katex.renderToString(tex, { displayMode: true, throwOnError: true, strict: 'ignore' })}</div>`;
  return plain ? `<p><code>${escaped(plain)}</code></p>` : '';
}

function page(language: Language, name: string, title: string, body: string): GeneratedPage {
  return { language, name: `reference/${name}`, title, html: `<h1>${escaped(title)}</h1>\n${body}` };
}

function metrics(program: string, language: Language): GeneratedPage {
  const w = referenceWords[language];
  const entries = list(program, 'metrics').map((m) =>
    entry(
      m.name,
      m.name,
      `${paragraph(language === 'zh' ? chineseMetrics[m.name] : m.title)}<p><code>${escaped(m.formula)}</code></p>${paragraph(w.metricFacts(m.kind, m.unit), 'muted')}`,
    ),
  );
  return page(language, 'metrics', w.metrics, paragraph(w.metricsText) + filter(language) + entries.join(''));
}

function references(program: string, language: Language): GeneratedPage {
  const w = referenceWords[language];
  const entries = list(program, 'references').map((r) =>
    entry(
      r.name,
      r.name,
      paragraph(r.title) +
        formulaHtml(r.tex ?? '', r.formula ?? '') +
        paragraph(r.source ? w.source + r.source : '', 'muted'),
    ),
  );
  return page(language, 'references', w.references, paragraph(w.referencesText) + filter(language) + entries.join(''));
}

function scenarios(program: string, language: Language): GeneratedPage {
  const w = referenceWords[language];
  const entries = list(program, 'scenarios').map((s) => {
    const facts = [...w.sceneFacts(s.dimension, s.bodies, s.duration), ...(s.isolates ?? [])];
    const reference = s.reference
      ? `<p class="muted">${w.reference}${w.colon}<a href="references.html#${escaped(s.reference)}"><code>${escaped(s.reference)}</code></a></p>`
      : '';
    return entry(s.name, s.name, paragraph(s.title) + paragraph(facts.join(w.comma), 'muted') + reference);
  });
  return page(language, 'scenarios', w.scenarios, filter(language) + entries.join(''));
}

function algorithms(program: string, language: Language): GeneratedPage {
  const w = referenceWords[language];
  const stages = new Map<string, Json[]>();
  for (const a of list(program, 'algorithms')) {
    const known = stages.get(a.stage);
    if (known) known.push(a);
    else stages.set(a.stage, [a]);
  }
  const parts = [...stages].map(([stage, all]) => {
    const rows = all.map(
      (a) =>
        `<tr data-entry><td><code>${escaped(a.name)}</code></td><td>${escaped(a.summary ?? '')}${a.default ? ` <b>${w.isDefault}</b>` : ''}</td></tr>`,
    );
    return `<h2 id="${escaped(stage)}">${escaped(stage.replaceAll('_', ' '))}</h2><div class="table" tabindex="0"><table><tbody>${rows.join('')}</tbody></table></div>`;
  });
  return page(language, 'algorithms', w.algorithms, paragraph(w.algorithmsText) + filter(language) + parts.join('\n'));
}

function engineOptions(options: Json[], columns: readonly string[]): string {
  const rows = options.map((o) => {
    const values = o.values ? o.values.join(', ') : o.range ? `${o.range[0]} … ${o.range[1]}` : '';
    return `<tr data-entry><td><code>${escaped(String(o.key))}</code></td><td data-title="${columns[1]}">${escaped(String(o.default ?? ''))}</td><td data-title="${columns[2]}">${escaped(String(o.matched ?? ''))}</td><td>${escaped(String(o.help ?? ''))}<br><span class="muted">${escaped(values)}</span></td></tr>`;
  });
  return `<div class="table settings" tabindex="0"><table><thead><tr>${columns.map((c) => `<th>${c}</th>`).join('')}</tr></thead><tbody>${rows.join('')}</tbody></table></div>`;
}

function specs(program: string, language: Language): GeneratedPage {
  const w = referenceWords[language];
  const engines = list(program, 'engines').filter((e) => !e.problem);
  const parts = engines.map((e) => {
    const facts = w.facts(e.version, (e.precisions ?? []).join(w.comma), (e.presets ?? []).join(w.comma));
    return `<h2 id="${escaped(e.name)}">${escaped(e.title)} (<code>${escaped(e.name)}</code>)</h2>${paragraph(facts, 'muted')}${engineOptions(e.options ?? [], w.specColumns)}`;
  });
  return page(language, 'specs', w.specs, `<p>${w.specsText}</p>${filter(language)}${parts.join('\n')}`);
}

function studies(program: string, language: Language): GeneratedPage {
  const w = referenceWords[language];
  const row = (s: Json, parts: string[]) =>
    `<tr><td><code>${escaped(s.name)}</code></td><td>${escaped(s.title)}<br><span class="muted">${escaped(parts.join(', '))}</span></td></tr>`;
  const table = (rows: string[]) =>
    `<div class="table" tabindex="0"><table><tbody>${rows.join('')}</tbody></table></div>`;
  const suites = list(program, 'suites').map((s) => row(s, [w.suiteSize((s.scenarios ?? []).length)]));
  const studyTable = table(list(program, 'studies').map((s) => row(s, s.parts ?? [])));
  return page(
    language,
    'suites-and-studies',
    w.studiesPage,
    `<h2>${w.suites}</h2>${paragraph(w.suitesText)}${table(suites)}<h2>${w.studies}</h2>${paragraph(w.studiesText)}${studyTable}`,
  );
}

/** Help of the program with its long lines broken at `width`; what follows stands below the explanation. */
export function reflowed(help: string, width: number): string {
  return help
    .split('\n')
    .map((line) => {
      if (line.length <= width) return line;
      const indent = ' '.repeat((line.match(/^ +\S.*? {2,}(?=\S)|^ */)?.[0] ?? '').length);
      let now = line.slice(0, indent.length);
      const lines: string[] = [];
      for (const word of line.slice(indent.length).split(' ')) {
        if (now.length + word.length > width && now.trim()) {
          lines.push(now.trimEnd());
          now = indent;
        }
        now += `${word} `;
      }
      return [...lines, now.trimEnd()].join('\n');
    })
    .join('\n');
}

const helpWidth = 112; // characters that fit a wide block

function commandLine(program: string, language: Language): GeneratedPage {
  const w = referenceWords[language];
  const main = output(program, ['--help']);
  const names = [...(main.split('Subcommands:')[1]?.split('\n\n')[0] ?? '').matchAll(/^ {2}([a-z]+) /gm)].map(
    (m) => m[1] as string,
  );
  if (names.length < 10) throw new Error('the help of the program names fewer than ten commands');
  const common = main.slice(main.indexOf('Exit codes:'));
  const block = (text: string) =>
    `<div class="code wide help"><pre tabindex="0"><code>${escaped(reflowed(text.trim(), helpWidth))}</code></pre></div>`;
  const parts = names.map((name) => {
    const help = output(program, [name, '--help']);
    return `<h2 id="${name}">rigor ${name}</h2>${block(help.replace(common, ''))}`;
  });
  return page(language, 'command-line', w.commandLine, block(main) + parts.join('\n'));
}

/** A document of the repository; its links to others lead to their pages, those to files are left as text. */
function documentPage(root: string, { file, page: name, title }: Document, language: Language): GeneratedPage {
  const made = renderPage(readFileSync(join(root, file), 'utf8'), {
    readSource: () => '',
    siteRoot: '',
    sourceLink: () => '',
    sceneHtml: () => '',
    metric: () => null,
    words: words[language],
  });
  const html = made.html.replace(/<a href="([^"]*)">([\s\S]*?)<\/a>/g, (whole, target: string, text: string) => {
    if (/^https?:/.test(target)) return whole;
    const to = relative('.', join(dirname(file), target.replace(/#.*/, '').replace(/\.html$/, '.md')));
    const known = documents.find((d) => d.file === to);
    return known ? `<a href="${known.page}.html">${text}</a>` : text;
  });
  const note = `<p class="muted">${referenceWords[language].from(escaped(file))}</p>`;
  const english = title ?? made.title;
  const headed = language === 'zh' ? html.replace(/(<h[1-4][^>]*>)([\s\S]*?)(<\/h[1-4]>)/g, inChinese) : html;
  return {
    language,
    name: `reference/${name}`,
    title: language === 'zh' ? (chineseHeadings[english] ?? english) : english,
    html: headed.replace('</h1>', `</h1>\n${note}`),
  };
}

/** A heading of a document in Chinese, with the English one behind it: the text below is English. */
function inChinese(whole: string, open: string, text: string, close: string): string {
  const plain = text.replace(/<[^>]*>/g, '').replaceAll('&#39;', "'");
  const chinese = chineseHeadings[plain];
  return chinese ? `${open}${chinese} <small lang="en">${text}</small>${close}` : whole;
}

function schemas(root: string, language: Language): GeneratedPage {
  const w = referenceWords[language];
  const block = (name: string) => {
    const text = readFileSync(join(root, 'scenarios/schema', name), 'utf8');
    return `<h2>${escaped(name)}</h2><details><summary>${w.lines(text.split('\n').length)}</summary><div class="code"><pre tabindex="0"><code>${escaped(text)}</code></pre></div></details>`;
  };
  const names = ['scenario.schema.json', 'suite.schema.json', 'study.schema.json', 'collision.schema.json'];
  return page(language, 'schemas', w.schemas, paragraph(w.schemasText) + names.map(block).join('\n'));
}

/** The pages of the reference in both languages. */
export function referencePages(root: string, program: string): GeneratedPage[] {
  return languages.flatMap((language) => [
    ...[commandLine, specs, algorithms, scenarios, studies, metrics, references].map((make) => make(program, language)),
    ...documents.map((d) => documentPage(root, d, language)),
    schemas(root, language),
    page(language, 'api', referenceWords[language].api, apiHtml(root, language)),
  ]);
}
