r"""How a spec stands in XML: safe parsing, reading and writing of dataclasses, every fault at once.

.. code-block:: xml

    <rangeSensor> <name>sonar</name> <relativeTo>part0</relativeTo> <range>10</range> </rangeSensor>

A frozen dataclass is the grammar. Each field is an element (``relative_to`` is ``<relativeTo>``;
`element` says where it differs), its annotation says what may stand there, its documentation
string says what it means and, in brackets, its unit:

=========================  ====================================================================
annotation                 in the file
=========================  ====================================================================
``str``                    text, trimmed
``float``                  a number, or ``M_PI``, ``-M_PI_2`` ...; never NaN nor infinite
``int``                    a whole number; ``320.5`` is read as 320 with a notice, as atoi did
``bool``                   0 or 1 (attributes: true or false); else the default, with a notice
``Literal["a", "b"]``      one of these words
``tuple[float, x3]``       three elements, ``parts="xyz"`` (or ``rpy``, ``rgb``)
a dataclass                an element that is filled from its own fields
``tuple[T, ...]``          the element any number of times, or with ``item=`` one list of items
``tuple[Base, ...]``       with ``choice=TABLE``: an element whose children the table names
``T | None``               may be absent
=========================  ====================================================================

Elements stand in any order. Names without a namespace are the original's and nothing else;
extensions live in ``urn:uwsim:1``. A DTD is never loaded, an entity never expanded, the network
never asked. `Faults` in strict mode also holds a file against the order of the fields.

It is longer than most modules because reading and writing are two sides of one table.
"""

from __future__ import annotations

import ast
import dataclasses
import functools
import inspect
import itertools
import math
import re
import textwrap
import types
import typing
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import MISSING, dataclass
from pathlib import Path
from typing import Any, Literal, TypeVar, cast

from lxml import etree

from .errors import Fault, FileError, did_you_mean

NAMESPACE = "urn:uwsim:1"
"""Where extensions of both dialects live; its prefix is ``u``."""

MAX_BYTES = 16 * 2**20
MAX_DEPTH = 256
MAX_NODES = 100_000
MAX_FAULTS = 100

TOKENS = {
    "M_PI": math.pi,
    "M_PI_2": math.pi / 2,
    "M_PI_4": math.pi / 4,
    "-M_PI": -math.pi,
    "-M_PI_2": -math.pi / 2,
    "-M_PI_4": -math.pi / 4,
}
"""What may stand in the place of a number."""

BLANKS = " \t\n\r"
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_LEADING_INT = re.compile(r"[+-]?\d+", re.ASCII)
_DECLARATION = re.compile(rb"<!(ENTITY|ATTLIST|ELEMENT|NOTATION)\b")
_ENCODING = re.compile(rb"""^\s*<\?xml[^>]*?encoding\s*=\s*["']([A-Za-z0-9._-]+)["']""")
_ENCODINGS = re.compile(r"utf-?8|us-ascii|ascii|iso-?8859-\d+|latin-?1|windows-125\d", re.I)

T = TypeVar("T")


# --------------------------------------------------------------------------- files and faults


@dataclass(frozen=True, eq=False)
class Document:
    """A well-formed file."""

    path: Path
    """The file as the user named it."""
    root: etree._Element
    """Its root element."""
    has_doctype: bool
    """Whether it names a DTD (which is never loaded)."""


