// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import init from 'jolt-physics';

const J = await init();

export const engine = 'jolt:preset=default';
export const bound = 5e-5; // single precision
export const scenes = ['sleeping_top', 'hanging_chain_mode', 'euler_disc', 'backspin', 'bouncing_ball', 'asymmetric_top'];

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

function shapeOf({ box, sphere, cylinder, cone }) {
    if (box) return new J.BoxShape(new J.Vec3(...box.half_extents), Math.min(0.05, ...box.half_extents));
    if (sphere) return new J.SphereShape(sphere.radius);
    if (cylinder) return new J.CylinderShape(cylinder.half_length, cylinder.radius, Math.min(0.05, cylinder.half_length, cylinder.radius));
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

export function start({ gravity, dt, friction, restitution, bodies, joints }) {
    const jolt = system();
    const physics = jolt.GetPhysicsSystem();
    physics.SetGravity(new J.Vec3(...gravity));
    const space = physics.GetBodyInterface();
    const made = bodies.map((b) => {
        const [w, x, y, z] = b.quaternion;
        const motion = b.isStatic ? J.EMotionType_Static : J.EMotionType_Dynamic;
        const layer = b.isStatic ? kStill : b.collides ? kMoving : kUntouched;
        const settings = new J.BodyCreationSettings(
            shapeOf(b.shape),
            new J.RVec3(...b.position),
            new J.Quat(x, y, z, w),
            motion,
            layer,
        );
        settings.mFriction = friction;
        settings.mRestitution = restitution;
        settings.mLinearDamping = 0;
        settings.mAngularDamping = 0;
        if (!b.isStatic) {
            settings.mOverrideMassProperties = J.EOverrideMassProperties_CalculateInertia;
            settings.mMassPropertiesOverride.mMass = b.mass;
            settings.mLinearVelocity.Set(...b.velocity);
            settings.mAngularVelocity.Set(...b.spin);
        }
        const body = space.CreateBody(settings);
        if (!b.isStatic && !b.collides)
            body.GetMotionProperties().SetInverseInertia(new J.Vec3(...b.inertia.map((I) => 1 / I)), new J.Quat(0, 0, 0, 1));
        space.AddBody(body.GetID(), J.EActivation_Activate);
        return body;
    });
    for (const joint of joints) addJoint(physics, joint, made[joint.a] ?? J.Body.prototype.sFixedToWorld, made[joint.b]);
    return {
        step: () => jolt.Step(dt, 1),
        positions: () =>
            made.map((body) => {
                const p = body.GetPosition(); // overwritten by the next call
                return [p.GetX(), p.GetY(), p.GetZ()];
            }),
    };
}
