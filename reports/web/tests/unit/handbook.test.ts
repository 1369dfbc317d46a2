// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The sources of the handbook: quotes that are found, links that lead somewhere, two languages of one structure. No
// program is needed; scenes have no numbers here.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { readHeader } from '../../src/handbook/site/api.ts';
import { brokenLinks, externalRequests, structureOf, translationErrors } from '../../src/handbook/site/checks.ts';
import { commandOf, readExercise, readSceneFence } from '../../src/handbook/site/fences.ts';
import { readGallery } from '../../src/handbook/site/gallery.ts';
import { sceneHtml, shown, shownIn } from '../../src/handbook/site/layout.ts';
import { coloured, renderPage } from '../../src/handbook/site/markup.ts';
import { chineseKinds, chineseMetrics } from '../../src/handbook/site/metric_titles.ts';
import { findQuote, readQuote } from '../../src/handbook/site/quotes.ts';
import { overridden, scenarioFile } from '../../src/handbook/site/record.ts';
import { reflowed } from '../../src/handbook/site/reference.ts';
import { makeSite } from '../../src/handbook/site/site.ts';

const root = process.env.RIGOR_SOURCE_DIR as string;
const site = makeSite(root, null, []);
const added = (path: string) =>
  /^(assets|pictures)\//.test(path) || /^(en|zh)\/(reference\/[a-z-]+|gallery)\.html$/.test(path);

test('every quote, scene and exercise of the handbook is there, in both languages alike', () => {
  assert.deepEqual(translationErrors(site), []);
  const chapters = site.pages.filter((p) => p.language === 'en' && p.name.startsWith('build/'));
  assert.ok(chapters.length >= 12, `${chapters.length} chapters`);
  for (const { name, page } of chapters) {
    assert.ok(page.scenes.length >= 1, `${name} has a scene`);
    assert.ok(page.exercises.length >= 3, `${name} has three exercises`);
    assert.ok(page.formulas.length >= 1, `${name} has a formula`);
    assert.ok(page.quotes.length >= 1 || name.endsWith('doctor'), `${name} quotes the engine`);
  }
});

test('links lead somewhere, and a page loads nothing from elsewhere', () => {
  assert.deepEqual(brokenLinks(site.files, added), []);
  assert.deepEqual(externalRequests(site.files), []);
});

test('Chinese pages are in Chinese', () => {
  for (const { language, name, page } of site.pages) {
    const share = (page.html.match(/[\u4e00-\u9fff]/g) ?? []).length;
    if (language === 'zh') assert.ok(share > 300, `${name}: ${share} Chinese characters`);
    else assert.equal(share, 0, name);
  }
});