class Faults:
    """Collects what is wrong with one file; at most `MAX_FAULTS` in full, the others counted."""

    def __init__(self, file: Path | str, *, strict: bool = False) -> None:
        self.file = str(file)
        self.strict = strict
        self._found: list[Fault] = []
        self._uncounted = {"fault": 0, "notice": 0}
        self._nodes: dict[int, tuple[object, etree._Element]] = {}

    def add(self, node: etree._Element | int | None, message: str) -> None:
        """Say that something is wrong at ``node`` (or at a line number)."""
        self._append(node, message, "fault")

    def notice(self, node: etree._Element | int | None, message: str) -> None:
        """Say something worth knowing that does not make the file wrong."""
        self._append(node, message, "notice")

    def unknown(self, node: etree._Element, what: str, name: str, known: Iterable[str]) -> None:
        """Say that ``name`` is not one of ``known``, with the nearest right one."""
        near = did_you_mean(name, known) if self._has_room("fault") and len(name) < 80 else ""
        self.add(node, f"{what}.{near.replace(chr(39), '')}")

    def remember(self, spec: object, node: etree._Element) -> None:
        """Keep the element a spec was read from, so that later checks can name its line."""
        self._nodes[id(spec)] = (spec, node)

    def node_of(self, spec: object) -> etree._Element | None:
        """Return the element ``spec`` was read from."""
        return self._nodes.get(id(spec), (None, None))[1]

    @property
    def any(self) -> bool:
        """Whether the file is wrong (notices do not count)."""
        return any(fault.severity == "fault" for fault in self._found)

    def all(self) -> list[Fault]:
        """Everything found, in the order of the file."""
        found = sorted(self._found, key=lambda fault: fault.line or 0)
        for severity, count in self._uncounted.items():
            if count:
                message = f"and {count} more {severity}s"
                found.append(_fault(self.file, None, message, severity))
        return found

    def check(self, error: type[FileError] = FileError) -> None:
        """Raise ``error`` with every fault, if there is one."""
        if self.any:
            raise error([fault for fault in self.all() if fault.severity == "fault"])

    def _has_room(self, severity: str) -> bool:
        return sum(fault.severity == severity for fault in self._found) < MAX_FAULTS

    def _append(self, node: etree._Element | int | None, message: str, severity: str) -> None:
        if self._uncounted[severity] or not self._has_room(severity):
            self._uncounted[severity] += 1
            return
        line = cast(int | None, getattr(node, "sourceline", node))
        self._found.append(_fault(self.file, line, message, severity))


def _fault(file: str, line: int | None, message: str, severity: str) -> Fault:
    kind = cast(Literal["fault", "notice"], severity)
    return Fault(file=file, line=line, message=message, severity=kind)


def parse(path: Path, *, error: type[FileError] = FileError) -> Document:
    """Read a file as XML: no DTD, no entities, no network, bounded in size, depth and number.

    Raises:
        FileError: (or the ``error`` asked for) it cannot be read or is not well-formed.
    """
    faults = Faults(path)
    data = _bytes(path, faults)
    faults.check(error)
    parser = etree.XMLParser(
        resolve_entities=False,
        no_network=True,
        load_dtd=False,
        dtd_validation=False,
        attribute_defaults=False,
        huge_tree=False,
        encoding="utf-8" if data[:1] == b"\xff" else None,
    )
    root: etree._Element | None = None
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as problem:
        for entry in list(parser.error_log)[:10]:
            message = entry.message.replace("use XML_PARSE_HUGE option", "").strip()
            faults.add(entry.line, f"not well-formed XML: {message[:200]}")
        if not faults.any:
            faults.add(problem.lineno, f"not well-formed XML: {str(problem)[:200]}")
    except (ValueError, LookupError) as problem:
        faults.add(None, f"not well-formed XML: {str(problem)[:200]}")
    faults.check(error)
    assert root is not None
    return Document(path, root, root.getroottree().docinfo.internalDTD is not None)


def _bytes(path: Path, faults: Faults) -> bytes:
    """The bytes of a file that may be handed to the parser, or faults."""
    try:
        if not path.is_file():
            what = "is a folder, not a file" if path.is_dir() else "there is no such file"
            faults.add(None, what)
            return b""
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as problem:
        faults.add(None, f"cannot be read: {getattr(problem, 'strerror', None) or problem}")
        return b""
    if len(data) > MAX_BYTES:
        faults.add(None, f"larger than {MAX_BYTES // 2**20} MB; no scene or benchmark is")
        return b""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        data = data.decode("utf-16", errors="replace").encode("utf-8")
        data = re.sub(rb"^\s*<\?xml.*?\?>", b"", data, count=1, flags=re.S)
    declared = _ENCODING.match(data[:200])
    if declared and not _ENCODINGS.fullmatch(declared[1].decode("ascii")):
        name = declared[1].decode("ascii")
        if name.lower() != "utf-16":
            faults.add(1, f"the encoding {name!r} is not read; write the file as UTF-8")
    if b"\0" in data:
        faults.add(None, "holds zero bytes; not a text file in UTF-8")
    if declaration := _DECLARATION.search(data):
        line = data.count(b"\n", 0, declaration.start()) + 1
        word = declaration[1].decode("ascii")
        faults.add(line, f"<!{word}> declarations are not read; a DOCTYPE may only name the DTD")
    for mark, what in ((b"<", "elements"), (b"=", "attributes")):
        if data.count(mark) > 2 * MAX_NODES:
            faults.add(None, f"has more than {MAX_NODES} {what}; no scene or benchmark has")
    return data


