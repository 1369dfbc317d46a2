# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Types of the engine's module. What each does, with units and frames: help(rigor.World).
from typing import Any, Iterator, Literal, Mapping, Optional, Sequence, Union, overload

import numpy as np
import numpy.typing as npt

Key = Union[int, str]
Array = npt.NDArray[Any]

class EngineError(ValueError):
    id: str

class Shape:
    @property
    def kind(self) -> str: ...
    @staticmethod
    def sphere(radius: float) -> Shape: ...
    @staticmethod
    def box(half_extents: npt.ArrayLike) -> Shape: ...
    @staticmethod
    def capsule(radius: float, half_length: float) -> Shape: ...
    @staticmethod
    def cylinder(radius: float, half_length: float) -> Shape: ...
    @staticmethod
    def cone(radius: float, half_length: float) -> Shape: ...
    @staticmethod
    def ellipsoid(half_axes: npt.ArrayLike) -> Shape: ...
    @staticmethod
    def half_space(normal: npt.ArrayLike, offset: float = 0.0) -> Shape: ...
    @staticmethod
    def hull(points: npt.ArrayLike) -> Shape: ...
    @staticmethod
    def segment(a: npt.ArrayLike, b: npt.ArrayLike) -> Shape: ...
    @staticmethod
    def chain(points: npt.ArrayLike, loop: bool = False) -> Shape: ...
    @staticmethod
    def triangle_mesh(vertices: npt.ArrayLike, triangles: Sequence[Sequence[int]]) -> Shape: ...
    @staticmethod
    def height_field(
        heights: npt.ArrayLike, spacing_x: float, spacing_z: float, thickness: float = 1.0
    ) -> Shape: ...

class JointAxis:
    mode: str
    lower: float
    upper: float
    motor_speed: float
    motor_max_force: float
    target: float
    frequency: float
    damping_ratio: float
    stiffness: float
    damping: float
    def __init__(
        self,
        mode: Literal["usual", "free", "locked", "limited"] = "usual",
        *,
        lower: float = ...,
        upper: float = ...,
        motor_speed: float = 0.0,
        motor_max_force: float = 0.0,
        target: float = 0.0,
        frequency: float = 0.0,
        damping_ratio: float = 0.0,
        stiffness: float = 0.0,
        damping: float = 0.0,
    ) -> None: ...

