"""The clouds of sediment of a running scene, which thrusters stir up."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.linear import rotate_rows
from ...model.scene_model import SceneModel
from ...particles.draws import draw_uniforms
from ...particles.jet import WIDTH, Jet
from ...particles.puffs import BIRTH, MASS, NUMBER, VARIANCE, Puffs, X, Z
from ...particles.sediment import SedimentSpec
from ...physics.engine import Engine
from ...rendering.physical.visible_particles import LUMP, VisibleClouds
from .scene_rays import SceneRays

UPDATE_RATE = 4.0
"""The rate at which the thrusters erode the floor, and puffs are born [Hz]."""
MAX_HEIGHT = 6.0
"""The greatest height above the floor at which thrusters stir it [m]."""
MIN_THRUST = 0.5
"""The thrust below which a thruster stirs nothing [N]."""
N_LUMPS = 6
"""The number of lumps in which a puff is drawn."""
LUMP_WIDTH = 0.42
"""The width of a lump over that of its puff [1]; the places of the lumps make up the rest."""
BIRTH_TIME = 0.5
"""The time over which a new puff appears in images [s]."""
MAX_REACH = 40.0
"""The distance of a puff from the camera beyond which it is not drawn [m]."""
MAX_OWN_HITS = 64
"""The largest number of a vehicle's own surfaces through which the floor is sought."""
OUTFLOW = 0.5
"""The speed of a new puff along the floor over that of the jet there [1]."""


@dataclass(frozen=True, kw_only=True)
class FloorJet:
    """A jet that reaches the floor."""

    contact: Array
    """The place on the floor where it is fastest, in W, (3,) [m]."""
    speed: float
    """The speed there [m/s]."""
    width: float
    """The radius of the disc that erodes [m]."""
    direction: Array
    """The direction of the jet in W, (3,)."""


