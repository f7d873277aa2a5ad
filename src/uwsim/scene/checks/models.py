"""Checks that the models and images that a scene names are there and can be read."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import Protocol

from ...devices.structured_light_projector import StructuredLightProjectorSpec
from ...errors import AssetError
from ...schema import Diagnostics, Document
from ..spec import SceneSpec
from .comms import comms_devices

MAX_FILES = 200
"""So many different robots and models of a scene, and meshes of a robot, are looked for."""


class Library(Protocol):
    """Look-up of the files that a scene names, implemented by ``uwsim.assets``."""

    def find(self, name: str, named_by: Path) -> Path | None:
        """The file ``name``, which the file ``named_by`` names; None when it is nowhere."""

    def find_robot(self, name: str, named_by: Path) -> Path | None:
        """The robot file ``name``, or else ours of the same file name; None without either."""

    def bundled_robots(self) -> tuple[str, ...]:
        """The file names of our own robots."""

    def has_model(self, name: str, named_by: Path) -> bool:
        """Whether there is a model of that name, or a stand-in."""

    def unreadable(self, name: str, named_by: Path) -> str:
        """Why the file of a model cannot be read here; empty if it can, or is not there."""

    def doubtful_size(self, name: str, scale: tuple[float, float, float], named_by: Path) -> str:
        """Why a robot's mesh is likely not in metres; empty if it may be."""

    def place_remark(self, name: str, named_by: Path) -> str:
        """That a file is found elsewhere than its name states; empty if it is there, or nowhere."""

    def model_place_remark(self, name: str, named_by: Path) -> str:
        """The same of a model, whose file may have another extension."""

    def model_remarks(self, name: str, named_by: Path) -> tuple[str, ...]:
        """What of the file of a model cannot be read, though the rest of it can."""

    def package_remark(self, name: str, named_by: Path) -> str:
        """That the package of a name is not found, or where it is; empty without a package."""

    def searched(self, name: str, named_by: Path) -> str:
        """The folders that were searched, or that its package is not found."""


def check_models(
    scene: SceneSpec, document: Document, library: Library, diagnostics: Diagnostics
) -> None:
    """Report models of objects and devices, and images, that are not found or cannot be read."""
    _check_projectors(scene, document, library, diagnostics)
    first: dict[str, object] = {}
    for device in (each for vehicle in scene.vehicles for each in comms_devices(vehicle)):
        if device.mesh is not None:
            first.setdefault(device.mesh.path, device.mesh)
    for thing in scene.objects:
        first.setdefault(thing.file, thing)
        if thing.physics is not None and thing.physics.collision_shape:
            first.setdefault(thing.physics.collision_shape, thing)
    for name, spec in itertools.islice(first.items(), MAX_FILES):
        if why := library.unreadable(name, document.path):
            diagnostics.error(spec, why)
        elif not library.has_model(name, document.path):
            _lost(name, "model", "has no stand-in", spec, document, library, diagnostics)
        elif remark := library.model_place_remark(name, document.path):
            diagnostics.warning(spec, remark)
        for said in library.model_remarks(name, document.path):
            diagnostics.warning(spec, said)


def _check_projectors(
    scene: SceneSpec, document: Document, library: Library, diagnostics: Diagnostics
) -> None:
    """Report projectors that shine nothing: of several the last shines, if its image is there."""
    projectors = [
        projector
        for vehicle in scene.vehicles
        if not vehicle.vr
        for projector in vehicle.parts_of(StructuredLightProjectorSpec)
    ]
    for projector in projectors[:-1]:
        message = f"projector {projector.name!r} shines nothing: of several only the last shines"
        diagnostics.warning(projector, message)
    for projector in projectors[-1:]:
        image = projector.image_name
        try:
            path = library.find(image, document.path)
        except AssetError as error:
            diagnostics.error(projector, str(error))
            continue
        if path is None:
            so = f"projector {projector.name!r} shines nothing"
            _lost(image, "image", so, projector, document, library, diagnostics)
        elif remark := library.place_remark(image, document.path):
            diagnostics.warning(projector, remark)


def _lost(
    name: str,
    what: str,
    so: str,
    spec: object,
    document: Document,
    library: Library,
    diagnostics: Diagnostics,
) -> None:
    """Report a missing file: an error, but in a scene of the original a warning.

    The archive with the original's models is no longer to be had, so that a scene with the
    original's DOCTYPE is not at error for naming what lay in it.
    """
    from ...assets.packages import without_file_scheme

    say = diagnostics.warning if document.has_doctype else diagnostics.error
    shown = without_file_scheme(name)
    say(spec, f"{what} {shown!r} is nowhere and {so}; {library.searched(name, document.path)}")
