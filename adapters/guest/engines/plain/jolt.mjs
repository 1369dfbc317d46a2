// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import init from 'jolt-physics';

const J = await init();

export const engine = 'jolt:preset=default';
export const bound = 5e-5; // single precision
export const scenes = ['backspin', 'bouncing_ball', 'asymmetric_top'];

const [kStill, kMoving] = [0, 1];

function system() {
    const settings = new J.JoltSettings();
    const pairs = new J.ObjectLayerPairFilterTable(2);
    pairs.EnableCollision(kStill, kMoving);
    pairs.EnableCollision(kMoving, kMoving);
    const phases = new J.BroadPhaseLayerInterfaceTable(2, 2);
    phases.MapObjectToBroadPhaseLayer(kStill, new J.BroadPhaseLayer(0));
    phases.MapObjectToBroadPhaseLayer(kMoving, new J.BroadPhaseLayer(1));
    settings.mObjectLayerPairFilter = pairs;
    settings.mBroadPhaseLayerInterface = phases;
    settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(phases, 2, pairs, 2);
    settings.mMaxWorkerThreads = 0;
    return new J.JoltInterface(settings);
}

function shapeOf({ box, sphere }) {
    if (box) return new J.BoxShape(new J.Vec3(...box.half_extents), Math.min(0.05, ...box.half_extents));
    if (sphere) return new J.SphereShape(sphere.radius);
    const plane = new J.Plane(new J.Vec3(0, 1, 0), 0);
    return new J.PlaneShapeSettings(plane, undefined, 1e4).Create().Get();
}

export function start({ gravity, dt, friction, restitution, bodies }) {
    const jolt = system();
    const physics = jolt.GetPhysicsSystem();
    physics.SetGravity(new J.Vec3(...gravity));
    const space = physics.GetBodyInterface();
    const made = bodies.map((b) => {
        const [w, x, y, z] = b.quaternion;
        const motion = b.isStatic ? J.EMotionType_Static : J.EMotionType_Dynamic;
        const layer = b.isStatic ? kStill : kMoving;
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
        space.AddBody(body.GetID(), J.EActivation_Activate);
        return body;
    });
    return {
        step: () => jolt.Step(dt, 1),
        positions: () =>
            made.map((body) => {
                const p = body.GetPosition(); // overwritten by the next call
                return [p.GetX(), p.GetY(), p.GetZ()];
            }),
    };
}
