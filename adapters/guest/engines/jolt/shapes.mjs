// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import * as rg from '../../sdk/rigor_guest.mjs';
import { surfaceOf } from '../shared/height_field.mjs';
import { J, using, vector, withQuat, withVec3 } from './library.mjs';

/** Planes are cut off here [m]. */
const kPlaneHalfExtent = 1e4;

function hullOf(vertices, radius) {
    const settings = new J.ConvexHullShapeSettings();
    for (const v of vertices) withVec3(v, (point) => settings.mPoints.push_back(point));
    settings.mMaxConvexRadius = radius;
    return settings;
}

function oneSided({ vertices, triangles }, user) {
    const list = new J.TriangleList();
    const points = vertices.map((v) => new J.Vec3(...v));
    for (const [a, b, c] of triangles)
        using(new J.Triangle(points[a], points[b], points[c]), (triangle) => list.push_back(triangle));
    const settings = new J.MeshShapeSettings(list);
    settings.mUserData = user;
    for (const point of points) J.destroy(point);
    J.destroy(list);
    return settings;
}

/**
 * The library's triangles have one side, and it finds inner edges, which are not to be felt, by the two triangles of an
 * edge. So a mesh is two, one for either side.
 */
function meshOf(mesh, user) {
    const turned = { ...mesh, triangles: mesh.triangles.map(([a, b, c]) => [c, b, a]) };
    const both = new J.StaticCompoundShapeSettings();
    for (const side of [mesh, turned])
        withVec3([0, 0, 0], (origin) => withQuat([1, 0, 0, 0], (q) => both.AddShape(origin, q, oneSided(side, user), user)));
    return both;
}

const builders = {
    sphere: (s) => new J.SphereShapeSettings(s.radius),
    box: (s, radius) =>
        withVec3(s.half_extents, (half) => new J.BoxShapeSettings(half, Math.min(radius, ...s.half_extents))),
    capsule: (s) => new J.CapsuleShapeSettings(s.half_length, s.radius),
    cylinder: (s, radius) =>
        new J.CylinderShapeSettings(s.half_length, s.radius, Math.min(radius, s.half_length, s.radius)),
    cone: (s) => new J.TaperedCylinderShapeSettings(s.half_length, 0, s.radius, 0),
    hull: (s, radius) => hullOf(s.vertices, radius),
    triangle_mesh: (s, _radius, user) => meshOf(s, user),
    height_field: (s, _radius, user) => oneSided(surfaceOf(s), user),
    half_space: (s) =>
        withVec3(s.normal, (normal) => {
            const plane = new J.Plane(normal, -s.offset);
            const settings = new J.PlaneShapeSettings(plane, undefined, kPlaneHalfExtent);
            J.destroy(plane);
            return settings;
        }),
};

function create(settings, user) {
    const result = settings.Create();
    if (result.HasError()) throw new rg.BadInput(`${user}: Jolt refuses a shape: ${result.GetError().c_str()}`);
    return result.Get();
}

/**
 * The shape of a body, with its centre of mass. The shapes of the scenario have their number, from 1, as user data.
 * A body without shapes that collide gets one that nothing touches.
 */
export function shapeOf(body, radius) {
    const user = `body '${body.name}'`;
    const parts = body.collides ? body.shapes : [];
    const compound = new J.StaticCompoundShapeSettings();
    let whole = parts.length === 0 ? new J.SphereShapeSettings(1) : compound;
    parts.forEach((shape, k) => {
        const settings = builders[shape.shape](shape, radius, k + 1);
        settings.mUserData = k + 1;
        const still = shape.position.every((x) => x === 0) && shape.orientation[0] === 1;
        // A single shape in the frame of its body needs no other one around it.
        if (parts.length === 1 && still) {
            whole = settings;
            return;
        }
        if (parts.length === 1) {
            whole = withVec3(shape.position, (position) =>
                withQuat(shape.orientation, (q) => new J.RotatedTranslatedShapeSettings(position, q, settings)),
            );
            return;
        }
        withVec3(shape.position, (position) =>
            withQuat(shape.orientation, (q) => compound.AddShape(position, q, settings, k + 1)),
        );
    });
    const shape = create(whole, user);
    if (body.type === 'static') return shape;
    // The library turns kinematic bodies about the centre of mass of their shapes, the scenario about their origin.
    const center = body.type === 'kinematic' ? [0, 0, 0] : body.center_of_mass;
    const offset = rg.difference(center, vector(shape.GetCenterOfMass()));
    if (rg.norm(offset) === 0) return shape;
    return create(withVec3(offset, (v) => new J.OffsetCenterOfMassShapeSettings(v, whole)), user);
}
