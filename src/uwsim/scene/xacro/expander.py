"""The expander: walks a document and replaces every element of xacro by what it stands for.

An element from an included file gets the line of the include, or of the call of its macro, so that
errors of the expanded document are at lines of the file that the user wrote.
"""

from __future__ import annotations

import copy
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol, cast

from lxml import etree

from ...errors import Diagnostic, FileError, choices
from ...schema import MAX_NODES, Diagnostics
from .functions import FUNCTIONS
from .macro import Macro, parameters_of
from .scope import Scope, literal_of
from .substitution import Arguments, substituted
from .value import ExpressionError, Value, written
from .yaml_file import read_yaml

XACRO = frozenset(
    f"http://{host}"
    for host in ("www.ros.org/wiki/xacro", "ros.org/wiki/xacro", "wiki.ros.org/xacro")
) | {"http://www.ros.org/xacro"}
"""Namespaces of xacro that files use."""
XINCLUDE = frozenset({"http://www.w3.org/2001/XInclude", "http://www.w3.org/2003/XInclude"})
DEFINITIONS = {"macro": {"name"}, "property": {"name", "value"}}
"""Elements of xacro, and attributes, that are known without its prefix, too."""
OF_ROBOTS = frozenset(
    {
        *("axis", "box", "calibration", "capsule", "child", "collision", "color", "cylinder"),
        *("dynamics", "gazebo", "geometry", "inertia", "inertial", "joint", "limit", "link"),
        *("mass", "material", "mesh", "mimic", "origin", "parent", "plugin", "robot"),
        *("safety_controller", "sensor", "sphere", "texture", "transmission", "visual"),
    }
)
"""Elements of robot files, which call no macro of their name."""
FOREIGN = frozenset({"gazebo", "plugin", "ros2_control", "sensor", "transmission"})
"""Elements of robot files whose content is not URDF: nothing in it is a call without a prefix."""
CALLING = frozenset({"if", "macro", "unless"})
"""Elements of xacro in which there are calls without a prefix."""
MAX_DEPTH = 60
"""Deepest nesting of calls and includes."""
MAX_FILES = 100
"""Most files that are included."""


class NotFound(ExpressionError):
    """A file that is nowhere."""


class Files(Protocol):
    """The files that a document names."""

    def find(self, name: str, named_by: Path) -> Path:
        """Find a file; raises NotFound, or ExpressionError where it may not be read."""

    def parse(self, path: Path) -> etree._Element:
        """Read an included file; returns its root element."""

    def location_remark(self, name: str, path: Path, named_by: Path) -> str:
        """Say that a file was found elsewhere than its name states; empty if it is there."""


def namespace_of(node: etree._Element) -> str:
    """Return the namespace of an element."""
    return etree.QName(node).namespace or ""


def local(node: etree._Element) -> str:
    """Return the name of an element without its namespace."""
    return etree.QName(node).localname


def needed(node: etree._Element, attribute: str) -> str:
    """Return an attribute; raises ExpressionError if it is not there."""
    text = node.get(attribute)
    if text is None:
        name = etree.QName(node).localname
        raise ExpressionError(f"<{node.prefix}:{name}> lacks its attribute {attribute}")
    return str(text)


