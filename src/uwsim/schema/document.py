"""Parsing of XML files without DTD, entities and network, and with limits of size and depth."""

from __future__ import annotations

import re
import textwrap
from dataclasses import dataclass
from pathlib import Path

from lxml import etree

from ..base.files.input_files import read_bytes
from ..errors import AssetError, Diagnostic, FileError
from .diagnostics import Diagnostics
from .names import NAMESPACE, format_tag

MAX_BYTES = 16 * 2**20
"""The size of the largest file that is read [bytes]."""
MAX_DEPTH = 256
"""The deepest nesting of elements that is read: the limit of the parser, libxml2."""
MAX_NODES = 50_000
"""The greatest number of elements: a file may have twice as many of each of ``<``, ``=``, ``&``."""

_VERSION = re.compile(rb"""^(\s*<\?xml\s+version\s*=\s*["'])(?!1\.)\d+\.\d+(?=["'])""")
"""A version of XML that does not exist; some robot files of PyBullet have one, which is ignored."""
_DECLARATION = re.compile(rb"<!(ENTITY|ATTLIST|ELEMENT|NOTATION)\b")
_ENCODING = re.compile(rb"""^\s*<\?xml[^>]*?encoding\s*=\s*["']([A-Za-z0-9._-]+)["']""")
_ENCODINGS = re.compile(r"utf-?8|us-ascii|ascii|iso-?8859-\d+|latin-?1|windows-125\d", re.I)

CHARACTER_MESSAGES = {
    "xmlParseEntityRef: no name": "a bare '&'; write &amp;",
    "EntityRef: expecting ';'": "a bare '&'; write &amp;",
    "StartTag: invalid element name": "a '<' that begins no element; for 'less than' write &lt;",
}
"""Messages about characters with a meaning in XML: parts of the parser's message, by ours."""
_LATIN_1 = re.compile(r"latin-?1", re.I)


@dataclass(frozen=True, kw_only=True)
class Expansion:
    """The arguments and warnings of the xacro expansion of a file."""

    arguments: tuple[tuple[str, str], ...] = ()
    """The names and values of the arguments of the caller, sorted by name."""
    declared_arguments: tuple[str, ...] = ()
    """The names of the arguments that the file and its included files declare, sorted."""
    warnings: tuple[Diagnostic, ...] = ()
    """The warnings about included files that were found at another path than the one written."""


@dataclass(frozen=True, eq=False)
class Document:
    """A well-formed XML file."""

    path: Path
    """The file as the user named it."""
    root: etree._Element
    """The root element."""
    has_doctype: bool
    """True if the file names a DTD (which is never loaded)."""
    expansion: Expansion = Expansion()
    """The xacro expansion of the file."""


def parse(
    path: Path, *, error: type[FileError] = FileError, allows_undeclared_prefixes: bool = False
) -> Document:
    """Parse an XML file without DTD, entities and network, and with limits of size and depth.

    Args:
        path: the file.
        error: the class of the error.
        allows_undeclared_prefixes: True to keep prefixes that no ``xmlns`` declares in the names of
            elements and attributes, as programs do that know no namespaces.

    Raises:
        FileError: (or the class ``error``) the file cannot be read or is not well-formed.
    """
    diagnostics = Diagnostics(path)
    data = _read_valid_bytes(path, diagnostics)
    diagnostics.check(error)
    parser = _make_parser(data)
    root: etree._Element | None = None
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as problem:
        if allows_undeclared_prefixes and _has_undeclared_prefixes_alone(parser):
            return _parse_with_prefixes(path, data)
        messages: dict[int, str] = {}  # by line: the first error causes the others of its line
        for entry in parser.error_log:
            messages.setdefault(entry.line, _syntax_message(entry, data))
        for line, message in list(messages.items())[:10]:
            diagnostics.error(line, f"not well-formed XML: {message}")
        if not diagnostics.has_errors:
            diagnostics.error(problem.lineno, f"not well-formed XML: {str(problem)[:200]}")
    except (ValueError, LookupError) as problem:
        diagnostics.error(None, f"not well-formed XML: {str(problem)[:200]}")
    diagnostics.check(error)
    assert root is not None
    return Document(path, root, root.getroottree().docinfo.internalDTD is not None)


def _make_parser(data: bytes, *, recover: bool = False) -> etree.XMLParser:
    return etree.XMLParser(
        recover=recover,
        resolve_entities=False,
        no_network=True,
        load_dtd=False,
        dtd_validation=False,
        attribute_defaults=False,
        huge_tree=False,
        encoding="utf-8" if data[:1] == b"\xff" else None,
    )


def _has_undeclared_prefixes_alone(parser: etree.XMLParser) -> bool:
    return all(entry.type_name == "NS_ERR_UNDEFINED_NAMESPACE" for entry in parser.error_log)


