// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rapier 2D as a guest: its features.
import RAPIER from '@dimforge/rapier2d-compat';
import { serveRapier } from '../shared/rapier_guest.mjs';
import { kinds, space } from './space.mjs';

await RAPIER.init();

serveRapier(space, 2, {
    shapes: ['circle', 'box', 'capsule', 'polygon', 'half_plane', 'segment', 'chain'],
    joints: ['six_dof', 'six_dof.limit', 'six_dof.motor', 'six_dof.spring'],
    lacks: { '3D': 'README.md of @dimforge/rapier2d-compat: 3D is another package, rapier3d', wheel: kinds },
});