class Expander:
    """Expands one document.

    Args:
        path: its file.
        files: finds and reads the files that it names.
        arguments: values of ``<xacro:arg>`` from outside, by name.
    """

    def __init__(self, path: Path, files: Files, arguments: Mapping[str, str]) -> None:
        self._path, self._files = path, files
        self._diagnostics: dict[str, Diagnostics] = {}
        self._macros: dict[str, Macro] = {}
        self._yaml_values: dict[Path, Value] = {}
        self.arguments = Arguments(arguments)
        """The values of ``<xacro:arg>``."""
        self._n_nodes = self._n_files = 0
        self._depth = 0
        self._n_foreign = 0
        self._is_robot = False
        self._file = path
        self._line: int | None = None
        """Line that stands for what is expanded; None: it is of the user's own file."""

    def expand(self, root: etree._Element) -> None:
        """Expand the document in place."""
        functions = {
            **FUNCTIONS,
            **dict.fromkeys(("xacro.load_yaml", "load_yaml"), self._yaml),
            "xacro.arg": lambda name: literal_of(self.arguments.value(name)),
        }
        scope = Scope(None, self._substituted, functions)
        self._is_robot = etree.QName(root).localname == "robot"
        root[:] = self._expanded(list(root), scope)
        self._attributes(root, root, scope)
        self._text(root, root, scope)

    def check(self, error: type[FileError]) -> None:
        """Raise ``error`` with the errors of all files, if there are any."""
        found = [each for file in self._diagnostics.values() for each in file.to_list()]
        if wrong := [each for each in found if each.severity == "error"]:
            raise error(wrong)

    @property
    def warnings(self) -> tuple[Diagnostic, ...]:
        """The warnings of all files."""
        found = (each for file in self._diagnostics.values() for each in file.to_list())
        return tuple(each for each in found if each.severity == "warning")

    def error(self, node: etree._Element, message: str) -> None:
        """Add an error at an element of the file that is being expanded."""
        self._of_file().error(node, message)

    def _of_file(self) -> Diagnostics:
        return self._diagnostics_of(self._file)

    def _diagnostics_of(self, file: Path) -> Diagnostics:
        return self._diagnostics.setdefault(str(file), Diagnostics(file))

    def _expanded(self, nodes: Sequence[etree._Element], scope: Scope) -> Iterator[etree._Element]:
        """Give what the nodes stand for."""
        for node in nodes:
            if self._n_nodes > MAX_NODES:
                return
            self._n_nodes += 1 + len(node.attrib)
            if self._n_nodes > MAX_NODES:
                self.error(node, f"expands to more than {MAX_NODES} elements and attributes")
                return
            try:
                if isinstance(node.tag, str):
                    yield from self._one(node, scope)
                else:
                    yield self._comment(node, scope)
            except ExpressionError as error:
                self.error(node, str(error))

    def _one(self, node: etree._Element, scope: Scope) -> Iterator[etree._Element]:
        namespace, name = namespace_of(node), etree.QName(node).localname
        if namespace in XINCLUDE:
            yield from self._included(node, "href", scope, keeps_root=True)
        elif namespace not in XACRO and not self._is_of_xacro(node, name):
            yield self._plain(node, scope)
        elif name in ("if", "unless"):
            needed(node, "value")
            if self._flag(node, "value", scope, default="") is (name == "if"):
                yield from self._expanded(list(node), scope)
        elif name == "property":
            self._property(node, scope)
        elif name == "arg":
            default = node.get("default")
            text = None if default is None else written(scope.text(default))
            self.arguments.declare(needed(node, "name"), text)
        elif name == "macro":
            self._define(node)
        elif name == "include":
            yield from self._included(node, "filename", scope)
        elif name == "insert_block":
            yield from self._block(node, scope)
        elif name in ("element", "attribute"):
            raise ExpressionError(f"<xacro:{name}> is not supported")
        else:
            called = written(scope.text(needed(node, "macro"))) if name == "call" else name
            yield from self._called(node, called, scope)

    def _is_of_xacro(self, node: etree._Element, name: str) -> bool:
        """Whether an element without xacro's prefix is meant as one with it, as up to ROS Melodic.

        In robot files the calls of known macros are, and definitions of macros and properties, but
        not in elements of other formats, such as the SDF in ``<gazebo>``, nor in blocks.
        """
        if not self._is_robot or self._n_foreign or namespace_of(node) or name in OF_ROBOTS:
            return False
        around = node.getparent()
        if around is not None and namespace_of(around) in XACRO and local(around) not in CALLING:
            return False
        is_definition = name in DEFINITIONS and DEFINITIONS[name] <= set(node.attrib)
        if not is_definition and name not in self._macros:
            return False
        self._of_file().warning(
            node, f"<{name}> lacks the prefix xacro:; it is read as if it had it"
        )
        return True

    def _plain(self, node: etree._Element, scope: Scope) -> etree._Element:
        made = etree.Element(node.tag, nsmap=cast(dict[str, str], node.nsmap))
        made.sourceline = self._line_of(node)  # type: ignore[assignment]
        made.tail = node.tail
        self._attributes(node, made, scope)
        made.text = node.text
        self._text(node, made, scope)
        is_foreign = node.tag in FOREIGN
        self._n_foreign += is_foreign
        made.extend(self._expanded(list(node), scope))
        self._n_foreign -= is_foreign
        return made

    def _comment(self, node: etree._Element, scope: Scope) -> etree._Element:
        """Return a comment, an instruction or an entity with the text behind it."""
        made = copy.deepcopy(node)
        if node.tail is not None:
            made.tail = written(scope.text(node.tail))
        return made

    def _line_of(self, node: etree._Element) -> int:
        """Line of the user's file that stands for an element."""
        return self._line or int(str(node.sourceline))

    def _attributes(self, node: etree._Element, made: etree._Element, scope: Scope) -> None:
        for key, text in node.attrib.items():
            try:
                made.set(key, written(scope.text(str(text))))
            except (ExpressionError, ValueError) as error:
                self.error(node, f"{etree.QName(key).localname}={str(text)[:60]!r}: {error}")

    def _text(self, node: etree._Element, made: etree._Element, scope: Scope) -> None:
        if made.text and "$" in made.text:
            try:
                made.text = written(scope.text(made.text))
            except (ExpressionError, ValueError) as error:
                self.error(node, f"{made.text.strip()[:60]!r}: {error}")
                made.text = ""

    def _property(self, node: etree._Element, scope: Scope) -> None:
        """Set or remove a property, which is evaluated when it is used if nothing else is asked."""
        name = written(scope.text(needed(node, "name")))
        value, default = node.get("value"), node.get("default")
        is_removed = self._flag(node, "remove", scope, default="false")
        if (value is not None) + (default is not None) + is_removed > 1:
            raise ExpressionError(f"the property {name[:60]!r}: only one of value, default, remove")
        if is_removed:
            scope.remove(name)
            return
        if default is not None and scope.has(name):
            return
        kept_in = node.get("scope", "")
        where = {"parent": scope.around, "global": scope.outermost}.get(kept_in, scope)
        is_lazy = self._flag(node, "lazy_eval", scope, default="true")
        text = default if value is None else value
        if text is None:
            where.blocks[name] = list(self._expanded(list(node), scope))
        elif is_lazy and where is scope:
            where.set_text(name, str(text))
        else:
            where.set_value(name, literal_of(scope.text(str(text))))

    def _flag(self, node: etree._Element, attribute: str, scope: Scope, *, default: str) -> bool:
        text = str(node.get(attribute, default))
        value = literal_of(scope.text(text))
        if isinstance(value, str):
            raise ExpressionError(f"{attribute}={text[:60]!r} is neither true nor false")
        return bool(value)

    def _define(self, node: etree._Element) -> None:
        name = needed(node, "name").removeprefix("xacro:")
        parameters = parameters_of(node.get("params", ""))
        self._macros[name] = Macro(name, parameters, node, str(self._file))

    def _called(self, node: etree._Element, name: str, scope: Scope) -> Iterator[etree._Element]:
        macro = self._macros.get(name)
        if macro is None:
            known = choices(name, self._macros)
            raise ExpressionError(f"no macro is called {name[:60]!r}.{known}")
        inner = self._filled(node, macro, scope)
        line = self._line or (None if macro.file == str(self._path) else self._line_of(node))
        with self._nested(Path(macro.file), line):
            made = list(self._expanded(list(macro.body), inner))
        yield from made

    def _filled(self, node: etree._Element, macro: Macro, scope: Scope) -> Scope:
        """Return the scope of a call: each parameter with its value."""
        given = {str(key): str(text) for key, text in node.attrib.items()}
        if etree.QName(node).localname == "call":
            given.pop("macro", None)
        return macro.bind(given, list(self._expanded(list(node), scope)), scope)

    def _block(self, node: etree._Element, scope: Scope) -> Iterator[etree._Element]:
        name = written(scope.text(needed(node, "name")))
        block = scope.block(name)
        if block is None:
            raise ExpressionError(f"no block is called {name[:60]!r}")
        for each in block:
            self._n_nodes += 1 + sum(1 for _ in each.iter())
            if self._n_nodes <= MAX_NODES:
                yield copy.deepcopy(each)

    def _included(
        self, node: etree._Element, attribute: str, scope: Scope, *, keeps_root: bool = False
    ) -> Iterator[etree._Element]:
        """Give the content of a file; of xacro without its root element, whatever its name."""
        name = written(scope.text(needed(node, attribute)))
        self._n_files += 1
        if self._n_files > MAX_FILES:
            raise ExpressionError(f"includes more than {MAX_FILES} files")
        try:
            path = self._files.find(name, self._file)
        except NotFound:
            if str(node.get("optional", "false")).lower() in ("1", "true"):
                return
            raise
        root = self._files.parse(path)
        whole = [root] if keeps_root and not _is_stripped(root) else list(root)
        if remark := self._files.location_remark(name, path, self._file):
            self._of_file().warning(node, remark)
        with self._nested(path, self._line_of(node)):
            made = list(self._expanded(whole, scope))
        yield from made

    def _yaml(self, name: Value) -> Value:
        """Return what is in a YAML file; each file is read once."""
        path = self._files.find(written(name), self._file)
        if path not in self._yaml_values:
            if len(self._yaml_values) >= MAX_FILES:
                raise ExpressionError(f"reads more than {MAX_FILES} YAML files")
            warn = self._diagnostics_of(path).warning
            self._yaml_values[path] = read_yaml(path, name=written(name), warn=warn)
        return self._yaml_values[path]

    @contextmanager
    def _nested(self, file: Path, line: int | None) -> Iterator[None]:
        """Expand what stands in a file, one level deeper; raises ExpressionError."""
        before = self._file, self._line
        if self._depth >= MAX_DEPTH:
            raise ExpressionError(f"calls and includes are nested deeper than {MAX_DEPTH} levels")
        self._depth += 1
        self._file, self._line = file, line
        try:
            yield
        finally:
            self._depth -= 1
            self._file, self._line = before

    def _substituted(self, text: str) -> str:
        return substituted(text, self.arguments, self._file)


def _is_stripped(root: etree._Element) -> bool:
    """Whether only the content of an included file counts: a whole file, or macros alone."""
    if etree.QName(root).localname in ("UWSimScene", "robot", "fragment"):
        return True
    spaces = {namespace_of(child) for child in root.iterchildren("*")}
    return bool(spaces) and spaces <= XACRO
