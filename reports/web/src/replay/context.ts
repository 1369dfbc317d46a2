// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Input of a replay from the page that mounts it.
import type { Cursor } from '../common/cursor.ts';
import type { ContactFinding } from '../common/finding.ts';
import type { FetchFrames } from './full_frames.ts';
import type { Json } from './json.ts';

export interface ReplayContext {
  name?: string; // name of the scenario, for files
  scenario: Json; // the scenario file, parsed
  index: number; // index of the scenario in the run
  step: number; // index of the time step among those that were run, coarsest first
  cursor: Cursor;
  /** Colour of a spec, as the curves have it; "" is the reference. */
  colourOf: (spec: string, index: number) => string;
  dt?: number; // [s] of the runs; else that of the replay file
  /** True for the engines that are shown at first, if there are more than that. */
  isPreferred?: (spec: string) => boolean;
  metrics?: readonly string[]; // metrics in order of importance, whose largest error counts
  /** The finding of a key in the audit of a spec; null where there is none. */
  findingOf?: (spec: string, key: string) => ContactFinding | null;
  /** Loads the replay file; by default the one beside the page. */
  load?: () => Promise<ArrayBuffer>;
  /** State that a link restores, and the listener to its changes; by default both are the page's address. */
  state?: string;
  /** All frames of a case, where a server is given; else requested from the server of the page. */
  frames?: (caseId: string) => FetchFrames;
  onState?: (state: string) => void;
}
