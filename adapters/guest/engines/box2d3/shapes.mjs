// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import * as rg from '../../sdk/rigor_guest.mjs';
import { angleOf, B, withRot, withVec2 } from './library.mjs';

const kMostVertices = 8;

function polygonOf(points, user) {
    if (points.length > kMostVertices)
        throw new rg.Unsupported(
            `polygon of ${points.length} vertices`,
            'Box2D manual, "Polygons": at most B2_MAX_POLYGON_VERTICES, 8',
            user,
        );
    const vectors = points.map(([x, y]) => new B.b2Vec2(x, y));
    const hull = B.b2ComputeHull(vectors);
    const polygon = hull.count === points.length ? B.b2MakePolygon(hull, 0) : null;
    hull.delete();
    for (const v of vectors) v.delete();
    if (!polygon) throw new rg.BadInput(`${user}: Box2D makes no polygon of these vertices`);
    return polygon;
}

const corners = ([x, y]) => [
    [-x, -y, 0],
    [x, -y, 0],
    [x, y, 0],
    [-x, y, 0],
];

function segmentFrom(body, def, a, b) {
    const segment = new B.b2Segment();
    withVec2(a, (p) => {
        segment.point1 = p;
    });
    withVec2(b, (p) => {
        segment.point2 = p;
    });
    return B.b2CreateSegmentShape(body, def, segment);
}

/** The surface has a velocity over its body. */
export const moves = ({ surface_velocity: { linear, angular } }) => [...linear, ...angular].some((v) => v !== 0);

/**
 * The library's surfaces run round their shape with one speed: a circle that turns about its centre is that, and a velocity along
 * one side of another shape is on this side, for which the upper one is taken.
 */
export function tangentSpeed(shape, body, gravity) {
    if (!moves(shape)) return 0;
    const { linear, angular } = shape.surface_velocity;
    const isCentred = shape.shape === 'circle' && rg.norm(shape.position) === 0;
    if (isCentred && rg.norm(linear) === 0) return -angular[2] * shape.radius;
    if (rg.norm(angular) > 0 || rg.norm(gravity) === 0)
        throw new rg.Unsupported('a surface that turns about another point than the centre of a circle', '', `body '${body.name}'`);
    const right = rg.scaled(1 / rg.norm(gravity), [-gravity[1], gravity[0], 0]);
    return rg.dot(rg.rotate(body.orientation, linear), right);
}

/** Segments of a chain, which has two sides; the library's own chain has one. */
function chainSegments({ vertices, loop }) {
    const pairs = vertices.slice(1).map((v, k) => [vertices[k], v]);
    return loop ? [...pairs, [vertices.at(-1), vertices[0]]] : pairs;
}

/** Adds a shape to a body: ids of the library's shapes. */
export function addShapes(body, shape, def, reach, user) {
    if (shape.shape !== 'chain') return [addShape(body, shape, def, reach, user)];
    const place = (p) => rg.sum(shape.position, rg.rotate(shape.orientation, p));
    return chainSegments(shape).map(([a, b]) => segmentFrom(body, def, place(a), place(b)));
}

function addShape(body, shape, def, reach, user) {
    const place = (p) => rg.sum(shape.position, rg.rotate(shape.orientation, p));
    const polygon = (points) => {
        const made = polygonOf(points, user);
        const id = B.b2CreatePolygonShape(body, def, made);
        made.delete();
        return id;
    };
    switch (shape.shape) {
        case 'circle': {
            const circle = new B.b2Circle();
            withVec2(shape.position, (center) => {
                circle.center = center;
            });
            circle.radius = shape.radius;
            return B.b2CreateCircleShape(body, def, circle);
        }
        case 'capsule': {
            const capsule = new B.b2Capsule();
            withVec2(place([0, -shape.half_length, 0]), (p) => {
                capsule.center1 = p;
            });
            withVec2(place([0, shape.half_length, 0]), (p) => {
                capsule.center2 = p;
            });
            capsule.radius = shape.radius;
            return B.b2CreateCapsuleShape(body, def, capsule);
        }
        case 'segment':
            return segmentFrom(body, def, place(shape.a), place(shape.b));
        case 'half_plane': {
            const center = place(rg.scaled(shape.offset - reach, shape.normal));
            const angle = angleOf(shape.orientation) + Math.atan2(shape.normal[1], shape.normal[0]);
            const box = withVec2(center, (c) => withRot(angle, (q) => B.b2MakeOffsetBox(reach, reach, c, q)));
            const id = B.b2CreatePolygonShape(body, def, box);
            box.delete();
            return id;
        }
        case 'box':
            return polygon(corners(shape.half_extents).map(place));
        default:
            return polygon(shape.vertices.map(place));
    }
}
