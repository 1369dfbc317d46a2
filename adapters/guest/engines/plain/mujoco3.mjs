// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import load from '@mujoco/mujoco';
import { inBody } from './scene.mjs';

const M = await load();

export const bound = 1e-8;
// The chain leaves every number after 1.03 s at this step, in both; from 0.5 s on what is 1e-9 m apart before grows.
export const scenes = {
    default: [
        ...['heavy_top_fast', 'heavy_top_steady', 'heavy_top_nutation', 'tippe_top', 'bouncing_ball'],
        ...['heavy_end_chain', 'slide_and_stop'],
    ],
    matched: ['heavy_top_fast', 'heavy_top_steady', 'heavy_top_nutation', 'tippe_top', 'bouncing_ball', 'slide_and_stop'],
};
export const steps = { heavy_end_chain: 20 };

/**
 * The library has no restitution: contacts that bounce are springs of w dt = 0.3 whose damping ratio keeps 0.8 of the speed,
 * which `findings` checks.
 */
const kBounce = { rate: 0.3, restitution: 0.8, dampingRatio: 0.07384129047386523 };

/** The chain as the library means chains: bodies in bodies, from its last link to its first. */
function chain({ links, link_length: length, direction: [x, y], body, end_body }) {
    const at = (part) => `pos="${part * length * x} ${part * length * y} 0"`;
    const tilt = body.shapes[0].axis_angle_deg.angle_deg;
    let tree = '';
    for (let k = links - 1; k >= 0; --k) {
        const isEnd = k === links - 1;
        const { mass, shapes } = isEnd ? end_body : body;
        const [{ box, sphere }] = shapes;
        const geom = sphere
            ? `<geom type="sphere" size="${sphere.radius}" mass="${mass}" contype="0" conaffinity="0" ${at(0.5)}/>`
            : `<geom type="box" size="${box.half_extents.join(' ')}" mass="${mass}" euler="0 0 ${tilt}" contype="0" conaffinity="0" ${at(0.5)}/>`;
        tree = `<body name="b${k}" ${at(k === 0 ? 0 : 1)}><joint type="ball"/>${geom}${tree}</body>`;
    }
    return tree;
}

/** A body on a ball joint to the world, with the mass and the moments given. */
function topOf(b, k, { anchorB }) {
    const placed = `name="b${k}" pos="${b.position.join(' ')}" quat="${b.quaternion.join(' ')}"`;
    const inertial = `<inertial pos="0 0 0" mass="${b.mass}" diaginertia="${b.inertia.join(' ')}"/>`;
    return `<body ${placed}>${inertial}<joint type="ball" pos="${anchorB.join(' ')}"/></body>`;
}

function freeBody(b, k) {
    const { box, sphere } = b.shape;
    const size = box ? box.half_extents.join(' ') : sphere?.radius;
    const kind = box ? 'box' : 'sphere';
    if (b.isStatic && !box) return '<geom type="plane" size="0 0 1" quat="0.7071067811865476 -0.7071067811865476 0 0"/>';
    const geom = `<geom type="${kind}" size="${size}" pos="${b.shapePosition.join(' ')}"/>`;
    const placed = `name="b${k}" pos="${b.position.join(' ')}" quat="${b.quaternion.join(' ')}"`;
    const motion = b.isStatic ? '' : `<freejoint/><inertial pos="0 0 0" mass="${b.mass}" diaginertia="${b.inertia.join(' ')}"/>`;
    return `<body ${placed}>${motion}${geom}</body>`;
}

/** Attributes of options and of contacts that the preset `matched` changes. */
const kOption = 'cone="elliptic" impratio="10" iterations="500" tolerance="1e-12"';
const kSolimp = 'solimp="0.99 0.999 0.001"';

/** Time constant and damping ratio of contacts, or, both negative, stiffness and damping of those that bounce. */
function solrefOf({ preset, dt, restitution }) {
    const { rate, dampingRatio } = kBounce;
    if (restitution === kBounce.restitution) return [-((rate / dt) ** 2), (-2 * dampingRatio * rate) / dt];
    return [preset === 'matched' ? 2 * dt : Math.max(0.02, 2 * dt), 1];
}

