# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""The recorded motion of one case, from ``trajectories/<case id>.h5``."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, Optional

import h5py
import numpy as np
import numpy.typing as npt
import pandas as pd

from .errors import DamagedStore, NewerFormat, NoSuchCase

if TYPE_CHECKING:
    import xarray

Array = npt.NDArray[np.float64]

#: The newest format of trajectory files that this package knows.
NEWEST_TRAJECTORY = 4

#: One contact point: bodies and shapes by their indices in the scenario (A is the lower one), world frame.
CONTACT = np.dtype(
    [
        ("time", "f8"),  # of the frame at which its step began, or ended (contacts_at_step_end) [s]
        ("body_a", "i4"),
        ("body_b", "i4"),
        ("shape_a", "i4"),
        ("shape_b", "i4"),
        ("point_a", "f8", 3),  # on the surface of A [m]
        ("point_b", "f8", 3),  # on the surface of B [m]
        ("normal", "f8", 3),  # unit, from A to B
        ("depth", "f8"),  # > 0: overlap [m]
        ("normal_impulse", "f8"),  # [N s]; NaN: not reported
        ("friction_impulse", "f8", 3),  # on B [N s]
    ]
)

_CHANNELS = {
    "position": ("x", "y", "z"),
    "orientation": ("qw", "qx", "qy", "qz"),
    "velocity": ("vx", "vy", "vz"),
    "angular_velocity": ("wx", "wy", "wz"),
}
_UNITS = {"position": "m", "orientation": "1", "velocity": "m/s", "angular_velocity": "rad/s"}


@dataclass(frozen=True)
class Motion:
    """Motion of one body in the world frame: frames x 3 or 4, None where nothing is known."""

    name: str
    #: Of the body frame's origin [m].
    position: Optional[Array] = None
    #: Body to world, unit quaternion in the order w, x, y, z.
    orientation: Optional[Array] = None
    #: Of the centre of mass [m/s].
    velocity: Optional[Array] = None
    #: [rad/s].
    angular_velocity: Optional[Array] = None


@dataclass(frozen=True)
class Trajectory:
    """Frames of one case. Arrays have one row for each frame; SI units, world frame, y up in most scenarios."""

    scenario: str
    spec: str
    case_id: str
    #: Time step of the run [s].
    dt: float
    #: Steps between two frames.
    stride: int
    #: Frames between those whose contacts are stored.
    contact_stride: int
    #: False: contacts stand at the frame at which their step began; True: at which it ended.
    contacts_at_step_end: bool
    #: Time of each frame [s].
    time: Array
    #: All bodies by name, in the order of the scenario.
    bodies: dict[str, Motion]
    #: Exact motion of the bodies that the reference knows; NaN where it is unknown.
    reference: dict[str, Motion]
    #: Observables by (name, subject); the subject is "" for the whole scene. NaN where not known.
    series: dict[tuple[str, str], Array]
    #: Contact points in time order, a structured array (``CONTACT``).
    contacts: npt.NDArray[Any]
    #: Unit of every array: of "position", ..., of "contacts/depth", ..., of a series by its name.
    units: dict[str, str] = field(default_factory=dict)

    def body(self, name: str) -> Motion:
        """Motion of a body. Raises NoSuchCase with the names that there are."""
        if name not in self.bodies:
            raise NoSuchCase(f"no body has the name '{name}'; expected one of {', '.join(self.bodies)}")
        return self.bodies[name]

    def frame(self, body: str) -> pd.DataFrame:
        """A body's motion as a data frame over time: x y z [m], qw qx qy qz, vx vy vz [m/s], wx wy wz [rad/s]."""
        motion = self.body(body)
        columns = {}
        for channel, names in _CHANNELS.items():
            values = getattr(motion, channel)
            if values is not None:
                columns.update({name: values[:, i] for i, name in enumerate(names)})
        return pd.DataFrame(columns, index=pd.Index(self.time, name="time"))

    def position_error(self, body: str) -> Array:
        """Distance of a body from its exact place at each frame [m]. Raises NoSuchCase where the reference has none."""
        found, exact = self.body(body).position, self.reference.get(body, Motion(body)).position
        if found is None or exact is None:
            raise NoSuchCase(f"the reference of {self.scenario} does not know where body '{body}' is")
        return np.asarray(np.linalg.norm(found - exact, axis=1))

    def contacts_at(self, frame: int) -> npt.NDArray[Any]:
        """Contacts of the step that begins, or ends, at a frame; empty for frames whose contacts are not stored."""
        chosen: npt.NDArray[Any] = self.contacts[self.contacts["time"] == self.time[frame]]
        return chosen

    def to_xarray(self) -> "xarray.Dataset":
        """The bodies' motion as an xarray Dataset (dimensions time, body, axis, quaternion)."""
        import xarray

        names = [name for name, motion in self.bodies.items() if motion.position is not None]
        data = {}
        for channel in _CHANNELS:
            parts = [getattr(self.bodies[name], channel) for name in names]
            if parts and all(part is not None for part in parts):
                axis = "quaternion" if channel == "orientation" else "axis"
                data[channel] = (("time", "body", axis), np.stack(parts, axis=1), {"units": _UNITS[channel]})
        coordinates = {"time": self.time, "body": names, "axis": list("xyz"), "quaternion": list("wxyz")}
        return xarray.Dataset(data, coords=coordinates, attrs={"scenario": self.scenario, "spec": self.spec, "dt": self.dt})


