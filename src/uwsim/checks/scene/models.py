"""Checks that the models and images that a scene names are there and can be read."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

from ... import assets
from ...assets.packages import strip_file_scheme
from ...devices.structured_light_projector import StructuredLightProjectorSpec
from ...errors import AssetError, Diagnostic
from ...model.parts import comms_devices
from ..robot_search import MAX_FILES
from ..subjects import CheckedScene


def model_files(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report models of objects and devices that are not found or cannot be read."""
    first: dict[str, object] = {}
    for device in (each for vehicle in scene.spec.vehicles for each in comms_devices(vehicle)):
        if device.mesh is not None:
            first.setdefault(device.mesh.path, device.mesh)
    for thing in scene.spec.objects:
        first.setdefault(thing.file, thing)
        if thing.physics is not None and thing.physics.collision_shape:
            first.setdefault(thing.physics.collision_shape, thing)
    for name, spec in itertools.islice(first.items(), MAX_FILES):
        if why := assets.model_read_error(name, **scene.where):
            yield scene.error(spec, why)
        elif not assets.has_model(name, **scene.where):
            yield _lost(
                scene,
                spec,
                f"model {strip_file_scheme(name)!r} is nowhere and has no stand-in",
                name,
            )
        elif remark := assets.model_location_remark(name, **scene.where):
            yield scene.warning(spec, remark)
        for said in assets.model_remarks(name, **scene.where):
            yield scene.warning(spec, said)


def projectors(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report projectors that shine nothing: of several the last shines, if its image is there."""
    projectors = [
        projector
        for vehicle in scene.spec.vehicles
        if not vehicle.vr
        for projector in vehicle.parts_of(StructuredLightProjectorSpec)
    ]
    for projector in projectors[:-1]:
        message = f"projector {projector.name!r} shines nothing: of several only the last shines"
        yield scene.warning(projector, message)
    for projector in projectors[-1:]:
        image = projector.image_name
        try:
            path = assets.find(image, **scene.where)
        except AssetError as error:
            yield scene.error(projector, str(error))
            continue
        if path is None:
            so = f"projector {projector.name!r} shines nothing"
            yield _lost(
                scene, projector, f"image {strip_file_scheme(image)!r} is nowhere and {so}", image
            )
        elif remark := assets.location_remark(image, path, **scene.where):
            yield scene.warning(projector, remark)


def _lost(scene: CheckedScene, place: object, message: str, name: str) -> Diagnostic:
    """Report a missing file: an error, but in a scene of the original a warning.

    The archive with the original's models is no longer to be had, so that a scene with the
    original's DOCTYPE is not at error for naming what lay in it.
    """
    report = scene.warning if scene.spec.is_original else scene.error
    return report(place, f"{message}; {assets.describe_search(name, **scene.where)}")