function xmlOf(scene) {
    const { preset, gravity, dt, friction, bodies, chains, joints } = scene;
    const joined = (b, k) => joints.find((joint) => joint.b === k);
    const bodyOf = (b, k) => (joined(b, k) ? topOf(b, k, joined(b, k)) : freeBody(b, k));
    const isMatched = preset === 'matched';
    const tree = chains.map(chain).join('') + bodies.map(bodyOf).join('');
    const softness = `solref="${solrefOf(scene).join(' ')}" ${isMatched ? kSolimp : ''}`;
    return `<mujoco>
        <compiler angle="degree"/>
        <option ${isMatched ? kOption : ''} timestep="${dt}" gravity="${gravity.join(' ')}"><flag autoreset="disable"/></option>
        <default><geom friction="${friction} 0 0" condim="${friction > 0 ? 3 : 1}" ${softness}/></default>
        <worldbody>${tree}</worldbody></mujoco>`;
}

/** Whether the chain keeps to finite numbers for `duration` at the step `dt`, with `mass` at its end. */
function swings(scene, dt, mass) {
    const [given] = scene.chains;
    const plain = start({ ...scene, dt, chains: [{ ...given, end_body: { ...given.end_body, mass } }] });
    for (let k = 1; k <= scene.duration / dt; ++k) {
        plain.step();
        if (!plain.positions().flat().every(Number.isFinite)) return false;
    }
    return true;
}

/** The part of its speed with which the ball of `bouncing_ball` leaves the floor, in the mean over where in a step it arrives. */
function partKept(scene) {
    const [speed, arrivals] = [2, 8];
    const parts = Array.from({ length: arrivals }, (_, k) => {
        const height = 0.1 + (2 + (k + 0.5) / arrivals) * speed * scene.dt;
        const [floor, ball] = scene.bodies;
        const plain = start({ ...scene, gravity: [0, 0, 0], bodies: [floor, { ...ball, position: [0, height, 0], velocity: [0, -speed, 0] }] });
        let [before, after] = [0, 0];
        for (let step = 0; step < 40; ++step) {
            plain.step();
            [before, after] = [after, plain.positions()[1][1]];
        }
        return (after - before) / (speed * scene.dt);
    });
    return parts.reduce((sum, part) => sum + part) / arrivals;
}

/** What is said of the library, here and in known deviations of scenarios: sentences, and whether they hold. */
export function findings(read) {
    const chain = read('heavy_end_chain');
    const bounces = ['default', 'matched'].map((preset) => {
        const kept = partKept(read('bouncing_ball', preset));
        const holds = Math.abs(kept - kBounce.restitution) < 0.005;
        return [`contacts that bounce keep 0.8 of the speed (${kept.toFixed(4)}, ${preset})`, holds];
    });
    return [
        ...bounces,
        ['at 1/60 s a weight of 10 kg makes the chain infinite', !swings(chain, 1 / 60, 10)],
        ['at 1/240 s it swings', swings(chain, 1 / 240, 10)],
        ['with a weight of 1 kg it swings at 1/60 s', swings(chain, 1 / 60, 1)],
    ];
}

export function start(scene) {
    const model = M.MjModel.from_xml_string(xmlOf(scene));
    const data = new M.MjData(model);
    scene.bodies.forEach((b, k) => {
        const body = M.mj_name2id(model, M.mjtObj.mjOBJ_BODY.value, `b${k}`);
        if (body <= 0 || b.isStatic) return;
        const spin = inBody(b.quaternion, b.spin);
        const isTop = scene.joints.length > 0;
        data.qvel.set(isTop ? spin : [...b.velocity, ...spin], model.body_dofadr[body]);
    });
    M.mj_forward(model, data);
    return {
        step: () => M.mj_step(model, data),
        /** Centres of mass; of bodies that stand still their place in the scene. */
        positions() {
            M.mj_kinematics(model, data);
            const names = scene.chains.length > 0 ? scene.chains[0].links : scene.bodies.length;
            return Array.from({ length: names }, (_, k) => {
                const body = M.mj_name2id(model, M.mjtObj.mjOBJ_BODY.value, `b${k}`);
                const stands = scene.bodies[k]?.isStatic;
                return stands ? scene.bodies[k].position : [...data.xipos.slice(3 * body, 3 * body + 3)];
            });
        },
    };
}