def _parse_with_prefixes(path: Path, data: bytes) -> Document:
    """Parse a file that is well-formed but for prefixes that it does not declare."""
    root = etree.fromstring(data, _make_parser(data, recover=True))
    return Document(path, root, root.getroottree().docinfo.internalDTD is not None)


def _syntax_message(entry: etree._LogEntry, data: bytes) -> str:
    text = data.rstrip()
    if (
        entry.line > text.count(b"\n")
        and not text.endswith(b">")
        and not entry.message.startswith(("Extra content", "Start tag expected"))
    ):
        return "the file ends in the middle; its end is missing"
    for parser_message, replacement in CHARACTER_MESSAGES.items():
        if parser_message in entry.message:
            return replacement
    if entry.message.startswith("Namespace prefix u on "):
        return f'{entry.message}; write <UWSimScene xmlns:u="{NAMESPACE}">, also in another root'
    message = re.sub(r",? (use|try) XML_PARSE_HUGE( option)?", "", entry.message)
    return textwrap.shorten(message, 200, placeholder=" ...")


def _path_fault(path: Path) -> str:
    if path.is_dir():
        return "is a folder, not a file"
    return "is not a regular file" if path.exists() else "there is no such file"


def _read_valid_bytes(path: Path, diagnostics: Diagnostics) -> bytes:
    try:
        if not path.is_file():
            diagnostics.error(None, _path_fault(path))
            return b""
        data = read_bytes(path, at_most=MAX_BYTES)
    except AssetError:
        diagnostics.error(None, f"larger than {MAX_BYTES // 2**20} MB, the limit")
        return b""
    except (OSError, ValueError) as problem:
        diagnostics.error(None, f"cannot be read: {getattr(problem, 'strerror', None) or problem}")
        return b""
    if not data.strip():
        diagnostics.error(None, "not well-formed XML: the file is empty")
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        data = data.decode("utf-16", errors="replace").encode("utf-8")
        data = re.sub(rb"^\s*<\?xml.*?\?>", b"", data, count=1, flags=re.S)
    data = _VERSION.sub(rb"\g<1>1.0", data, count=1)
    encoding = _ENCODING.match(data[:200])
    if encoding and not _ENCODINGS.fullmatch(encoding[1].decode("ascii")):
        name = encoding[1].decode("ascii")
        if name.lower() != "utf-16":
            diagnostics.error(1, f"the encoding {name!r} is not read; write the file as UTF-8")
    if encoding and _LATIN_1.fullmatch(encoding[1].decode("ascii")):  # unknown to the parser
        data = data[: encoding.start(1)] + b"ISO-8859-1" + data[encoding.end(1) :]
    if encoding is None:
        _check_utf_8(data, diagnostics)
    if b"\0" in data:
        diagnostics.error(None, "contains zero bytes; expected a text file in UTF-8")
    if declaration := _DECLARATION.search(data):
        line = data.count(b"\n", 0, declaration.start()) + 1
        word = declaration[1].decode("ascii")
        diagnostics.error(
            line, f"<!{word}> declarations are not read; a DOCTYPE may only name the DTD"
        )
    for mark, counted_parts in ((b"<", "elements"), (b"=", "attributes"), (b"&", "references")):
        if data.count(mark) > 2 * MAX_NODES:
            diagnostics.error(None, f"has more than {MAX_NODES} {counted_parts}, the limit")
    return data


def _check_utf_8(data: bytes, diagnostics: Diagnostics) -> None:
    try:
        data.decode("utf-8")
    except UnicodeDecodeError as problem:
        line = data.count(b"\n", 0, problem.start) + 1
        diagnostics.error(
            line,
            f"not well-formed XML: the byte {data[problem.start]:#04x} is not UTF-8; save the file "
            'as UTF-8, or declare what it is: <?xml version="1.0" encoding="ISO-8859-1"?>',
        )


def check_head(document: Document, root: str, diagnostics: Diagnostics) -> None:
    """Check the name of the root, and that a file with extensions has no DOCTYPE."""
    tag = document.root.tag
    if tag != root:
        diagnostics.error(
            document.root, f"the root element is {format_tag(str(tag))}; expected <{root}>"
        )
    if document.has_doctype and (extension := _first_extension(document.root)) is not None:
        diagnostics.error(
            extension,
            f"uses {NAMESPACE} and names a DOCTYPE; remove the DOCTYPE, so that the original "
            "rejects the file instead of running something else",
        )


def _first_extension(root: etree._Element) -> etree._Element | None:
    mark = f"{{{NAMESPACE}}}"
    for node in root.iter("*"):
        names = [str(node.tag), *map(str, node.attrib)]
        if any(name.startswith(mark) for name in names):
            return node
    return None
