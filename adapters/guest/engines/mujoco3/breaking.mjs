// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What equalities of the library bear, and how they are switched off: joints that can break are equalities.
import * as rg from '../../sdk/rigor_guest.mjs';
import { Breaking } from '../shared/breaking.mjs';
import { M } from './library.mjs';

const kActive = M.mjtState.mjSTATE_EQ_ACTIVE.value;
const kEquality = M.mjtConstraint.mjCNSTR_EQUALITY.value;

/** Forces of the rows of an equality in the last step. */
function rowsOf(data, index) {
    const [types, ids, forces] = [data.efc_type, data.efc_id, data.efc_force];
    const rows = [];
    for (let k = 0; k < data.nefc; ++k) if (types[k] === kEquality && ids[k] === index) rows.push(forces[k]);
    return rows;
}

/**
 * Force, and torque about the anchor. Rows of `connect` are a force at its point. Those of `weld` are a force at its point, which is
 * the anchor, and the torque by halves of the rotation: the library's error is the vector part of a quaternion.
 */
function reactionOf({ data, text, bodyIds }, joint) {
    let [force, torque] = [
        [0, 0, 0],
        [0, 0, 0],
    ];
    const parts = text.constraintsOf.get(joint);
    for (const [k, { kind, index }] of parts.entries()) {
        const rows = rowsOf(data, index);
        // A rod that holds nothing has no row.
        if (rows.length === 0) continue;
        if (kind === 'tendon') return { force: Math.abs(rows[0]), torque: 0 };
        const at = rows.slice(0, 3);
        force = rg.sum(force, at);
        if (kind === 'weld') torque = rg.sum(torque, rg.scaled(0.5, rows.slice(3, 6)));
        else if (parts.length === 2) {
            const quaternion = [...data.xquat.slice(4 * bodyIds[joint.body_b], 4 * bodyIds[joint.body_b] + 4)];
            const arm = rg.scaled([-0.25, 0.25][k], rg.rotate(quaternion, joint.axis_b));
            torque = rg.sum(torque, rg.cross(arm, at));
        }
    }
    return { force: rg.norm(force), torque: rg.norm(torque) };
}

/** Which equalities act, one number for each. The package has no view of `eq_active`, but of it as a state. */
function activeOf({ model, data }) {
    const buffer = new M.DoubleBuffer(M.mj_stateSize(model, kActive));
    M.mj_getState(model, data, buffer, kActive);
    const active = [...buffer.GetView()];
    buffer.delete();
    return active;
}

export function breakingOf(world) {
    const { scenario, model, data, text } = world;
    const remove = (joint) => {
        const active = activeOf(world);
        for (const { index } of text.constraintsOf.get(joint)) active[index] = 0;
        M.mj_setState(model, data, active, kActive);
    };
    const breaking = new Breaking(scenario, scenario.joints, (joint) => reactionOf(world, joint), remove);
    if (breaking.weak.length === 0) return breaking;
    // The library's state knows what is broken already.
    const active = activeOf(world);
    breaking.weak = breaking.weak.filter(({ joint, index }) => {
        const isActive = text.constraintsOf.get(joint).every((part) => active[part.index] === 1);
        if (!isActive) breaking.broken.push(index);
        return isActive;
    });
    return breaking;
}
