"""Directions of cameras in words, and sensors that seem to be mounted as before July 2014."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping

from ...devices.object_picker import ObjectPickerSpec
from ...schema import Diagnostics, uses_extensions
from ...sensors.sensor import Looking, Mounted
from ...sensors.virtual_camera import VirtualCameraSpec
from ...sensors.virtual_range_image import VirtualRangeImageSpec
from ..mounts import MountFrames, in_words
from ..spec import SceneSpec
from ..urdf.robot import RobotSpec
from ..vehicle import VehicleSpec

STEEP = 0.5
"""What looks higher looks up: sine of the angle above the horizon."""


def check_looks(
    scene: SceneSpec, robots: Mapping[int, RobotSpec], diagnostics: Diagnostics
) -> None:
    """Report where the cameras of a scene look.

    Args:
        scene: the scene.
        robots: the robot of each vehicle that has one, by its number in the scene.
        diagnostics: receives the warnings.
    """
    for index, robot in robots.items():
        vehicle = scene.vehicles[index]
        frames = MountFrames(vehicle, robot, scene.world_from_localized)
        for spec in looking(vehicle):
            if spec.look_at is not None and any(spec.orientation):
                message = "its <orientation> is not used: <u:lookAt> says where it looks"
                diagnostics.warning(spec, f"{_called(spec)}: {message}")
            is_camera = isinstance(spec, VirtualCameraSpec | VirtualRangeImageSpec)
            if is_camera and robot.link(spec.relative_to) is not None:
                diagnostics.warning(spec, f"{_called(spec)} {_looks(spec, frames)}")
        if not uses_extensions(scene):
            _check_age(frames, diagnostics)
    cameras = [
        spec
        for index, robot in robots.items()
        for spec in scene.vehicles[index].parts_of(VirtualCameraSpec)
        if robot.link(spec.relative_to) is not None
    ]
    last = {spec.name: spec for spec in cameras}
    for name, count in Counter(spec.name for spec in cameras).items():
        if count > 1:
            message = (
                f"{count} cameras are called {name!r}; interfaces and benchmarks find this one"
            )
            diagnostics.warning(last[name], message)


def looking(vehicle: VehicleSpec) -> Iterator[Looking]:
    """Every part of a vehicle with a viewing direction."""
    return (part for part in vehicle.parts if isinstance(part, Looking))


def _looks(spec: Mounted, frames: MountFrames) -> str:
    ahead, top = frames.looks(spec)
    words = frames.directions
    return f"looks {in_words(ahead, words)}; the top of its image is {in_words(top, words)}"


def _called(spec: Mounted) -> str:
    return repr(str(getattr(spec, "name", "")))


def _check_age(frames: MountFrames, diagnostics: Diagnostics) -> None:
    """Until July 2014 sensors hung on visual frames: those on turned ones may now look up."""
    turned: list[Looking] = []
    n_right = 0
    for spec in looking(frames.vehicle):
        if isinstance(spec, ObjectPickerSpec) or frames.robot.link(spec.relative_to) is None:
            continue
        is_up, was_up = (
            float(frames.looks(spec, visual=visual)[0][2]) > STEEP for visual in (False, True)
        )
        if is_up and not was_up:
            turned.append(spec)
        n_right += was_up and not is_up
    if len(turned) > n_right:
        names = ", ".join(_called(spec) for spec in turned[:5])
        diagnostics.warning(
            turned[0],
            f"looking up from links whose visual frames are turned: {names}. Before July 2014 "
            "sensors hung on visual frames; if this scene is that old, use --compat visual-frames",
        )