test('metrics have Chinese titles, which stand on Chinese pages alone', () => {
  const read = (file: string) => readFileSync(join(root, file), 'utf8');
  const table = [
    ...read('validation/metrics/metrics.def').matchAll(/METRIC\((\w+),\s*\w+,\s*"[^"]*",\s*"[^"]*",\s*(\w+),/g),
  ];
  const costs = [...read('validation/runner/cost.cpp').matchAll(/Cost\{"(\w+)"/g)].map((m) => m[1] as string);
  assert.ok(table.length >= 50 && costs.length === 5, `${table.length} metrics, ${costs.length} counters`);
  assert.deepEqual(Object.keys(chineseMetrics).sort(), [...table.map((m) => m[1] as string), ...costs].sort());
  const kinds = new Set(table.map((m) => (m[2] as string).replace(/(?<!^)[A-Z]/g, '_$&').toLowerCase()));
  assert.deepEqual(Object.keys(chineseKinds).sort(), [...kinds].sort());
  for (const title of [...Object.values(chineseMetrics), ...Object.values(chineseKinds)])
    assert.match(title, /[\u4e00-\u9fff]/);
  for (const { language, name, page } of site.pages)
    for (const scene of page.scenes)
      for (const [, title = '', metric] of sceneHtml(scene, [], 'a/b.html', language).matchAll(
        /<dt>([^<]*)<code>([^<@]*)/g,
      ))
        assert.equal(title.trim(), language === 'zh' ? chineseMetrics[metric as string] : '', `${name}: ${metric}`);
});

test('files that exercises and the gallery name exist', () => {
  for (const { scenario } of readGallery(root)) scenarioFile(root, scenario);
  assert.ok(readGallery(root).length >= 20);
  for (const { name, page } of site.pages)
    for (const exercise of page.exercises)
      for (const command of [...exercise.answer, exercise.command])
        for (const [, file] of command.matchAll(/ ((?:reports|scenarios)\/\S+\.json)/g))
          assert.doesNotThrow(() => readFileSync(join(root, file as string)), `${name}: ${file}`);
});

test('a quote is found by its text, and one that is gone or stands twice is an error', () => {
  const code = 'int a() {\n    return 1;  // }\n}\n\n/// Two.\ntemplate <class S>\nint b() {\n    if (x) { y(); }\n}\n';
  const quote = findQuote({ file: 'f', from: 'int b() {', to: null }, code);
  assert.equal(quote.first, 5);
  assert.deepEqual(quote.lines.slice(-2), ['    if (x) { y(); }', '}']);
  assert.equal(findQuote({ file: 'f', from: 'int a', to: 'return' }, code).lines.length, 2);
  assert.deepEqual(findQuote({ file: 'f', from: 'int a', to: null }, code).lines.at(-1), '}');
  assert.throws(() => findQuote({ file: 'f', from: 'int c', to: null }, code), /stands on 0 lines/);
  assert.throws(() => findQuote({ file: 'f', from: 'int', to: null }, code), /stands on 2 lines/);
  assert.throws(() => findQuote({ file: 'f', from: 'int a', to: 'nowhere' }, code), /no end/);
  assert.deepEqual(readQuote('f', 'from: x y\nto: z'), { file: 'f', from: 'x y', to: 'z' });
  assert.throws(() => readQuote('f', 'to: z'));
});

test('fences are read', () => {
  const scene = readSceneFence(
    'scenario: a\nset: k=1\nside: L | x:y=1\nside: R | x | dt=1/240 | scenario=b\nmetric: m, n@q',
  );
  assert.deepEqual(scene.metrics, ['m', 'n@q']);
  assert.deepEqual(
    scene.sides.map((s) => commandOf(s.run)),
    ['./rigor run a --engine x:y=1 --set k=1', './rigor run b --engine x --dt 1/240 --set k=1'],
  );
  assert.throws(() => readSceneFence('scenario: a\nsides: L | x'), /not known/);
  assert.throws(() => readSceneFence('scenario: a'), /one to three/);
  const text = 'Do.\n--- judge\n./j\n--- answer\n./a\n./b\n--- wrong\n./w\n./v\n--- solution\nSo.';
  const exercise = {
    text: 'Do.',
    command: './j',
    isJudged: true,
    answer: ['./a', './b'],
    wrong: ['./w', './v'],
    solution: 'So.',
  };
  assert.deepEqual(readExercise(text), exercise);
  const observed = text.replace('judge', 'look');
  assert.throws(() => readExercise(observed), /nothing judges/);
  assert.equal(readExercise(observed.replace('--- wrong\n./w\n./v\n', '')).isJudged, false);
  assert.throws(() => readExercise('Do.\n--- judge\n./j'), /has a text/);
});

/** The surroundings of a page that has no others. */
const plain = {
  readSource: () => 'f() {\n}\n',
  siteRoot: '',
  sourceLink: () => '#',
  sceneHtml: () => '',
  metric: (name: string) => (name === 'm' ? { href: 'h', title: 't' } : null),
  words: { exercise: '', judge: '', look: '', answer: '', copy: '' },
};

test('the structure of a page notices what a translation lacks', () => {
  const source =
    '# T\n\n$x$ text\n\n```math\nx = \\text{one}\n```\n\n```quote f.cpp\nfrom: f()\n```\n\n```sh\n./rigor a  # note\n```\n';
  const page = renderPage(source, plain);
  assert.equal(page.title, 'T');
  assert.match(renderPage('`m` and `n`', plain).html, /<a href="h" title="t"><code>m<\/code><\/a> and <code>n<\/code>/);
  assert.equal(page.inlineFormulas, 1);
  assert.deepEqual(structureOf(page).commands, ['./rigor a']);
  assert.deepEqual(structureOf(renderPage(source.replace('one', '一'), plain)), structureOf(page));
  for (const lost of ['# T', '```math\nx = \\text{one}\n```', '```quote f.cpp\nfrom: f()\n```', './rigor a'])
    assert.notDeepEqual(structureOf(renderPage(source.replace(lost, ''), plain)), structureOf(page), lost);
});

test('no line of a page ends inside an option or begins with the comma behind a formula', () => {
  const html = (text: string) => renderPage(text, plain).html;
  assert.match(coloured('./rigor run a --set b=1', 'sh'), /<span class="option">--set<\/span> b=1/);
  assert.match(
    html('the option `--without actuators`'),
    /<code><span class="option">--without<\/span> actuators<\/code>/,
  );
  assert.match(
    html('设 $n$，则（$m$）'),
    /设 <span class="held"><span class="katex">.*<\/span>，<\/span>则<span class="held">（<span/,
  );
  const long = html(`是 $J = (-n,\\ -r_A \\times n,\\ n,\\ r_B \\times n)$，即`);
  assert.doesNotMatch(long, /held|\ue000|\ue001/);
  assert.doesNotMatch(
    html('# 长度 $l$\n\n```exercise\n求 $x$。\n--- look\na\n--- answer\na\n--- solution\n$1$\n```'),
    /[\ue000\ue001]/,
  );
});

test('what a reader copies has a button, and commands are wrapped', () => {
  const html = (lang: string) => renderPage(`\`\`\`${lang}\n{}\n\`\`\``, plain).html;
  for (const lang of ['sh', 'json', 'python']) assert.match(html(lang), /<button type="button" class="copy">/, lang);
  assert.doesNotMatch(html('text'), /<button/);
  for (const lang of ['sh', 'text']) assert.match(html(lang), /class="code commands"/, lang);
});

test('long lines of a help text are broken below their explanation', () => {
  const help = 'Usage: a\n  --out TEXT      one two three four\n';
  assert.equal(reflowed(help, 28), 'Usage: a\n  --out TEXT      one two\n                  three four\n');
  assert.equal(reflowed('one two three', 8), 'one two\nthree');
  assert.equal(reflowed(help, 80), help);
});

test('checks of links and requests find what is wrong', () => {
  const files = new Map([
    ['a/b.html', '<a href="../c.html#x">c</a><a href="d.html"></a>'],
    ['c.html', '<p id="y">'],
  ]);
  assert.deepEqual(
    brokenLinks(files, () => false),
    ['a/b.html: ../c.html#x, no such place', 'a/b.html: d.html'],
  );
  const loads = new Map([
    ['a', '<img alt="" src="https://x.y/z.png"> <a href="https://x.y">'],
    ['b.css', 'url(//x.y/f)'],
  ]);
  assert.deepEqual(externalRequests(loads), ['a: https://x.y/z.png', 'b.css: //x.y/f']);
});

test('overrides, numbers and headers', () => {
  const file = { bodies: [{ name: 'a', mass: 1 }], list: [{ grid: { counts: [1] } }] };
  assert.deepEqual(overridden(file, ['bodies.a.mass=2', 'list.0.grid.counts=[3,4]']), {
    bodies: [{ name: 'a', mass: 2 }],
    list: [{ grid: { counts: [3, 4] } }],
  });
  assert.equal(file.bodies[0]?.mass, 1);
  assert.deepEqual([null, 0, 12.345, 1.23e-9].map(shown), ['—', '0', '12.3', '1.2 · 10^-9']);
  assert.deepEqual(
    [0, 0.0333, 0.00123, 1.5, 2e-5, 3.6e-16, 250].map((v) => shownIn(v, 'm')),
    ['0 m', '33.3 mm', '1.23 mm', '1.5 m', '20 µm', '3.6 · 10^-16 m', '250 m'],
  );
  assert.equal(shownIn(0.0333, '1'), '0.0333');
  assert.equal(shownIn(0.0333, 'widths'), '0.0333 widths');
  assert.equal(shownIn(null, 'm'), '—');
  const header = readHeader(
    'h',
    '// SPDX\n// What.\n#pragma once\n/// Steps.\nvoid step(int n);\nint a = 0;  ///< count\n',
  );
  assert.equal(header.purpose, 'What.');
  assert.deepEqual(
    header.declarations.map((d) => [d.line, d.code, d.comment]),
    [
      [5, 'void step(int n)', 'Steps.'],
      [6, 'int a = 0;', 'count'],
    ],
  );
});
