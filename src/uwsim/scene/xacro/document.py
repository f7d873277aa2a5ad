"""Parsing of a file, and expansion of the xacro and the includes in it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path, PurePosixPath

from lxml import etree

from ...errors import AssetError, FileError
from ...schema import Document, Expansion, parse
from .expander import XACRO, XINCLUDE, Expander, NotFound, local, namespace_of
from .value import ExpressionError

SUFFIX = ".xacro"


def parse_expanded(
    path: Path,
    *,
    error: type[FileError] = FileError,
    data_path: tuple[Path, ...] = (),
    arguments: Mapping[str, str] | None = None,
) -> Document:
    """Read a file as XML, with its xacro and includes expanded.

    What is included is looked for as every file that a scene names, and under the same folders.

    Args:
        path: the file.
        error: what is raised.
        data_path: further folders in which files are looked for.
        arguments: values of ``<xacro:arg>`` in place of their defaults, by name.

    Raises:
        FileError: (or the ``error`` asked for) a file cannot be read, or is wrong.
    """
    document = parse(path, error=error)
    given = tuple(sorted((arguments or {}).items()))
    if not _is_to_expand(document):
        return replace(document, expansion=Expansion(arguments=given))
    expander = Expander(path, _NamedFiles(error, data_path), dict(given))
    try:
        expander.expand(document.root)
    except RecursionError:
        expander.error(document.root, "calls, includes and elements are nested too deeply")
    expander.check(error)
    _merge_interfaces(document.root)
    expansion = Expansion(
        arguments=given, declared_arguments=expander.arguments.known, warnings=expander.warnings
    )
    return replace(document, expansion=expansion)


class _NamedFiles:
    """The files that a document names, in the folders that `uwsim.assets` searches."""

    def __init__(self, error: type[FileError], data_path: tuple[Path, ...]) -> None:
        self._error, self._data_path = error, data_path

    def find(self, name: str, named_by: Path) -> Path:
        """Find a file; raises NotFound, or ExpressionError where it may not be read.

        Of a package that is not found only a file of the same path counts: the content of another
        file of that name, or of the one that names it, would be taken without a word.
        """
        from ...assets import describe_search, find

        try:
            found = find(name, named_by=named_by, data_path=self._data_path)
        except AssetError as outside:
            raise ExpressionError(str(outside)) from None
        if found is None or _is_guess(name, found, named_by):
            why = describe_search(name, named_by=named_by, data_path=self._data_path)
            raise NotFound(f"the file {name[:200]!r} is nowhere; {why}")
        return found

    def parse(self, path: Path) -> etree._Element:
        """Read an included file; returns its root element."""
        return parse(path, error=self._error).root

    def location_remark(self, name: str, path: Path, named_by: Path) -> str:
        """Say that a file was found elsewhere than its name states; empty if it is there."""
        from ...assets import location_remark

        return location_remark(name, path, named_by=named_by, data_path=self._data_path)


def _is_guess(name: str, found: Path, named_by: Path) -> bool:
    """Whether a file of a package has another path than its name states, or names itself."""
    from ...assets.packages import UWSIM_PACKAGE, package_of

    in_package = package_of(name)
    if in_package is None or in_package[0] == UWSIM_PACKAGE:
        return False
    parts = PurePosixPath(in_package[1]).parts
    return found.parts[-len(parts) :] != parts or found.samefile(named_by)


def library_of(root: etree._Element) -> tuple[str, tuple[str, ...]] | None:
    """Return what a library of xacro has, and the names; None for a file with other elements.

    A library has macros, else properties, and besides them only arguments, includes and materials.
    """
    children = [child for child in root if isinstance(child.tag, str)]
    names = {"macro", "property", "arg", "include"}
    if not all(
        child.tag == "material" or (namespace_of(child) in XACRO and local(child) in names)
        for child in children
    ):
        return None
    for kind, plural in (("macro", "macros"), ("property", "properties")):
        if names_of := tuple(str(each.get("name")) for each in children if local(each) == kind):
            return plural, names_of
    return None


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
