# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""The smallest guest: bodies that fly freely and touch nothing, by symplectic Euler and turns at constant velocity."""
import os
import sys

here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [here, os.path.join(here, "../../sdk")]
import rigor_guest as rg


class Body:
    def __init__(self, given, gravity):
        self.given, self.moves = given, given["type"] == "dynamic"
        self.q, self.com, self.inertia = given["orientation"], given["center_of_mass"], given["inertia"]
        self.x = [p + r for p, r in zip(given["position"], rg.rotate(self.q, self.com))]  # centre of mass
        self.v = given["velocity"] if self.moves else [0.0] * 3
        self.w = given["angular_velocity"] if self.moves else [0.0] * 3
        self.g = [given["gravity_scale"] * x for x in gravity] if self.moves else [0.0] * 3
        self.force, self.torque = [0.0] * 3, [0.0] * 3

    def state(self):
        arm = rg.rotate(self.q, self.com)
        return [p - r for p, r in zip(self.x, arm)] + self.q + self.v + self.w

    def step(self, dt, planar):
        turn = rg.rotate_back(self.q, self.torque)
        turn = rg.times(rg.inverse(self.inertia), turn) if not planar else [0.0, 0.0, turn[2] / self.inertia[8]]
        self.v = [v + dt * (g + f / self.given["mass"]) for v, g, f in zip(self.v, self.g, self.force)]
        self.w = [w + dt * a for w, a in zip(self.w, rg.rotate(self.q, turn))]
        self.x = [x + dt * v for x, v in zip(self.x, self.v)]
        self.q = rg.turned(self.q, self.w, dt)
        self.force, self.torque = [0.0] * 3, [0.0] * 3


class FreeFlightWorld(rg.World):
    scheme = "symplectic_euler"

    def __init__(self, scenario, dt):
        self.dt, self.planar = dt, scenario["dimension"] == 2
        self.bodies = [Body(given, scenario["gravity"]) for given in scenario["bodies"]]

    def apply_force(self, body, force, torque):
        b = self.bodies[body]
        b.force, b.torque = [x + y for x, y in zip(b.force, force)], [x + y for x, y in zip(b.torque, torque)]

    def step(self):
        for body in self.bodies:
            if body.moves:
                body.step(self.dt, self.planar)

    def states(self):
        return [body.state() for body in self.bodies]

    def read_back(self):
        return [rg.body_row(b.given["mass"], b.com, b.inertia, b.state(), b.g) for b in self.bodies], []

    def ledger(self):
        return [rg.exact("integrator", "symplectic_euler"),
                rg.approximate("gyroscopic_term", "exact rigid-body rotation", "none", "constant without torque")]


class FreeFlight(rg.Guest):
    name, title, version = "free_flight_python", "Free flight, in Python", "1.0"
    capabilities = {"dynamics": True, "dimensions": [2, 3], "gravity_scale": True, "center_of_mass_offset": True}

    def build(self, scenario, dt, settings):
        return FreeFlightWorld(scenario, dt)


rg.serve(FreeFlight())
