"""Lines of a scene file for errors that are found after it was read."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import Literal

from lxml import etree

from ...errors import Diagnostic, FileError
from ...scene.legacy import upgrade
from ...scene.spec import SceneSpec
from ...schema import NAMESPACE, Diagnostics
from ...xacro import parse_expanded


class SceneLines:
    """Finds the line of an element; reads the file again at the first look-up."""

    def __init__(self, scene: SceneSpec, data_path: tuple[Path, ...] = ()) -> None:
        self._path, self._data_path = scene.path, data_path
        self._root: etree._Element | None = None

    def diagnostic(
        self,
        message: str,
        parent: str,
        index: int,
        child: str,
        number: int = 0,
        *,
        severity: Literal["error", "warning"] = "error",
    ) -> Diagnostic:
        """Make an error at the ``number``th ``child`` of the ``index``th ``parent``."""
        return Diagnostic(
            file=self._path or "the scene",
            line=self.line(parent, index, child, number),
            message=message,
            severity=severity,
        )

    def line(self, parent: str, index: int, child: str, number: int = 0) -> int | None:
        """Line of the ``number``th ``child`` of the ``index``th ``parent``, else of that; or None.

        Args:
            parent: path from the root, as ``oceanState/u:current``.
            index: which of several such.
            child: name of the element in it; ``*`` for any.
            number: which of several such.
        """
        if self._root is None and self._path:
            with suppress(FileError):
                document = parse_expanded(Path(self._path), data_path=self._data_path)
                upgrade(document.root, Diagnostics(document.path))
                self._root = document.root
        if self._root is None:
            return None
        parents = self._root.findall(_qualified(parent))
        if index >= len(parents):
            return None
        nodes = [n for n in parents[index].findall(_qualified(child)) if isinstance(n.tag, str)]
        node = nodes[number] if number < len(nodes) else parents[index]
        return int(str(node.sourceline))


def _qualified(path: str) -> str:
    """``oceanState/u:current`` -> ``oceanState/{urn:uwsim:1}current``."""
    return "/".join(part.replace("u:", f"{{{NAMESPACE}}}", 1) if part.startswith("u:") else part
                    for part in path.split("/"))  # fmt: skip
