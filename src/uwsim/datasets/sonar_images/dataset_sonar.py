"""The sonar of a data set: an imaging sonar of the scene, which pings from any pose.

Images are polar: row k is the range bin k, the nearest on top, and column 0 is the beam furthest
to port, so that port is left.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Intrinsics, Pose
from ...base.numerics.elementwise import arcsin, arctan2
from ...base.numerics.linear import product
from ...errors import BadSetting
from ...sensors.sonar.imaging_sonar import ImagingSonar
from ...simulation import Simulation
from ..camera import NEAR_PLANE
from ..request import DatasetRequest

ELEMENT = "u:imagingSonar"
MAX_FRAME = 120.0
"""The greatest angle of the rectangle in which targets are placed [deg]."""
FRAME_SIZE = 256
"""The width and height of that rectangle [px]."""
CAMERA_FROM_SONAR = np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]])
"""The rotation from the sonar's axes (x ahead, y to port, z up) to OpenGL axes, (3, 3)."""


@dataclass(frozen=True, eq=False)
class DatasetSonar:
    """An imaging sonar that pings from any pose."""

    sonar: ImagingSonar
    """The sonar of the scene."""

    @property
    def reach(self) -> float:
        """The end of the last range bin [m]."""
        return self.sonar.spec.range

    @property
    def frame(self) -> Intrinsics:
        """A pinhole whose image is the fan, up to `MAX_FRAME`, for the choice of poses."""
        spec = self.sonar.spec
        fx, fy = (
            FRAME_SIZE / (2.0 * math.tan(math.radians(0.5 * min(angle, MAX_FRAME))))
            for angle in (spec.horizontal_aperture, spec.vertical_aperture)
        )
        centre = 0.5 * (FRAME_SIZE - 1)
        return Intrinsics(
            width=FRAME_SIZE,
            height=FRAME_SIZE,
            fx=fx,
            fy=fy,
            cx=centre,
            cy=centre,
            near=NEAR_PLANE,
        )

    def take(self, world_from_sonar: Pose, rng: np.random.Generator) -> npt.NDArray[np.uint8]:
        """Return the polar image of a ping, (bins, beams)."""
        greys = self.sonar.ping_grey(world_from_sonar, int(rng.integers(2**63)))
        return np.ascontiguousarray(greys[:, ::-1])

    def project(self, points: Array) -> Array:
        """Return column and row of points in the sonar's axes (n, 3) [m], (n, 2).

        Points outside of the fan, or beyond the ranges, have NaN.
        """
        spec = self.sonar.spec
        ranges = np.sqrt((points * points).sum(axis=1))
        azimuths = arctan2(points[:, 1], points[:, 0])
        elevations = arcsin(np.clip(points[:, 2] / np.maximum(ranges, 1e-9), -1.0, 1.0))
        half = math.radians(0.5 * spec.horizontal_aperture)
        columns = (half - azimuths) / (2.0 * half) * (spec.beams - 1)
        rows = (ranges - spec.min_range) / self.sonar.echoes.bin_size - 0.5
        pixels: Array = np.stack([columns, rows], axis=1)
        is_inside = (columns >= -0.5) & (columns < spec.beams - 0.5)
        is_inside &= (rows >= -0.5) & (rows < spec.bins - 0.5)
        is_inside &= np.abs(elevations) <= self.sonar.echoes.grid.max_elevation
        pixels[~is_inside] = np.nan
        return pixels

    def describe(self, world_from_sonar: Pose) -> dict[str, Any]:
        """Return the sonar and its pose for a record; axes: x ahead, y to port, z up."""
        spec = self.sonar.spec
        return {
            "name": spec.name,
            "width": spec.beams,
            "height": spec.bins,
            "min_range": spec.min_range,
            "range": spec.range,
            "horizontal_aperture": spec.horizontal_aperture,
            "vertical_aperture": spec.vertical_aperture,
            "frequency": spec.frequency,
            "position": world_from_sonar.position.tolist(),
            "quaternion_wxyz": world_from_sonar.quaternion.tolist(),
        }


def make_sonar(simulation: Simulation, request: DatasetRequest) -> DatasetSonar:
    """Return the sonar of a request.

    Raises:
        UnknownName: the scene has no such imaging sonar.
        BadSetting: the distance of the request is beyond its range.
    """
    sonar = simulation.world.sensors.sensor(request.sonar or "", (ELEMENT,))
    assert isinstance(sonar, ImagingSonar)
    if request.distance is not None and request.distance.high > sonar.spec.range:
        raise BadSetting(
            f"--distance {request.distance.low:g}..{request.distance.high:g}: the sonar "
            f"{request.sonar} reaches {sonar.spec.range:g} m."
        )
    return DatasetSonar(sonar)


def camera_pose_at(world_from_sonar: Pose) -> Pose:
    """Return the pose with OpenGL axes that looks as a sonar does."""
    rotation = product(world_from_sonar.rotation, CAMERA_FROM_SONAR.T)
    return Pose(world_from_sonar.position.copy(), rotation)


def world_from_sonar_at(world_from_camera: Pose) -> Pose:
    """Return the pose of a sonar that looks as a camera with OpenGL axes does."""
    rotation = product(world_from_camera.rotation, CAMERA_FROM_SONAR)
    return Pose(world_from_camera.position, rotation)
