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
import { words } from './contents.ts';
import { escaped, renderPage } from './markup.ts';
import type { GeneratedPage } from './site.ts';

const folder = 'en/reference';

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
];

function output(program: string, given: string[]): string {
  const ended = spawnSync(program, given, { encoding: 'utf8', maxBuffer: 1 << 26, timeout: 120_000 });
  if (ended.status !== 0) throw new Error(`${given.join(' ')} ended with ${ended.status}: ${ended.stderr}`);
  return ended.stdout;
}

const list = (program: string, what: string): Json[] => JSON.parse(output(program, ['list', what, '--json'])) as Json[];

const filter = `<p><input class="filter" type="search" aria-label="${words.en.filter}" placeholder="${words.en.filter}"></p>\n`;
const entry = (id: string, name: string, body: string) =>
  `<section class="entry" data-entry id="${escaped(id)}"><h2><code>${escaped(name)}</code></h2>${body}</section>\n`;
const paragraph = (text: string, kind = '') => (text ? `<p${kind ? ` class="${kind}"` : ''}>${escaped(text)}</p>` : '');

function formulaHtml(tex: string, plain: string): string {
  if (tex)
    return `<div class="formula" tabindex="0">${katex.renderToString(tex, { displayMode: true, throwOnError: true, strict: 'ignore' })}</div>`;
  return plain ? `<p><code>${escaped(plain)}</code></p>` : '';
}

function page(name: string, title: string, body: string): GeneratedPage {
  return { path: `${folder}/${name}.html`, title, html: `<h1>${escaped(title)}</h1>\n${body}` };
}

function metrics(program: string): GeneratedPage {
  const entries = list(program, 'metrics').map((m) =>
    entry(
      m.name,
      m.name,
      `${paragraph(m.title)}<p><code>${escaped(m.formula)}</code></p>${paragraph(`${m.kind}, unit ${m.unit}`, 'muted')}`,
    ),
  );
  const text = paragraph('Every metric is one pure function from a trajectory to a number, the same for every engine.');
  return page('metrics', 'Metrics', text + filter + entries.join(''));
}

function references(program: string): GeneratedPage {
  const entries = list(program, 'references').map((r) =>
    entry(
      r.name,
      r.name,
      paragraph(r.title) +
        formulaHtml(r.tex ?? '', r.formula ?? '') +
        paragraph(r.source ? `Source: ${r.source}` : '', 'muted'),
    ),
  );
  const text = paragraph('Exact solutions that scenarios name under "reference", with their sources.');
  return page('references', 'References', text + filter + entries.join(''));
}

function scenarios(program: string): GeneratedPage {
  const entries = list(program, 'scenarios').map((s) => {
    const facts = [`${s.dimension}D`, `${s.bodies} bodies`, `${s.duration} s`, ...(s.isolates ?? [])];
    const reference = s.reference
      ? `<p class="muted">reference: <a href="references.html#${escaped(s.reference)}"><code>${escaped(s.reference)}</code></a></p>`
      : '';
    return entry(s.name, s.name, paragraph(s.title) + paragraph(facts.join(', '), 'muted') + reference);
  });
  return page('scenarios', 'Scenarios of the library', filter + entries.join(''));
}

function algorithms(program: string): GeneratedPage {
  const stages = new Map<string, Json[]>();
  for (const a of list(program, 'algorithms')) {
    const known = stages.get(a.stage);
    if (known) known.push(a);
    else stages.set(a.stage, [a]);
  }
  const parts = [...stages].map(([stage, all]) => {
    const rows = all.map(
      (a) =>
        `<tr data-entry><td><code>${escaped(a.name)}</code></td><td>${escaped(a.summary ?? '')}${a.default ? ' <b>(default)</b>' : ''}</td></tr>`,
    );
    return `<h2 id="${escaped(stage)}">${escaped(stage.replaceAll('_', ' '))}</h2><div class="table" tabindex="0"><table><tbody>${rows.join('')}</tbody></table></div>`;
  });
  const text = paragraph(
    'What the in-house engine can do at every stage of its step. A choice is made in a spec, as in rigor:solver=nsgs,substeps=4.',
  );
  return page('algorithms', 'Algorithms of the engine', text + filter + parts.join('\n'));
}

function engineOptions(options: Json[]): string {
  const rows = options.map((o) => {
    const values = o.values ? o.values.join(', ') : o.range ? `${o.range[0]} … ${o.range[1]}` : '';
    return `<tr data-entry><td><code>${escaped(String(o.key))}</code></td><td>${escaped(String(o.default ?? ''))}</td><td>${escaped(String(o.matched ?? ''))}</td><td>${escaped(String(o.help ?? ''))}<br><span class="muted">${escaped(values)}</span></td></tr>`;
  });
  return `<div class="table" tabindex="0"><table><thead><tr><th>key</th><th>default</th><th>matched</th><th>meaning and values</th></tr></thead><tbody>${rows.join('')}</tbody></table></div>`;
}