def check_head(document: Document, root: str, faults: Faults) -> None:
    """Check the name of the root, and that a file with extensions carries no DOCTYPE."""
    tag = document.root.tag
    if tag != root:
        faults.add(document.root, f"the root element is {_shown_tag(str(tag))}; expected <{root}>")
    if document.has_doctype and (use := _first_extension(document.root)) is not None:
        faults.add(
            use,
            f"uses {NAMESPACE} and names a DOCTYPE; drop the DOCTYPE, so that the original "
            "refuses the file instead of playing something else",
        )


def _first_extension(root: etree._Element) -> etree._Element | None:
    mark = f"{{{NAMESPACE}}}"
    for node in root.iter("*"):
        names = [str(node.tag), *map(str, node.attrib)]
        if any(name.startswith(mark) for name in names):
            return node
    return None


# --------------------------------------------------------------------------- fields


@dataclass(frozen=True)
class _Xml:
    """What `element` keeps about a field."""

    name: str | None = None
    unit: str = ""
    attribute: bool = False
    text: bool = False
    namespaced: bool = False
    aliases: tuple[str, ...] = ()
    parts: str = "xyz"
    item: str | None = None
    choice: Mapping[str, type] | None = None
    minimum: float | None = None
    maximum: float | None = None
    above: float | None = None
    below: float | None = None
    invalid: bool | None = None
    lenient: bool = False
    required_by_dtd: bool = False
    pattern: str | None = None


def element(
    name: str | None = None,
    *,
    default: Any = MISSING,
    default_factory: Any = MISSING,
    unit: str = "",
    attribute: bool = False,
    text: bool = False,
    namespaced: bool = False,
    aliases: tuple[str, ...] = (),
    parts: str = "xyz",
    item: str | None = None,
    choice: Mapping[str, type] | None = None,
    minimum: float | None = None,
    maximum: float | None = None,
    above: float | None = None,
    below: float | None = None,
    invalid: bool | None = None,
    lenient: bool = False,
    required_by_dtd: bool = False,
) -> Any:
    """Make a dataclass field that stands in the file otherwise than its name alone would say.

    Args:
        name: of the element or attribute; the field's in camelCase when absent.
        default: when the element is absent or empty.
        default_factory: as in `dataclasses.field`.
        unit: for messages, when the documentation string does not name it in brackets.
        attribute: it is an attribute of the element that the spec is read from.
        text: it is the text of the element that the spec is read from.
        namespaced: it is an extension, ``u:name``.
        aliases: old names, read with a notice.
        parts: names of a triple's elements, one letter each.
        item: the element is a list; this is the name of its items.
        choice: name -> spec of the children that may stand in the element, in any number.
        minimum: smallest value allowed.
        maximum: largest value allowed.
        above: values must be greater.
        below: values must be less.
        invalid: what a flag that is neither 0 nor 1 is read as; the default when absent.
        lenient: junk behind a number is a notice, not a fault (the original used atof).
        required_by_dtd: the original's grammar wants it although it has a default.
    """
    xml = _Xml(
        name, unit, attribute, text, namespaced, aliases, parts, item, choice,
        minimum, maximum, above, below, invalid, lenient, required_by_dtd,
    )  # fmt: skip
    metadata = {"xml": xml}
    if default_factory is not MISSING:
        return dataclasses.field(default_factory=default_factory, metadata=metadata)
    return dataclasses.field(default=default, metadata=metadata)


