// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Compiles an MJCF document for `rigor import mjcf` (scenarios/exchange/mjcf/newer_library.cpp):
//     node compile.mjs REQUEST ANSWER
// The request has the document, the files that it names, a keyframe (-1: none), and names of sizes and arrays of the
// library's model and data. The answer has them at the start, with what the library computes of them.
import { readFileSync, writeFileSync } from 'node:fs';
import { M, modelOf, sixNumbers } from './library.mjs';

/** Margin of limits with which all of them are constraints. */
const kEverywhere = 1e9;

const { mjtConstraint, mjtDisableBit, mjtObj } = M;
const library = `MuJoCo ${M.mj_versionString()}`;

function filesOf(paths) {
    const files = new M.MjVFS();
    for (const path of new Set(paths)) files.addBuffer(path, readFileSync(path));
    return files;
}

/** Rows of equalities, or of limits, without contacts: [number of the equality, joint or tendon, its violation]. */
function rowsOf(data, type) {
    const [types, ids, violations] = [data.efc_type, data.efc_id, data.efc_pos];
    return Array.from({ length: data.nefc }, (_, k) => k)
        .filter((k) => types[k] === type.value)
        .map((k) => [ids[k], violations[k]]);
}

/** The package hands over no arrays of bool: what is limited or active is seen by its rows when margins reach everywhere. */
function acting(model) {
    const data = new M.MjData(model);
    const [flags, joints, tendons] = [model.opt.disableflags, [...model.jnt_margin], [...model.tendon_margin]];
    model.opt.disableflags = mjtDisableBit.mjDSBL_CONTACT.value;
    model.jnt_margin.fill(kEverywhere);
    model.tendon_margin.fill(kEverywhere);
    M.mj_fwdPosition(model, data);
    const flagsOf = (count, type) => {
        const found = new Set(rowsOf(data, type).map(([id]) => id));
        return Array.from({ length: count }, (_, id) => Number(found.has(id)));
    };
    const found = {
        jnt_limited: flagsOf(model.njnt, mjtConstraint.mjCNSTR_LIMIT_JOINT),
        tendon_limited: flagsOf(model.ntendon, mjtConstraint.mjCNSTR_LIMIT_TENDON),
        eq_active: flagsOf(model.neq, mjtConstraint.mjCNSTR_EQUALITY),
    };
    model.opt.disableflags = flags;
    model.jnt_margin.set(joints);
    model.tendon_margin.set(tendons);
    data.delete();
    return found;
}

/** The library's pose and velocities at the start. */
function startOf(model, keyframe) {
    const data = new M.MjData(model);
    if (keyframe >= 0) M.mj_resetDataKeyframe(model, data, keyframe);
    const flags = model.opt.disableflags;
    model.opt.disableflags = flags | mjtDisableBit.mjDSBL_CONTACT.value;
    M.mj_forward(model, data);
    model.opt.disableflags = flags;
    return data;
}

function violationsOf(model, data) {
    const most = new Array(model.neq).fill(0);
    for (const [id, violation] of rowsOf(data, mjtConstraint.mjCNSTR_EQUALITY))
        most[id] = Math.max(most[id], Math.abs(violation));
    return most;
}

function flagsOff(model) {
    const bits = {
        constraint: mjtDisableBit.mjDSBL_CONSTRAINT.value,
        equality: mjtDisableBit.mjDSBL_EQUALITY.value,
        frictionloss: mjtDisableBit.mjDSBL_FRICTIONLOSS.value,
        limit: mjtDisableBit.mjDSBL_LIMIT.value,
        contact: mjtDisableBit.mjDSBL_CONTACT.value,
        passive: mjtDisableBit.mjDSBL_SPRING.value | mjtDisableBit.mjDSBL_DAMPER.value,
        gravity: mjtDisableBit.mjDSBL_GRAVITY.value,
        filterparent: mjtDisableBit.mjDSBL_FILTERPARENT.value,
    };
    return Object.keys(bits).filter((name) => (model.opt.disableflags & bits[name]) === bits[name]);
}

/** Names as the model stores them; "" without one. */
function namesOf(model, places) {
    const bytes = Buffer.from(model.names);
    return [...places].map((start) => bytes.toString('utf8', start, bytes.indexOf(0, start)));
}

/** Arrays that the older library has in another form: bodies of an exclusion count from 1, springs of tendons have one length. */
function translated(model) {
    const lengths = [...model.tendon_lengthspring];
    return {
        ...acting(model),
        exclude_signature: [...model.exclude_signature].map((s) => (((s >> 16) + 1) << 16) + (s & 0xffff) + 1),
        tendon_lengthspring: lengths.filter((_, k) => k % 2 === 0),
        tendon_deadband: lengths.flatMap((upper, k) => (k % 2 === 1 ? [upper - lengths[k - 1]] : [])),
    };
}

function compiled({ document, files, keyframe, sizes, arrays }) {
    const model = modelOf(document, filesOf(files));
    const special = translated(model);
    const data = startOf(model, keyframe);
    const velocityOf = (body) => sixNumbers((six) => M.mj_objectVelocity(model, data, mjtObj.mjOBJ_BODY.value, body, six, 0));
    const arrayOf = (name) => special[name] ?? [...(model[name] ?? data[name])];
    return {
        library,
        sizes: Object.fromEntries(sizes.map((name) => [name, model[name]])),
        arrays: Object.fromEntries(arrays.map((name) => [name, arrayOf(name)])),
        body_velocity: Array.from({ length: model.nbody }, (_, body) => velocityOf(body)).flat(),
        eq_violation: violationsOf(model, data),
        names: {
            body: namesOf(model, model.name_bodyadr),
            joint: namesOf(model, model.name_jntadr),
            equality: namesOf(model, model.name_eqadr),
            tendon: namesOf(model, model.name_tendonadr),
        },
        timestep: model.opt.timestep,
        gravity: [...model.opt.gravity],
        off: flagsOff(model),
    };
}

function answerTo(request) {
    try {
        return compiled(request);
    } catch (error) {
        return { library, error: String(error.message ?? error) };
    }
}

const [request, answer] = process.argv.slice(2);
writeFileSync(answer, JSON.stringify(answerTo(JSON.parse(readFileSync(request, 'utf8')))));
