"""A scene file becomes a `SceneSpec`, or every fault it has."""

from __future__ import annotations

import dataclasses
from pathlib import Path

from ..dialect import Document, Faults, check_head, parse, read
from ..errors import Fault, SceneError
from .legacy import upgrade
from .spec import SceneSpec

ROOT = "UWSimScene"
"""Name of the root element."""


def read_scene(path: Path) -> SceneSpec:
    """Read a scene file.

    Raises:
        SceneError: with every fault of the file.
    """
    faults = Faults(path)
    scene = read_document(parse(path, error=SceneError), faults)
    faults.check(SceneError)
    assert scene is not None
    return scene


def read_document(document: Document, faults: Faults) -> SceneSpec | None:
    """Read a scene that is already parsed; None when its faults leave nothing to build on."""
    check_head(document, ROOT, faults)
    if document.root.tag != ROOT:
        return None
    upgrade(document.root, faults)
    scene = read(SceneSpec, document.root, faults)
    return scene and dataclasses.replace(scene, path=str(document.path))


def check_scene(
    path: Path, *, strict: bool = False, data_path: tuple[Path, ...] = ()
) -> list[Fault]:
    """Everything wrong or worth knowing about a scene file, in the order of the file."""
    faults = Faults(path, strict=strict)
    try:
        document = parse(path, error=SceneError)
    except SceneError as error:
        return list(error.faults)
    read_document(document, faults)
    return faults.all()
