"""Limits on the sizes of images and fans of beams, which cost memory and time."""

from __future__ import annotations

from collections.abc import Iterator

from ..schema import Diagnostics
from ..sensors.multibeam_sensor import MultibeamSensorSpec
from ..sensors.profiling_sonar import ProfilingSonarSpec
from ..sensors.virtual_camera import VirtualCameraSpec
from ..sensors.virtual_range_image import VirtualRangeImageSpec
from .sim_params import SimParamsSpec
from .spec import SceneSpec

MAX_PIXELS = 7680 * 4320
"""Largest image of a camera [px]: 8K. Drawing it takes about 1 GB."""
MAX_PIXELS_IN_ALL = 4 * MAX_PIXELS
"""Of all cameras of a scene [px]."""
MAX_BEAMS = 100_000
"""Most beams of one sensor."""

ImageSpec = VirtualCameraSpec | VirtualRangeImageSpec | SimParamsSpec


def check_sizes(scene: SceneSpec, diagnostics: Diagnostics) -> None:
    """Report cameras, windows and fans of beams that are too large."""
    n_all = 0
    for image in (scene.sim_params, *_cameras(scene)):
        n = image.resw * image.resh
        if n > MAX_PIXELS:
            diagnostics.error(
                diagnostics.node_of(image),
                f"an image of {image.resw} x {image.resh} pixels; at most "
                f"{MAX_PIXELS / 1e6:.0f} million are drawn",
            )
            continue
        n_all += n
        if n_all > MAX_PIXELS_IN_ALL:
            diagnostics.error(
                diagnostics.node_of(image),
                f"with this one, the images of the scene have {n_all / 1e6:.0f} million pixels; "
                f"at most {MAX_PIXELS_IN_ALL / 1e6:.0f} are drawn",
            )
            break
    for fan in _fans(scene):
        if abs(fan.final_angle - fan.init_angle) >= MAX_BEAMS * fan.angle_incr:
            diagnostics.error(
                diagnostics.node_of(fan),
                f"from {fan.init_angle:g} to {fan.final_angle:g} degrees in steps of "
                f"{fan.angle_incr:g} are more than {MAX_BEAMS} beams",
            )


def _cameras(scene: SceneSpec) -> Iterator[VirtualCameraSpec | VirtualRangeImageSpec]:
    for vehicle in scene.vehicles:
        yield from vehicle.parts_of(VirtualCameraSpec)
        yield from vehicle.parts_of(VirtualRangeImageSpec)


def _fans(scene: SceneSpec) -> Iterator[MultibeamSensorSpec | ProfilingSonarSpec]:
    for vehicle in scene.vehicles:
        yield from vehicle.parts_of(MultibeamSensorSpec)
        yield from vehicle.parts_of(ProfilingSonarSpec)
