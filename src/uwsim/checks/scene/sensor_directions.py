"""Rules that state the directions of sensors and lamps in words, and rules about cameras."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ...devices.object_picker import ObjectPickerSpec
from ...devices.structured_light_projector import StructuredLightProjectorSpec
from ...errors import Diagnostic
from ...scene.mounts import MountFrames
from ...scene.pointing import describe_direction, directional_parts
from ...schema import NAMESPACE, uses_extensions
from ...sensors.dvl_sensor import DvlSensorSpec
from ...sensors.sensor import DirectedPart, MountedPart
from ...sensors.virtual_camera import VirtualCameraSpec
from ..subjects import CheckedScene

MIN_UPWARD_SINE = 0.5
"""The sine of the elevation of the viewing axis above which a sensor points up [1]."""
POLISHED_IMAGE_COST = "three to four times the time of"
"""The rendering time, measured with a software rasteriser: 16.7 ms instead of 5.4 ms at 320x240,
46 ms instead of 13 ms at 640x480."""


def directions(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report the directions of the sensors and lamps of a scene."""
    for index, robot in scene.robots.items():
        vehicle = scene.placed_scene.vehicles[index]
        frames = MountFrames(vehicle, robot, scene.spec.world_from_localized)
        for spec in directional_parts(vehicle):
            if spec.look_at is not None and any(spec.orientation):
                message = "its <orientation> is not used: <u:lookAt> sets its direction"
                yield scene.warning(spec, f"{_quoted_name(spec)}: {message}")
            is_reported = not isinstance(spec, ObjectPickerSpec | StructuredLightProjectorSpec)
            if is_reported and robot.link(spec.relative_to) is not None:
                message = f"{_quoted_name(spec)} {describe_direction(spec, frames)}"
                yield scene.note(spec, message)
        if not uses_extensions(scene.placed_scene):
            yield from _upward_sensors(scene, frames)


def shared_camera_names(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of several cameras with the same name."""
    cameras = [
        spec
        for index, robot in scene.robots.items()
        for spec in scene.spec.vehicles[index].parts_of(VirtualCameraSpec)
        if robot.link(spec.relative_to) is not None
    ]
    last_specs = {spec.name: spec for spec in cameras}
    for name, count in Counter(spec.name for spec in cameras).items():
        if count > 1:
            message = f"{count} cameras are called {name!r}; interfaces and benchmarks use this one"
            yield scene.warning(last_specs[name], message)


def polished_cameras(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report the cost of polished images."""
    for vehicle in scene.spec.vehicles:
        for camera in vehicle.parts_of(VirtualCameraSpec):
            if camera.quality == "polished":
                message = f"a polished image takes {POLISHED_IMAGE_COST} a plain one"
                element = f"{{{NAMESPACE}}}quality"
                yield scene.warning(camera, f"{_quoted_name(camera)}: {message}", element)


def _quoted_name(spec: MountedPart) -> str:
    return repr(str(getattr(spec, "name", "")))


def _upward_sensors(scene: CheckedScene, frames: MountFrames) -> Iterator[Diagnostic]:
    """Warn of sensors that point up, as their file is for visual frames (used until July 2014)."""
    upward_specs: list[DirectedPart] = []
    n_downward = 0
    for spec in directional_parts(frames.vehicle):
        if (
            isinstance(spec, ObjectPickerSpec | DvlSensorSpec)
            or frames.robot.link(spec.relative_to) is None
        ):
            continue
        is_up, was_up = (
            float(frames.viewing_axes(spec, visual=visual)[0][2]) > MIN_UPWARD_SINE
            for visual in (False, True)
        )
        if is_up and not was_up:
            upward_specs.append(spec)
        n_downward += was_up and not is_up
    if len(upward_specs) > n_downward:
        names = ", ".join(_quoted_name(spec) for spec in upward_specs[:5])
        yield scene.warning(
            upward_specs[0],
            f"sensors look up from links whose visual frames are rotated: {names}. Before July "
            "2014 sensors were mounted on visual frames. For such a scene use "
            "--compat visual-frames",
        )
