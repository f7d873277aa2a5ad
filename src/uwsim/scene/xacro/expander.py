"""The expander of xacro, which traverses a document and replaces every xacro element.

An element from an included file gets the line of the include, or of the call of its macro, so that
errors in the expanded document refer to lines of the user's file.
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
from .substitution import Arguments, substitute
from .value import ExpressionError, Value, to_text
from .yaml_file import read_yaml

Node = etree._Element
XACRO = frozenset(
    f"http://{host}"
    for host in ("www.ros.org/wiki/xacro", "ros.org/wiki/xacro", "wiki.ros.org/xacro")
) | {"http://www.ros.org/xacro"}
"""The namespaces of xacro that files use."""
XINCLUDE = frozenset({"http://www.w3.org/2001/XInclude", "http://www.w3.org/2003/XInclude"})
DEFINITIONS = {"macro": {"name"}, "property": {"name", "value"}}
"""The xacro elements that are also valid without the prefix, with their required attributes."""
ROBOT_ELEMENTS = frozenset(
    {
        *("axis", "box", "calibration", "capsule", "child", "collision", "color", "cylinder"),
        *("dynamics", "gazebo", "geometry", "inertia", "inertial", "joint", "limit", "link"),
        *("mass", "material", "mesh", "mimic", "origin", "parent", "plugin", "robot"),
        *("safety_controller", "sensor", "sphere", "texture", "transmission", "visual"),
    }
)
"""The elements of robot files, which are never calls of macros with the same name."""
FOREIGN_ELEMENTS = frozenset({"gazebo", "plugin", "ros2_control", "sensor", "transmission"})
"""The elements of robot files whose content is not URDF and has no calls without a prefix."""
CALLING_ELEMENTS = frozenset({"if", "macro", "unless"})
"""The xacro elements that can contain calls without a prefix."""
MAX_DEPTH = 60
"""The deepest nesting of calls and includes."""
MAX_FILES = 100
"""The greatest number of files that are included."""


class NotFound(ExpressionError):
    """An error for a file that is not found."""


class Files(Protocol):
    """The search for files that a document names, and their reading."""

    def find(self, name: str, named_by: Path) -> Path:
        """Return the path of a file; raise NotFound, or ExpressionError if it may not be read."""

    def parse(self, path: Path) -> Node:
        """Read an included file and return its root element."""

    def location_remark(self, name: str, path: Path, named_by: Path) -> str:
        """Return a remark if a file is at another path than its name states; else empty."""


def namespace_of(node: Node) -> str:
    """Return the namespace of an element."""
    return etree.QName(node).namespace or ""


def local_name(node: Node) -> str:
    """Return the name of an element without its namespace."""
    return etree.QName(node).localname


def require(node: Node, attribute: str) -> str:
    """Return a required attribute; raise ExpressionError if it is absent."""
    text = node.get(attribute)
    if text is None:
        name = etree.QName(node).localname
        raise ExpressionError(f"<{node.prefix}:{name}> lacks its attribute {attribute}")
    return str(text)


class Expander:
    """The expansion of one document.

    Args:
        path: the file of the document.
        files: the search for files that the document names.
        arguments: the caller's values of ``<xacro:arg>``, by name.
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
        """The line of the user's file for included elements; None in the user's own file."""

    def expand(self, root: Node) -> None:
        """Expand the document in place."""
        functions = {
            **FUNCTIONS,
            **dict.fromkeys(("xacro.load_yaml", "load_yaml"), self._load_yaml),
            "xacro.arg": lambda name: literal_of(self.arguments.value(name)),
        }
        scope = Scope(None, self._substitute, functions)
        self._is_robot = etree.QName(root).localname == "robot"
        root[:] = self._expand_nodes(list(root), scope)
        self._expand_attributes(root, root, scope)
        self._expand_text(root, root, scope)

    def check(self, error: type[FileError]) -> None:
        """Raise ``error`` with the errors of all files, if there are any."""
        if errors := self._select("error"):
            raise error(errors)

    @property
    def warnings(self) -> tuple[Diagnostic, ...]:
        """The warnings of all files."""
        return tuple(self._select("warning"))

    def _select(self, severity: str) -> list[Diagnostic]:
        lists = (file.to_list() for file in self._diagnostics.values())
        return [entry for entries in lists for entry in entries if entry.severity == severity]

    def error(self, node: Node, message: str) -> None:
        """Add an error at an element of the file that is being expanded."""
        self._file_diagnostics().error(node, message)

    def _file_diagnostics(self) -> Diagnostics:
        return self._diagnostics_of(self._file)

    def _diagnostics_of(self, file: Path) -> Diagnostics:
        return self._diagnostics.setdefault(str(file), Diagnostics(file))

    def _expand_nodes(self, nodes: Sequence[Node], scope: Scope) -> Iterator[Node]:
        for node in nodes:
            if self._n_nodes > MAX_NODES:
                return
            self._n_nodes += 1 + len(node.attrib)
            if self._n_nodes > MAX_NODES:
                self.error(node, f"expands to more than {MAX_NODES} elements and attributes")
                return
            try:
                if isinstance(node.tag, str):
                    yield from self._expand_node(node, scope)
                else:
                    yield self._copy_comment(node, scope)
            except ExpressionError as error:
                self.error(node, str(error))

    def _expand_node(self, node: Node, scope: Scope) -> Iterator[Node]:
        namespace, name = namespace_of(node), etree.QName(node).localname
        if namespace in XINCLUDE:
            yield from self._include(node, "href", scope, keeps_root=True)
        elif namespace not in XACRO and not self._is_unprefixed_xacro(node, name):
            yield self._copy_element(node, scope)
        elif name in ("if", "unless"):
            require(node, "value")
            if self._flag(node, "value", scope, default="") is (name == "if"):
                yield from self._expand_nodes(list(node), scope)
        elif name == "property":
            self._set_property(node, scope)
        elif name == "arg":
            default = node.get("default")
            text = None if default is None else to_text(scope.text(default))
            self.arguments.declare(require(node, "name"), text)
        elif name == "macro":
            self._define(node)
        elif name == "include":
            yield from self._include(node, "filename", scope)
        elif name == "insert_block":
            yield from self._insert_block(node, scope)
        elif name in ("element", "attribute"):
            raise ExpressionError(f"<xacro:{name}> is not supported")
        else:
            macro_name = to_text(scope.text(require(node, "macro"))) if name == "call" else name
            yield from self._call_macro(node, macro_name, scope)

    def _is_unprefixed_xacro(self, node: Node, name: str) -> bool:
        """Return whether an element without the prefix is a xacro element, as until ROS Melodic.

        In robot files these are calls of known macros, and definitions of macros and properties;
        but not within elements of other formats (such as SDF in ``<gazebo>``) or within blocks.
        """
        if not self._is_robot or self._n_foreign or namespace_of(node) or name in ROBOT_ELEMENTS:
            return False
        parent = node.getparent()
        if (
            parent is not None
            and namespace_of(parent) in XACRO
            and local_name(parent) not in CALLING_ELEMENTS
        ):
            return False
        is_definition = name in DEFINITIONS and DEFINITIONS[name] <= set(node.attrib)
        if not is_definition and name not in self._macros:
            return False
        message = f"<{name}> lacks the prefix xacro:; it is read as <xacro:{name}>"
        self._file_diagnostics().warning(node, message)
        return True

    def _copy_element(self, node: Node, scope: Scope) -> Node:
        element = etree.Element(node.tag, nsmap=cast(dict[str, str], node.nsmap))
        element.sourceline = self._line_of(node)  # type: ignore[assignment]
        element.tail = node.tail
        self._expand_attributes(node, element, scope)
        element.text = node.text
        self._expand_text(node, element, scope)
        is_foreign = node.tag in FOREIGN_ELEMENTS
        self._n_foreign += is_foreign
        element.extend(self._expand_nodes(list(node), scope))
        self._n_foreign -= is_foreign
        return element

    def _copy_comment(self, node: Node, scope: Scope) -> Node:
        element = copy.deepcopy(node)
        if node.tail is not None:
            element.tail = to_text(scope.text(node.tail))
        return element

    def _line_of(self, node: Node) -> int:
        """Return the line in the user's file to which errors of an element refer."""
        return self._line or int(str(node.sourceline))

    def _expand_attributes(self, node: Node, element: Node, scope: Scope) -> None:
        for key, text in node.attrib.items():
            try:
                element.set(key, to_text(scope.text(str(text))))
            except (ExpressionError, ValueError) as error:
                self.error(node, f"{etree.QName(key).localname}={str(text)[:60]!r}: {error}")

    def _expand_text(self, node: Node, element: Node, scope: Scope) -> None:
        if element.text and "$" in element.text:
            try:
                element.text = to_text(scope.text(element.text))
            except (ExpressionError, ValueError) as error:
                self.error(node, f"{element.text.strip()[:60]!r}: {error}")
                element.text = ""

    def _set_property(self, node: Node, scope: Scope) -> None:
        """Set or remove a property; by default its text is evaluated when it is used."""
        name = to_text(scope.text(require(node, "name")))
        value, default = node.get("value"), node.get("default")
        is_removed = self._flag(node, "remove", scope, default="false")
        if (value is not None) + (default is not None) + is_removed > 1:
            raise ExpressionError(f"the property {name[:60]!r}: only one of value, default, remove")
        if is_removed:
            scope.remove(name)
            return
        if default is not None and scope.has_name(name):
            return
        scope_name = node.get("scope", "")
        target_scope = {"parent": scope.parent, "global": scope.file_scope}.get(scope_name, scope)
        is_lazy = self._flag(node, "lazy_eval", scope, default="true")
        text = default if value is None else value
        if text is None:
            target_scope.blocks[name] = list(self._expand_nodes(list(node), scope))
        elif is_lazy and target_scope is scope:
            target_scope.set_text(name, str(text))
        else:
            target_scope.set_value(name, literal_of(scope.text(str(text))))

    def _flag(self, node: Node, attribute: str, scope: Scope, *, default: str) -> bool:
        text = str(node.get(attribute, default))
        value = literal_of(scope.text(text))
        if isinstance(value, str):
            raise ExpressionError(f"{attribute}={text[:60]!r} is neither true nor false")
        return bool(value)

    def _define(self, node: Node) -> None:
        name = require(node, "name").removeprefix("xacro:")
        parameters = parameters_of(node.get("params", ""))
        self._macros[name] = Macro(name, parameters, node, str(self._file))

    def _call_macro(self, node: Node, name: str, scope: Scope) -> Iterator[Node]:
        macro = self._macros.get(name)
        if macro is None:
            suggestion = choices(name, self._macros)
            raise ExpressionError(f"no macro is called {name[:60]!r}.{suggestion}")
        call_scope = self._bind_call(node, macro, scope)
        line = self._line or (None if macro.file == str(self._path) else self._line_of(node))
        with self._enter_file(Path(macro.file), line):
            elements = list(self._expand_nodes(list(macro.body), call_scope))
        yield from elements

    def _bind_call(self, node: Node, macro: Macro, scope: Scope) -> Scope:
        texts = {str(key): str(text) for key, text in node.attrib.items()}
        if etree.QName(node).localname == "call":
            texts.pop("macro", None)
        return macro.bind(texts, list(self._expand_nodes(list(node), scope)), scope)

    def _insert_block(self, node: Node, scope: Scope) -> Iterator[Node]:
        name = to_text(scope.text(require(node, "name")))
        block = scope.block(name)
        if block is None:
            raise ExpressionError(f"no block is called {name[:60]!r}")
        for element in block:
            self._n_nodes += 1 + sum(1 for _ in element.iter())
            if self._n_nodes <= MAX_NODES:
                yield copy.deepcopy(element)

    def _include(
        self, node: Node, attribute: str, scope: Scope, *, keeps_root: bool = False
    ) -> Iterator[Node]:
        """Yield the expanded content of a file; without its root element, unless ``keeps_root``."""
        name = to_text(scope.text(require(node, attribute)))
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
        nodes = [root] if keeps_root and not _is_stripped(root) else list(root)
        if remark := self._files.location_remark(name, path, self._file):
            self._file_diagnostics().warning(node, remark)
        with self._enter_file(path, self._line_of(node)):
            elements = list(self._expand_nodes(nodes, scope))
        yield from elements

    def _load_yaml(self, name: Value) -> Value:
        path = self._files.find(to_text(name), self._file)
        if path not in self._yaml_values:
            if len(self._yaml_values) >= MAX_FILES:
                raise ExpressionError(f"reads more than {MAX_FILES} YAML files")
            warn = self._diagnostics_of(path).warning
            self._yaml_values[path] = read_yaml(path, name=to_text(name), warn=warn)
        return self._yaml_values[path]

    @contextmanager
    def _enter_file(self, file: Path, line: int | None) -> Iterator[None]:
        previous_place = self._file, self._line
        if self._depth >= MAX_DEPTH:
            raise ExpressionError(f"calls and includes are nested deeper than {MAX_DEPTH} levels")
        self._depth += 1
        self._file, self._line = file, line
        try:
            yield
        finally:
            self._depth -= 1
            self._file, self._line = previous_place

    def _substitute(self, text: str) -> str:
        return substitute(text, self.arguments, self._file)


def _is_stripped(root: Node) -> bool:
    """Return whether the root of a file included by XInclude is removed.

    It is removed from a whole scene or robot, from a ``<fragment>``, and from a library of xacro.
    """
    if etree.QName(root).localname in ("UWSimScene", "robot", "fragment"):
        return True
    spaces = {namespace_of(child) for child in root.iterchildren("*")}
    return bool(spaces) and spaces <= XACRO
