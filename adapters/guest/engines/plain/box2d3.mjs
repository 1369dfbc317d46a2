// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import init from 'box2d3-wasm';
import { pullOf } from './scene.mjs';

const B = await init();

export const bound = 2e-5; // single precision
export const scenes = {
    default: ['hanging_chain_mode_2d', 'bouncing_disc_2d', 'backspin_2d', 'box_stack_2d', 'andrews_squeezer_2d'],
    matched: ['andrews_squeezer_2d', 'hanging_chain_mode_2d', 'bouncing_disc_2d'],
};

const vector = ([x, y]) => new B.b2Vec2(x, y);

function rotation(angle) {
    const turned = new B.b2Rot();
    Object.assign(turned, { c: Math.cos(angle), s: Math.sin(angle) });
    return turned;
}

/** Frames of a joint have the axes of the world at the start. */
function addHinge(world, { anchorA, anchorB }, [a, angleA], [b, angleB]) {
    const def = B.b2DefaultRevoluteJointDef();
    const base = def.base;
    base.bodyIdA = a;
    base.bodyIdB = b;
    const place = (key, anchor, angle) => {
        const frame = new B.b2Transform();
        frame.p = vector(anchor);
        frame.q = rotation(-angle);
        base[key] = frame;
    };
    place('localFrameA', anchorA, angleA);
    place('localFrameB', anchorB, angleB);
    def.base = base;
    B.b2CreateRevoluteJoint(world, def);
}

/** Forces act during the next step. */
function push(body, { spring, constant }) {
    if (constant) {
        B.b2Body_ApplyTorque(body, constant.torque, true);
        return;
    }
    const { x, y } = B.b2Body_GetWorldPoint(body, vector(spring.anchor));
    B.b2Body_ApplyForce(body, vector(pullOf(spring, [x, y])), new B.b2Vec2(x, y), true);
}

/** What the preset `matched` changes. */
const kWorld = { enableSleep: false, enableContinuous: false, restitutionThreshold: 0, maximumLinearSpeed: 1e6 };
const kBody = { enableSleep: false, allowFastRotation: true };

export function start({ preset, gravity, dt, friction, restitution, bodies, joints, forces }) {
    const worldDef = B.b2DefaultWorldDef();
    worldDef.gravity = vector(gravity);
    if (preset === 'matched') Object.assign(worldDef, kWorld);
    const world = B.b2CreateWorld(worldDef);
    const made = bodies.map((b) => {
        const def = B.b2DefaultBodyDef();
        if (preset === 'matched') Object.assign(def, kBody);
        def.type = b.isStatic ? B.b2BodyType.b2_staticBody : B.b2BodyType.b2_dynamicBody;
        def.position = vector(b.position);
        def.linearVelocity = vector(b.velocity);
        def.angularVelocity = b.spin;
        def.rotation = rotation(b.angle);
        const body = B.b2CreateBody(world, def);
        if (!b.collides) {
            const data = new B.b2MassData();
            Object.assign(data, { mass: b.mass, center: new B.b2Vec2(0, 0), rotationalInertia: b.inertia });
            B.b2Body_SetMassData(body, data);
            return body;
        }
        const shapeDef = B.b2DefaultShapeDef();
        const material = shapeDef.material;
        Object.assign(material, { friction, restitution });
        shapeDef.material = material;
        const { box, circle } = b.shape;
        const area = box ? 4 * box.half_extents[0] * box.half_extents[1] : Math.PI * circle.radius ** 2;
        if (!b.isStatic) shapeDef.density = b.mass / area;
        if (box) B.b2CreatePolygonShape(body, shapeDef, B.b2MakeBox(...box.half_extents));
        else {
            const round = new B.b2Circle();
            round.radius = circle.radius;
            B.b2CreateCircleShape(body, shapeDef, round);
        }
        return body;
    });
    const outside = () => B.b2CreateBody(world, B.b2DefaultBodyDef());
    const sideOf = (k) => (k < 0 ? [outside(), 0] : [made[k], bodies[k].angle]);
    for (const joint of joints) addHinge(world, joint, sideOf(joint.a), sideOf(joint.b));
    return {
        step() {
            for (const force of forces) push(made[(force.spring ?? force.constant).body], force);
            B.b2World_Step(world, dt, 4);
        },
        positions: () => made.map((body) => B.b2Body_GetPosition(body)).map(({ x, y }) => [x, y, 0]),
    };
}
