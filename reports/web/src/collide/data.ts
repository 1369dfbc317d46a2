// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page's data as validation/collide/print.cpp writes them. SI units, world frame.
import type { Point } from '../common/finding.ts';
import type { Json } from '../replay/json.ts';

export interface Answer {
  engine: string;
  verdict: string; // "ok", "wrong normal", ...
  overlap?: boolean;
  signed_distance?: number | null; // [m]; minus the depth where they overlap
  normal?: Point | null; // A to B
  witness_a?: Point | null;
  witness_b?: Point | null;
  contacts?: number;
  distance_error?: number | null; // [m]
  normal_angle?: number | null; // [rad]
  point_error?: number | null;
  message?: string;
}

export interface CollideCase {
  name: string;
  file: string;
  dimension: 2 | 3;
  tags: string[];
  a: Json; // shape and pose, as in a scenario file
  b: Json;
  truth: {
    source: string; // "oracle", "file", "none"
    signed_distance?: number;
    overlap?: boolean;
    normals?: Point[];
    continuum?: boolean;
    witness_a?: Point | null;
    witness_b?: Point | null;
  };
  answers: Answer[];
}

export interface CollideRun {
  left_out?: number; // right cases that are in collide.json alone
  tolerance: { touch: number; relative: number; angle: number; single: number };
  summary: {
    name: string;
    precision: 'f32' | 'f64';
    unsupported: number;
    answered: number;
    failed: number;
    missed: number;
    spurious: number;
    wrong_depth: number;
    wrong_normal: number;
    normal_angle_max?: number | null;
    depth_error_max?: number | null;
    microseconds_median?: number | null;
  }[];
  cases: CollideCase[];
}
