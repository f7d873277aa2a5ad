"""A world without engine, renderer or file: what law tests look at instead of a simulation."""

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
from uwsim.world import Actuators, Body, BodyMotion, Box, Camera, Contact, Flow
from uwsim.world.mounts import MOUNT


def place_fixed(parameters: int, values: int, time: float) -> None:
    """Write the frame that `FakeBody.prepare` has written down."""
    view_doubles(values, 12)[:] = view_doubles(parameters, 12)


def move_fixed(parameters: int, values: int, time: float) -> None:
    """Write the motion that `FakeBody.prepare` has written down."""
    view_doubles(values + 24, 9)[:] = view_doubles(parameters + 96, 9)


class FakeBody:
    """A body that stands where it is put."""

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
        self.functions["place"] = function_address(place_fixed)
        self.functions["move"] = function_address(move_fixed)
        self.functions["parameters"] = address_of(self._numbers)
        if rotation is not None:
            self.turn(rotation)

    def prepare(self) -> None:
        """Write down where it is and how it moves, for compiled code."""
        self._numbers[:3], self._numbers[3:12] = self._pose.position, self._pose.rotation.ravel()
        if self.motion is not None:
            moving = self.motion()
            self._numbers[12:] = np.concatenate(
                [moving.velocity, moving.angular_velocity, moving.acceleration]
            )

    @property
    def world_from_body(self) -> Pose:
        return Pose(self._pose.position.copy(), self._pose.rotation.copy())

    def move(self, *position: float) -> None:
        """Put its origin at ``position`` [m]."""
        self._pose = Pose(np.array(position, dtype=float), self._pose.rotation)

    def turn(self, rotation: np.ndarray) -> None:
        """Give it the rotation matrix (3, 3)."""
        self._pose = Pose(self._pose.position, np.array(rotation, dtype=float))


class FakeCamera:
    """A pinhole that looks down -z of W (x right, y up) unless it is turned."""

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
        turned = np.eye(3) if rotation is None else np.array(rotation, dtype=float)
        self._pose = Pose(np.array(position, dtype=float), turned)

    @property
    def world_from_camera(self) -> Pose:
        return Pose(self._pose.position.copy(), self._pose.rotation.copy())

    def move(self, *position: float) -> None:
        """Put its centre at ``position`` [m]."""
        self._pose = Pose(np.array(position, dtype=float), self._pose.rotation)


class FakeActuators:
    """Thrusters and joints that draw what they are told to."""

    def __init__(self, *, thrusters: tuple[str, ...] = (), joints: tuple[str, ...] = ()) -> None:
        self.thrusters, self.joints = thrusters, joints
        self.draws = np.zeros(len(thrusters) + len(joints))  # (n,) [W]

    def powers(self) -> np.ndarray:
        return self.draws.copy()


class FakeWorld:
    """A `uwsim.world.World` and its `uwsim.world.Stage`; time moves only by `advance`.

    What updaters do to it is kept in ``fog``, ``light_rate``, ``camera_noise``, ``joints``,
    ``current`` and ``put_backs``; what touches what stands in ``touching``, with which force in
    ``pressing``, what drives a vehicle in ``driven``.
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
        self.joints: dict[str, dict[int, float]] = {}
        self.current: Flow | None = None
        self.put_backs: list[tuple[str, float]] = []
        self.touching: dict[str, list[Contact]] = {}
        self.pressing: dict[str, dict[str, np.ndarray]] = {}
        self.driven: dict[str, Actuators] = {}
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
        """Let time pass, and deliver what was published."""
        for _ in range(steps):
            self.bus.step += 1
            for rate, call in list(self._timers):
                n = math.floor(self.step * rate * self.timestep + 1e-9)
                if math.ceil(n / (rate * self.timestep) - 1e-9) == self.step:
                    call()
            self.bus.deliver()

    def body(self, name: str) -> Body:
        if name not in self.bodies:
            raise UnknownName("body", name, self.bodies)
        return self.bodies[name]

    def contacts(self, name: str) -> Sequence[Contact]:
        self.body(name)
        return tuple(self.touching.get(name, ()))

    def contact_forces(self, name: str) -> Mapping[str, np.ndarray]:
        self.body(name)
        return self.pressing.get(name, {})

    def actuators(self, name: str) -> Actuators | None:
        known = {*self.driven, *self.vehicles}
        if name not in known:
            raise UnknownName("vehicle", name, sorted(known))
        return self.driven.get(name)

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

    def set_fog(self, density: float) -> None:
        self.fog = density

    def set_light_rate(self, rate: float) -> None:
        self.light_rate = rate

    def set_camera_noise(self, std: float) -> None:
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
