# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""A guest with one fault: faulty_guest.py SDK_FOLDER FAULT [NAME]. Its one body does not move; its answers are right but for
the fault, which is in the answer to `hello` or, from the third one on, to `step`. The guest `tired` ends in its second
world. Every start adds a line to the file RIGOR_GUEST_STARTS, where this variable names one."""
import math
import os
import signal
import struct
import sys
import time

sys.path.insert(0, sys.argv[1])
import rigor_guest as rg

FAULT = sys.argv[2]
worlds = 0
if os.environ.get("RIGOR_GUEST_STARTS"):
    with open(os.environ["RIGOR_GUEST_STARTS"], "a") as starts:
        starts.write("%d\n" % os.getpid())


class StillWorld(rg.World):
    scheme = "symplectic_euler"

    def __init__(self, scenario):
        self.scenario, self.steps = scenario, 0

    def apply_force(self, body, force, torque):
        pass

    def step(self):
        self.steps += 1
        if FAULT == "tired" and worlds > 1:
            os._exit(3)

    def states(self):
        moved = math.nan if FAULT == "nan" and self.steps >= 3 else 0.0
        rows = [[*b["position"], *b["orientation"], *b["velocity"], *b["angular_velocity"]] for b in self.scenario["bodies"]]
        rows[-1][1] += moved
        return rows

    def contacts(self):
        row = rg.contact(0, 1, [0] * 3, [0] * 3, [0, 1, 0], 0.1)
        if FAULT == "contact_order":
            row[0], row[1] = row[1], row[0]
        if FAULT == "contact_index":
            row[1] = 7
        return [row]

    def read_back(self):
        g = self.scenario["gravity"]
        bodies = self.scenario["bodies"]
        rows = [rg.body_row(b["mass"], b["center_of_mass"], b["inertia"], s, g) for b, s in zip(bodies, self.states())]
        return rows, []

    def ledger(self):
        line = rg.exact("integrator", "none")
        if FAULT == "ledger_without_topic":
            del line["topic"]
        if FAULT == "realisation":
            line["realisation"] = "nearly"
        return [line]


class Faulty(rg.Guest):
    name = title = sys.argv[3] if len(sys.argv) > 3 else "faulty"
    version = "" if FAULT == "no_version" else "1"
    capabilities = {"dynamics": True, "dimensions": [3], "shapes": ["sphere", "half_space", "box"]}
    if FAULT == "unknown_capability":
        capabilities["teleportation"] = True

    def build(self, scenario, dt, settings):
        if FAULT == "refuse_in_library":
            raise rg.Unsupported("shape 'sphere'", "its manual, chapter 3", "body 'ball'")
        if FAULT == "refuse":
            raise rg.Unsupported("spheres that fly", user="body 'ball'")
        if FAULT == "bad_input":
            raise rg.BadInput("mass of 2")
        if FAULT == "raise":
            raise ValueError("there is no such thing")
        global worlds
        worlds += 1
        return StillWorld(scenario)


def use_memory():
    hog = []
    while True:
        hog.append(bytearray(b"x" * (32 << 20)))
        time.sleep(0.05)


def write_for_ever(file):
    while True:
        os.write(file, b"text without an end, which is no frame\n" * 100)


def misbehave(output, header):
    """The faults that have no answer, or none that is one."""
    if FAULT == "exit":
        print("the guest gives up")
        os._exit(3)
    if FAULT == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    if FAULT == "closed":
        output.close()
        time.sleep(1000)
    if FAULT == "silent":
        time.sleep(1000)
    if FAULT == "memory":
        use_memory()
    if FAULT == "garbage":
        output.write(b"Hello, world\n")
        output.flush()
        time.sleep(1000)
    if FAULT == "huge":
        output.write(struct.pack("<4sIQ", rg.MAGIC, 2, 1 << 60) + b"{}")
        output.flush()
        time.sleep(1000)
    if FAULT == "no_json":
        output.write(struct.pack("<4sIQ", rg.MAGIC, 4, 0) + b"{id:")
        output.flush()
        time.sleep(1000)
    if FAULT == "truncated":
        output.write(struct.pack("<4sIQ", rg.MAGIC, 100, 0) + b'{"id": ')
        output.flush()
        os._exit(0)
    if FAULT == "endless_text":
        write_for_ever(output.fileno())
    if FAULT == "endless_log":
        write_for_ever(2)


def with_fault(header, arrays):
    """The faults of an answer."""
    if FAULT == "wrong_id":
        header["id"] += 1
    if FAULT == "no_states":
        arrays.pop("states", None)
    if FAULT == "no_seconds":
        header.pop("seconds", None)
    if FAULT == "few_states" and "states" in arrays:
        arrays["states"] = (13, arrays["states"][1][:-1])
    if FAULT == "narrow_states" and "states" in arrays:
        arrays["states"] = (12, [row[:12] for row in arrays["states"][1]])
    if FAULT == "error_without_code":
        header = {"id": header["id"], "error": {"message": "something"}}
    return header, arrays


if "FAULTY_GUEST_PID" in os.environ:
    with open(os.environ["FAULTY_GUEST_PID"], "w") as file:
        file.write("%d\n" % os.getpid())

AT_HELLO = {"version", "no_engine", "hello_exit", "hello_garbage", "hello_silent"}
steps = 0
write_frame = rg.write_frame


def write_faulty(output, header, arrays):
    global FAULT, steps
    if FAULT in AT_HELLO:
        if FAULT == "version":
            header["protocol"] = 2
        elif FAULT == "no_engine":
            header.pop("engine", None)
        else:
            FAULT = FAULT[len("hello_") :]
            misbehave(output, header)
    steps += 1 if "seconds" in header else 0
    if steps >= 3 and "seconds" in header:
        misbehave(output, header)
        header, arrays = with_fault(header, arrays)
    write_frame(output, header, arrays)


rg.write_frame = write_faulty
rg.serve(Faulty())
if FAULT == "stays":
    time.sleep(1000)
