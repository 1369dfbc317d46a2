// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints that break. None of the libraries here breaks joints itself; those that tell what a joint has borne let their user
// do it: a joint whose mean force or torque over a step exceeds its strength is taken out after this step.
import * as rg from '../../sdk/rigor_guest.mjs';

/** What a joint that can break is called among the capabilities. */
export const breaking = (types) => types.map((type) => `${type}.break`);

/** The joint has a strength. */
export const canBreak = (joint) => joint.break_force !== null || joint.break_torque !== null;

/** The ledger's line, where the scenario has such joints; `source`: what the library tells. */
export const ledgerOfBreaking = (scenario, source) =>
    scenario.joints.some(canBreak) ? [rg.exact('breaking_joints', `${source} after each step; broken from the next step on`)] : [];

export class Breaking {
    /**
     * `joints`: the library's, in the scenario's order. reactionOf(joint, index): { force, torque } over the last step, in N and
     * N m. remove(joint, index) takes one out of the world.
     */
    constructor(scenario, joints, reactionOf, remove) {
        Object.assign(this, { joints, reactionOf, remove });
        this.broken = [];
        this.weak = scenario.joints.flatMap((joint, index) => (canBreak(joint) ? [{ joint, index }] : []));
    }

    /** Breaks what the last step has overloaded. Returns the indices of all that have broken so far. */
    afterStep() {
        this.weak = this.weak.filter(({ joint, index }) => {
            const { force, torque } = this.reactionOf(this.joints[index], index);
            const { break_force, break_torque } = joint;
            if (force <= (break_force ?? force) && torque <= (break_torque ?? torque)) return true;
            this.remove(this.joints[index], index);
            this.broken.push(index);
            return false;
        });
        return this.broken;
    }
}
