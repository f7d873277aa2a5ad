"""Limits on numbers of pixels, beams, rays and waves; order of clipping planes; sea settings."""

from __future__ import annotations

from collections.abc import Iterator

from ..schema import NAMESPACE, Diagnostics, line_of
from ..sensors.sonar.multibeam_sensor import MultibeamSensorSpec
from ..sensors.sonar.profiling_sonar import ProfilingSonarSpec
from ..sensors.sonar.spec import SonarSpec
from ..sensors.virtual_camera import VirtualCameraSpec
from ..sensors.virtual_range_image import VirtualRangeImageSpec
from ..waves import find_sea_errors
from .object import ObjectSpec
from .physical_water import PhysicalWaterSpec
from .spec import SceneSpec

MAX_PIXELS = 7680 * 4320
"""The greatest number of pixels of a camera image: 8K. Rendering it needs about 1 GB of memory."""
MAX_TOTAL_PIXELS = 4 * MAX_PIXELS
"""The greatest number of pixels of all cameras of a scene together."""
MAX_BEAMS = 100_000
"""The greatest number of beams of a multibeam or profiling sonar."""
MAX_BINS = 20_000_000
"""The greatest number of range bins in all beams, or stored pings, of a sonar: 80 MB of memory."""
MAX_RAYS = 1_000_000
"""The greatest number of rays that a sonar casts for one ping."""


def check_sizes(scene: SceneSpec, diagnostics: Diagnostics) -> None:
    """Report sensors that exceed these limits, empty ranges, and seas that waves cannot have."""
    ocean = scene.ocean_state
    for message in find_sea_errors(ocean.waves, ocean.sea):
        element = message.partition(">")[0].removeprefix("<")
        tag = element.replace("u:", f"{{{NAMESPACE}}}")
        diagnostics.error(line_of(ocean, tag), message)
    for force in scene.forces:
        for error in force.errors():
            diagnostics.error(force, error)
    for item in scene.objects:
        for error in () if item.course is None else item.course.errors():
            diagnostics.error(item.course, error)
        if item.course is not None and item.physics is not None and item.physics.is_loose:
            diagnostics.error(item.course, "<u:course> is fixed; remove <physics>, or its mass")
        check_joint(scene, item, diagnostics)
        for error in () if item.net is None else item.net.errors():
            diagnostics.error(item.net, error)
        if item.net is not None and item.course is not None:
            diagnostics.error(item.net, "<u:net> and <u:course> are both given; remove one of them")
        if item.course is not None and item.dock is not None:
            diagnostics.error(item.dock, "an object has a <u:course> or a <u:dock>, not both")
        for error in item.chart_errors():
            diagnostics.error(item.bathymetry, error)
    n_total = 0
    for image in _cameras(scene):
        if error := find_size_error(image.resw, image.resh, ocean.water):
            diagnostics.error(image, error)
            continue
        n_total += _count_pixels(image.resw, image.resh, ocean.water)
        if n_total > MAX_TOTAL_PIXELS:
            diagnostics.error(
                image,
                f"with this one, the images of the scene have {n_total / 1e6:.0f} million pixels; "
                f"expected at most {MAX_TOTAL_PIXELS / 1e6:.0f}",
            )
            break
    for camera in _cameras(scene):
        planes = camera.parameters
        if planes is not None and planes.f <= planes.n:
            diagnostics.error(
                planes,
                f"the far plane <f> is {planes.f:g} m and the near plane <n> {planes.n:g} m; "
                "expected the far one beyond the near one",
            )
        if isinstance(camera, VirtualCameraSpec) and camera.resw * camera.resh <= MAX_PIXELS:
            for part, error in camera.find_errors():
                diagnostics.error(part, error)
    for fan in _fans(scene):
        if abs(fan.final_angle - fan.init_angle) >= MAX_BEAMS * fan.angle_incr:
            diagnostics.error(
                fan,
                f"from {fan.init_angle:g} to {fan.final_angle:g} degrees in steps of "
                f"{fan.angle_incr:g} are too many beams; expected at most {MAX_BEAMS}",
            )
    for sonar in (
        sonar_spec for vehicle in scene.vehicles for sonar_spec in vehicle.parts_of(SonarSpec)
    ):
        for error in _sonar_errors(sonar):
            diagnostics.error(sonar, error)


def find_size_error(width: int, height: int, water: PhysicalWaterSpec | None) -> str:
    """Describe an image of too many pixels, those of its margin included; empty if it has not.

    Args:
        width: the width of the image [px].
        height: the height of the image [px].
        water: the physical water of the scene; None if it has the fog law.
    """
    n_pixels = _count_pixels(width, height, water)
    if n_pixels <= MAX_PIXELS:
        return ""
    has_margin = water is not None and water.blur_margin > 0.0
    margin = f", {n_pixels / 1e6:.1f} million with <u:blurMargin>" if has_margin else ""
    return (
        f"an image of {width} x {height} pixels{margin}; expected at most "
        f"{MAX_PIXELS / 1e6:.0f} million"
    )


def _count_pixels(width: int, height: int, water: PhysicalWaterSpec | None) -> int:
    scale = 1.0 if water is None else 1.0 + 2.0 * water.blur_margin
    return round(width * height * scale * scale)


def _sonar_errors(sonar: SonarSpec) -> Iterator[str]:
    if sonar.min_range >= sonar.range:
        yield f"<minRange> is {sonar.min_range:g}; expected less than <range>, {sonar.range:g} m"
    if sonar.n_cells > MAX_BINS:
        yield (
            f"{sonar.bins} bins of {sonar.n_cells // sonar.bins} beams or pings; expected at most "
            f"{MAX_BINS / 1e6:.0f} million in all"
        )
    if sonar.n_rays > MAX_RAYS:
        yield (
            f"{sonar.n_rays // sonar.rows} columns of {sonar.rows} rays; expected at most "
            f"{MAX_RAYS / 1e6:.0f} million rays in a ping"
        )


def check_joint(scene: SceneSpec, item: ObjectSpec, diagnostics: Diagnostics) -> None:
    """Report a joint that is invalid, or that nothing can move."""
    joint = item.joint
    if joint is None:
        return
    for error in joint.errors():
        diagnostics.error(joint, error)
    if item.hinge is not None and item.slide is not None:
        diagnostics.error(joint, "the object has a <u:hinge>, too; expected one joint")
    if item.physics is None or not item.physics.is_loose or item.is_solid is False:
        diagnostics.error(joint, "the object is fixed; expected <physics> with a <mass> above 0")
    if not scene.is_dynamic:
        diagnostics.error(joint, "nothing moves the joint; expected a vehicle with <u:dynamics>")


def _cameras(scene: SceneSpec) -> Iterator[VirtualCameraSpec | VirtualRangeImageSpec]:
    for vehicle in scene.vehicles:
        yield from vehicle.parts_of(VirtualCameraSpec)
        yield from vehicle.parts_of(VirtualRangeImageSpec)


def _fans(scene: SceneSpec) -> Iterator[MultibeamSensorSpec | ProfilingSonarSpec]:
    for vehicle in scene.vehicles:
        yield from vehicle.parts_of(MultibeamSensorSpec)
        yield from vehicle.parts_of(ProfilingSonarSpec)
