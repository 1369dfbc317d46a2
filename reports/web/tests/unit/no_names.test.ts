// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Engines and presets come from the data: a page that names one misses the next one, or treats it otherwise than others.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

const root = process.env.RIGOR_SOURCE_DIR ?? '';

const filesUnder = (folder: string): string[] =>
  readdirSync(folder).flatMap((name) => {
    const path = join(folder, name);
    return statSync(path).isDirectory() ? filesUnder(path) : [path];
  });

/** Texts of the code in quotes of any kind; comments are left out. */
function literals(code: string): string[] {
  const bare = code.replace(/\/\*[\s\S]*?\*\//g, '').replace(/(^|\s)\/\/.*$/gm, '');
  return [...bare.matchAll(/(['"`])((?:\\.|(?!\1)[^\\\n])*)\1/g)].map((found) => found[2] as string);
}

test('no engine and no preset is named in the code of the pages', () => {
  const kept = new Set(['interface', 'conformance', 'tests']);
  const engines = readdirSync(join(root, 'adapters'), { withFileTypes: true })
    .filter((entry) => entry.isDirectory() && !kept.has(entry.name))
    .map((entry) => entry.name);
  assert.ok(engines.length >= 5, engines.join());
  // "rigor" is the program, too: it is distinguished from the engine if it stands alone.
  const named = new RegExp(`preset=|^(?:${[...engines, 'default', 'matched', 'fast'].join('|')})(?::.*)?$`);
  const files = filesUnder(join(root, 'reports/web/src')).filter((file) => file.endsWith('.ts'));
  assert.ok(files.length > 80);
  assert.deepEqual(
    literals("const a = 'fast'; // 'ode'\n/* 'fcl' */ const b = `x` + \"rigor:n=1\";").filter((text) =>
      named.test(text),
    ),
    ['fast', 'rigor:n=1'],
  );
  for (const file of files) {
    const found = literals(readFileSync(file, 'utf8')).filter((text) => named.test(text) && !text.includes('${'));
    assert.deepEqual(found, [], file);
  }
});