def read_trajectory(file: Path) -> Trajectory:
    """Reads one trajectory file. Raises DamagedStore, NewerFormat."""
    if not file.is_file():
        raise NoSuchCase(f"'{file}': there is no such trajectory")
    try:
        with h5py.File(file, "r") as h5:
            return _read(h5, file)
    except (OSError, KeyError, ValueError) as error:
        raise DamagedStore(f"'{file}' cannot be read as a trajectory: {error}") from error


def _read(h5: h5py.File, file: Path) -> Trajectory:
    version = int(h5.attrs["rigor_trajectory"])
    if version > NEWEST_TRAJECTORY:
        raise NewerFormat(
            f"'{file}' was written by a newer rigor: found format {version}, expected at most {NEWEST_TRAJECTORY}"
        )
    units = dict(_UNITS, time="s")
    time = h5["time"][()].reshape(-1)
    return Trajectory(
        scenario=_text(h5.attrs["scenario"]),
        spec=_text(h5.attrs["spec"]),
        case_id=_text(h5.attrs["case_id"]),
        dt=float(h5.attrs["dt"]),
        stride=int(h5.attrs["stride"]),
        contact_stride=int(h5.attrs.get("contact_stride", 1)),
        contacts_at_step_end=version > 3,
        time=time,
        bodies=_motions(h5.get("bodies")),
        reference=_motions(h5.get("reference")),
        series=dict(_series(h5.get("series"), units)),
        contacts=_contacts(h5.get("contacts"), units),
        units=units,
    )


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _motions(group: Any) -> dict[str, Motion]:
    if group is None:
        return {}
    bodies = sorted(group.values(), key=lambda body: int(body.attrs.get("index", 0)))
    return {
        _text(body.attrs["name"]): Motion(
            _text(body.attrs["name"]), **{name: body[name][()] for name in _CHANNELS if name in body}
        )
        for body in bodies
    }


def _series(group: Any, units: dict[str, str]) -> Iterator[tuple[tuple[str, str], Array]]:
    data = [(named.attrs["name"], part) for named in (group or {}).values() for part in named.values()]
    for name, part in sorted(data, key=lambda entry: int(entry[1].attrs["index"])):
        units[_text(name)] = _text(part.attrs.get("unit", ""))
        yield (_text(name), _text(part.attrs["subject"])), part[()].reshape(-1)


def _contacts(group: Any, units: dict[str, str]) -> npt.NDArray[Any]:
    if group is None or "time" not in group:
        return np.zeros(0, CONTACT)
    contacts = np.zeros(group["time"].shape[0], CONTACT)
    indices = group["body_a_body_b_shape_a_shape_b"][()]
    for i, name in enumerate(("body_a", "body_b", "shape_a", "shape_b")):
        contacts[name] = indices[:, i]
    for name in ("time", "point_a", "point_b", "normal", "depth", "normal_impulse", "friction_impulse"):
        values = group[name][()]
        contacts[name] = values.reshape(contacts[name].shape)
        units["contacts/" + name] = _text(group[name].attrs.get("unit", ""))
    return contacts