class SceneSediment:
    """The clouds of sediment of a scene.

    Args:
        model: the compiled scene.
        spec: the ``<u:sediment>`` element.
        key: the key of the random numbers.
    """

    def __init__(self, model: SceneModel, spec: SedimentSpec, key: int) -> None:
        self._model = model
        self.spec = spec
        """The element of the scene file."""
        self.key = np.uint64(key)
        """The key of the random numbers."""
        self.puffs = Puffs(spec)
        """The puffs of sediment."""

    def stir(self, engine: Engine, rays: SceneRays, time: float, water_velocity: Array) -> None:
        """Move the puffs to a time, and add those of the thrusters in one period.

        Args:
            engine: the engine, which knows the thrusts and poses.
            rays: the rays that find the floor.
            time: the time [s].
            water_velocity: the velocity of the water in W, (3,) [m/s].
        """
        self.puffs.advance(time, water_velocity)
        for index, vehicle in enumerate(self._model.scene.vehicles):
            if engine.has_dynamics(index):
                for jet in self._find_jets(engine, rays, index, vehicle.name):
                    self._erode(jet)

    def _find_jets(
        self, engine: Engine, rays: SceneRays, index: int, name: str
    ) -> Iterator[FloorJet]:
        """Yield the jets of a vehicle that reach the floor."""
        places, axes, thrusts = engine.actuation[index].measure_thrusts()
        if not (np.abs(thrusts) > MIN_THRUST).any():
            return
        floor = _find_floor(rays, engine.poses.vehicle(index).position, name)
        if floor is None:
            return
        specs = self._model.dynamics[index].thrusters
        for place, axis, thrust, spec in zip(places, axes, thrusts.tolist(), specs, strict=True):
            height = float(place[2]) - floor
            if abs(thrust) <= MIN_THRUST or height <= 0.05:
                continue
            direction = -math.copysign(1.0, thrust) * axis
            jet = Jet(thrust=abs(thrust), diameter=2.0 * spec.radius)
            distance, speed = jet.find_floor_contact(height, float(direction[2]))
            contact = place + distance * direction
            contact[2] = floor
            yield FloorJet(
                contact=contact, speed=speed, width=WIDTH * distance, direction=direction
            )

    def _erode(self, jet: FloorJet) -> None:
        """Add the puff that a jet erodes in one period."""
        area = math.pi * jet.width**2
        mass = self.spec.compute_erosion(jet.speed) * area / UPDATE_RATE
        if mass <= 0.0:
            return
        numbers = draw_uniforms(self.key, self.puffs.state.n_born, 5).tolist()
        angle = 2.0 * math.pi * numbers[0]
        radial_direction = np.array([math.cos(angle), math.sin(angle), 0.0])
        place = jet.contact + jet.width * math.sqrt(numbers[1]) * radial_direction
        width = max(jet.width * (0.5 + 0.5 * numbers[2]), 0.05)
        place[2] += width
        velocity = OUTFLOW * jet.speed * (0.6 + 0.8 * numbers[3]) * radial_direction
        velocity += jet.speed * np.array([jet.direction[0], jet.direction[1], 0.0])
        velocity[2] = 0.25 * jet.speed * numbers[4]
        self.puffs.add(place, width, mass, velocity, float(jet.contact[2]))

    def find_visible(
        self, world_from_camera: Pose, time: float, water_velocity: Array
    ) -> VisibleClouds | None:
        """Return the clouds before a camera at a time [s]; None if there are none."""
        puffs = self.puffs.predict(time, water_velocity)
        if not len(puffs):
            return None
        widths = np.sqrt(puffs[:, VARIANCE])
        ages = np.maximum(time - puffs[:, BIRTH], 0.0)
        offsets = np.array([self._draw_offsets(int(n)) for n in puffs[:, NUMBER].tolist()])
        centres = puffs[:, None, X : Z + 1] + widths[:, None, None] * offsets
        places = rotate_rows(
            world_from_camera.rotation.T, centres.reshape(-1, 3) - world_from_camera.position
        )
        lump_widths = np.repeat(LUMP_WIDTH * widths, N_LUMPS)
        masses = np.repeat(puffs[:, MASS] * np.minimum(ages / BIRTH_TIME, 1.0) / N_LUMPS, N_LUMPS)
        depths = self.spec.scattering * masses / (2.0 * math.pi * lump_widths**2)
        ranges = np.sqrt((places * places).sum(axis=1))
        is_visible = (places[:, 2] < 3.0 * lump_widths) & (ranges < MAX_REACH) & (depths > 1e-4)
        if not is_visible.any():
            return None
        lumps = np.zeros(int(np.count_nonzero(is_visible)), LUMP)
        lumps["place"][:, :3] = places[is_visible]
        lumps["place"][:, 3] = lump_widths[is_visible]
        lumps["depth"] = depths[is_visible]
        return VisibleClouds(lumps, self.spec.color)

    def _draw_offsets(self, number: int) -> Array:
        """Draw the places of the lumps of a puff, in its widths, (`N_LUMPS`, 3).

        Their mean is 0, and their variance along each axis is 1 - `LUMP_WIDTH`^2 on the average.
        """
        numbers = draw_uniforms(self.key, number, 5 + 3 * N_LUMPS)[5:].reshape(-1, 3)
        offsets = numbers - numbers.mean(axis=0)
        scale = math.sqrt(12.0 * (1.0 - LUMP_WIDTH**2) * N_LUMPS / (N_LUMPS - 1))
        result: Array = scale * offsets
        return result


def _find_floor(rays: SceneRays, position: Array, vehicle: str) -> float | None:
    """Return the height of the floor below a point of a vehicle in W [m]; None without a floor."""
    down, start = np.array([[0.0, 0.0, -1.0]]), position.copy()
    for _ in range(MAX_OWN_HITS):
        hits = rays.cast(Pose(start, np.eye(3)), down, MAX_HEIGHT)
        surface, distance = int(hits.surface[0]), float(hits.distance[0])
        if surface < 0:
            return None
        if rays.vehicles[surface] != vehicle:
            return float(start[2]) - distance
        start[2] -= distance + 1e-3
    return None
