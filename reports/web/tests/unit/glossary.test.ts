// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { meaningOf, metricTerms, terms } from '../../src/report/glossary_terms.ts';

test('every metric of the table has its title and its formula', () => {
  const table = readFileSync(join(process.env.RIGOR_SOURCE_DIR ?? '', 'validation/metrics/metrics.def'), 'utf8');
  const names = [...table.matchAll(/^METRIC\((\w+)/gm)].map((m) => m[1]);
  assert.ok(names.length > 40);
  assert.deepEqual([...metricTerms.keys()], names);
  for (const { name, meaning, formula } of metricTerms.values()) {
    assert.match(meaning, /^[A-Z][^"]+$/, name);
    assert.match(formula ?? '', /^[^"]{3,}$/, name);
  }
  assert.equal(meaningOf('position max'), 'Largest position error: max_t |x(t) - x_exact(t)|');
});

test('a term has one line, and is found in any case', () => {
  for (const { name, meaning } of terms) {
    assert.ok(meaning.endsWith('.') && meaning.length < 160, name);
    assert.equal(meaningOf(name.toUpperCase()), meaning);
  }
  assert.equal(new Set(terms.map((t) => t.name.toLowerCase())).size, terms.length, 'each once');
  assert.equal(meaningOf('no such word'), undefined);
});
