"""Rules about models and images that a scene names: they exist and can be read."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

from ... import assets
from ...assets.packages import strip_file_scheme
from ...devices.structured_light_projector import StructuredLightProjectorSpec
from ...errors import AssetError, Diagnostic, UwsimError
from ...model.parts import comms_devices
from ...model.terrain import height_grid
from ...scene.object import ObjectSpec
from ..robot_search import MAX_FILES
from ..subjects import CheckedScene


def model_files(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report models of objects and devices that are not found or cannot be read."""
    specs: dict[str, object] = {}
    for device in (unit for vehicle in scene.spec.vehicles for unit in comms_devices(vehicle)):
        if device.mesh is not None:
            specs.setdefault(device.mesh.path, device.mesh)
    for object_spec in scene.spec.objects:
        if object_spec.bathymetry is not None:
            yield from _chart_errors(scene, object_spec)
            continue
        specs.setdefault(object_spec.file, object_spec)
        if object_spec.physics is not None and object_spec.physics.collision_shape:
            specs.setdefault(object_spec.physics.collision_shape, object_spec)
    for name, spec in itertools.islice(specs.items(), MAX_FILES):
        if message := assets.model_read_error(name, **scene.file_search):
            yield scene.error(spec, message)
        elif not assets.has_model(name, **scene.file_search):
            message = f"model {strip_file_scheme(name)!r} is not found and has no stand-in"
            yield _missing_file(scene, spec, message, name)
        elif remark := assets.model_location_remark(name, **scene.file_search):
            yield scene.warning(spec, remark)
        for text in assets.model_remarks(name, **scene.file_search):
            yield scene.warning(spec, text)


def _chart_errors(scene: CheckedScene, spec: ObjectSpec) -> Iterator[Diagnostic]:
    """Report a chart of the sea floor that is not found, or does not fit the scene."""
    try:
        height_grid(scene.spec, spec, scene.data_path)
    except UwsimError as error:
        yield scene.error(spec, str(error).removesuffix("."), "file")


def projectors(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report projectors without effect: only the last projector emits light, if it has an image."""
    projectors = [
        projector
        for vehicle in scene.spec.vehicles
        if not vehicle.vr
        for projector in vehicle.parts_of(StructuredLightProjectorSpec)
    ]
    for projector in projectors[:-1]:
        message = f"projector {projector.name!r} has no effect: only the last projector shines"
        yield scene.warning(projector, message)
    for projector in projectors[-1:]:
        image = projector.image_name
        try:
            path = assets.find(image, **scene.file_search)
        except AssetError as error:
            yield scene.error(projector, str(error))
            continue
        if path is None:
            effect = f"projector {projector.name!r} has no effect"
            message = f"image {strip_file_scheme(image)!r} is not found: {effect}"
            yield _missing_file(scene, projector, message, image)
        elif remark := assets.location_remark(image, path, **scene.file_search):
            yield scene.warning(projector, remark)


def _missing_file(scene: CheckedScene, place: object, message: str, name: str) -> Diagnostic:
    """Report a missing file: an error, or a warning in a scene of the original UWSim.

    The archive with the models of the original is no longer available. So a missing model is no
    error in a scene with the DOCTYPE of the original.
    """
    report = scene.warning if scene.spec.is_original else scene.error
    return report(place, f"{message}; {assets.describe_search(name, **scene.file_search)}")
