// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// No file of the pages imports itself by way of others, imports of types included.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, normalize } from 'node:path';
import { test } from 'node:test';

type Graph = Map<string, string[]>;

/** Files that a source text imports, relative to the folder of `file`. */
function importsOf(file: string, text: string): string[] {
  const pattern = /\b(?:import|export)\b[^;'"]*?\bfrom '(\.[^']+)'|\bimport '(\.[^']+)'|\bimport\('(\.[^']+)'\)/g;
  return [...text.matchAll(pattern)].map((m) => normalize(join(dirname(file), (m[1] ?? m[2] ?? m[3]) as string)));
}

/** A cycle of the graph as the list of its files, the first one repeated at the end; empty where there is none. */
function findCycle(graph: Graph): string[] {
  const finished = new Set<string>();
  const path: string[] = [];
  const visit = (file: string): string[] => {
    if (finished.has(file)) return [];
    const start = path.indexOf(file);
    if (start >= 0) return [...path.slice(start), file];
    path.push(file);
    for (const next of graph.get(file) ?? []) {
      const cycle = visit(next);
      if (cycle.length > 0) return cycle;
    }
    path.pop();
    finished.add(file);
    return [];
  };
  for (const file of graph.keys()) {
    const cycle = visit(file);
    if (cycle.length > 0) return cycle;
  }
  return [];
}

function readGraph(root: string): Graph {
  const graph: Graph = new Map();
  const read = (folder: string) => {
    for (const entry of readdirSync(join(root, folder), { withFileTypes: true })) {
      const file = join(folder, entry.name);
      if (entry.isDirectory()) read(file);
      else if (file.endsWith('.ts')) graph.set(file, importsOf(file, readFileSync(join(root, file), 'utf8')));
    }
  };
  read('');
  return graph;
}

test('no file imports itself by way of others', () => {
  const graph = readGraph(join(process.env.RIGOR_SOURCE_DIR as string, 'reports/web/src'));
  assert.ok(graph.size > 90, `${graph.size} files`);
  assert.ok([...graph.values()].flat().filter((file) => graph.has(file)).length > 300);
  assert.deepEqual(findCycle(graph), []);
});

test('the finder knows imports of values, types and styles, and finds cycles', () => {
  const text =
    "import type {\n  A,\n} from './a.ts';\nexport { b } from '../b.ts';\nimport './c.css';\nimport 'three';";
  assert.deepEqual(importsOf('x/y.ts', text), ['x/a.ts', 'b.ts', 'x/c.css']);
  const chain: [string, string[]][] = [
    ['a', ['b', 'd']],
    ['b', ['c']],
    ['c', ['d']],
    ['d', []],
  ];
  assert.deepEqual(findCycle(new Map(chain)), []);
  assert.deepEqual(findCycle(new Map([...chain, ['d', ['b']]])), ['b', 'c', 'd', 'b']);
});
