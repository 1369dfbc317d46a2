// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A WebM file of one video track: a header, then a cluster for each key frame [WebM container, matroska.org].

type Bytes = Uint8Array<ArrayBuffer>;

export interface EncodedFrame {
  data: Bytes;
  milliseconds: number;
  key: boolean;
}

function joined(parts: Bytes[]): Bytes {
  const out = new Uint8Array(parts.reduce((sum, p) => sum + p.length, 0));
  let at = 0;
  for (const part of parts) {
    out.set(part, at);
    at += part.length;
  }
  return out;
}

/** Big-endian digits, at least one. */
function unsigned(value: number): Bytes {
  const bytes: number[] = [];
  for (let rest = value; rest > 0 || bytes.length === 0; rest = Math.floor(rest / 256)) bytes.unshift(rest % 256);
  return Uint8Array.from(bytes);
}

/** Length of an element: eight bytes, the first is the mark of that. */
function size(length: number): Bytes {
  const digits = unsigned(length);
  const out = new Uint8Array(8);
  out[0] = 1;
  out.set(digits, 8 - digits.length);
  return out;
}

const element = (id: number, ...content: Bytes[]): Bytes => {
  const data = joined(content);
  return joined([unsigned(id), size(data.length), data]);
};
const text = (id: number, value: string) => element(id, new TextEncoder().encode(value) as Bytes);
const number = (id: number, value: number) => element(id, unsigned(value));
function float(id: number, value: number): Bytes {
  const data = new Uint8Array(8);
  new DataView(data.buffer).setFloat64(0, value);
  return element(id, data);
}

function block({ data, key }: EncodedFrame, after: number): Bytes {
  const head = new Uint8Array(4);
  head[0] = 0x81; // track 1
  new DataView(head.buffer).setInt16(1, after);
  head[3] = key ? 0x80 : 0;
  return element(0xa3, head, data);
}

/** Frames in the order of time, the first one a key frame; `codec`: "V_VP8" or "V_VP9". */
export function webmOf(frames: EncodedFrame[], codec: string, width: number, height: number, duration: number): Bytes {
  const clusters: Bytes[] = [];
  let blocks: Bytes[] = [];
  let start = 0;
  const end = () => {
    if (blocks.length > 0) clusters.push(element(0x1f43b675, number(0xe7, start), ...blocks));
    blocks = [];
  };
  for (const frame of frames) {
    if (frame.key) {
      end();
      start = frame.milliseconds;
    }
    blocks.push(block(frame, frame.milliseconds - start));
  }
  end();
  const head = element(
    0x1a45dfa3,
    number(0x4286, 1),
    number(0x42f7, 1),
    number(0x42f2, 4),
    number(0x42f3, 8),
    text(0x4282, 'webm'),
    number(0x4287, 2),
    number(0x4285, 2),
  );
  const info = element(
    0x1549a966,
    number(0x2ad7b1, 1_000_000), // times are in milliseconds
    float(0x4489, duration),
    text(0x4d80, 'replay'),
    text(0x5741, 'replay'),
  );
  const video = element(0xe0, number(0xb0, width), number(0xba, height));
  const track = element(0xae, number(0xd7, 1), number(0x73c5, 1), number(0x83, 1), text(0x86, codec), video);
  return joined([head, element(0x18538067, info, element(0x1654ae6b, track), ...clusters)]);
}
