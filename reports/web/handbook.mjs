// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// node handbook.mjs OUTPUT PROGRAM: the handbook as a folder of pages that open from disk. PROGRAM is the built `rigor`,
// which makes the runs, tables and pictures.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const [output, program] = process.argv.slice(2);
if (!output || !program) {
  console.error('node handbook.mjs OUTPUT PROGRAM');
  process.exit(2);
}
const here = dirname(fileURLToPath(import.meta.url));
const site = resolve(output);

await build({
  absWorkingDir: here,
  entryPoints: { handbook: 'src/handbook/page/main.ts' },
  outdir: join(site, 'assets'),
  bundle: true,
  format: 'iife',
  target: ['chrome111', 'firefox115', 'safari16.4'],
  minify: true,
  legalComments: 'inline',
  loader: { '.woff2': 'dataurl', '.woff': 'empty', '.ttf': 'empty' },
  logLevel: 'warning',
});
const temporary = mkdtempSync(join(tmpdir(), 'rigor-handbook-build-'));
try {
  const script = join(temporary, 'main.cjs');
  await build({
    absWorkingDir: here,
    entryPoints: ['src/handbook/site/main.ts'],
    outfile: script,
    bundle: true,
    platform: 'node',
    format: 'cjs',
    target: 'node18',
    logLevel: 'warning',
  });
  const ended = spawnSync(process.execPath, [script, resolve(here, '../..'), site, resolve(program)], {
    stdio: 'inherit',
  });
  process.exitCode = ended.status ?? 1;
} finally {
  rmSync(temporary, { recursive: true });
}
