// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Files of what the replay shows: the picture with its names as PNG, the whole run as a video, the states of the
// bodies as CSV.

import { csvText } from '../common/download.ts';
import { cssValue } from '../common/elements.ts';
import type { FrameSource } from './frames.ts';
import { type NotesOf, noteFont, noteHeight, notePadding, placedNotes } from './notes_layout.ts';
import type { Scene } from './scene.ts';
import type { ReplayView } from './view.ts';
import { type EncodedFrame, webmOf } from './webm.ts';

const rate = 30; // [1/s] pictures of a video
const mostPictures = 1800;
const keyEvery = 60;

/** The canvas and the texts over it, in a canvas of its own with an even number of pixels. */
export function composed(view: ReplayView, notes: readonly NotesOf[], into: HTMLCanvasElement): HTMLCanvasElement {
  const { width, height } = view.canvas;
  into.width = width - (width % 2);
  into.height = height - (height % 2);
  const ctx = into.getContext('2d');
  if (!ctx) return into;
  ctx.drawImage(view.canvas, 0, 0);
  const scale = width / Math.max(1, view.canvas.clientWidth);
  ctx.scale(scale, scale);
  const ink = cssValue('--text') || '#1d232b';
  const write = (text: string, x: number, y: number, font: string, colour = ink) => {
    ctx.font = font;
    ctx.lineWidth = 3;
    ctx.strokeStyle = cssValue('--panel') || '#ffffff';
    ctx.strokeText(text, x, y);
    ctx.fillStyle = colour;
    ctx.fillText(text, x, y);
  };
  for (const { sources, rect } of view.panels) {
    const first = sources[0];
    const now = first && view.frameOf(first);
    write(sources.map((s) => s.label).join(', '), rect.x + 10, rect.y + 20, '600 14px system-ui, sans-serif');
    if (now) write(`t = ${now.frame.time.toFixed(4)} s`, rect.x + 10, rect.y + 37, '11px system-ui, sans-serif');
  }
  for (const { text, left, top } of placedNotes(view, notes))
    write(text, left + notePadding, top + 0.75 * noteHeight, noteFont);
  return into;
}

/** Times of the pictures of a video of a run that is `end` seconds long, at a speed; thinned where there are too many. */
export function videoTimes(end: number, speed: number): { times: number[]; seconds: number } {
  const wanted = Math.max(2, Math.ceil((end / speed) * rate) + 1);
  const count = Math.min(mostPictures, wanted);
  return { times: Array.from({ length: count }, (_, i) => (end * i) / (count - 1)), seconds: count / rate };
}

interface Recorder {
  show(time: number): HTMLCanvasElement; // the picture of that time
  progress(done: number): void; // 0 to 1
}

/** A WebM file of the whole run; every picture is that of its time, however long drawing takes. */
export async function recordVideo(end: number, speed: number, { show, progress }: Recorder): Promise<Blob> {
  if (typeof VideoEncoder === 'undefined') throw new Error('this browser cannot encode videos');
  const { times, seconds } = videoTimes(end, speed);
  const first = show(0);
  const { width, height } = first;
  const frames: EncodedFrame[] = [];
  let failed: Error | null = null;
  const encoder = new VideoEncoder({
    output: (chunk) => {
      const data = new Uint8Array(chunk.byteLength);
      chunk.copyTo(data);
      frames.push({ data, milliseconds: Math.round(chunk.timestamp / 1000), key: chunk.type === 'key' });
    },
    error: (error) => {
      failed = error;
    },
  });
  encoder.configure({ codec: 'vp8', width, height, bitrate: 4 * width * height, framerate: rate });
  for (const [i, time] of times.entries()) {
    const picture = show(time);
    const frame = new VideoFrame(picture, { timestamp: Math.round((1e6 * i) / rate) });
    encoder.encode(frame, { keyFrame: i % keyEvery === 0 });
    frame.close();
    progress((i + 1) / times.length);
    do await new Promise((done) => setTimeout(done));
    while (encoder.encodeQueueSize > 4 && !failed);
    if (failed) throw failed;
  }
  await encoder.flush();
  encoder.close();
  return new Blob([webmOf(frames, 'V_VP8', width, height, 1000 * seconds)], { type: 'video/webm' });
}

const columns = ['px', 'py', 'pz', 'qw', 'qx', 'qy', 'qz', 'vx', 'vy', 'vz', 'wx', 'wy', 'wz'];

/** States of all bodies in all frames of the sources: SI units, world frame. */
export function statesCsv(sources: readonly FrameSource[], scene: Scene): string {
  const rows: (string | number)[][] = [['engine', 'step', 'time', 'body', ...columns]];
  for (const source of sources)
    for (let i = 0; i < source.times.length; ++i) {
      const { step, time, position, orientation, velocity, angularVelocity } = source.frame(i);
      const of = (list: ArrayLike<number> | null, b: number, n: number) =>
        Array.from({ length: n }, (_, k) => (list ? (list[n * b + k] as number) : ''));
      for (const [b, { name }] of scene.bodies.entries()) {
        const state = [...of(position, b, 3), ...of(orientation, b, 4), ...of(velocity, b, 3)];
        rows.push([source.spec || source.label, step, time, name, ...state, ...of(angularVelocity, b, 3)]);
      }
    }
  return csvText(rows);
}
