"""Parser of VRML 97 (ISO/IEC 14772-1) and of X3D in ClassicVRML encoding.

Prototypes are not expanded: their instances are left out. Scripts and routes are skipped.
"""

from __future__ import annotations

import bisect
import re
import zlib
from typing import Any

import numpy as np

from .node import MAX_DEPTH, MAX_NODES, GraphError, Node

MAX_TEXT_BYTES = 64 * 2**20
"""The greatest size of a text, also of one that is compressed in the file [bytes]."""
_SPACE = re.compile(r"(?:[\s,]+|#[^\n]*)*")
_WORD = re.compile(r'[^\s,{}\[\]"#]+')
_STRING = re.compile(r'"((?:[^"\\]|\\.)*)"', re.DOTALL)
_NUMBER = re.compile(r"[+-]?(?:0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)")
_NUMBERS = re.compile(r"[-+.\deE\s,]*")
_COMMENT = re.compile(r"#[^\n]*")
SKIPPED_NODES = ("Script", "ComposedShader", "ShaderProgram", "PackagedShader")


def decode(data: bytes) -> str:
    """Return the text of a file, which may be compressed by gzip.

    Raises:
        ValueError: the text is too large, or is not gzip.
    """
    if data[:2] == b"\x1f\x8b":
        stream = zlib.decompressobj(wbits=31)
        try:
            data = stream.decompress(data, MAX_TEXT_BYTES + 1)
        except zlib.error as error:
            raise ValueError(f"the compressed text is damaged ({error})") from error
    if len(data) > MAX_TEXT_BYTES:
        raise ValueError(f"is text of more than {MAX_TEXT_BYTES >> 20} MiB; write it as .glb")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def parse_vrml(text: str) -> list[Node]:
    """Return the root nodes of a VRML file.

    Raises:
        GraphError: it is not VRML 97 or X3D ClassicVRML, or is damaged; with the line.
    """
    if not re.match(r"#(VRML V2\.0|X3D V\d)", text):
        first_line = text[:20].splitlines()[0] if text.strip() else "nothing"
        raise GraphError(1, f"begins with {first_line!r}; expected '#VRML V2.0 utf8' or '#X3D V3'")
    return _Parser(text).read_file()


