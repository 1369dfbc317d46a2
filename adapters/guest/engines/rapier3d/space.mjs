// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rapier's package in 3D, as shared/rapier_world.mjs needs it.
import RAPIER from '@dimforge/rapier3d-compat';
import * as rg from '../../sdk/rigor_guest.mjs';
import { addJoint } from './joints.mjs';
import { quatToRapier, toRapier } from './vectors.mjs';

const fromVector = ({ x, y, z }) => [x, y, z];
const fromRotation = ({ w, x, y, z }) => [w, x, y, z];

export const space = {
    RAPIER,
    vector: toRapier,
    fromVector,
    components: (v) => v,
    rotation: quatToRapier,
    fromRotation,
    turn: toRapier,
    fromTurn: fromVector,
    frameOf: () => [1, 0, 0, 0],
    addJoint,

    withMass(desc, body) {
        const { moments, orientation } = rg.principalAxes(body.inertia);
        const center = toRapier(body.center_of_mass);
        return desc.setAdditionalMassProperties(body.mass, center, toRapier(moments), quatToRapier(orientation));
    },
    inertiaOf: (body) =>
        rg.tensorOf(fromVector(body.principalInertia()), fromRotation(body.principalInertiaLocalFrame())),

    builders: {
        sphere: (s) => ({ desc: RAPIER.ColliderDesc.ball(s.radius) }),
        box: (s) => ({ desc: RAPIER.ColliderDesc.cuboid(...s.half_extents) }),
        capsule: (s) => ({ desc: RAPIER.ColliderDesc.capsule(s.half_length, s.radius) }),
        cylinder: (s) => ({ desc: RAPIER.ColliderDesc.cylinder(s.half_length, s.radius) }),
        cone: (s) => ({ desc: RAPIER.ColliderDesc.cone(s.half_length, s.radius) }),
        hull: (s) => ({ desc: RAPIER.ColliderDesc.convexHull(new Float32Array(s.vertices.flat())) }),
        triangle_mesh: (s, { internal_edges }) => ({
            desc: RAPIER.ColliderDesc.trimesh(
                new Float32Array(s.vertices.flat()),
                new Uint32Array(s.triangles.flat()),
                internal_edges === 'fixed' ? RAPIER.TriMeshFlags.FIX_INTERNAL_EDGES_TWO_SIDED : undefined,
            ),
        }),
        // Heights are a matrix of columns; its rows lie along z, its columns along x.
        height_field: (s, { internal_edges }) => {
            const heights = Array.from({ length: s.columns }, (_, i) =>
                Array.from({ length: s.rows }, (_, k) => s.heights[k * s.columns + i]),
            );
            const scale = { x: (s.columns - 1) * s.spacing_x, y: 1, z: (s.rows - 1) * s.spacing_z };
            const flags = internal_edges === 'fixed' ? RAPIER.HeightFieldFlags.FIX_INTERNAL_EDGES : undefined;
            return {
                desc: RAPIER.ColliderDesc.heightfield(s.rows - 1, s.columns - 1, new Float32Array(heights.flat()), scale, flags),
            };
        },
        // Its surface contains the origin of the collider.
        half_space: (s) => ({
            desc: new RAPIER.ColliderDesc(new RAPIER.HalfSpace(toRapier(s.normal))),
            offset: rg.scaled(s.offset, s.normal),
        }),
    },
};
