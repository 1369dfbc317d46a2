// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import RAPIER from '@dimforge/rapier3d-compat';
import * as rg from '../../sdk/rigor_guest.mjs';

export const toRapier = ([x, y, z]) => ({ x, y, z });
export const quatToRapier = ([w, x, y, z]) => ({ w, x, y, z });
export const fromRapier = ({ x, y, z }) => [x, y, z];
export const quatFromRapier = ({ w, x, y, z }) => [w, x, y, z];

const builders = {
    sphere: (s) => ({ desc: RAPIER.ColliderDesc.ball(s.radius) }),
    box: (s) => ({ desc: RAPIER.ColliderDesc.cuboid(...s.half_extents) }),
    capsule: (s) => ({ desc: RAPIER.ColliderDesc.capsule(s.half_length, s.radius) }),
    cylinder: (s) => ({ desc: RAPIER.ColliderDesc.cylinder(s.half_length, s.radius) }),
    cone: (s) => ({ desc: RAPIER.ColliderDesc.cone(s.half_length, s.radius) }),
    hull: (s) => ({ desc: RAPIER.ColliderDesc.convexHull(new Float32Array(s.vertices.flat())) }),
    // Its surface contains the origin of the collider.
    half_space: (s) => ({
        desc: new RAPIER.ColliderDesc(new RAPIER.HalfSpace(toRapier(s.normal))),
        offset: rg.scaled(s.offset, s.normal),
    }),
};

/** The collider of a shape, placed in its body, without material. */
export function colliderOf(shape, user) {
    const { desc, offset = [0, 0, 0] } = builders[shape.shape](shape);
    if (!desc) throw new rg.BadInput(`${user}: Rapier builds no hull of these vertices`);
    const position = rg.sum(shape.position, rg.rotate(shape.orientation, offset));
    return desc.setTranslation(...position).setRotation(quatToRapier(shape.orientation)).setDensity(0);
}
