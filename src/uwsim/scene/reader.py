"""Reader of scene files: it returns a `SceneSpec`, or raises an error with all mistakes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..errors import SceneError
from ..schema import Diagnostics, Document, check_head, read
from .legacy import upgrade
from .sizes import check_sizes
from .spec import SceneSpec
from .variation import check_variations
from .xacro import parse_expanded

ROOT = "UWSimScene"
"""The name of the root element."""


def read_scene(
    path: Path | str,
    *,
    data_path: tuple[Path, ...] = (),
    arguments: Mapping[str, str] | None = None,
) -> SceneSpec:
    """Read a scene file.

    Args:
        path: the file.
        data_path: the further folders that are searched for included files.
        arguments: the values of xacro arguments of the scene and its robots, by name.

    Raises:
        SceneError: the file is invalid; the error has every mistake in it.
    """
    path = Path(path)
    diagnostics = Diagnostics(path)
    document = parse_expanded(path, error=SceneError, data_path=data_path, arguments=arguments)
    scene = read_document(document, diagnostics)
    diagnostics.check(SceneError)
    assert scene is not None
    return scene


def read_document(document: Document, diagnostics: Diagnostics) -> SceneSpec | None:
    """Read a parsed scene; None if its root element is wrong or has invalid content."""
    check_head(document, ROOT, diagnostics)
    if document.root.tag != ROOT:
        return None
    upgrade(document.root, diagnostics)
    if diagnostics.is_strict:
        for node in document.root.iter("ProfilingSonar", "ProfilingSonarROS"):
            diagnostics.error(node, f"<{node.tag}> is not in the original grammar")
    scene = read(
        SceneSpec,
        document.root,
        diagnostics,
        known_fields={
            "path": str(document.path),
            "is_original": document.has_doctype,
            "expansion": document.expansion,
        },
    )
    if scene is not None:
        check_sizes(scene, diagnostics)
        check_variations(scene, diagnostics)
    return scene
