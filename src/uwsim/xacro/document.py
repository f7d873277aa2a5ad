"""Parsing of a file, and expansion of the xacro and the includes in it."""

from __future__ import annotations

from pathlib import Path

from lxml import etree

from ..errors import AssetError, FileError
from ..schema import Document, parse
from .expander import XACRO, XINCLUDE, Expander, namespace_of
from .expression import ExpressionError

SUFFIX = ".xacro"


def parse_expanded(
    path: Path, *, error: type[FileError] = FileError, data_path: tuple[Path, ...] = ()
) -> Document:
    """Read a file as XML, with its xacro and includes expanded.

    What is included is looked for as every file that a scene names, and under the same folders.

    Raises:
        FileError: (or the ``error`` asked for) a file cannot be read, or is wrong.
    """
    document = parse(path, error=error)
    if not _is_to_expand(document):
        return document

    def include(name: str, file: Path) -> tuple[Path, etree._Element] | str:
        from ..assets.find import find, folders_searched

        try:
            found = find(name, named_by=file, data_path=data_path)
        except AssetError as outside:
            raise ExpressionError(str(outside)) from None
        if found is None:
            folders = folders_searched(named_by=file, data_path=data_path)
            return ", ".join(str(folder) for folder in folders if folder.is_dir())
        return found, parse(found, error=error).root

    expander = Expander(path, include)
    try:
        expander.expand(document.root)
    except RecursionError:
        expander.error(document.root, "calls, includes and elements are nested too deeply")
    expander.check(error)
    _merge_interfaces(document.root)
    return document


def _is_to_expand(document: Document) -> bool:
    """Whether a file is xacro, by its name or a declared namespace, or includes another."""
    return (
        document.path.suffix == SUFFIX
        or not XACRO.isdisjoint(document.root.nsmap.values())
        or any(namespace_of(node) in XACRO | XINCLUDE for node in document.root.iter("*"))
    )


def _merge_interfaces(root: etree._Element) -> None:
    """Make one ``<rosInterfaces>`` of those of a scene and of what it includes."""
    found = root.findall("rosInterfaces")
    for other in found[1:]:
        found[0].extend(list(other))
        root.remove(other)
