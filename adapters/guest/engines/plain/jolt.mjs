// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import init from 'jolt-physics';

const J = await init();

export const bound = 1e-6; // single precision
export const scenes = {
    default: ['sleeping_top', 'hanging_chain_mode', 'euler_disc', 'backspin', 'bouncing_ball', 'asymmetric_top', 'ball_in_cylinder'],
    matched: [
        ...['mass_ratio_heavy_above', 'four_bar_linkage_2d', 'physical_pendulum_2d'],
        ...['rod_strikes_ball', 'rod_strikes_ball_with_its_end'],
    ],
};

const kHalfDepth = 0.5; // of what is flat [m]
const [kStill, kMoving, kUntouched] = [0, 1, 2];

function system() {
    const settings = new J.JoltSettings();
    const pairs = new J.ObjectLayerPairFilterTable(3);
    pairs.EnableCollision(kStill, kMoving);
    pairs.EnableCollision(kMoving, kMoving);
    const phases = new J.BroadPhaseLayerInterfaceTable(3, 2);
    phases.MapObjectToBroadPhaseLayer(kStill, new J.BroadPhaseLayer(0));
    phases.MapObjectToBroadPhaseLayer(kMoving, new J.BroadPhaseLayer(1));
    phases.MapObjectToBroadPhaseLayer(kUntouched, new J.BroadPhaseLayer(1));
    settings.mObjectLayerPairFilter = pairs;
    settings.mBroadPhaseLayerInterface = phases;
    settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(phases, 2, pairs, 3);
    settings.mMaxWorkerThreads = 0;
    return new J.JoltInterface(settings);
}

/** The library's triangles have one side: a mesh that is felt from both is two. */
function meshOf({ vertices, triangles }, isOneSided) {
    const both = new J.StaticCompoundShapeSettings();
    const turned = triangles.map((corners) => corners.toReversed());
    for (const side of isOneSided ? [turned] : [triangles, turned]) {
        const list = new J.TriangleList();
        for (const corners of side) list.push_back(new J.Triangle(...corners.map((k) => new J.Vec3(...vertices[k]))));
        both.AddShape(new J.Vec3(0, 0, 0), new J.Quat(0, 0, 0, 1), new J.MeshShapeSettings(list), 0);
    }
    return both.Create().Get();
}

/** A capsule at its place in its body. */
function capsuleOf({ shape: { capsule }, shapePosition, shapeAngle }) {
    const turn = new J.Quat(0, 0, Math.sin(0.5 * shapeAngle), Math.cos(0.5 * shapeAngle));
    const settings = new J.CapsuleShapeSettings(capsule.half_length, capsule.radius);
    const placed = new J.RotatedTranslatedShapeSettings(new J.Vec3(...shapePosition), turn, settings);
    // A body turns about its centre of mass, a kinematic one of the scenes about its origin.
    const back = new J.Vec3(...shapePosition.map((x) => -x));
    return new J.OffsetCenterOfMassShapeSettings(back, placed).Create().Get();
}

function cylinderOf({ half_length, radius }, rounding) {
    return new J.CylinderShape(half_length, radius, Math.min(rounding, half_length, radius));
}

function boxOf({ half_extents: half }, rounding) {
    return new J.BoxShape(new J.Vec3(...[...half, kHalfDepth].slice(0, 3)), Math.min(rounding, ...half));
}

function shapeOf(body, rounding, isOneSided) {
    const { box, sphere, cylinder, capsule, cone, triangle_mesh: mesh } = body.shape;
    if (mesh) return meshOf(mesh, isOneSided);
    if (box) return boxOf(box, rounding);
    if (sphere) return new J.SphereShape(sphere.radius);
    if (capsule) return capsuleOf(body);
    if (cylinder) return cylinderOf(cylinder, rounding);
    if (cone) return new J.SphereShape(cone.radius); // touches nothing, and its inertia is given
    const plane = new J.Plane(new J.Vec3(0, 1, 0), 0);
    return new J.PlaneShapeSettings(plane, undefined, 1e4).Create().Get();
}

function constraintOf({ type, axis }) {
    if (type === 'ball') return new J.PointConstraintSettings();
    const settings = new J.HingeConstraintSettings();
    for (const vector of [settings.mHingeAxis1, settings.mHingeAxis2]) vector.Set(...axis);
    for (const vector of [settings.mNormalAxis1, settings.mNormalAxis2]) vector.Set(0, 1, 0);
    return settings;
}

