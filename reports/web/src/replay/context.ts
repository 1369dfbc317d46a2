// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What a replay is given by the page that mounts it.
import type { Cursor } from '../common/cursor.ts';
import type { FetchFrames } from './full_frames.ts';
import type { Json } from './json.ts';

export interface ReplayContext {
  scenario: Json; // the scenario file, parsed
  index: number; // of the scenario in the run
  step: number; // of the time step among those that were run, coarsest first
  cursor: Cursor;
  /** Colour of a spec, as the curves have it; "" is the reference. */
  colourOf: (spec: string, index: number) => string;
  dt?: number; // [s] of the runs; else that of the replay file
  /** Of more engines than are shown at first: those to begin with. */
  isPreferred?: (spec: string) => boolean;
  metrics?: readonly string[]; // in order of importance: whose largest error counts
  /** Where the replay file comes from; else from beside the page. */
  load?: () => Promise<ArrayBuffer>;
  /** What a link restores, and what is told when that changes; else both are the page's address. */
  state?: string;
  /** All frames of a case, where a server is given; else requested from the server of the page. */
  frames?: (caseId: string) => FetchFrames;
  onState?: (state: string) => void;
}
