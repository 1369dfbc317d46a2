// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Poses to 4 x 4 matrices, column by column as WebGL takes them, written into arrays that exist.

/**
 * The pose (p, q) times a local pose, written at out[o]; q and the local orientation are unit quaternions w x y z.
 * `local` holds seven numbers at l: position, orientation. A pose that is not finite gives a matrix of zeros: nothing
 * is drawn. Returns whether it was finite.
 */
export function composeInto(
  out: Float32Array,
  o: number,
  position: ArrayLike<number>,
  orientation: ArrayLike<number>,
  body: number,
  local: ArrayLike<number>,
  l: number,
): boolean {
  const aw = orientation[4 * body] as number;
  const ax = orientation[4 * body + 1] as number;
  const ay = orientation[4 * body + 2] as number;
  const az = orientation[4 * body + 3] as number;
  const bw = local[l + 3] as number;
  const bx = local[l + 4] as number;
  const by = local[l + 5] as number;
  const bz = local[l + 6] as number;
  let w = aw * bw - ax * bx - ay * by - az * bz;
  let x = aw * bx + ax * bw + ay * bz - az * by;
  let y = aw * by - ax * bz + ay * bw + az * bx;
  let z = aw * bz + ax * by - ay * bx + az * bw;
  const s = 1 / Math.sqrt(w * w + x * x + y * y + z * z);
  const lx = local[l] as number;
  const ly = local[l + 1] as number;
  const lz = local[l + 2] as number;
  const tx = 2 * (ay * lz - az * ly);
  const ty = 2 * (az * lx - ax * lz);
  const tz = 2 * (ax * ly - ay * lx);
  const px = (position[3 * body] as number) + lx + aw * tx + ay * tz - az * ty;
  const py = (position[3 * body + 1] as number) + ly + aw * ty + az * tx - ax * tz;
  const pz = (position[3 * body + 2] as number) + lz + aw * tz + ax * ty - ay * tx;
  if (!Number.isFinite(px + py + pz + s)) {
    out.fill(0, o, o + 16);
    return false;
  }
  w *= s;
  x *= s;
  y *= s;
  z *= s;
  out[o] = 1 - 2 * (y * y + z * z);
  out[o + 1] = 2 * (x * y + w * z);
  out[o + 2] = 2 * (x * z - w * y);
  out[o + 3] = 0;
  out[o + 4] = 2 * (x * y - w * z);
  out[o + 5] = 1 - 2 * (x * x + z * z);
  out[o + 6] = 2 * (y * z + w * x);
  out[o + 7] = 0;
  out[o + 8] = 2 * (x * z + w * y);
  out[o + 9] = 2 * (y * z - w * x);
  out[o + 10] = 1 - 2 * (x * x + y * y);
  out[o + 11] = 0;
  out[o + 12] = px;
  out[o + 13] = py;
  out[o + 14] = pz;
  out[o + 15] = 1;
  return true;
}

/** Copies a rigid matrix with its axes stretched. */
export function stretchInto(
  out: Float32Array,
  o: number,
  rigid: Float32Array,
  r: number,
  scale: ArrayLike<number>,
  s: number,
) {
  for (let column = 0; column < 3; ++column) {
    const factor = scale[s + column] as number;
    for (let row = 0; row < 4; ++row) out[o + 4 * column + row] = (rigid[r + 4 * column + row] as number) * factor;
  }
  for (let row = 12; row < 16; ++row) out[o + row] = rigid[r + row] as number;
}
