// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A recorded run as the handbook's build writes it and its pages play it.
import type { Json } from '../replay/json.ts';

export interface Recording {
  scenario: Json; // the scenario file, overrides applied
  bodies: string[]; // in the order of the run
  /** Pose of a body that never moves (x y z, w x y z); null: it is in `poses`. Numbers that are none are null. */
  still: ((number | null)[] | null)[];
  times: number[]; // [s]
  poses: (number | null)[][]; // a frame: seven numbers for each body that moves
  contacts: number[][] | null; // a frame: six numbers for each contact: point, normal
}
