# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""Guests of Rigor in Python: the protocol of ../PROTOCOL.md, and a little geometry. Standard library alone.

An engine derives from Guest, its worlds from World, and the program ends with serve(MyEngine()). What it prints goes to
its log: standard output belongs to the protocol.
"""
import json
import math
import os
import struct
import sys
import time
import traceback
from array import array

PROTOCOL = 1
MAGIC = b"RGF1"


class Unsupported(Exception):
    """The scenario needs what is not here. `documentation`: where the library's own says that it has no such thing;
    without it the feature counts as one that the guest does not offer yet. `user`: what needs it."""

    def __init__(self, lacking, documentation="", user=""):
        super().__init__(lacking)
        self.lacking, self.documentation, self.user = lacking, documentation, user


class BadInput(Exception):
    """Input that must not reach the engine."""


def exact(topic, resolved):
    """A line of the ledger: what was requested is what the engine does."""
    return {"topic": topic, "requested": resolved, "resolved": resolved, "realisation": "exact", "reason": ""}


def approximate(topic, requested, resolved, reason, realisation="approximate"):
    """A line of the ledger: what could not be matched, and why."""
    return {"topic": topic, "requested": requested, "resolved": resolved, "realisation": realisation, "reason": reason}


class World:
    """One scenario at one time step. `scheme`, `impulses`, `set_states` and `snapshots` are as in the protocol."""

    scheme = "unknown"
    impulses = False  # true: apply_impulse() changes velocities at once
    set_states = ""  # what set_state() does with the warm start; "": it can not
    snapshots = False

    def apply_force(self, body, force, torque):
        """Force and torque on a body during the next step, world frame, at the centre of mass."""
        raise NotImplementedError

    def step(self):
        """One step. May return {"counters": {...}, "phases": {...}, "asleep": [...], "broken": [...]}."""
        raise NotImplementedError

    def states(self):
        """For every body 13 numbers: position, orientation w x y z, velocity of the centre of mass, angular velocity."""
        raise NotImplementedError

    def contacts(self):
        """For every contact of the last step 19 numbers; see contact()."""
        return []

    def read_back(self):
        """For every body 29 numbers (see body_row()), and for every pair of materials a, b, friction, restitution."""
        raise NotImplementedError

    def ledger(self):
        return []


class Guest:
    """An engine. `name` is that of the manifest."""

    name = title = version = ""
    precision = "f64"
    build_notes = ""
    capabilities = {}
    options = []
    presets = []

    def build(self, scenario, dt, settings):
        """A World of the scenario, which is the JSON object of the protocol."""
        raise NotImplementedError

    def collide(self, a, b, dimension, most):
        """{"overlap": bool, "contacts": rows, "signed_distance": number, "witnesses": two points}; the last two only
        with the capability signed_distance."""
        raise NotImplementedError


def contact(a, b, point_a, point_b, normal, depth, impulse=None, friction=(0.0, 0.0, 0.0), shapes=(0, 0)):
    """A row of contacts. `normal` from A to B. Body A has the lower index: other rows are turned round here."""
    if a > b:
        return contact(b, a, point_b, point_a, [-x for x in normal], depth, impulse, [-x for x in friction], shapes[::-1])
    known = impulse is not None
    return [a, b, *shapes, *point_a, *point_b, *normal, depth, float(known), impulse if known else 0.0, *friction]


def body_row(mass, center_of_mass, inertia, state, gravity):
    """A row of read_back(); `inertia`: 9 numbers, about the centre of mass, body axes."""
    return [mass, *center_of_mass, *inertia, *state, *gravity]


def rotate(q, v):
    """The vector v rotated by the unit quaternion q = w, x, y, z."""
    w, x, y, z = q
    tx, ty, tz = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    return [v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx]


def rotate_back(q, v):
    return rotate([q[0], -q[1], -q[2], -q[3]], v)


def quaternion_product(a, b):
    return [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]


def turned(q, w, dt):
    """The orientation q after dt at the constant angular velocity w (world frame), by the exponential map."""
    rate = math.sqrt(w[0] ** 2 + w[1] ** 2 + w[2] ** 2)
    if rate == 0.0:
        return q
    s = math.sin(0.5 * rate * dt) / rate
    q = quaternion_product([math.cos(0.5 * rate * dt), s * w[0], s * w[1], s * w[2]], q)
    length = math.sqrt(sum(x * x for x in q))
    return [x / length for x in q]


def inverse(m):
    """Inverse of a 3 x 3 matrix of 9 numbers."""
    a, b, c, d, e, f, g, h, i = m
    det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    cofactors = [e * i - f * h, c * h - b * i, b * f - c * e, f * g - d * i, a * i - c * g, c * d - a * f]
    return [x / det for x in [*cofactors, d * h - e * g, b * g - a * h, a * e - b * d]]


def times(m, v):
    """Matrix of 9 numbers times vector."""
    return [m[3 * r] * v[0] + m[3 * r + 1] * v[1] + m[3 * r + 2] * v[2] for r in range(3)]


# ------------------------------------------------------------------------------------------------- frames
def _read_exactly(file, size):
    parts = []
    while size > 0:
        part = file.read(size)
        if not part:
            return None
        parts.append(part)
        size -= len(part)
    return b"".join(parts)


def read_frame(file):
    """Header and arrays by name (rows of numbers, or bytes), or None at the end."""
    prefix = _read_exactly(file, 16)
    if prefix is None:
        return None
    magic, header_size, payload_size = struct.unpack("<4sIQ", prefix)
    if magic != MAGIC:
        raise ValueError("no frame: it begins with %r" % magic)
    header = json.loads(_read_exactly(file, header_size))
    payload = _read_exactly(file, payload_size)
    arrays, offset = {}, 0
    for entry in header.get("arrays", []):
        count = math.prod(entry["shape"])
        size = count if entry.get("type") == "u8" else 8 * count
        piece = payload[offset : offset + size]
        offset += size
        arrays[entry["name"]] = piece if entry.get("type") == "u8" else _rows(piece, entry["shape"])
    return header, arrays


def _rows(piece, shape):
    values = array("d", piece)
    if sys.byteorder == "big":
        values.byteswap()
    return [list(values[r * shape[1] : (r + 1) * shape[1]]) for r in range(shape[0])]


def write_frame(file, header, arrays):
    """`arrays`: by name, (columns, rows) or bytes."""
    payload, listed = [], []
    for name, content in arrays.items():
        if isinstance(content, (bytes, bytearray)):
            listed.append({"name": name, "type": "u8", "shape": [len(content)]})
            payload.append(bytes(content))
            continue
        columns, rows = content
        values = array("d", [x for row in rows for x in row])
        if len(values) != columns * len(rows):
            raise ValueError("%s: expected rows of %d numbers" % (name, columns))
        if sys.byteorder == "big":
            values.byteswap()
        listed.append({"name": name, "shape": [len(rows), columns]})
        payload.append(values.tobytes())
    if listed:
        header["arrays"] = listed
    head, body = json.dumps(header, allow_nan=False).encode(), b"".join(payload)
    file.write(struct.pack("<4sIQ", MAGIC, len(head), len(body)) + head + body)
    file.flush()


# ------------------------------------------------------------------------------------------------ serving
class _Server:
    def __init__(self, guest):
        self.guest, self.worlds = guest, {}

    def hello(self, header, arrays):
        g = self.guest
        engine = {key: getattr(g, key) for key in ("name", "title", "version", "precision", "build_notes")}
        return {"protocol": PROTOCOL, "engine": engine, "capabilities": g.capabilities, "options": g.options,
                "presets": g.presets}, {}

    def build(self, header, arrays):
        world = self.guest.build(header["scenario"], header["dt"], header["settings"])
        self.worlds[header["world"]] = world
        about = {key: getattr(world, key) for key in ("scheme", "impulses", "set_states", "snapshots")}
        return about, self.states(world)

    def states(self, world):
        return {"states": (13, world.states())}

    def step(self, header, arrays):
        world = self.worlds[header["world"]]
        for row in arrays["forces"]:
            world.apply_force(int(row[0]), row[1:4], row[4:7])
        start = time.perf_counter()
        more = world.step() or {}
        return {"seconds": time.perf_counter() - start, **more}, self.states(world)

    def impulse(self, header, arrays):
        world, row = self.worlds[header["world"]], arrays["impulse"][0]
        world.apply_impulse(header["body"], row[0:3], row[3:6])
        return {}, self.states(world)

    def set_states(self, header, arrays):
        world = self.worlds[header["world"]]
        world.set_state(arrays["states"])
        return {}, self.states(world)

    def contacts(self, header, arrays):
        return {}, {"contacts": (19, self.worlds[header["world"]].contacts())}

    def read_back(self, header, arrays):
        bodies, pairs = self.worlds[header["world"]].read_back()
        return {}, {"bodies": (29, bodies), "pairs": (4, pairs)}

    def ledger(self, header, arrays):
        return {"lines": self.worlds[header["world"]].ledger()}, {}

    def save(self, header, arrays):
        return {}, {"snapshot": self.worlds[header["world"]].save()}

    def restore(self, header, arrays):
        world = self.worlds[header["world"]]
        restored = world.restore(arrays["snapshot"])
        return {"restored": bool(restored)}, self.states(world)

    def destroy(self, header, arrays):
        self.worlds.pop(header["world"], None)
        return {}, {}

    def collide(self, header, arrays):
        answer = self.guest.collide(header["a"], header["b"], header["dimension"], header["max_contacts"])
        found = {"contacts": (19, answer.pop("contacts"))}
        if "witnesses" in answer:
            found["witnesses"] = (3, answer.pop("witnesses"))
        return answer, found

    REQUESTS = {
        "hello", "build", "step", "impulse", "set_states", "contacts", "read_back", "ledger", "save", "restore",
        "destroy", "collide",
    }

    def answer(self, header, arrays):
        request = header.get("request")
        if request not in self.REQUESTS:
            return {"error": {"code": "failed", "message": "unknown request %r" % request}}, {}
        try:
            return getattr(self, request)(header, arrays)
        except Unsupported as e:
            error = {"code": "unsupported", "message": str(e), "lacking": e.lacking}
            return {"error": {**error, "documentation": e.documentation, "user": e.user}}, {}
        except BadInput as e:
            return {"error": {"code": "bad_input", "message": str(e)}}, {}
        except Exception as e:
            traceback.print_exc()
            return {"error": {"code": "failed", "message": "%s: %s" % (type(e).__name__, e)}}, {}


def serve(guest):
    """Answers requests until the input ends."""
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what is printed goes to the log, a line at once: a guest may end without a last one
    sys.stdout.reconfigure(line_buffering=True)
    server = _Server(guest)
    while (frame := read_frame(sys.stdin.buffer)) is not None:
        header, found = server.answer(*frame)
        header["id"] = frame[0].get("id")
        write_frame(output, header, found)