@dataclass(frozen=True)
class Slot:
    """One field of a spec, ready to be read, written and documented."""

    field: str
    """Name of the dataclass field."""
    tag: str
    """Qualified name in the file."""
    kind: str
    """str, float, int, bool, word, triple, spec, choice, or hand (only its caller can read it)."""
    type: Any
    """The scalar's type, the spec, or the words of a Literal."""
    repeated: bool
    """Whether it is a tuple of these."""
    optional: bool
    """Whether None is allowed."""
    xml: _Xml
    """What `element` said."""
    default: Any
    """Its default; MISSING when it must be there."""
    owner: type
    """The spec it belongs to."""

    @property
    def shown(self) -> str:
        """The name as a user writes it."""
        return _local(self.tag)

    @property
    def doc(self) -> str:
        """Its documentation string."""
        return field_docs(self.owner).get(self.field, "")

    @property
    def unit(self) -> str:
        """Its unit, from `element` or the brackets of its documentation; may be empty."""
        if self.xml.unit:
            return self.xml.unit
        brackets = re.search(r"\[([^\]]+)\]", self.doc)
        return brackets[1] if brackets and self.kind in ("float", "int", "triple") else ""

    @property
    def expected(self) -> str:
        """What should have stood there, in words."""
        if self.kind == "word":
            return "one of " + ", ".join(repr(word) for word in self.type)
        if self.kind == "bool":
            return "true or false" if self.xml.attribute else "0 or 1"
        words = {"float": "a number", "triple": "a number", "int": "a whole number"}
        limits = [
            f"{sign} {limit:g}"
            for sign, limit in (
                (">=", self.xml.minimum),
                ("<=", self.xml.maximum),
                (">", self.xml.above),
                ("<", self.xml.below),
            )
            if limit is not None
        ]
        said = " ".join([words.get(self.kind, "text"), *(["and ".join(limits)] if limits else [])])
        return f"{said} [{self.unit}]" if self.unit else said


def camel(name: str) -> str:
    """``relative_to`` -> ``relativeTo``."""
    first, *others = name.split("_")
    return first + "".join(word.capitalize() for word in others)


def slots(cls: type) -> tuple[Slot, ...]:
    """The fields of a spec in their order, which is the order of the original grammar."""
    return _slots(cls)


@functools.cache
def _slots(cls: Hashable) -> tuple[Slot, ...]:
    assert isinstance(cls, type)
    hints = typing.get_type_hints(cls)
    return tuple(
        _slot(cls, field, hints[field.name])
        for field in dataclasses.fields(cls)
        if field.init and "path" not in field.metadata
    )


def _slot(cls: type, field: dataclasses.Field[Any], hint: Any) -> Slot:
    xml: _Xml = field.metadata.get("xml") or _Xml()
    tag = xml.name or camel(field.name)
    if xml.namespaced:
        tag = f"{{{NAMESPACE}}}{tag}"
    default: Any = field.default
    if field.default_factory is not MISSING:
        default = field.default_factory()
    optional, repeated = False, False
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        inner = [arg for arg in typing.get_args(hint) if arg is not type(None)]
        optional, hint = len(inner) < len(typing.get_args(hint)), inner[0]
    if _is_variadic(hint):
        repeated, hint = True, typing.get_args(hint)[0]
        if default is MISSING and xml.choice is None:
            default = MISSING
    kind, type_ = _kind(hint, xml)
    return Slot(field.name, tag, kind, type_, repeated, optional, xml, default, cls)


def _is_variadic(hint: Any) -> bool:
    return typing.get_origin(hint) is tuple and typing.get_args(hint)[-1] is Ellipsis


def _kind(hint: Any, xml: _Xml) -> tuple[str, Any]:
    if xml.choice is not None:
        return "choice", xml.choice
    if typing.get_origin(hint) is Literal:
        return "word", typing.get_args(hint)
    if typing.get_origin(hint) is tuple and typing.get_args(hint) == (float, float, float):
        return "triple", float
    if _is_variadic(hint) and xml.item:  # a repeated list: tuple[tuple[float, ...], ...]
        return "list", typing.get_args(hint)[0]
    if hint in (str, float, int, bool):
        return hint.__name__, hint
    if dataclasses.is_dataclass(hint) and not inspect.isabstract(hint):
        return "spec", hint
    return "hand", hint


