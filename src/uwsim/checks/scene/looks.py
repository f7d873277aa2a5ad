"""Directions of sensors and lamps in words; how cameras are called and drawn; old mounts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ...devices.object_picker import ObjectPickerSpec
from ...devices.structured_light_projector import StructuredLightProjectorSpec
from ...errors import Diagnostic
from ...scene.mounts import MountFrames
from ...scene.pointing import describe_direction, looking
from ...schema import NAMESPACE, uses_extensions
from ...sensors.dvl_sensor import DvlSensorSpec
from ...sensors.sensor import Looking, Mounted
from ...sensors.virtual_camera import VirtualCameraSpec
from ..subjects import CheckedScene

STEEP = 0.5
"""What looks higher looks up: sine of the angle above the horizon."""
COST_OF_POLISH = "three to four times the time of"
"""Measured with a software rasteriser: 16.7 ms in place of 5.4 ms at 320x240, 46 in place of 13 ms
at 640x480."""


def directions(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report where the sensors and lamps of a scene point."""
    for index, robot in scene.robots.items():
        vehicle = scene.placed.vehicles[index]
        frames = MountFrames(vehicle, robot, scene.spec.world_from_localized)
        for spec in looking(vehicle):
            if spec.look_at is not None and any(spec.orientation):
                message = "its <orientation> is not used: <u:lookAt> says where it looks"
                yield scene.warning(spec, f"{_called(spec)}: {message}")
            is_reported = not isinstance(spec, ObjectPickerSpec | StructuredLightProjectorSpec)
            if is_reported and robot.link(spec.relative_to) is not None:
                yield scene.warning(spec, f"{_called(spec)} {describe_direction(spec, frames)}")
        if not uses_extensions(scene.placed):
            yield from _turned_sensors(scene, frames)


def shared_camera_names(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of several cameras of one name."""
    cameras = [
        spec
        for index, robot in scene.robots.items()
        for spec in scene.spec.vehicles[index].parts_of(VirtualCameraSpec)
        if robot.link(spec.relative_to) is not None
    ]
    last = {spec.name: spec for spec in cameras}
    for name, count in Counter(spec.name for spec in cameras).items():
        if count > 1:
            message = (
                f"{count} cameras are called {name!r}; interfaces and benchmarks find this one"
            )
            yield scene.warning(last[name], message)


def polished_cameras(scene: CheckedScene) -> Iterator[Diagnostic]:
    """State what polished images cost."""
    for vehicle in scene.spec.vehicles:
        for camera in vehicle.parts_of(VirtualCameraSpec):
            if camera.quality == "polished":
                message = f"{_called(camera)}: a polished image takes {COST_OF_POLISH} a plain one"
                yield scene.warning(camera, message, f"{{{NAMESPACE}}}quality")


def _called(spec: Mounted) -> str:
    return repr(str(getattr(spec, "name", "")))


def _turned_sensors(scene: CheckedScene, frames: MountFrames) -> Iterator[Diagnostic]:
    """Until July 2014 sensors hung on visual frames: those on turned ones may now look up."""
    turned: list[Looking] = []
    n_right = 0
    for spec in looking(frames.vehicle):
        if (
            isinstance(spec, ObjectPickerSpec | DvlSensorSpec)
            or frames.robot.link(spec.relative_to) is None
        ):
            continue
        is_up, was_up = (
            float(frames.looks(spec, visual=visual)[0][2]) > STEEP for visual in (False, True)
        )
        if is_up and not was_up:
            turned.append(spec)
        n_right += was_up and not is_up
    if len(turned) > n_right:
        names = ", ".join(_called(spec) for spec in turned[:5])
        yield scene.warning(
            turned[0],
            f"looking up from links whose visual frames are turned: {names}. Before July 2014 "
            "sensors hung on visual frames; if this scene is that old, use --compat visual-frames",
        )
