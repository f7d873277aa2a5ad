"""A world without engine, renderer or file, for tests of formulas without a simulation."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np

from uwsim.base import rng
from uwsim.base.geodesy import Geodetic
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.base.numerics.calls import address_of, function_address
from uwsim.base.numerics.memory import view_doubles
from uwsim.bus import Bus
from uwsim.errors import AssetNotFound, UnknownName
from uwsim.network import Network
from uwsim.optics import Medium
from uwsim.world import (
    Actuators,
    Body,
    BodyMotion,
    Box,
    Camera,
    Contact,
    Flow,
    LineOfSight,
    Rays,
)
from uwsim.world.mounts import MOUNT


def write_pose(parameters: int, values: int, time: float) -> None:
    """Write the pose that the last `FakeBody.prepare` stored."""
    view_doubles(values, 12)[:] = view_doubles(parameters, 12)


def write_motion(parameters: int, values: int, time: float) -> None:
    """Write the motion that the last `FakeBody.prepare` stored."""
    view_doubles(values + 24, 9)[:] = view_doubles(parameters + 96, 9)


class FakeBody:
    """A body at a given pose."""

    is_compiled = False

    def __init__(
        self,
        position: tuple[float, float, float] = (0.0, 0.0, 0.0),
        *,
        name: str = "body",
        rotation: np.ndarray | None = None,
        box: Box | None = None,
    ) -> None:
        self.name, self.box = name, box
        self._pose = Pose(np.array(position, dtype=float), np.eye(3))
        self.motion: Callable[[], BodyMotion] | None = None
        self._numbers = np.zeros(21)
        self.functions = np.zeros(1, MOUNT)
        self.functions["pose"] = function_address(write_pose)
        self.functions["motion"] = function_address(write_motion)
        self.functions["parameters"] = address_of(self._numbers)
        if rotation is not None:
            self.turn(rotation)

    def prepare(self) -> None:
        """Store pose and motion for compiled code."""
        self._numbers[:3], self._numbers[3:12] = self._pose.position, self._pose.rotation.ravel()
        if self.motion is not None:
            motion = self.motion()
            self._numbers[12:] = np.concatenate(
                [motion.velocity, motion.angular_velocity, motion.acceleration]
            )

    @property
    def world_from_body(self) -> Pose:
        return Pose(self._pose.position.copy(), self._pose.rotation.copy())

    def move(self, *position: float) -> None:
        """Set the position of the origin [m]."""
        self._pose = Pose(np.array(position, dtype=float), self._pose.rotation)

    def turn(self, rotation: np.ndarray) -> None:
        """Set the rotation matrix (3, 3)."""
        self._pose = Pose(self._pose.position, np.array(rotation, dtype=float))


class FakeCamera:
    """A pinhole camera along -z of W (x right, y up) without a rotation."""

    def __init__(
        self,
        position: tuple[float, float, float] = (0.0, 0.0, 0.0),
        *,
        name: str = "bowtech1",
        rotation: np.ndarray | None = None,
        intrinsics: Intrinsics | None = None,
        std: float = 0.0,
    ) -> None:
        self.name, self.std = name, std
        self.n_images: int | None = None
        self.intrinsics = intrinsics or Intrinsics.from_fovy(320, 240, np.radians(50.0))
        rotation_matrix = np.eye(3) if rotation is None else np.array(rotation, dtype=float)
        self._pose = Pose(np.array(position, dtype=float), rotation_matrix)

    @property
    def world_from_camera(self) -> Pose:
        return Pose(self._pose.position.copy(), self._pose.rotation.copy())

    def move(self, *position: float) -> None:
        """Set the position of the centre [m]."""
        self._pose = Pose(np.array(position, dtype=float), self._pose.rotation)


class FakeActuators:
    """Thrusters and joints whose electric powers a test sets."""

    def __init__(self, *, thrusters: tuple[str, ...] = (), joints: tuple[str, ...] = ()) -> None:
        self.thrusters, self.joints = thrusters, joints
        self.electric_powers = np.zeros(len(thrusters) + len(joints))  # (n,) [W]

    def powers(self) -> np.ndarray:
        return self.electric_powers.copy()


class FakeStageWater:
    """A `uwsim.world.StageWater`, which stores what updaters set."""

    def __init__(self, medium: Medium | None = None) -> None:
        self.medium = medium
        self.wave_height: float | None = None
        self.settings: list[tuple[Medium, LineOfSight | None]] = []

    def set_medium(self, medium: Medium, *, sight: LineOfSight | None = None) -> None:
        self.settings.append((medium, sight))

    def set_wave_height(self, height: float | None) -> None:
        self.wave_height = height


class FakeWorld:
    """A `uwsim.world.World` and a `uwsim.world.Stage`; time advances only by `advance`.

    Updaters change ``fog``, ``light_rate``, ``camera_noise``, ``joints``, ``current``,
    ``water`` and ``put_backs``. Tests set ``contacts_by_body``, ``forces_by_body`` and
    ``actuators_by_vehicle``.
    """

    def __init__(
        self,
        bodies: Mapping[str, Body] | None = None,
        cameras: Mapping[str, Camera] | None = None,
        *,
        timestep: float = 0.002,
        compatibility: frozenset[str] = frozenset(),
        world_from_localized: Pose | None = None,
        vehicles: tuple[str, ...] = (),
        seed: int = 0,
    ) -> None:
        self.bodies, self.cameras = dict(bodies or {}), dict(cameras or {})
        self.timestep, self.compatibility = timestep, compatibility
        self.world_from_localized = world_from_localized or Pose.identity()
        self.vehicles = vehicles
        self.bus = Bus()
        self.network = Network(self.stream)
        self.fog: float | None = None
        self.fog_colour = (0.0, 0.05, 0.3)
        self.light_rate: float | None = None
        self.camera_noise: float | None = None
        self.water = FakeStageWater()
        self.joints: dict[str, dict[int, float]] = {}
        self.current: Flow | None = None
        self.put_backs: list[tuple[str, float]] = []
        self.contacts_by_body: dict[str, list[Contact]] = {}
        self.forces_by_body: dict[str, dict[str, np.ndarray]] = {}
        self.actuators_by_vehicle: dict[str, Actuators] = {}
        self.twists_by_vehicle: dict[str, np.ndarray] = {}
        self.courses: dict[str, np.ndarray] = {}
        self.joint_positions: dict[str, float] = {}
        self.rays: Rays | None = None
        self.net_holes: dict[str, np.ndarray] = {}
        self._timers: list[tuple[float, Callable[[], None]]] = []
        self._seed = seed

    @property
    def world(self) -> FakeWorld:
        return self

    @property
    def step(self) -> int:
        return self.bus.step

    @property
    def time(self) -> float:
        return self.step * self.timestep

    def advance(self, steps: int = 1) -> None:
        """Advance time, and deliver published messages."""
        for _ in range(steps):
            self.bus.step += 1
            for rate, call in list(self._timers):
                n = math.floor(self.step * rate * self.timestep + 1e-9)
                if math.ceil(n / (rate * self.timestep) - 1e-9) == self.step:
                    call()
            self.bus.deliver()

    @property
    def surroundings(self) -> FakeWorld:
        return self

    def body(self, name: str) -> Body:
        if name not in self.bodies:
            raise UnknownName("body", name, self.bodies)
        return self.bodies[name]

    def joint_position(self, name: str) -> float:
        if name not in self.joint_positions:
            raise UnknownName("object with a joint", name, self.joint_positions)
        return self.joint_positions[name]

    def contacts(self, name: str) -> Sequence[Contact]:
        self.body(name)
        return tuple(self.contacts_by_body.get(name, ()))

    def contact_forces(self, name: str) -> Mapping[str, np.ndarray]:
        self.body(name)
        return self.forces_by_body.get(name, {})

    def twist(self, name: str) -> np.ndarray:
        self.body(name)
        return self.twists_by_vehicle.get(name, np.zeros(6))

    def actuators(self, name: str) -> Actuators | None:
        known_vehicles = {*self.actuators_by_vehicle, *self.vehicles}
        if name not in known_vehicles:
            raise UnknownName("vehicle", name, sorted(known_vehicles))
        return self.actuators_by_vehicle.get(name)

    def course(self, name: str) -> np.ndarray:
        if name not in self.courses:
            raise UnknownName("object with a <u:course>", name, self.courses)
        return self.courses[name]

    def holes(self, name: str) -> np.ndarray:
        if name not in self.net_holes:
            raise UnknownName("object with a <u:net>", name, self.net_holes)
        return self.net_holes[name]

    def camera(self, name: str) -> Camera:
        if name not in self.cameras:
            raise UnknownName("camera", name, self.cameras)
        return self.cameras[name]

    def stream(self, name: str) -> np.random.Generator:
        return rng.stream(self._seed, name)

    def find(self, name: str, *, named_by: str) -> Path:
        path = Path(named_by).parent / name
        if not path.is_file():
            raise AssetNotFound(f"{name!r} is not next to {named_by}.", name=name)
        return path

    @property
    def ned_origin(self) -> Geodetic:
        return Geodetic(latitude=0.0, longitude=0.0)

    def datagrams(self, port: int) -> None:
        return None

    @property
    def connections(self) -> None:
        return None

    def set_fog(self, density: float) -> None:
        self.fog = density

    def set_light_rate(self, rate: float) -> None:
        self.light_rate = rate

    def set_camera_noise(self, std: float | None) -> None:
        self.camera_noise = std

    def set_joints(self, vehicle: str, values: Mapping[int, float]) -> None:
        if vehicle not in self.vehicles:
            raise UnknownName("vehicle", vehicle, self.vehicles)
        self.joints.setdefault(vehicle, {}).update(values)

    def set_current(self, current: Flow | None) -> None:
        self.current = current

    def put_back(self, vehicle: str) -> None:
        if vehicle not in self.vehicles:
            raise UnknownName("vehicle", vehicle, self.vehicles)
        self.put_backs.append((vehicle, self.time))

    def create_timer(self, rate: float, call: Callable[[], None]) -> Callable[[], None]:
        timer = (rate, call)
        self._timers.append(timer)
        return lambda: self._timers.remove(timer)