@functools.cache
def field_docs(cls: type) -> dict[str, str]:
    """The documentation string under each field of a spec, inherited ones included."""
    docs: dict[str, str] = {}
    for base in reversed(cls.__mro__):
        if not dataclasses.is_dataclass(base):
            continue
        try:
            source = textwrap.dedent(inspect.getsource(base))
        except (OSError, TypeError):
            continue
        body = cast(ast.ClassDef, ast.parse(source).body[0]).body
        for here, after in itertools.pairwise(body):
            if (
                isinstance(here, ast.AnnAssign)
                and isinstance(here.target, ast.Name)
                and isinstance(after, ast.Expr)
                and isinstance(after.value, ast.Constant)
            ):
                docs[here.target.id] = inspect.cleandoc(str(after.value.value))
    return docs


# --------------------------------------------------------------------------- reading


class _Bad:
    """What a value that cannot be read is read as."""


_BAD = _Bad()


def read(
    cls: type[T],
    node: etree._Element,
    faults: Faults,
    *,
    given: Mapping[str, object] | None = None,
) -> T | None:
    """Fill a spec from an element; every fault goes into ``faults``.

    Args:
        cls: a dataclass.
        node: the element.
        faults: where to say what is wrong.
        given: fields that the caller has read by hand; their elements are not looked at.

    Returns:
        The spec, with defaults where optional values were faulty; None when it cannot be made.
    """
    table = slots(cls)
    values: dict[str, Any] = dict(given or {})
    found = _children(table, node, faults)
    _read_attributes(table, node, values, faults)
    for slot in table:
        if slot.field in values or slot.xml.attribute:
            continue
        value = _read_slot(slot, node, found.get(slot.field, []), faults)
        if value is not _BAD:
            values[slot.field] = value
    for slot in table:
        if slot.field not in values:
            if slot.default is MISSING:
                return None
            values[slot.field] = slot.default
    spec = cls(**values)
    faults.remember(spec, node)
    return spec


def read_choice(
    table: Mapping[str, type[T]],
    node: etree._Element,
    faults: Faults,
    *,
    read_one: Callable[[type[T], etree._Element, Faults], T | None] = read,
) -> tuple[T, ...]:
    """Read the children of an element, each by the spec that the table has under its name."""
    read_specs = []
    order = {tag: index for index, tag in enumerate(table)}
    last: tuple[int, str] = (-1, "")
    _refuse_text(node, faults)
    for attribute in node.attrib:
        _unknown_attribute(node, str(attribute), (), faults)
    for child in _elements(node, faults):
        tag = str(child.tag)
        if tag not in table:
            _unknown_element(child, node, table, faults)
            continue
        if faults.strict and order[tag] < last[0]:
            _misplaced(child, last[1], faults)
        last = max(last, (order[tag], tag))
        if (spec := read_one(table[tag], child, faults)) is not None:
            read_specs.append(spec)
    return tuple(read_specs)


def text_of(node: etree._Element, faults: Faults) -> str:
    """The text of a leaf, trimmed; of several pieces split by comments the last that says some."""
    said = ""
    for piece in (node.text, *(child.tail for child in node)):
        said = (piece or "").strip(BLANKS) or said
    for child in _elements(node, faults):
        faults.add(child, f"{_shown(child)} inside {_shown(node)}, where only text may stand")
    return said


