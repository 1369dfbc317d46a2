// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rapier 3D as a guest: its features.
import RAPIER from '@dimforge/rapier3d-compat';
import { serveRapier } from '../shared/rapier_guest.mjs';
import { space } from './space.mjs';

await RAPIER.init();

const swings = 'dynamics/impulse_joint.d.ts: limits and motors are of single axes, none of the angle between two';

serveRapier(space, 3, {
    shapes: ['sphere', 'box', 'capsule', 'cylinder', 'cone', 'hull', 'half_space', 'triangle_mesh', 'height_field'],
    joints: ['ball', ...['six_dof', 'wheel'].flatMap((type) => [type, `${type}.limit`, `${type}.motor`, `${type}.spring`])],
    lacks: {
        'ball.limit': swings,
        'ball.spring': swings,
        cone_twist: swings,
        '2D': 'README.md of @dimforge/rapier3d-compat: 2D is another package, rapier2d',
        ellipsoid: 'geometry/shape.d.ts, enum ShapeType: none is an ellipsoid',
        torsional_friction: 'geometry/collider.d.ts, setFriction: the one coefficient of friction',
    },
});