function specs(program: string): GeneratedPage {
  const engines = list(program, 'engines').filter((e) => !e.problem);
  const parts = engines.map((e) => {
    const facts = [
      `version ${e.version}`,
      `precision ${(e.precisions ?? []).join(', ')}`,
      `presets ${(e.presets ?? []).join(', ')}`,
    ];
    return `<h2 id="${escaped(e.name)}">${escaped(e.title)} (<code>${escaped(e.name)}</code>)</h2>${paragraph(facts.join('; '), 'muted')}${engineOptions(e.options ?? [])}`;
  });
  const text = `<p>An engine is named by a spec, <code>NAME:key=value,key=value</code>. These engines were installed where this page was made; <code>./rigor list engines</code> shows yours.</p>`;
  return page('specs', 'Engines and their settings', text + filter + parts.join('\n'));
}

function studies(program: string): GeneratedPage {
  const row = (s: Json, parts: string[]) =>
    `<tr><td><code>${escaped(s.name)}</code></td><td>${escaped(s.title)}<br><span class="muted">${escaped(parts.join(', '))}</span></td></tr>`;
  const table = (rows: string[]) =>
    `<div class="table" tabindex="0"><table><tbody>${rows.join('')}</tbody></table></div>`;
  const suites = list(program, 'suites').map((s) => row(s, [`${(s.scenarios ?? []).length} scenarios`]));
  return page(
    'suites-and-studies',
    'Suites and studies',
    `<h2>Suites</h2>${paragraph('Lists of scenarios for rigor validate.')}${table(suites)}<h2>Studies</h2>${paragraph('Grids of choices for rigor study; beside each the parts that --part selects.')}${table(list(program, 'studies').map((s) => row(s, s.parts ?? [])))}`,
  );
}

function commandLine(program: string): GeneratedPage {
  const main = output(program, ['--help']);
  const names = [...(main.split('Subcommands:')[1]?.split('\n\n')[0] ?? '').matchAll(/^ {2}([a-z]+) /gm)].map(
    (m) => m[1] as string,
  );
  if (names.length < 10) throw new Error('the help of the program names fewer than ten commands');
  const common = main.slice(main.indexOf('Exit codes:'));
  const block = (text: string) =>
    `<div class="code"><pre tabindex="0"><code>${escaped(text.trim())}</code></pre></div>`;
  const parts = names.map((name) => {
    const help = output(program, [name, '--help']);
    return `<h2 id="${name}">rigor ${name}</h2>${block(help.replace(common, ''))}`;
  });
  return page('command-line', 'Command line and exit codes', block(main) + parts.join('\n'));
}

/** A document of the repository; its links to others lead to their pages, those to files are left as text. */
function documentPage(root: string, { file, page: name, title }: Document): GeneratedPage {
  const made = renderPage(readFileSync(join(root, file), 'utf8'), {
    readSource: () => '',
    siteRoot: '',
    sourceLink: () => '',
    sceneHtml: () => '',
    words: words.en,
  });
  const html = made.html.replace(/<a href="([^"]*)">([\s\S]*?)<\/a>/g, (whole, target: string, text: string) => {
    if (/^https?:/.test(target)) return whole;
    const to = relative('.', join(dirname(file), target.replace(/#.*/, '').replace(/\.html$/, '.md')));
    const known = documents.find((d) => d.file === to);
    return known ? `<a href="${known.page}.html">${text}</a>` : text;
  });
  const note = `<p class="muted">From <code>${escaped(file)}</code>.</p>`;
  return { path: `${folder}/${name}.html`, title: title ?? made.title, html: html.replace('</h1>', `</h1>\n${note}`) };
}

function schemas(root: string): GeneratedPage {
  const block = (name: string) => {
    const text = readFileSync(join(root, 'scenarios/schema', name), 'utf8');
    return `<h2>${escaped(name)}</h2><details><summary>${text.split('\n').length} lines</summary><div class="code"><pre tabindex="0"><code>${escaped(text)}</code></pre></div></details>`;
  };
  const names = ['scenario.schema.json', 'suite.schema.json', 'study.schema.json', 'collision.schema.json'];
  return page(
    'schemas',
    'JSON schemas',
    paragraph('What rigor check holds files to before it looks at their meaning.') + names.map(block).join('\n'),
  );
}

export function referencePages(root: string, program: string): GeneratedPage[] {
  return [
    commandLine(program),
    specs(program),
    algorithms(program),
    scenarios(program),
    studies(program),
    metrics(program),
    references(program),
    ...documents.map((d) => documentPage(root, d)),
    schemas(root),
    page('api', "The engine's interface in C++", apiHtml(root)),
  ];
}