def _children(
    table: tuple[Slot, ...], node: etree._Element, faults: Faults
) -> dict[str, list[etree._Element]]:
    """The child elements by field; unknown, repeated and misplaced ones are faults."""
    if any(slot.xml.text for slot in table):
        return {}
    by_tag = {slot.tag: (index, slot) for index, slot in enumerate(table) if not slot.xml.attribute}
    old = {alias: (index, slot) for index, slot in by_tag.values() for alias in slot.xml.aliases}
    found: dict[str, list[etree._Element]] = {}
    last: tuple[int, str] = (-1, "")
    _refuse_text(node, faults)
    for child in _elements(node, faults):
        tag = str(child.tag)
        entry = by_tag.get(tag) or old.get(tag)
        if entry is None:
            _unknown_element(child, node, by_tag, faults)
            continue
        index, slot = entry
        if tag not in by_tag:
            faults.notice(child, f"{_shown(child)} is an old name of <{slot.shown}>")
        if faults.strict and index < last[0] and not slot.xml.namespaced:
            _misplaced(child, last[1], faults)
        if not slot.xml.namespaced:
            last = max(last, (index, slot.shown))
        here = found.setdefault(slot.field, [])
        if here and not (slot.repeated and slot.kind != "choice" and _repeats(slot)):
            faults.add(
                child,
                f"{_shown(child)} stands twice in {_shown(node)} (first in line "
                f"{here[0].sourceline}); only one may",
            )
            continue
        here.append(child)
    return found


def _repeats(slot: Slot) -> bool:
    """Whether the element itself is repeated, rather than the items in it."""
    return slot.kind == "list" or slot.xml.item is None


def _read_attributes(
    table: tuple[Slot, ...], node: etree._Element, values: dict[str, Any], faults: Faults
) -> None:
    known = {slot.tag: slot for slot in table if slot.xml.attribute}
    for name, text in node.attrib.items():
        slot = known.get(str(name))
        if slot is None:
            _unknown_attribute(node, str(name), known, faults)
        elif slot.field not in values:
            value = _value(slot, str(text).strip(BLANKS), node, faults, _local(slot.tag) + "=")
            if value is not _BAD:
                values[slot.field] = value
    for slot in known.values():
        if slot.default is MISSING and slot.tag not in node.attrib and slot.field not in values:
            faults.add(node, f"{_shown(node)} lacks the attribute {slot.shown}")


def _read_slot(
    slot: Slot, parent: etree._Element, nodes: list[etree._Element], faults: Faults
) -> Any:
    """The value of a field that is not an attribute; _BAD when it is absent or faulty."""
    if slot.xml.text:
        return _leaf(slot, parent, faults)
    if not nodes:
        if slot.default is MISSING and slot.repeated and slot.kind != "hand" and _repeats(slot):
            faults.add(parent, f"{_shown(parent)} lacks <{slot.shown}>: at least one must stand")
        elif slot.default is MISSING or (faults.strict and slot.xml.required_by_dtd):
            faults.add(parent, f"{_shown(parent)} lacks <{slot.shown}>: {_purpose(slot)}")
        return _BAD
    if slot.kind == "choice":
        return read_choice(slot.type, nodes[0], faults)
    if slot.repeated and slot.kind == "list":
        return tuple(_read_list(slot, node, faults) for node in nodes)
    if slot.repeated and slot.xml.item:
        return _read_list(slot, nodes[0], faults)
    if slot.repeated:
        many = [_read_one(slot, node, faults) for node in nodes]
        return tuple(value for value in many if value is not _BAD)
    return _read_one(slot, nodes[0], faults)


def _read_one(slot: Slot, node: etree._Element, faults: Faults) -> Any:
    if slot.kind == "spec":
        spec = read(slot.type, node, faults)
        return _BAD if spec is None else spec
    for name in node.attrib:
        _unknown_attribute(node, str(name), (), faults)
    if slot.kind == "triple":
        return _read_triple(slot, node, faults)
    return _leaf(slot, node, faults)


def _leaf(slot: Slot, node: etree._Element, faults: Faults) -> Any:
    text = text_of(node, faults)
    if not text:
        if slot.default is MISSING:
            faults.add(node, f"{_shown(node)} is empty; expected {slot.expected}")
        return _BAD
    return _value(slot, text, node, faults, _shown(node))


