"""A world of triangles for sonars, without scene file and engine."""

from __future__ import annotations

import numpy as np

from tests.support.fakes import FakeBody
from uwsim.acoustics import MATERIALS, Material, SeaWater
from uwsim.base import rng
from uwsim.base.geodesy import Geodetic
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.rays import RayScene, Surface
from uwsim.sensors.pinhole import cast_depth
from uwsim.world import BodyMotion, WaterSurface

WORLD_FROM_NED = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
"""W is east, north, up."""


class Materials(RayScene):
    """Triangles, each set of them of one material."""

    def __init__(self, sets: list[np.ndarray], materials: list[Material] | None = None) -> None:
        super().__init__([[Surface(i, triangles) for i, triangles in enumerate(sets)]])
        self.vehicles = tuple("" for _ in sets)
        self.materials = tuple(materials or [MATERIALS["sand"]] * len(sets))


class AcousticWorld:
    """What a sonar sees of the world."""

    def __init__(
        self, *sets: np.ndarray, materials: list[Material] | None = None, seed: int = 0,
        surface_height: float = 100.0, compatibility: frozenset[str] = frozenset(),
    ) -> None:  # fmt: skip
        self.rays = Materials(list(sets), materials)
        self.sea_water = SeaWater()
        self.surface = WaterSurface(surface_height)
        self.compatibility = compatibility
        self.seed = seed
        self.world_from_localized = Pose(np.zeros(3), WORLD_FROM_NED)
        self.density_levels: tuple[tuple[float, float], ...] = ((0.0, 1000.0),)
        self.earth_origin: Geodetic | None = None
        self.current = np.zeros(3)

    def compiled_water(self, vehicle: str, n: int) -> None:
        return None

    def water_velocity(self, points: np.ndarray, time: float, vehicle: str) -> np.ndarray:
        return np.tile(self.current, (len(points), 1))

    def stream(self, name: str) -> np.random.Generator:
        return rng.stream(self.seed, name)

    def depth(self, world_from_camera: Pose, intrinsics: Intrinsics) -> np.ndarray:
        return cast_depth(self.rays, world_from_camera, intrinsics)


class FakeCarrier:
    """A vehicle in the origin of W, or where it is put: mounts stand where their spec says."""

    name = "vehicle"

    def __init__(self, pose: Pose | None = None) -> None:
        self.pose = pose or Pose.identity()
        self.compiled_vehicle = self

    def base_mount(self) -> FakeBody:
        return FakeBody(tuple(self.pose.position), rotation=self.pose.rotation)

    def mount(self, spec: object, *, visual: bool = False) -> FakeBody:
        here = self.pose @ Pose.from_rpy(spec.position, spec.orientation)  # type: ignore[attr-defined]
        return FakeBody(tuple(here.position), rotation=here.rotation)  # type: ignore[arg-type]


class MovingCarrier(FakeCarrier):
    """A vehicle whose mounts move at these velocities of W, whatever their place."""

    def __init__(self, pose: Pose, velocity: tuple[float, float, float]) -> None:
        super().__init__(pose)
        self.velocity = np.array(velocity)

    def moving_mount(self, spec: object) -> FakeBody:
        body = self.mount(spec)
        moving = BodyMotion(self.velocity, np.zeros(3), np.zeros(3))
        body.motion = lambda: moving
        return body


def plate(half: float, height: float) -> np.ndarray:
    """A level square around the z axis that looks up, (2, 3, 3) [m]."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float) * half
    corners[:, 2] = height
    return corners[[[0, 1, 2], [0, 2, 3]]]


def box(lower: tuple[float, float, float], upper: tuple[float, float, float]) -> np.ndarray:
    """A box, (12, 3, 3) [m]."""
    low, high = np.array(lower), np.array(upper)
    unit = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)])
    faces = np.array(
        [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
         [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]]
    )  # fmt: skip
    return (low + (high - low) * unit)[faces]


def sphere(centre: tuple[float, float, float], radius: float, n: int = 96) -> np.ndarray:
    """A ball of 2 n (n - 1) triangles, (m, 3, 3) [m]."""
    turn = np.linspace(0.0, 2.0 * np.pi, 2 * n + 1)[:-1]
    lean = np.linspace(0.0, np.pi, n + 1)
    t, e = np.meshgrid(turn, lean, indexing="ij")
    points = np.stack([np.sin(e) * np.cos(t), np.sin(e) * np.sin(t), np.cos(e)], axis=2)
    following = np.roll(points, -1, axis=0)
    a, b, c, d = points[:, :-1], points[:, 1:], following[:, 1:], following[:, :-1]
    faces = [np.stack(each, axis=2).reshape(-1, 3, 3) for each in ((a, b, c), (a, c, d))]
    found: np.ndarray = np.array(centre) + radius * np.concatenate(faces)
    return found