function addJoint(physics, joint, a, b) {
    const settings = constraintOf(joint);
    settings.mSpace = J.EConstraintSpace_WorldSpace;
    settings.mPoint1.Set(...joint.anchor);
    settings.mPoint2.Set(...joint.anchor);
    physics.AddConstraint(settings.Create(a, b));
}

function motionOf({ isStatic, isKinematic }) {
    if (isKinematic) return J.EMotionType_Kinematic;
    return isStatic ? J.EMotionType_Static : J.EMotionType_Dynamic;
}

/** What the preset `matched` changes in a system and in its bodies, beside the convex radius. */
const kPhysics = {
    mNumVelocitySteps: 40,
    mNumPositionSteps: 10,
    mPenetrationSlop: 0,
    mMinVelocityForRestitution: 0,
    mUseBodyPairContactCache: false,
    mAllowSleeping: false,
};
const kBody = {
    mApplyGyroscopicForce: true,
    mEnhancedInternalEdgeRemoval: true,
    mMaxLinearVelocity: 1e6,
    mMaxAngularVelocity: 1e6,
    mAllowSleeping: false,
};

/** Height of the ball in the pipe at the end [m]; `isOneSided`: with the triangles of its inside alone. */
function heightInPipe(scene, isOneSided) {
    const run = start({ ...scene, isOneSided });
    for (let k = 0; k < Math.round(scene.duration / scene.dt); ++k) run.step();
    const [, [, height]] = run.positions();
    run.end();
    return height;
}

export function findings(read) {
    const scene = read('ball_in_cylinder');
    const [both, inside] = [false, true].map((isOneSided) => heightInPipe(scene, isOneSided));
    return [
        [`the ball in the pipe sinks to less than -1 m, not -0.61 m and up again (${both.toFixed(2)} m)`, both < -1],
        [`and so it does where the pipe has the triangles of its inside alone (${inside.toFixed(2)} m)`, inside < -1],
    ];
}

const space3 = ([x, y, z = 0]) => [x, y, z];

export function start({ preset, isOneSided, dimension, gravity, dt, friction, restitution, bodies, joints }) {
    const jolt = system();
    const physics = jolt.GetPhysicsSystem();
    physics.SetGravity(new J.Vec3(...space3(gravity)));
    const isMatched = preset === 'matched';
    if (isMatched) physics.SetPhysicsSettings(Object.assign(physics.GetPhysicsSettings(), kPhysics));
    const space = physics.GetBodyInterface();
    const made = bodies.map((b) => {
        const [w, x, y, z] = b.quaternion;
        const motion = motionOf(b);
        const layer = b.isStatic ? kStill : b.collides ? kMoving : kUntouched;
        const settings = new J.BodyCreationSettings(
            shapeOf(b, isMatched ? 0 : 0.05, isOneSided),
            new J.RVec3(...space3(b.position)),
            new J.Quat(x, y, z, w),
            motion,
            layer,
        );
        if (isMatched) Object.assign(settings, kBody);
        settings.mFriction = friction;
        settings.mRestitution = restitution;
        settings.mLinearDamping = 0;
        settings.mAngularDamping = 0;
        if (dimension === 2) settings.mAllowedDOFs = J.EAllowedDOFs_Plane2D;
        settings.mLinearVelocity.Set(...space3(b.velocity));
        settings.mAngularVelocity.Set(...(dimension === 2 ? [0, 0, b.spin] : b.spin));
        if (b.inertia) {
            settings.mOverrideMassProperties = J.EOverrideMassProperties_CalculateInertia;
            settings.mMassPropertiesOverride.mMass = b.mass;
        }
        const body = space.CreateBody(settings);
        const inverse = dimension === 2 ? [0, 0, 1 / b.inertia] : b.inertia?.map((I) => 1 / I);
        if (b.inertia) body.GetMotionProperties().SetInverseInertia(new J.Vec3(...inverse), new J.Quat(0, 0, 0, 1));
        space.AddBody(body.GetID(), J.EActivation_Activate);
        return body;
    });
    for (const joint of joints) addJoint(physics, joint, made[joint.a] ?? J.Body.prototype.sFixedToWorld, made[joint.b]);
    return {
        step: () => jolt.Step(dt, 1),
        end: () => J.destroy(jolt),
        positions: () =>
            made.map((body) => {
                const p = body.GetPosition(); // overwritten by the next call
                return [p.GetX(), p.GetY(), p.GetZ()];
            }),
    };
}