class _Parser:
    """The parser of one text."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._place = 0
        self._depth = 0
        self._n_nodes = 0
        self._defined_nodes: dict[str, Node] = {}
        self._prototypes: set[str] = set()
        self._line_ends = [match.start() for match in re.finditer("\n", text)]

    def read_file(self) -> list[Node]:
        """Return the root nodes."""
        roots: list[Node] = []
        while word := self._word():
            node = self._statement(word)
            if node is not None:
                roots.append(node)
        return roots

    def _statement(self, word: str) -> Node | None:
        """Read what follows a word at the beginning of a statement."""
        if word == "PROTO" or word == "EXTERNPROTO":
            self._prototypes.add(self._word())
            self._skip_balanced("[", "]")
            if word == "PROTO":
                self._skip_balanced("{", "}")
            else:
                self._value()
            return None
        if word == "ROUTE":
            for _ in range(3):
                self._word()
            return None
        if word in ("PROFILE", "COMPONENT"):
            self._word()
            return None
        if word in ("META", "UNIT"):
            self._skip_words(2 if word == "META" else 3)
            return None
        return self._node(word)

    def _skip_words(self, count: int) -> None:
        for _ in range(count):
            if self._string() is None:
                self._word()

    def _node(self, word: str) -> Node | None:
        """Read a node whose first word is read; None for an instance of a prototype."""
        if word == "USE":
            name = self._word()
            return self._defined_nodes.get(name)
        name = ""
        if word == "DEF":
            name, word = self._word(), self._word()
        line = self._line()
        if self._peek() != "{":
            raise GraphError(line, f"found {word[:40]!r}; expected a node")
        self._n_nodes += 1
        self._depth += 1
        if self._n_nodes > MAX_NODES or self._depth > MAX_DEPTH:
            raise GraphError(line, f"more than {MAX_NODES} nodes, or {MAX_DEPTH} in each other")
        node = Node(kind=word, line=line)
        if word in SKIPPED_NODES or word in self._prototypes:
            self._skip_balanced("{", "}")
        else:
            self._place += 1
            self._fields(node)
        self._depth -= 1
        if name:
            self._defined_nodes[name] = node
        return node

    def _fields(self, node: Node) -> None:
        while True:
            if self._peek() == "}":
                self._place += 1
                return
            word = self._word()
            if not word:
                raise GraphError(node.line, f"{node.kind} has no end")
            if word in ("ROUTE", "PROTO", "EXTERNPROTO"):
                self._statement(word)
            else:
                node.fields[word] = self._value()

    def _value(self) -> Any:
        """Read the value of a field: numbers, texts, nodes, or a word."""
        mark = self._peek()
        if mark == "[":
            self._place += 1
            return self._list()
        if mark == '"':
            return self._string()
        number = _NUMBER.match(self._text, self._place)
        if number is not None:
            values = []
            while number is not None:
                values.append(_to_float(number[0]))
                self._place = number.end()
                self._peek()
                number = _NUMBER.match(self._text, self._place)
            return np.array(values)
        word = self._word()
        if word in ("TRUE", "FALSE", "NULL", ""):
            return word
        if word == "IS":
            self._word()
            return None
        return self._node(word)

    def _list(self) -> Any:
        """Read a list, whose bracket is read."""
        numbers = self._number_list()
        if numbers is not None:
            return numbers
        entries: list[Any] = []
        while True:
            mark = self._peek()
            if mark == "]":
                self._place += 1
                return entries
            if not mark:
                raise GraphError(self._line(), "a list has no end")
            if mark == '"':
                entries.append(self._string())
                continue
            word = self._word()
            if not word:
                raise GraphError(self._line(), f"found {mark!r} in a list")
            entries.append(word if word in ("TRUE", "FALSE") else self._statement(word))

    def _number_list(self) -> np.ndarray | None:
        """Read a list of numbers at once; None if it is another list."""
        end = self._text.find("]", self._place)
        if end < 0:
            return None
        content = self._text[self._place : end]
        if '"' in content:
            return None
        if "#" in content:
            content = _COMMENT.sub("", content)
        if not _NUMBERS.fullmatch(content):
            return None
        try:
            numbers = np.array(content.replace(",", " ").split(), dtype=np.float64)
        except ValueError as error:
            raise GraphError(self._line(), f"a list has a wrong number ({error})") from error
        self._place = end + 1
        return numbers

    def _peek(self) -> str:
        """Return the next character behind blanks and comments; "" at the end."""
        match = _SPACE.match(self._text, self._place)
        assert match is not None  # it may be empty
        self._place = match.end()
        return self._text[self._place : self._place + 1]

    def _word(self) -> str:
        """Read a word; "" if none follows."""
        self._peek()
        match = _WORD.match(self._text, self._place)
        if match is None:
            if self._place < len(self._text):
                raise GraphError(
                    self._line(), f"found {self._text[self._place]!r}; expected a name"
                )
            return ""
        self._place = match.end()
        return match[0]

    def _string(self) -> str | None:
        if self._peek() != '"':
            return None
        match = _STRING.match(self._text, self._place)
        if match is None:
            raise GraphError(self._line(), "a text has no end")
        self._place = match.end()
        return match[1].replace('\\"', '"').replace("\\\\", "\\")

    def _skip_balanced(self, start: str, end: str) -> None:
        """Skip a part in brackets, texts and comments in it included."""
        line, depth = self._line(), 0
        while mark := self._peek():
            if mark == '"':
                self._string()
                continue
            self._place += 1
            depth += (mark == start) - (mark == end)
            if depth == 0:
                return
        raise GraphError(line, f"a {start!r} has no end")

    def _line(self) -> int:
        return bisect.bisect_left(self._line_ends, self._place) + 1


def _to_float(text: str) -> float:
    return float(int(text, 16)) if "x" in text.lower() else float(text)
