// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rapier 2D as a guest: its features.
import RAPIER from '@dimforge/rapier2d-compat';
import { serveRapier } from '../shared/rapier_guest.mjs';
import { space } from './space.mjs';

await RAPIER.init();

const kinds = 'dynamics/impulse_joint.d.ts, class JointData in 2D: fixed, spring, rope, revolute, prismatic';

serveRapier(space, 2, {
    shapes: ['circle', 'box', 'capsule', 'polygon', 'half_plane', 'segment', 'chain'],
    joints: [],
    lacks: { '3D': 'README.md of @dimforge/rapier2d-compat: 3D is another package, rapier3d', wheel: kinds, six_dof: kinds },
});
