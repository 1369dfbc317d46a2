// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Boxes around shapes in the world: exact, as a broad phase without a margin would have them.
import type { Geometry } from './scene.ts';
import type { Vec3 } from './vectors.ts';

/** Low and high corner. */
export type Bounds = [number, number, number, number, number, number];

/** Largest distance of the shape from its own origin [m]; of a half-space 0. */
export function reachOf(geometry: Geometry): number {
  switch (geometry.kind) {
    case 'sphere':
      return geometry.radius;
    case 'box':
      return Math.hypot(...geometry.half);
    case 'ellipsoid':
      return Math.max(...geometry.half);
    case 'capsule':
      return geometry.radius + geometry.halfLength;
    case 'cylinder':
    case 'cone':
      return Math.hypot(geometry.radius, geometry.halfLength);
    case 'height_field': {
      const [rows, columns] = [geometry.heights.length, geometry.heights[0]?.length ?? 0];
      const high = geometry.heights.flat().reduce((a, b) => Math.max(a, Math.abs(b)), 0);
      return Math.hypot(((columns - 1) * geometry.spacing[0]) / 2, ((rows - 1) * geometry.spacing[1]) / 2, high);
    }
    case 'half_space':
      return 0;
    default:
      return geometry.vertices.reduce((most, v) => Math.max(most, Math.hypot(...v)), 0);
  }
}

/** Half widths along the axes of what is symmetric about its origin; of a cone that of its base disc. */
function halfWidth(geometry: Geometry, m: ArrayLike<number>, o: number, k: number): number {
  const [x, y, z] = [m[o + k] as number, m[o + 4 + k] as number, m[o + 8 + k] as number];
  switch (geometry.kind) {
    case 'sphere':
      return geometry.radius;
    case 'box':
      return Math.abs(x) * geometry.half[0] + Math.abs(y) * geometry.half[1] + Math.abs(z) * geometry.half[2];
    case 'ellipsoid':
      return Math.hypot(x * geometry.half[0], y * geometry.half[1], z * geometry.half[2]);
    case 'capsule':
      return geometry.radius + Math.abs(y) * geometry.halfLength;
    case 'cylinder':
      return geometry.radius * Math.sqrt(Math.max(0, 1 - y * y)) + Math.abs(y) * geometry.halfLength;
    case 'cone':
      return geometry.radius * Math.sqrt(Math.max(0, 1 - y * y));
    default:
      return 0;
  }
}

const corner = (geometry: Geometry): Vec3[] | null => {
  if (geometry.kind === 'hull' || geometry.kind === 'triangle_mesh') return geometry.vertices;
  if (geometry.kind === 'segment' || geometry.kind === 'chain') return geometry.vertices;
  return null;
};

/**
 * Box of a shape whose frame is the rigid 4 x 4 matrix (column by column) at m[o]. False where there is none: half-spaces
 * have no end, height fields are never in the way.
 */
export function boundsOf(geometry: Geometry, m: ArrayLike<number>, o: number, out: Bounds): boolean {
  if (geometry.kind === 'half_space' || geometry.kind === 'height_field') return false;
  const vertices = corner(geometry);
  for (let k = 0; k < 3; ++k) {
    const center = m[o + 12 + k] as number;
    let low = 0;
    let high = 0;
    if (vertices !== null) {
      low = Number.POSITIVE_INFINITY;
      high = Number.NEGATIVE_INFINITY;
      for (const v of vertices) {
        const at = (m[o + k] as number) * v[0] + (m[o + 4 + k] as number) * v[1] + (m[o + 8 + k] as number) * v[2];
        low = Math.min(low, at);
        high = Math.max(high, at);
      }
    } else {
      high = halfWidth(geometry, m, o, k);
      low = -high;
      if (geometry.kind === 'cone') {
        const apex = (m[o + 4 + k] as number) * geometry.halfLength;
        low = Math.min(-apex + low, apex);
        high = Math.max(-apex + high, apex);
      }
    }
    out[k] = center + low;
    out[3 + k] = center + high;
  }
  return true;
}
