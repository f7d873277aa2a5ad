"""Descriptions in words of the directions of sensors and lamps at the start of a scene."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..base.geometry import Array, rotation_y, rotation_z
from ..base.numerics.linear import product
from ..devices.lamp import LampSpec
from ..devices.structured_light_projector import StructuredLightProjectorSpec
from ..sensors.dvl_sensor import DvlSensorSpec
from ..sensors.sensor import DirectedPart, MountedPart
from ..sensors.sonar.multibeam_sensor import FanSpec
from ..sensors.sonar.side_scan_sonar import SIDES, SideScanSonarSpec
from ..sensors.sonar.spec import SonarSpec
from ..sensors.virtual_camera import VirtualCameraSpec
from ..sensors.virtual_range_image import VirtualRangeImageSpec
from .mounts import MountFrames, describe_axis
from .vehicle import VehicleSpec


def directional_parts(vehicle: VehicleSpec) -> Iterator[DirectedPart]:
    """Yield every sensor and device of a vehicle that has a viewing direction."""
    return (part for part in vehicle.parts if isinstance(part, DirectedPart))


def describe_direction(spec: MountedPart, frames: MountFrames) -> str:
    """Describe the direction of a part, such as ``looks down, 2 deg off``.

    Raises:
        KeyError: the link of the part does not exist.
    """
    direction, top = (describe_axis(axis, frames.directions) for axis in frames.viewing_axes(spec))
    axes = frames.world_axes(spec)
    if isinstance(spec, VirtualCameraSpec | VirtualRangeImageSpec):
        return f"looks {direction}; the top of its image is {top}"
    if isinstance(spec, DvlSensorSpec):
        return f"looks {direction}; its x axis points {top}"
    if isinstance(spec, FanSpec):
        side = describe_axis(axes[:, 1], frames.directions)
        return f"looks {direction}; its positive angles are towards {side}"
    if isinstance(spec, SideScanSonarSpec):
        sides = (describe_axis(beam, frames.directions) for beam in _side_beams(spec, axes))
        return f"looks {' and '.join(sides)}; its track is {direction}"
    if isinstance(spec, SonarSpec):
        return f"looks {direction}; its top is {top}"
    if isinstance(spec, LampSpec | StructuredLightProjectorSpec):
        return f"shines {direction}"
    return f"looks {direction}"


def _side_beams(spec: SideScanSonarSpec, axes: Array) -> Iterator[Array]:
    """Yield the directions of the beam centres of a side-scan sonar, in W, (3,) each."""
    tilt_rotation = rotation_y(math.radians(spec.tilt))
    return (product(axes, product(rotation_z(side), tilt_rotation))[:, 0] for side in SIDES)