def _read_triple(slot: Slot, node: etree._Element, faults: Faults) -> Any:
    values: dict[str, float] = {}
    seen: set[str] = set()
    _refuse_text(node, faults)
    for child in _elements(node, faults):
        tag = str(child.tag)
        if tag not in tuple(slot.xml.parts):
            _unknown_element(child, node, tuple(slot.xml.parts), faults)
        elif tag in seen:
            faults.add(child, f"<{tag}> stands twice in {_shown(node)}; only one may")
        else:
            seen.add(tag)
            text = text_of(child, faults)
            shown = f"<{tag}> of {_shown(node)}"
            value = _value(slot, text, child, faults, shown) if text else 0.0
            if not isinstance(value, _Bad):
                values[tag] = value
    if lacking := [f"<{part}>" for part in slot.xml.parts if part not in seen]:
        faults.add(node, f"{_shown(node)} lacks {', '.join(lacking)}")
    if len(values) < len(slot.xml.parts):
        return _BAD
    return tuple(values[part] for part in slot.xml.parts)


def _read_list(slot: Slot, node: etree._Element, faults: Faults) -> tuple[Any, ...]:
    values = []
    assert slot.xml.item is not None
    _refuse_text(node, faults)
    scalar = dataclasses.replace(slot, kind="float", type=float) if slot.kind == "list" else slot
    for child in _elements(node, faults):
        if child.tag != slot.xml.item:
            _unknown_element(child, node, (slot.xml.item,), faults)
        elif (value := _read_one(scalar, child, faults)) is not _BAD:
            values.append(value)
    return tuple(values)


def _value(slot: Slot, text: str, node: etree._Element, faults: Faults, shown: str) -> Any:
    """A scalar from its text."""
    value: Any = _BAD
    if slot.kind == "str":
        value = text
    elif slot.kind in ("float", "triple"):
        value = number(text)
        if value is None and slot.xml.lenient and (leading := _NUMBER.match(text)):
            value = number(leading[0])
            faults.notice(node, f"{shown} is {_cut(text)}; read as {value:g}, as the original does")
        value = _BAD if value is None else value
    elif slot.kind == "int":
        leading = _LEADING_INT.match(text)
        if leading and len(leading[0]) < 12 and abs(int(leading[0])) < 2**31:
            value = int(leading[0])
            if leading[0] != text:
                faults.notice(
                    node, f"{shown} is {_cut(text)}; read as {value}, as the original does"
                )
    elif slot.kind == "bool":
        value = {"0": False, "1": True}.get(text, _BAD)
        if slot.xml.attribute and value is _BAD:
            value = {"false": False, "true": True}.get(text, _BAD)
        if value is _BAD and not slot.xml.attribute:
            value = slot.default if slot.xml.invalid is None else slot.xml.invalid
            faults.notice(
                node,
                f"{shown} is {_cut(text)}; expected 0 or 1; read as {value:d}, "
                "as the original does",
            )
    elif slot.kind == "word" and text in slot.type:
        value = text
    if value is not _BAD and slot.kind in ("float", "int", "triple") and not _within(slot, value):
        value = _BAD
    if value is _BAD:
        near = did_you_mean(text, slot.type) if slot.kind == "word" and len(text) < 80 else ""
        faults.add(node, f"{shown} is {_cut(text)}; expected {slot.expected}.{near}".rstrip("."))
    return value


def number(text: str) -> float | None:
    """A number or an ``M_PI`` token; None when it is neither, or not finite."""
    if text in TOKENS:
        return TOKENS[text]
    if len(text) > 400 or not _NUMBER.fullmatch(text):
        return None
    value = float(text)
    return value if math.isfinite(value) else None


def _within(slot: Slot, value: float) -> bool:
    xml = slot.xml
    return not (
        (xml.minimum is not None and value < xml.minimum)
        or (xml.maximum is not None and value > xml.maximum)
        or (xml.above is not None and value <= xml.above)
        or (xml.below is not None and value >= xml.below)
    )


def _elements(node: etree._Element, faults: Faults) -> Iterator[etree._Element]:
    """The child elements; comments and instructions are skipped, entities are faults."""
    for child in node:
        if isinstance(child.tag, str):
            yield child
        elif isinstance(child, etree._Entity):
            faults.add(node, f"{_cut(child.text or '')} in {_shown(node)}: entities are not read")


def _refuse_text(node: etree._Element, faults: Faults) -> None:
    for piece in (node.text, *(child.tail for child in node)):
        if stray := (piece or "").strip(BLANKS):
            faults.add(node, f"stray text {_cut(stray)} in {_shown(node)}")
            return


