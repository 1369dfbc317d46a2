// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import init from 'box2d3-wasm';

const B = await init();

export const engine = 'box2d3:preset=default';
export const bound = 2e-5; // single precision
export const scenes = ['bouncing_disc_2d', 'backspin_2d', 'box_stack_2d'];

const vector = ([x, y]) => new B.b2Vec2(x, y);

export function start({ gravity, dt, friction, restitution, bodies }) {
    const worldDef = B.b2DefaultWorldDef();
    worldDef.gravity = vector(gravity);
    const world = B.b2CreateWorld(worldDef);
    const made = bodies.map((b) => {
        const def = B.b2DefaultBodyDef();
        def.type = b.isStatic ? B.b2BodyType.b2_staticBody : B.b2BodyType.b2_dynamicBody;
        def.position = vector(b.position);
        def.linearVelocity = vector(b.velocity);
        def.angularVelocity = b.spin;
        const body = B.b2CreateBody(world, def);
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
    return {
        step: () => B.b2World_Step(world, dt, 4),
        positions: () => made.map((body) => B.b2Body_GetPosition(body)).map(({ x, y }) => [x, y, 0]),
    };
}
