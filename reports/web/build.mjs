// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// node build.mjs OUTPUT [--tests] The bundles that are embedded in the program: each is one script and one style sheet,
// fonts and pictures inside, so that a page fetches nothing. With --tests it builds the tests instead, for `node
// --test`.
import { existsSync, readdirSync } from 'node:fs';
import { build } from 'esbuild';

const [output = 'dist', mode] = process.argv.slice(2);

const pages = {
  entryPoints: {
    report: 'src/report/main.ts',
    live: 'src/live/main.ts',
    history: 'src/history/main.ts',
    collide: 'src/collide/main.ts',
    solve: 'src/solve/main.ts',
  },
  format: 'iife',
  target: ['chrome110', 'firefox115', 'safari16.4'],
  minify: true,
  legalComments: 'inline',
  loader: { '.woff2': 'dataurl', '.woff': 'empty', '.ttf': 'empty', '.def': 'text' },
};
const tests = {
  entryPoints: ['unit', 'browser'].flatMap((kind) =>
    (existsSync(`tests/${kind}`) ? readdirSync(`tests/${kind}`) : [])
      .filter((name) => name.endsWith('.test.ts'))
      .map((name) => `tests/${kind}/${name}`),
  ),
  outbase: 'tests',
  format: 'cjs', // finds the libraries by NODE_PATH
  outExtension: { '.js': '.cjs' },
  platform: 'node',
  target: 'node18',
  loader: { '.def': 'text' },
  external: ['axe-core', 'playwright-core'],
};

const common = {
  bundle: true,
  charset: 'ascii', // no compiler minds what is embedded
  logLevel: 'warning',
};
await build({ ...common, ...(mode === '--tests' ? tests : pages), outdir: output });
if (mode === '--tests') {
  // All tests in the browser as one program: they share Chromium and the reports (tests/browser.ts).
  const files = tests.entryPoints.filter((path) => path.startsWith('tests/browser/'));
  const { entryPoints, outbase, outExtension, ...options } = tests;
  await build({
    ...common,
    ...options,
    stdin: { contents: files.map((path) => `import './${path}';\n`).join(''), resolveDir: '.' },
    outfile: `${output}/browser.cjs`,
  });
}
