"""Where sensors and lamps point at the start, in words."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..base.geometry import Array, rotation_y, rotation_z
from ..base.numerics.linear import product
from ..devices.lamp import LampSpec
from ..devices.structured_light_projector import StructuredLightProjectorSpec
from ..sensors.dvl_sensor import DvlSensorSpec
from ..sensors.sensor import Looking, Mounted
from ..sensors.sonar.multibeam_sensor import FanSpec
from ..sensors.sonar.side_scan_sonar import SIDES, SideScanSonarSpec
from ..sensors.sonar.spec import SonarSpec
from ..sensors.virtual_camera import VirtualCameraSpec
from ..sensors.virtual_range_image import VirtualRangeImageSpec
from .mounts import MountFrames, in_words
from .vehicle import VehicleSpec


def looking(vehicle: VehicleSpec) -> Iterator[Looking]:
    """Every part of a vehicle with a viewing direction."""
    return (part for part in vehicle.parts if isinstance(part, Looking))


def describe_direction(spec: Mounted, frames: MountFrames) -> str:
    """Describe where a part with a viewing direction points, such as ``looks down, 2 deg off``.

    Raises:
        KeyError: its vehicle has no such link.
    """
    ahead, top = (in_words(axis, frames.directions) for axis in frames.looks(spec))
    axes = frames.world_axes(spec)
    if isinstance(spec, VirtualCameraSpec | VirtualRangeImageSpec):
        return f"looks {ahead}; the top of its image is {top}"
    if isinstance(spec, DvlSensorSpec):
        return f"looks {ahead}; its x axis points {top}"
    if isinstance(spec, FanSpec):
        side = in_words(axes[:, 1], frames.directions)
        return f"looks {ahead}; its positive angles are towards {side}"
    if isinstance(spec, SideScanSonarSpec):
        sides = (in_words(beam, frames.directions) for beam in _side_beams(spec, axes))
        return f"looks {' and '.join(sides)}; its track is {ahead}"
    if isinstance(spec, SonarSpec):
        return f"looks {ahead}; its top is {top}"
    if isinstance(spec, LampSpec | StructuredLightProjectorSpec):
        return f"shines {ahead}"
    return f"looks {ahead}"


def _side_beams(spec: SideScanSonarSpec, axes: Array) -> Iterator[Array]:
    """Directions in W of the middle of the beams of a side-scan, (3,) each."""
    tilted = rotation_y(math.radians(spec.tilt))
    return (product(axes, product(rotation_z(side), tilted))[:, 0] for side in SIDES)
