// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { videoTimes } from '../../src/replay/capture.ts';
import { webmOf } from '../../src/replay/webm.ts';

/** Elements of a WebM file: identity and content, lengths of eight bytes. */
function elements(data: Uint8Array): { id: number; content: Uint8Array }[] {
  const found: { id: number; content: Uint8Array }[] = [];
  for (let at = 0; at < data.length; ) {
    const first = data[at] as number;
    const bytes = first >= 0x80 ? 1 : first >= 0x40 ? 2 : first >= 0x20 ? 3 : 4;
    const number = (from: number, count: number) =>
      [...data.slice(from, from + count)].reduce((sum, b) => sum * 256 + b, 0);
    const id = number(at, bytes);
    at += bytes;
    assert.equal(data[at], 1, 'the mark of a length of eight bytes');
    const length = number(at + 1, 7);
    at += 8;
    found.push({ id, content: data.slice(at, at + length) });
    at += length;
  }
  return found;
}

test('a cluster for each key frame, with the frames at their times', () => {
  const frame = (milliseconds: number, key: boolean, byte: number) => ({
    data: Uint8Array.of(byte),
    milliseconds,
    key,
  });
  const file = webmOf([frame(0, true, 7), frame(33, false, 8), frame(2000, true, 9)], 'V_VP8', 640, 480, 2033);
  const [head, segment, ...rest] = elements(file);
  assert.equal(rest.length, 0);
  assert.equal(head?.id, 0x1a45dfa3);
  assert.equal(segment?.id, 0x18538067);
  const parts = elements(segment?.content ?? new Uint8Array());
  assert.deepEqual(
    parts.map((p) => p.id),
    [0x1549a966, 0x1654ae6b, 0x1f43b675, 0x1f43b675],
  );
  const clusters = parts.filter((p) => p.id === 0x1f43b675).map((p) => elements(p.content));
  assert.deepEqual([...(clusters[1]?.[0]?.content ?? [])], [0x07, 0xd0], 'the second begins at 2000 ms');
  const blocks = clusters[0]?.filter((e) => e.id === 0xa3).map((e) => [...e.content]);
  assert.deepEqual(blocks, [
    [0x81, 0, 0, 0x80, 7],
    [0x81, 0, 33, 0, 8],
  ]);
});

test('a video has thirty pictures a second from the start to the end, and no more than there may be', () => {
  const { times, seconds } = videoTimes(2, 1);
  assert.equal(times.length, 61);
  assert.equal(times[0], 0);
  assert.equal(times.at(-1), 2);
  assert.ok(Math.abs(seconds - 61 / 30) < 1e-12);
  assert.equal(videoTimes(2, 0.5).times.length, 121, 'half as fast');
  assert.equal(videoTimes(1e4, 1).times.length, 1800);
});
