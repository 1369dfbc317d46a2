# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""The engine from Python: the bits of the program, arrays and their lifetime, physics by hand, errors, threads."""

from __future__ import annotations

import ast
import copy
import gc
import signal
import threading
import unittest
from pathlib import Path
from typing import Any

import numpy as np

import rigor
import rigor.engine
from made_run import temporary_folder

FLOOR = rigor.Shape.half_space((0, 1, 0))


def pile(**world: Any) -> rigor.World:
    """A floor and a tower of three boxes with a ball on it, named."""
    w = rigor.World(dt=1 / 120, **world)
    w.add_shape(w.add_body(name="floor", type="static"), FLOOR)
    for i in range(3):
        box = w.add_body(name=f"box_{i}", position=(0, 0.5 + i, 0.05 * i))
        w.add_shape(box, rigor.Shape.box((0.5, 0.5, 0.5)))
    w.add_shape(w.add_body(name="ball", position=(0.1, 3.6, 0)), rigor.Shape.sphere(0.4), density=300)
    return w


class SameBits(unittest.TestCase):
    """World(scenario, spec) is the world that the program steps."""

    def compare(self, scenario: str, spec: str, dt: float, steps: int) -> None:
        folder = temporary_folder() / spec.replace("=", "-") / scenario
        run = rigor.validate(scenario, engines=spec, dt=dt, out=folder, audit=False, progress=False)
        motion = run.trajectory(engine="rigor", dt=dt)
        world = rigor.World(scenario, spec, dt=dt)
        self.assertEqual(world.bodies, list(motion.bodies))
        frames = range(0, min(len(motion.time), steps // motion.stride + 1))
        self.assertGreater(len(frames), 10)
        for frame in frames:
            for states, (name, body) in zip(world.states, motion.bodies.items()):
                if body.velocity is not None:
                    channels = (body.position, body.orientation, body.velocity, body.angular_velocity)
                    row = np.concatenate([channel[frame] for channel in channels])
                    np.testing.assert_array_equal(states.view(np.int64), row.view(np.int64), f"{name} in frame {frame}")
            world.step(motion.stride)

    def test_friction(self) -> None:
        self.compare("slide_and_stop", "rigor:preset=matched", 1 / 240, 200)

    def test_joints(self) -> None:
        self.compare("pendulum_chain", "rigor:preset=default", 1 / 60, 60)

    def test_scheduled_impulses(self) -> None:
        self.compare("mass_properties", "rigor:preset=default", 1 / 240, 200)

    def test_batches_copies_and_snapshots_have_the_same_bits(self) -> None:
        world = rigor.World("box_stack", "rigor:preset=fast", dt=1 / 120)
        world.step(20)
        saved, copied = world.snapshot(), copy.copy(world)
        batches = [world.batch(5, threads=threads) for threads in (1, 2, 3)]
        world.step(30)
        for batch in batches:
            self.assertTrue(batch.step(30))
            self.assertEqual(set(batch.state_hashes()), {world.state_hash()})
            np.testing.assert_array_equal(batch.states[3], world.states)
        copied.step(30)
        self.assertEqual(copied.state_hash(), world.state_hash())
        after = world.state_hash()
        world.restore(saved)
        self.assertNotEqual(world.state_hash(), after)
        for _ in range(30):
            world.step()
        self.assertEqual(world.state_hash(), after)

    def test_a_world_by_hand_is_that_of_the_same_scenario(self) -> None:
        scenario = {
            "rigor": 1, "name": "two", "title": "A ball on a box", "dimension": 3, "gravity": [0, -9.81, 0], "duration": 1,
            "dt": [0.01], "materials": {"m": {"friction": 0.6}},
            "bodies": [
                {"name": "floor", "type": "static", "shapes": [{"half_space": {"normal": [0, 1, 0]}, "material": "m"}]},
                {"name": "box", "position": [0, 0.5, 0], "mass": 3.0,
                 "shapes": [{"box": {"half_extents": [0.5, 0.5, 0.5]}, "material": "m"}]}],
        }
        one = rigor.World(scenario, "rigor")
        two = rigor.World(dt=0.01)
        two.add_shape(two.add_body(name="floor", type="static"), FLOOR)
        two.add_shape(two.add_body(name="box", position=(0, 0.5, 0), mass=3.0, inertia=[0.5, 0.5, 0.5]), rigor.Shape.box([0.5] * 3))
        for world in (one, two):
            world.apply_impulse("box", (2, 0, 0.5), (0, 0.3, 0))
            world.step(50)
        np.testing.assert_array_equal(one.states, two.states)


class Arrays(unittest.TestCase):
    def test_one_array_that_follows_the_world(self) -> None:
        world = pile()
        states = world.states
        self.assertEqual((states.shape, states.dtype), ((5, 13), np.float64))
        before = states[4, 1]
        world.step(10)
        self.assertIs(world.states, states)
        self.assertNotEqual(states[4, 1], before)
        world.set_velocity("ball", (1, 2, 3))
        np.testing.assert_array_equal(states[4, 7:10], (1, 2, 3))
        with self.assertRaisesRegex(ValueError, "read-only"):
            states[0, 0] = 1

    def test_a_view_outlives_its_world(self) -> None:
        world = pile()
        world.step(5)
        views, expected = [world.states, world.states[1:3, 7:10]], world.states.copy()
        batch = world.batch(3)
        batch_view = batch.states
        del world, batch
        gc.collect()
        junk = [np.full(10_000, 7.0) for _ in range(100)]
        np.testing.assert_array_equal(views[0], expected)
        np.testing.assert_array_equal(views[1], expected[1:3, 7:10])
        np.testing.assert_array_equal(batch_view[2], expected)
        self.assertEqual(len(junk), 100)

    def test_a_new_body_begins_a_new_array(self) -> None:
        world = pile()
        old = world.states
        world.add_body(mass=1, inertia=np.eye(3), position=(9, 9, 9))
        world.step()
        self.assertEqual((old.shape, world.states.shape), ((5, 13), (6, 13)))
        self.assertEqual(old[4, 1], 3.6)

    def test_assigned_states_move_bodies(self) -> None:
        world = pile()
        target = world.states.copy()
        target[4, 0:3], target[4, 10] = (5, 6, 7), 2.5
        world.states = target
        np.testing.assert_array_equal(world.states, target)
        with self.assertRaisesRegex(rigor.EngineError, "found 13 numbers, expected 65"):
            world.states = target[0]
        target[4, 3:7] = 0
        with self.assertRaises(rigor.EngineError) as refused:
            world.states = target
        self.assertEqual(refused.exception.id, "body_pose")

    def test_precisions_and_dimensions(self) -> None:
        flat = rigor.World(dimension=2, precision="f32")
        flat.add_body(position=(1, 2), orientation=0.5, angular_velocity=-3, mass=1, inertia=1)
        self.assertEqual((flat.states.dtype, flat.states.shape), (np.float32, (1, 6)))
        np.testing.assert_allclose(flat.states[0], (1, 2, 0.5, 0, 0, -3), rtol=1e-6)

    def test_contacts_carry_the_weight(self) -> None:
        world = pile()
        world.step(400)
        contacts = world.contacts
        on_floor = contacts[contacts["body_a"] == world.index("floor")]
        weight = sum(world.body(name)["mass"] for name in world.bodies) * 9.81
        resting = on_floor["normal_impulse"].sum() / world.dt
        self.assertGreater(len(on_floor), 3)
        self.assertAlmostEqual(resting / weight, 1, delta=0.02)
        np.testing.assert_allclose(on_floor["normal"], [[0, 1, 0]] * len(on_floor), atol=1e-9)
        np.testing.assert_allclose((on_floor["point_a"] - on_floor["point_b"])[:, 1], on_floor["depth"], atol=1e-12)
        self.assertGreater(contacts["depth"].max(), 0)  # resting contacts overlap by the slop
        self.assertEqual(set(contacts["shape_a"]), set(contacts["body_a"]))  # each body has one shape


class Physics(unittest.TestCase):
    def test_a_force_acts_for_one_step(self) -> None:
        world = rigor.World(gravity=(0, 0, 0), dt=0.1)
        body = world.add_body(mass=2, inertia=[1, 2, 4])
        world.apply_force(body, (4, 0, 0), (0, 0, 8))
        world.step(3)
        np.testing.assert_allclose(world.states[0, 7:13], (0.2, 0, 0, 0, 0, 0.2), atol=1e-12)
        world.apply_wrenches([[0, 6, 0, 0, 0, 0]])
        world.step()
        self.assertAlmostEqual(world.states[0, 8], 0.3, delta=1e-12)
        self.assertAlmostEqual(world.energy(), 0.5 * 2 * (0.2**2 + 0.3**2) + 0.5 * 4 * 0.2**2, delta=1e-12)

    def test_springs_drag_and_constant_forces(self) -> None:
        world = rigor.World(gravity=(0, 0, 0), dt=1e-3, settings={"integrator": "rk4"})
        bob = world.add_body(position=(1.5, 0, 0), mass=1, inertia=[1, 1, 1])
        world.add_spring(None, bob, stiffness=4, length=1.0)
        free = world.add_body(mass=1, inertia=[1, 1, 1], velocity=(1, 0, 0), position=(0, 5, 0))
        world.add_drag(free, linear=1.0)
        pushed = world.add_body(mass=2, inertia=[1, 1, 1], position=(0, 9, 0))
        world.add_constant_force(pushed, (0, 0, 2), start=0.2, end=0.7)
        world.step(1000)
        self.assertAlmostEqual(world.states[bob, 0], 1 + 0.5 * np.cos(2), delta=1e-9)
        self.assertAlmostEqual(world.states[free, 7], np.exp(-1), delta=1e-9)
        self.assertAlmostEqual(world.states[pushed, 9], 0.5, delta=1e-9)

    def test_a_motor_turns_a_door_to_its_stop(self) -> None:
        world = rigor.World(gravity=(0, 0, 0), dt=1 / 240)
        door = world.add_body(mass=10, inertia=[1, 1, 1])
        axis = rigor.JointAxis("limited", lower=0, upper=1.0, motor_speed=2, motor_max_force=50)
        hinge = world.add_joint("hinge", None, door, axis_a=(0, 1, 0), axis_b=(0, 1, 0), axes=[axis], name="hinge")
        world.step(4)
        self.assertAlmostEqual(world.joint_torque(hinge)[1], 50, delta=1e-6)  # while it speeds up, all that it has
        self.assertAlmostEqual(world.states[door, 11], 50 * 4 / 240, delta=1e-6)
        world.step(56)
        self.assertAlmostEqual(world.joint_speed(hinge), 2, delta=1e-6)
        self.assertAlmostEqual(world.joint_coordinate("hinge"), 0.5, delta=0.05)
        world.step(240)
        self.assertAlmostEqual(world.joint_coordinate("hinge"), 1.0, delta=1e-3)
        self.assertAlmostEqual(world.joint_torque("hinge")[1], 0, delta=1e-6)  # motor and stop in balance
        world.set_joint_motor("hinge", 0, -1.0, 50)
        world.step(120)
        self.assertAlmostEqual(world.joint_coordinate("hinge"), 0.5, delta=0.05)

    def test_joints_carry_and_break(self) -> None:
        world = rigor.World(dt=1 / 120)
        weight = world.add_body(name="weight", mass=3, inertia=[1, 1, 1], position=(0, -1, 0))
        rope = world.add_joint("ball", None, weight, anchor_b=(0, 1, 0), break_force=100, name="rope")
        world.step(60)
        np.testing.assert_allclose(world.joint_force(rope), (0, 3 * 9.81, 0), atol=1e-6)
        world.apply_force("weight", (0, -500, 0))
        world.step()
        self.assertEqual(world.last_step["broken"], [rope])
        self.assertFalse(world.joint_holds("rope"))
        with self.assertRaises(rigor.EngineError) as refused:
            world.joint_force("rope")
        self.assertEqual(refused.exception.id, "joint_broken")

    def test_queries(self) -> None:
        world = pile()
        hit = world.cast_ray((0.1, 10, 0), (0, -20, 0))
        self.assertEqual(hit["body"], world.index("ball"))
        self.assertAlmostEqual(hit["distance"], 6.0, delta=1e-9)
        np.testing.assert_allclose(hit["normal"], (0, 1, 0), atol=1e-9)
        world.set_pose("ball", (50, 0.4, 0))
        self.assertEqual(world.cast_ray((0.1, 10, 0), (0, -20, 0))["body"], world.index("box_2"))
        rays = world.cast_rays([(50, 9, 0), (-30, 9, 0), (0, 9, 0)], [(0, -5, 0)])
        self.assertEqual(list(rays["body"]), [-1, -1, -1])
        rays = world.cast_rays([(50, 9, 0), (-30, 9, 0)], [(0, -20, 0)])
        self.assertEqual(list(rays["body"]), [4, 0])
        np.testing.assert_allclose(rays["distance"], (8.2, 9))
        moved = world.cast_shape(rigor.Shape.sphere(0.25), (-3, 1.5, 0), (10, 0, 0))
        self.assertEqual(moved["body"], world.index("box_1"))
        self.assertAlmostEqual(moved["distance"], 3 - 0.5 - 0.25, delta=1e-6)
        near = world.nearest((-1.5, 2.5, 0.1), within=3)
        self.assertEqual((near["body"], round(near["distance"], 6)), (world.index("box_2"), 1.0))
        self.assertIsNone(world.nearest((0, 1000, 0), within=3))
        found = world.overlapping(rigor.Shape.box((0.1, 1.2, 0.1)), (0, 1.5, 0))
        self.assertEqual({body for body, _ in found}, {1, 2, 3})

    def test_sensors_and_events(self) -> None:
        world = rigor.World(dt=0.01)
        world.add_shape(world.add_body(name="gate", type="static"), rigor.Shape.box((1, 0.1, 1)), sensor=True)
        world.add_shape(world.add_body(name="ball", position=(0, 0.5, 0)), rigor.Shape.sphere(0.1))
        kinds = []
        for _ in range(60):
            world.step()
            kinds += [(event["kind"], event["body_a"], event["body_b"]) for event in world.events]
        self.assertEqual(kinds, [("sensor_begins", 0, 1), ("sensor_ends", 0, 1)])

    def test_every_shape_has_its_volume(self) -> None:
        shape, pi = rigor.Shape, np.pi
        corners = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
        volumes = [
            (shape.sphere(2), 4 / 3 * pi * 8), (shape.box((1, 2, 3)), 48), (shape.capsule(1, 2), pi * 4 + 4 / 3 * pi),
            (shape.cylinder(2, 1), pi * 8), (shape.cone(2, 1.5), pi * 4), (shape.ellipsoid((1, 2, 3)), 8 * pi),
            (shape.hull(corners), 1 / 6)]
        for made, volume in volumes:
            world = rigor.World()
            body = world.add_body()
            world.add_shape(body, made, density=2.0)
            self.assertAlmostEqual(world.body(body)["mass"] / (2 * volume), 1, delta=1e-9, msg=made.kind)

    def test_surfaces_hold_what_lies_on_them(self) -> None:
        square = np.array([(-5, 0, -5), (5, 0, -5), (5, 0, 5), (-5, 0, 5)], dtype=float)
        mesh = rigor.Shape.triangle_mesh(square, [(0, 2, 1), (0, 3, 2)])
        for ground in (mesh, rigor.Shape.height_field(np.zeros((3, 4)), 2.0, 3.0)):
            world = rigor.World()
            world.add_shape(world.add_body(type="static"), ground)
            world.add_shape(world.add_body(position=(0.3, 0.5, 0.2)), rigor.Shape.sphere(0.5))
            world.step(120)
            self.assertAlmostEqual(world.states[1, 1], 0.5, delta=1e-3, msg=ground.kind)
        for ground in (rigor.Shape.segment((-5, 0), (5, 0)), rigor.Shape.chain([(-5, 0), (0, 0), (5, 0)])):
            world = rigor.World(dimension=2)
            world.add_shape(world.add_body(type="static"), ground)
            world.add_shape(world.add_body(position=(0.3, 0.5)), rigor.Shape.sphere(0.5))
            world.step(120)
            self.assertAlmostEqual(world.states[1, 1], 0.5, delta=1e-3, msg=ground.kind)


class Batches(unittest.TestCase):
    def test_worlds_of_different_parameters(self) -> None:
        worlds = []
        for friction in (0.1, 0.3, 0.6):
            world = rigor.World(dt=1 / 240)
            slick = world.add_material(friction)
            world.add_shape(world.add_body(type="static"), FLOOR, material=slick)
            world.add_shape(world.add_body(position=(0, 0.5, 0), velocity=(2, 0, 0)), rigor.Shape.box([0.5] * 3), material=slick)
            worlds.append(world)
        batch = rigor.WorldBatch(worlds, threads=2)
        self.assertTrue(batch.step(240 * 3))
        way = batch.states[:, 1, 0]
        np.testing.assert_allclose(way, [4 / (2 * 9.81 * mu) for mu in (0.1, 0.3, 0.6)], rtol=0.02)
        self.assertEqual(worlds[0].time, 0)
        again = batch[1]
        np.testing.assert_array_equal(again.states, batch.states[1])
        batch.reset([0, 2])
        np.testing.assert_array_equal(batch.states[0], worlds[0].states)
        np.testing.assert_array_equal(batch.states[1], again.states)

    def test_motors_wrenches_and_states_by_world(self) -> None:
        world = rigor.World(gravity=(0, 0, 0), dt=0.01)
        wheel = world.add_body(mass=1, inertia=[1, 1, 1])
        world.add_joint("hinge", None, wheel, axes=[rigor.JointAxis(motor_speed=0, motor_max_force=1e4)], name="axle")
        batch = world.batch(3)
        self.assertTrue(batch.set_joint_motors("axle", 0, [1.0, 2.0, 3.0], 1e4))
        batch.step(10)
        np.testing.assert_allclose(np.linalg.norm(batch.states[:, 0, 10:13], axis=1), [1, 2, 3], rtol=1e-6)
        free = rigor.World(gravity=(0, 0, 0), dt=0.5)
        free.add_body(mass=2, inertia=[1, 1, 1])
        batch = free.batch(2)
        batch.apply_wrenches([[[4, 0, 0, 0, 0, 0]], [[8, 0, 0, 0, 0, 0]]])
        batch.step()
        np.testing.assert_allclose(batch.states[:, 0, 7], [1, 2])
        states = batch.states.copy()
        states[1, 0, 3:7] = 0  # no rotation
        self.assertFalse(batch.set_states(states))
        self.assertEqual([index for index, _ in batch.failures()], [1])
        self.assertIn("body_pose", batch.failures()[0][1])
        self.assertFalse(batch.step())
        batch.reset()
        self.assertTrue(batch.step())

    def test_worlds_of_two_kinds_are_refused(self) -> None:
        with self.assertRaises(rigor.EngineError) as refused:
            rigor.WorldBatch([pile(), pile(precision="f32")])
        self.assertEqual(refused.exception.id, "batch_worlds")


class Threads(unittest.TestCase):
    def test_python_goes_on_while_a_world_steps_and_a_second_caller_is_refused(self) -> None:
        world = pile()
        errors, counted = [], 0
        stepping = threading.Thread(target=world.step, args=(50_000,))
        stepping.start()
        while stepping.is_alive():
            counted += 1
            try:
                world.step()
            except RuntimeError as error:
                errors.append(str(error))
        stepping.join()
        self.assertGreater(counted, 10)
        self.assertEqual(set(errors), {"the world is in use by another thread"})

    def test_ctrl_c_ends_a_step_between_two_steps_of_the_engine(self) -> None:
        world = pile()
        threading.Timer(0.3, signal.raise_signal, args=(signal.SIGINT,)).start()
        with self.assertRaises(KeyboardInterrupt):
            world.step(1_000_000_000)
        self.assertGreater(world.time, 0)
        np.testing.assert_array_equal(world.states, world.copy().states)

    def test_two_worlds_in_two_threads_have_the_bits_of_one(self) -> None:
        worlds = [pile(), pile()]
        threads = [threading.Thread(target=world.step, args=(500,)) for world in worlds]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        alone = pile()
        alone.step(500)
        self.assertEqual({world.state_hash() for world in worlds}, {alone.state_hash()})


class Errors(unittest.TestCase):
    def refused(self, kind: Any, pattern: str, call: Any) -> None:
        with self.assertRaisesRegex(kind, pattern):
            call()

    def test_bad_arguments(self) -> None:
        world = pile()
        hash_before = world.state_hash()
        self.refused(rigor.EngineError, "body_mass", lambda: world.add_body(mass=-1))
        self.refused(rigor.EngineError, "expected dynamic, static or kinematic", lambda: world.add_body(type="fixed"))
        self.refused(rigor.EngineError, "there is a body 'ball' already", lambda: world.add_body(name="ball"))
        self.refused(rigor.EngineError, "no shape 'chain' in 3D", lambda: world.add_shape(0, rigor.Shape.chain([(0, 0), (1, 1)])))
        self.refused(rigor.EngineError, "half_space_body", lambda: world.add_shape("ball", FLOOR))
        self.refused(rigor.EngineError, "no joint 'weld', expected one of ball", lambda: world.add_joint("weld", 1, 2))
        self.refused(rigor.EngineError, "expected usual, free", lambda: rigor.JointAxis("stuck"))
        self.refused(KeyError, "no body has the name 'brick'", lambda: world.body("brick"))
        self.refused(IndexError, "there are 5", lambda: world.body(5))
        self.refused(IndexError, "body -1", lambda: world.body(-1))
        self.refused(TypeError, "incompatible", lambda: world.apply_force("ball", "up"))
        self.refused(rigor.EngineError, "found 2 numbers, expected 3", lambda: world.apply_force("ball", (1, 2)))
        self.refused(rigor.EngineError, "time_step", lambda: setattr(world, "dt", -1))
        self.refused(rigor.EngineError, "snapshot_world", lambda: world.restore(rigor.World().snapshot()))
        self.refused(rigor.EngineError, "unknown_algorithm", lambda: rigor.World(settings={"solver": "none"}))
        self.refused(rigor.EngineError, "expected an integer", lambda: rigor.World(settings={"substeps": "four"}))
        self.refused(rigor.EngineError, "precision", lambda: rigor.World(precision="f16"))
        self.assertEqual(world.state_hash(), hash_before)
        self.assertTrue(issubclass(rigor.EngineError, ValueError))

    def test_bad_scenarios_and_specs(self) -> None:
        self.refused(ValueError, "did you mean 'box_stack'", lambda: rigor.World("box_stackk"))
        self.refused(ValueError, "expected rigor", lambda: rigor.World("box_stack", "ode"))
        self.refused(ValueError, "key 'solver'", lambda: rigor.World("box_stack", "rigor:solver=none"))
        self.refused(ValueError, "found no key", lambda: rigor.World({"rigor": 1}))

    def test_numbers_that_overflow_are_an_error(self) -> None:
        world = rigor.World(gravity=(0, 0, 0))
        body = world.add_body(mass=1, inertia=[1, 1, 1])
        world.apply_force(body, (1e308, 0, 0))
        world.step()
        world.set_velocity(body, (1e308, 0, 0))
        with self.assertRaisesRegex(FloatingPointError, "after step .* of 100"):
            for _ in range(3):
                world.apply_force(body, (1.7e308, 0, 0))
                world.step(100, dt=100.0)


class Documentation(unittest.TestCase):
    def test_help_says_units_and_frames(self) -> None:
        for text, words in (
            (rigor.World.__doc__, ("radians", "world frame", "w, x, y, z")),
            (rigor.World.states.__doc__, ("[m/s]", "[rad/s]", "world frame", "7:10")),
            (rigor.World.contacts.__doc__, ("from A to B", "[N s]", "[m]")),
            (rigor.World.apply_force.__doc__, ("[N]", "[N m]", "world frame")),
            (rigor.World.add_body.__doc__, ("[kg]", "[kg m^2]", "body axes")),
        ):
            for word in words:
                self.assertIn(word, text)

    def test_all_that_is_public_is_documented_and_typed(self) -> None:
        stub = ast.parse(Path(rigor.engine.__file__).with_name("_engine.pyi").read_text())
        for node in stub.body:
            if not isinstance(node, ast.ClassDef):
                continue
            declared = {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
            declared |= {part.target.id for part in node.body if isinstance(part, ast.AnnAssign)}
            bound = getattr(rigor, node.name)
            public = {name for name in vars(bound) if not name.startswith("_")}
            if node.name == "EngineError":
                continue
            self.assertEqual({name for name in declared if not name.startswith("_")}, public, node.name)
            for name in public:
                self.assertTrue(getattr(bound, name).__doc__, f"{node.name}.{name}")


if __name__ == "__main__":
    unittest.main()
