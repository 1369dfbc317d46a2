// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { Quaternion, Vec3 } from 'cannon-es';

export const toCannon = (v) => new Vec3(...v);
export const quatToCannon = ([w, x, y, z]) => new Quaternion(x, y, z, w);
export const fromCannon = ({ x, y, z }) => [x, y, z];
export const quatFromCannon = ({ w, x, y, z }) => [w, x, y, z];
