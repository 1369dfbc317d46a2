// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { ArrayBundle } from '../../src/common/arrays.ts';
import { inflate } from '../../src/common/data_files.ts';
import { indexAt } from '../../src/replay/frames.ts';

function bundle(head: object, body: Uint8Array): ArrayBuffer {
  const text = new TextEncoder().encode(JSON.stringify(head));
  const start = Math.ceil((4 + text.length) / 8) * 8;
  const bytes = new Uint8Array(start + body.length);
  new DataView(bytes.buffer).setUint32(0, text.length, true);
  bytes.set(text, 4);
  bytes.set(body, start);
  return bytes.buffer;
}

const twoArrays = {
  meta: { steps: 3 },
  arrays: [
    { name: 't', type: 'f64', offset: 0, count: 2 },
    { name: 'q', type: 'i16', offset: 16, count: 3 },
  ],
};

test('arrays of a bundle come back with their types and values', () => {
  const body = new Uint8Array(24);
  new Float64Array(body.buffer, 0, 2).set([0.25, -1e300]);
  new Int16Array(body.buffer, 16, 3).set([-32768, 0, 7]);
  const read = new ArrayBundle(bundle(twoArrays, body));
  assert.deepEqual(read.meta, { steps: 3 });
  assert.deepEqual([...read.get('t')], [0.25, -1e300]);
  assert.deepEqual([...read.get('q')], [-32768, 0, 7]);
  assert.throws(() => read.get('absent'), RangeError);
});

test('a bundle shorter than its head says is refused', () => {
  assert.throws(() => new ArrayBundle(bundle(twoArrays, new Uint8Array(8))), RangeError);
});

test('a data file is base64 of gzip', async () => {
  const text = 'x'.repeat(100_000);
  const back = await inflate(gzipSync(text).toString('base64'));
  assert.equal(new TextDecoder().decode(back), text);
  await assert.rejects(inflate(Buffer.from('not gzip').toString('base64')));
});

test('the frame at a time is the last one not after it', () => {
  const times = [0, 0.1, 0.2, 0.30000000000000004];
  assert.deepEqual(
    [-1, 0, 0.05, 0.1, 0.29, 0.3, 9].map((t) => indexAt(times, t)),
    [0, 0, 0, 1, 2, 3, 3],
  );
});
