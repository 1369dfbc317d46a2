// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario in Jolt.
import { performance } from 'node:perf_hooks';
import * as rg from '../../sdk/rigor_guest.mjs';
import { Breaking } from '../shared/breaking.mjs';
import { addJoints } from '../shared/joints.mjs';
import { Contacts } from './contacts.mjs';
import { addJoint, reactionOf } from './joints.mjs';
import { ledgerOf } from './ledger.mjs';
import { J, quaternion, using, vector, withQuat, withRVec3, withVec3 } from './library.mjs';
import { shapeOf } from './shapes.mjs';

const kMostContacts = 16384; // what the package's memory for a step holds beside the rest
const [kMoving, kStill, kNothing] = [0, 1, 2]; // object layers: bodies of the last touch nothing
const kMotion = { static: 'EMotionType_Static', kinematic: 'EMotionType_Kinematic', dynamic: 'EMotionType_Dynamic' };

function layersInto(settings) {
    const pairs = new J.ObjectLayerPairFilterTable(3);
    pairs.EnableCollision(kMoving, kMoving);
    pairs.EnableCollision(kMoving, kStill);
    const phases = new J.BroadPhaseLayerInterfaceTable(3, 2);
    [0, 1, 0].forEach((phase, layer) =>
        using(new J.BroadPhaseLayer(phase), (value) => phases.MapObjectToBroadPhaseLayer(layer, value)),
    );
    settings.mObjectLayerPairFilter = pairs;
    settings.mBroadPhaseLayerInterface = phases;
    settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(phases, 2, pairs, 3);
}

function mostContacts(bodies) {
    return Math.min(kMostContacts, Math.max(4096, 32 * bodies));
}

function interfaceFor(bodies) {
    const settings = new J.JoltSettings();
    settings.mMaxBodies = Math.max(1024, bodies + 16);
    settings.mMaxBodyPairs = Math.max(4096, 32 * bodies);
    settings.mMaxContactConstraints = mostContacts(bodies);
    settings.mMaxWorkerThreads = 0;
    layersInto(settings);
    return using(settings, () => new J.JoltInterface(settings));
}

export class JoltWorld extends rg.World {
    impulses = true;
    set_states = 'kept';

    constructor(scenario, dt, settings) {
        super();
        this.scenario = scenario;
        this.settings = settings;
        this.dt = dt;
        this.collisionSteps = Number(settings.collision_steps);
        this.scheme = this.collisionSteps === 1 ? 'symplectic_euler' : 'unknown';
        this.jolt = interfaceFor(scenario.bodies.length);
        this.system = this.jolt.GetPhysicsSystem();
        this.interface = this.system.GetBodyInterface();
        withVec3(scenario.gravity, (gravity) => this.system.SetGravity(gravity));
        this.applySettings();
        this.contactsOf = new Contacts(scenario, dt / this.collisionSteps);
        this.system.SetContactListener(this.contactsOf.listener);
        this.bodies = scenario.bodies.map((body, i) => this.addBody(body, i));
        const outside = () => J.JoltInterface.prototype.sGetFixedToWorldBody();
        const joints = addJoints(scenario, this.bodies, outside, (...joint) => addJoint(this.system, ...joint));
        // The library keeps the impulses of its last collision step.
        const last = dt / this.collisionSteps;
        const reaction = (joint, index) => reactionOf(joint, scenario.joints[index], last);
        this.breaking = new Breaking(scenario, joints, reaction, (joint) => joint.SetEnabled(false));
        this.system.OptimizeBroadPhase();
    }

    applySettings() {
        const own = this.system.GetPhysicsSettings();
        const given = this.settings;
        own.mNumVelocitySteps = Number(given.velocity_steps);
        own.mNumPositionSteps = Number(given.position_steps);
        own.mBaumgarte = Number(given.baumgarte);
        own.mPenetrationSlop = Number(given.penetration_slop);
        own.mSpeculativeContactDistance = Number(given.speculative_distance);
        own.mMinVelocityForRestitution = Number(given.restitution_threshold);
        own.mUseBodyPairContactCache = given.contact_cache === 'on';
        own.mAllowSleeping = given.sleeping === 'on';
        this.system.SetPhysicsSettings(own);
    }

    layerOf(body) {
        if (!body.collides || body.shapes.length === 0) return kNothing;
        return body.type === 'static' ? kStill : kMoving;
    }