def _unknown_element(
    child: etree._Element, parent: etree._Element, known: Iterable[str], faults: Faults
) -> None:
    names = [_local(name) for name in known]
    faults.unknown(
        child, f"{_shown(child)} is not an element of {_shown(parent)}", _local(str(child.tag)),
        names,
    )  # fmt: skip


def _unknown_attribute(
    node: etree._Element, name: str, known: Iterable[str], faults: Faults
) -> None:
    names = [_local(each) for each in known]
    shown = _shown_tag(name)[1:-1]
    faults.unknown(node, f"{shown} is not an attribute of {_shown(node)}", _local(name), names)


def _misplaced(child: etree._Element, after: str, faults: Faults) -> None:
    faults.add(child, f"{_shown(child)} stands behind <{after}>; the original wants it before")


def _purpose(slot: Slot) -> str:
    """What a missing element would say: the first sentence of its documentation."""
    return slot.doc.split(". ")[0].replace("\n", " ").rstrip(".").lower() or slot.expected


def _shown(node: etree._Element) -> str:
    return _shown_tag(str(node.tag))


def _shown_tag(tag: str) -> str:
    if tag.startswith("{"):
        space, _, local = tag[1:].partition("}")
        return f"<u:{local[:60]}>" if space == NAMESPACE else f"<{local[:60]}> (in {space[:60]!r})"
    return f"<{tag[:60]}>"


def _local(tag: str) -> str:
    return tag.replace(f"{{{NAMESPACE}}}", "u:")


def _cut(text: str) -> str:
    return repr(text if len(text) <= 60 else text[:57] + "...")


# --------------------------------------------------------------------------- writing


def write(spec: object, tag: str) -> etree._Element:
    """Write a spec as an element; what equals its default is left out (``read`` brings it back)."""
    node = etree.Element(tag, nsmap={"u": NAMESPACE} if uses_extensions(spec) else None)
    _fill(node, spec)
    return node


def uses_extensions(spec: object) -> bool:
    """Whether any field of the namespace ``u`` of a spec, at any depth, is not its default."""
    if isinstance(spec, tuple):
        return any(uses_extensions(item) for item in spec)
    if not dataclasses.is_dataclass(spec) or isinstance(spec, type):
        return False
    return any(
        (slot.xml.namespaced and getattr(spec, slot.field) != slot.default)
        or uses_extensions(getattr(spec, slot.field))
        for slot in slots(type(spec))
    )  # fmt: skip


def _fill(node: etree._Element, spec: object) -> None:
    for slot in slots(type(spec)):
        value = getattr(spec, slot.field)
        if value is None or (value == slot.default and not slot.xml.required_by_dtd):
            continue
        if slot.xml.attribute:
            node.set(slot.tag, _text(value, attribute=True))
        elif slot.xml.text:
            node.text = _text(value)
        elif slot.kind == "choice":
            box = etree.SubElement(node, slot.tag)
            names = {cls: name for name, cls in slot.type.items()}
            for item in value:
                _fill(etree.SubElement(box, names[type(item)]), item)
        elif slot.kind == "list":
            for items in value:
                _write_items(etree.SubElement(node, slot.tag), slot, items)
        elif slot.repeated and slot.xml.item:
            _write_items(etree.SubElement(node, slot.tag), slot, value)
        else:
            for item in value if slot.repeated else (value,):
                _write_one(etree.SubElement(node, slot.tag), slot, item)


def _write_items(node: etree._Element, slot: Slot, items: Iterable[Any]) -> None:
    assert slot.xml.item is not None
    for item in items:
        etree.SubElement(node, slot.xml.item).text = _text(item)


def _write_one(node: etree._Element, slot: Slot, value: Any) -> None:
    if slot.kind == "spec":
        _fill(node, value)
    elif slot.kind == "triple":
        for part, number_ in zip(slot.xml.parts, value, strict=True):
            etree.SubElement(node, part).text = _text(number_)
    else:
        node.text = _text(value)


def _text(value: Any, *, attribute: bool = False) -> str:
    if isinstance(value, bool):
        return str(value).lower() if attribute else str(int(value))
    return repr(value) if isinstance(value, float) else str(value)
