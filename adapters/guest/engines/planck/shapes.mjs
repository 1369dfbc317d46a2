// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { BoxShape, ChainShape, CircleShape, EdgeShape, PolygonShape, Settings } from 'planck';
import * as rg from '../../sdk/rigor_guest.mjs';

export const toPlanck = ([x, y]) => ({ x, y });
export const angleOf = ([w, , , z]) => 2 * Math.atan2(z, w);

/** A rectangle and a circle at either end, whose line is the shape's y. */
function capsule({ radius, half_length }, place, angle) {
    const ends = [half_length, -half_length].map((y) => new CircleShape(toPlanck(place([0, y, 0])), radius));
    return [new BoxShape(radius, half_length, toPlanck(place([0, 0, 0])), angle), ...ends];
}

/** Shapes of the library that make one of the format's, placed in its body. */
export function shapesOf(shape, reach, user) {
    if (shape.shape !== 'capsule') return [shapeOf(shape, reach, user)];
    const place = (p) => rg.sum(shape.position, rg.rotate(shape.orientation, p));
    return capsule(shape, place, angleOf(shape.orientation));
}

function shapeOf(shape, reach, user) {
    const place = (p) => rg.sum(shape.position, rg.rotate(shape.orientation, p));
    switch (shape.shape) {
        case 'circle':
            return new CircleShape(toPlanck(shape.position), shape.radius);
        case 'box':
            return new BoxShape(...shape.half_extents.slice(0, 2), toPlanck(shape.position), angleOf(shape.orientation));
        case 'segment':
            return new EdgeShape(toPlanck(place(shape.a)), toPlanck(place(shape.b)));
        case 'chain':
            return new ChainShape(shape.vertices.map((v) => toPlanck(place(v))), shape.loop);
        case 'half_plane': {
            const center = place(rg.scaled(shape.offset - reach, shape.normal));
            const angle = angleOf(shape.orientation) + Math.atan2(shape.normal[1], shape.normal[0]);
            return new BoxShape(reach, reach, toPlanck(center), angle);
        }
        default: {
            if (shape.vertices.length > Settings.maxPolygonVertices)
                throw new rg.Unsupported(
                    `polygon of ${shape.vertices.length} vertices`,
                    `planck.d.ts, Settings.maxPolygonVertices ${Settings.maxPolygonVertices}`,
                    user,
                );
            return new PolygonShape(shape.vertices.map((v) => toPlanck(place(v))));
        }
    }
}

/** The library's skin of one of its shapes, which lies outside of it. */
export const skinOf = (shape) => (shape.getType() === 'circle' ? 0 : Settings.polygonRadius);
