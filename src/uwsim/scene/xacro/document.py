"""Parsing of XML files, with expansion of their xacro and includes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path, PurePosixPath

from lxml import etree

from ...errors import AssetError, FileError
from ...schema import Document, Expansion, parse
from .expander import XACRO, XINCLUDE, Expander, NotFound, local_name, namespace_of
from .value import ExpressionError

SUFFIX = ".xacro"


def parse_expanded(
    path: Path,
    *,
    error: type[FileError] = FileError,
    data_path: tuple[Path, ...] = (),
    arguments: Mapping[str, str] | None = None,
) -> Document:
    """Read an XML file and expand its xacro and includes.

    Included files are searched in the same folders as all files that a scene names.

    Args:
        path: the file.
        error: the type of error to raise.
        data_path: the further folders that are searched for files.
        arguments: the values of ``<xacro:arg>`` that replace their defaults, by name.

    Raises:
        FileError: a file cannot be read, or is invalid; the type is ``error``.
    """
    document = parse(path, error=error)
    argument_pairs = tuple(sorted((arguments or {}).items()))
    if not _is_to_expand(document):
        return replace(document, expansion=Expansion(arguments=argument_pairs))
    expander = Expander(path, _NamedFiles(error, data_path), dict(argument_pairs))
    try:
        expander.expand(document.root)
    except RecursionError:
        expander.error(document.root, "calls, includes and elements are nested too deeply")
    expander.check(error)
    _merge_interfaces(document.root)
    names, warnings = expander.arguments.names, expander.warnings
    expansion = Expansion(arguments=argument_pairs, declared_arguments=names, warnings=warnings)
    return replace(document, expansion=expansion)


class _NamedFiles:
    """The search for files that a document names, in the folders that `uwsim.assets` searches."""

    def __init__(self, error: type[FileError], data_path: tuple[Path, ...]) -> None:
        self._error, self._data_path = error, data_path

    def find(self, name: str, named_by: Path) -> Path:
        """Return the path of a file; raise NotFound, or ExpressionError if it may not be read.

        For a package that is not found, only a file with the same path is accepted: otherwise
        another file with the same name, or the including file itself, would be used without a
        warning.
        """
        from ...assets import describe_search, find

        try:
            path = find(name, named_by=named_by, data_path=self._data_path)
        except AssetError as error:
            raise ExpressionError(str(error)) from None
        if path is None or _is_guess(name, path, named_by):
            search_text = describe_search(name, named_by=named_by, data_path=self._data_path)
            raise NotFound(f"the file {name[:200]!r} is not found; {search_text}")
        return path

    def parse(self, path: Path) -> etree._Element:
        """Read an included file and return its root element."""
        return parse(path, error=self._error).root

    def location_remark(self, name: str, path: Path, named_by: Path) -> str:
        """Return a remark if a file is at another path than its name states; else empty."""
        from ...assets import location_remark

        return location_remark(name, path, named_by=named_by, data_path=self._data_path)


def _is_guess(name: str, path: Path, named_by: Path) -> bool:
    """Return whether a file of a package is at another path, or is the including file."""
    from ...assets.packages import UWSIM_PACKAGE, package_of

    in_package = package_of(name)
    if in_package is None or in_package[0] == UWSIM_PACKAGE:
        return False
    parts = PurePosixPath(in_package[1]).parts
    return path.parts[-len(parts) :] != parts or path.samefile(named_by)


def library_of(root: etree._Element) -> tuple[str, tuple[str, ...]] | None:
    """Return the kind and the names of the definitions in a xacro library; None for other files.

    A library contains macros or properties and, besides these, only arguments, includes and
    materials. The kind is ``macros`` or ``properties``.
    """
    children = [node for node in root if isinstance(node.tag, str)]
    names = {"macro", "property", "arg", "include"}
    if not all(
        node.tag == "material" or (namespace_of(node) in XACRO and local_name(node) in names)
        for node in children
    ):
        return None
    for kind, plural in (("macro", "macros"), ("property", "properties")):
        elements = [element for element in children if local_name(element) == kind]
        if elements:
            return plural, tuple(str(element.get("name")) for element in elements)
    return None


def _is_to_expand(document: Document) -> bool:
    """Return whether a file is xacro, by its suffix or a namespace, or includes other files."""
    return (
        document.path.suffix == SUFFIX
        or not XACRO.isdisjoint(document.root.nsmap.values())
        or any(namespace_of(node) in XACRO | XINCLUDE for node in document.root.iter("*"))
    )


def _merge_interfaces(root: etree._Element) -> None:
    interfaces = root.findall("rosInterfaces")
    for other in interfaces[1:]:
        interfaces[0].extend(list(other))
        root.remove(other)
