// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Queries of pairs of shapes: Rapier's closest or deepest points of two shapes.
import * as rg from '../../sdk/rigor_guest.mjs';

/** Distances are found up to here [m]. */
const kFarthest = 1e3;

/** Positions are relative to `origin`, before they become numbers of single precision. */
function placed(space, given, origin) {
    const { desc, offset = [0, 0, 0] } = space.builders[given.shape](given, {});
    if (!desc) throw new rg.BadInput('Rapier builds no hull of these vertices');
    const inWorld = rg.sum(given.position, rg.rotate(given.orientation, offset));
    const position = rg.difference(inWorld, origin);
    return { shape: desc.shape, position: space.vector(position), rotation: space.rotation(given.orientation) };
}

const isHalf = (given) => given.shape === 'half_space' || given.shape === 'half_plane';

/** A half-space goes first: as the second shape Rapier takes it for another one (rapier3d/README.md). */
export function collide(space, a, b) {
    if (!isHalf(b) || isHalf(a)) return query(space, a, b);
    const { contacts, witnesses, ...found } = query(space, b, a);
    const turned = contacts.map((row) => {
        const [pointA, pointB, normal] = [row.slice(7, 10), row.slice(4, 7), rg.negated(row.slice(10, 13))];
        return rg.contact(0, 1, pointA, pointB, normal, row[13]);
    });
    return { ...found, contacts: turned, witnesses: [witnesses[1], witnesses[0]] };
}

function query(space, a, b) {
    const origin = a.position;
    const [first, second] = [placed(space, a, origin), placed(space, b, origin)];
    const found = first.shape.contactShape(
        first.position,
        first.rotation,
        second.shape,
        second.position,
        second.rotation,
        kFarthest,
    );
    if (!found) throw new rg.Unsupported(`distance of ${a.shape} and ${b.shape}`);
    const witnesses = [found.point1, found.point2].map((point) => rg.sum(origin, space.fromVector(point)));
    const overlap = found.distance <= 0;
    const normal = space.fromVector(found.normal1);
    const contacts = overlap ? [rg.contact(0, 1, witnesses[0], witnesses[1], normal, -found.distance)] : [];
    return { overlap, contacts, signed_distance: found.distance, witnesses };
}