    addBody(body, index) {
        const shape = shapeOf(body, Number(this.settings.convex_radius));
        const settings = withRVec3(body.position, (position) =>
            withQuat(
                body.orientation,
                (q) => new J.BodyCreationSettings(shape, position, q, J[kMotion[body.type]], this.layerOf(body)),
            ),
        );
        // Damping multiplies velocities by 1 - c h in every sub-step h.
        const h = this.dt / this.collisionSteps;
        settings.mLinearDamping = (1 - body.linear_velocity_kept ** h) / h;
        settings.mAngularDamping = (1 - body.angular_velocity_kept ** h) / h;
        settings.mMaxLinearVelocity = Number(this.settings.max_linear_velocity);
        settings.mMaxAngularVelocity = Number(this.settings.max_angular_velocity);
        settings.mGravityFactor = body.gravity_scale;
        settings.mApplyGyroscopicForce = this.settings.gyroscopic_term === 'on';
        settings.mAllowSleeping = this.settings.sleeping === 'on';
        settings.mEnhancedInternalEdgeRemoval = this.settings.internal_edge_removal === 'on';
        if (this.scenario.planar) settings.mAllowedDOFs = J.EAllowedDOFs_Plane2D;
        if (body.type !== 'static') {
            settings.mLinearVelocity.Set(...body.velocity);
            settings.mAngularVelocity.Set(...body.angular_velocity);
            // The inertia is given below, exactly; the library wants one now.
            settings.mOverrideMassProperties = J.EOverrideMassProperties_MassAndInertiaProvided;
            settings.mMassPropertiesOverride.mMass = body.type === 'dynamic' ? body.mass : 1;
            const unit = J.Mat44.prototype.sIdentity();
            settings.mMassPropertiesOverride.mInertia = unit;
        }
        const created = this.interface.CreateBody(settings);
        J.destroy(settings);
        if (body.type === 'dynamic') this.setInertia(created, body);
        this.contactsOf.owners.set(created.GetID().GetIndex(), index);
        this.interface.AddBody(created.GetID(), J.EActivation_Activate);
        return created;
    }

    setInertia(created, body) {
        const { moments, orientation } = rg.principalAxes(body.inertia);
        const motion = created.GetMotionProperties();
        const inverse = moments.map((moment) => 1 / moment);
        if (this.scenario.planar) inverse[0] = inverse[1] = 0;
        withVec3(inverse, (I) => withQuat(this.scenario.planar ? [1, 0, 0, 0] : orientation, (q) => motion.SetInverseInertia(I, q)));
    }

    stateOf(body) {
        const pose = [...vector(body.GetPosition()), ...quaternion(body.GetRotation())];
        if (body.IsStatic()) return [...pose, 0, 0, 0, 0, 0, 0];
        return [...pose, ...vector(body.GetLinearVelocity()), ...vector(body.GetAngularVelocity())];
    }
    states() {
        return this.bodies.map((body) => this.stateOf(body));
    }

    applyForce(index, force, torque) {
        const body = this.bodies[index];
        this.interface.ActivateBody(body.GetID());
        withVec3(force, (f) => body.AddForce(f));
        withVec3(torque, (t) => body.AddTorque(t));
    }
    applyImpulse(index, linear, angular) {
        const id = this.bodies[index].GetID();
        withVec3(linear, (p) => this.interface.AddImpulse(id, p));
        withVec3(angular, (p) => this.interface.AddAngularImpulse(id, p));
    }

    step() {
        this.contactsOf.clear();
        const start = performance.now();
        this.jolt.Step(this.dt, this.collisionSteps);
        const seconds = 1e-3 * (performance.now() - start);
        this.contactsOf.checkNumber(mostContacts(this.scenario.bodies.length) * this.collisionSteps);
        const asleep = this.bodies.flatMap((body, i) => (body.IsDynamic() && !body.IsActive() ? [i] : []));
        return { seconds, asleep, broken: this.breaking.afterStep() };
    }

    contacts() {
        return this.contactsOf.rows;
    }

    setStates(states) {
        states.forEach((row, i) => {
            const body = this.bodies[i];
            if (!body.IsDynamic()) return;
            withRVec3(row.slice(0, 3), (x) =>
                withQuat(row.slice(3, 7), (q) =>
                    withVec3(row.slice(7, 10), (v) =>
                        withVec3(row.slice(10, 13), (w) =>
                            this.interface.SetPositionRotationAndVelocity(body.GetID(), x, q, v, w),
                        ),
                    ),
                ),
            );
            this.interface.ActivateBody(body.GetID());
            body.ResetSleepTimer();
        });
    }

    readBack() {
        const bodies = this.scenario.bodies.map((given, i) => {
            const body = this.bodies[i];
            const whole = vector(this.system.GetGravity());
            if (given.type !== 'dynamic') return rg.bodyRow(0, [0, 0, 0], new Array(9).fill(0), this.stateOf(body), whole);
            const motion = body.GetMotionProperties();
            const gravity = rg.scaled(motion.GetGravityFactor(), whole);
            const inverse = vector(motion.GetInverseInertiaDiagonal());
            const moments = inverse.map((x) => (x > 0 ? 1 / x : 0));
            const inertia = rg.tensorOf(moments, quaternion(motion.GetInertiaRotation()));
            const center = vector(body.GetShape().GetCenterOfMass());
            return rg.bodyRow(1 / motion.GetInverseMass(), center, inertia, this.stateOf(body), gravity);
        });
        // The listener gives every contact these numbers.
        const pairs = this.scenario.pairs.map((p) => [p.a, p.b, Math.fround(p.friction), Math.fround(p.restitution)]);
        return { bodies, pairs };
    }

    ledger() {
        return ledgerOf(this);
    }
    destroy() {
        J.destroy(this.jolt);
        J.destroy(this.contactsOf.listener);
    }
}