class World:
    dt: float
    gravity: Array
    states: Array
    @overload
    def __init__(
        self,
        dimension: int = 3,
        *,
        precision: Literal["f32", "f64"] = "f64",
        preset: str = "default",
        gravity: Optional[npt.ArrayLike] = None,
        dt: float = ...,
        settings: Mapping[str, Any] = ...,
    ) -> None: ...
    @overload
    def __init__(
        self,
        scenario: Union[str, dict[str, Any]],
        spec: str = "rigor",
        *,
        dt: Optional[float] = None,
        set: dict[str, Any] = ...,
    ) -> None: ...
    @property
    def dimension(self) -> int: ...
    @property
    def precision(self) -> str: ...
    @property
    def settings(self) -> dict[str, Any]: ...
    @property
    def time(self) -> float: ...
    @property
    def bodies(self) -> list[str]: ...
    @property
    def joints(self) -> list[str]: ...
    @property
    def materials(self) -> list[str]: ...
    @property
    def contacts(self) -> Array: ...
    @property
    def events(self) -> list[dict[str, Any]]: ...
    @property
    def last_step(self) -> dict[str, Any]: ...
    def add_material(
        self,
        friction: float,
        restitution: float = 0.0,
        *,
        static_friction: float = 0.0,
        rolling_friction: float = 0.0,
        torsional_friction: float = 0.0,
        name: str = "",
    ) -> int: ...
    def set_pair(
        self,
        a: Key,
        b: Key,
        friction: float,
        restitution: float = 0.0,
        *,
        static_friction: float = 0.0,
        rolling_friction: float = 0.0,
        torsional_friction: float = 0.0,
    ) -> None: ...
    def add_body(
        self,
        *,
        name: str = "",
        type: Literal["dynamic", "static", "kinematic"] = "dynamic",
        position: Optional[npt.ArrayLike] = None,
        orientation: Optional[npt.ArrayLike] = None,
        velocity: Optional[npt.ArrayLike] = None,
        angular_velocity: Optional[npt.ArrayLike] = None,
        mass: float = 0.0,
        center_of_mass: Optional[npt.ArrayLike] = None,
        inertia: Optional[npt.ArrayLike] = None,
        linear_velocity_kept: float = 1.0,
        angular_velocity_kept: float = 1.0,
        gravity_scale: float = 1.0,
        collides: bool = True,
        continuous: Optional[bool] = None,
    ) -> int: ...
    def add_shape(
        self,
        body: Key,
        shape: Shape,
        *,
        position: Optional[npt.ArrayLike] = None,
        orientation: Optional[npt.ArrayLike] = None,
        material: Key = 1,
        density: float = 1000.0,
        sensor: bool = False,
        surface_velocity: Optional[npt.ArrayLike] = None,
        surface_angular_velocity: Optional[npt.ArrayLike] = None,
        layers: int = 1,
        mask: int = 0xFFFFFFFF,
        group: int = 0,
    ) -> int: ...
    def add_joint(
        self,
        type: str,
        body_a: Optional[Key],
        body_b: Optional[Key],
        *,
        anchor_a: Optional[npt.ArrayLike] = None,
        anchor_b: Optional[npt.ArrayLike] = None,
        axis_a: Optional[npt.ArrayLike] = None,
        axis_b: Optional[npt.ArrayLike] = None,
        spin_axis_b: Optional[npt.ArrayLike] = None,
        normal_a: Optional[npt.ArrayLike] = None,
        length: float = 0.0,
        collide_connected: bool = False,
        axes: Sequence[JointAxis] = (),
        break_force: float = ...,
        break_torque: float = ...,
        name: str = "",
    ) -> int: ...
    def add_constant_force(
        self,
        body: Key,
        force: npt.ArrayLike,
        torque: Optional[npt.ArrayLike] = None,
        *,
        start: float = 0.0,
        end: float = ...,
    ) -> None: ...
    def add_drag(self, body: Key, *, linear: float = 0.0, quadratic: float = 0.0) -> None: ...
    def add_spring(
        self,
        body_a: Optional[Key],
        body_b: Optional[Key],
        *,
        anchor_a: Optional[npt.ArrayLike] = None,
        anchor_b: Optional[npt.ArrayLike] = None,
        stiffness: float,
        damping: float = 0.0,
        length: float = 0.0,
    ) -> None: ...
    def step(self, steps: int = 1, *, dt: Optional[float] = None) -> None: ...
    def apply_force(self, body: Key, force: npt.ArrayLike, torque: Optional[npt.ArrayLike] = None) -> None: ...
    def apply_impulse(
        self, body: Key, impulse: npt.ArrayLike, angular_impulse: Optional[npt.ArrayLike] = None
    ) -> None: ...
    def apply_wrenches(self, wrenches: npt.ArrayLike) -> None: ...
    def set_pose(self, body: Key, position: npt.ArrayLike, orientation: Optional[npt.ArrayLike] = None) -> None: ...
    def set_velocity(
        self, body: Key, velocity: npt.ArrayLike, angular_velocity: Optional[npt.ArrayLike] = None
    ) -> None: ...
    def index(self, body: Key) -> int: ...
    def body(self, body: Key) -> dict[str, Any]: ...
    def energy(self) -> float: ...
    def state_hash(self) -> int: ...
    def joint_holds(self, joint: Key) -> bool: ...
    def joint_coordinate(self, joint: Key, axis: int = 0) -> float: ...
    def joint_speed(self, joint: Key, axis: int = 0) -> float: ...
    def joint_force(self, joint: Key) -> Array: ...
    def joint_torque(self, joint: Key) -> Any: ...
    def set_joint_axis(self, joint: Key, axis: int, control: JointAxis) -> None: ...
    def set_joint_motor(self, joint: Key, axis: int, speed: float, max_force: float) -> None: ...
    def set_joint_target(self, joint: Key, axis: int, target: float) -> None: ...
    def remove_joint(self, joint: Key) -> None: ...
    def cast_ray(self, origin: npt.ArrayLike, translation: npt.ArrayLike) -> Optional[np.void]: ...
    def cast_rays(self, origins: npt.ArrayLike, translations: npt.ArrayLike) -> Array: ...
    def cast_shape(
        self,
        shape: Shape,
        position: npt.ArrayLike,
        translation: npt.ArrayLike,
        orientation: Optional[npt.ArrayLike] = None,
    ) -> Optional[np.void]: ...
    def overlapping(
        self, shape: Shape, position: npt.ArrayLike, orientation: Optional[npt.ArrayLike] = None
    ) -> npt.NDArray[np.int32]: ...
    def nearest(self, point: npt.ArrayLike, within: float) -> Optional[np.void]: ...
    def snapshot(self) -> bytes: ...
    def restore(self, snapshot: bytes) -> None: ...
    def copy(self) -> World: ...
    def __copy__(self) -> World: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> World: ...
    def batch(self, count: int, threads: int = 1) -> WorldBatch: ...

class WorldBatch:
    states: Array
    def __init__(self, worlds: Sequence[World], threads: int = 1) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, index: int) -> World: ...
    def __iter__(self) -> Iterator[World]: ...
    def step(self, steps: int = 1, *, dt: Optional[float] = None) -> bool: ...
    def set_states(self, states: npt.ArrayLike) -> bool: ...
    def apply_wrenches(self, wrenches: npt.ArrayLike) -> bool: ...
    def set_joint_motors(self, joint: Key, axis: int, speeds: npt.ArrayLike, max_force: float) -> bool: ...
    def set_joint_targets(self, joint: Key, axis: int, targets: npt.ArrayLike) -> bool: ...
    def state_hashes(self) -> npt.NDArray[np.uint64]: ...
    def failures(self) -> list[tuple[int, str]]: ...
    def reset(self, worlds: Optional[Sequence[int]] = None) -> None: ...
