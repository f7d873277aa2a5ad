"""Reader of DataFlash logs (``.bin``) of ArduPilot: messages whose formats the file describes.

A message begins with the bytes A3 95 and the number of its type. Type 128 (``FMT``) describes a
type: its number, length, name, a letter for each field, and the names of the fields. The letters
are those of the logger of ArduPilot; ``c``, ``C``, ``e``, ``E`` are hundredths, ``L`` 1e-7 degrees.
"""

from __future__ import annotations

import struct
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from ..base.files.input_files import read_document
from ..errors import Diagnostic
from .csv_log import LogError
from .limits import MAX_BYTES

HEAD = b"\xa3\x95"
"""The first bytes of a message."""
FORMAT_TYPE = 128
"""The number of the type that describes types."""
FORMAT_LENGTH = 89
"""The length of a message of that type [bytes]."""
MAX_LOST_BYTES = 64 * 1024
"""The greatest number of bytes that belong to no message, in the whole file."""
CODES: Mapping[str, tuple[str, float | None]] = {
    "a": ("64s", None),
    "b": ("b", 1.0),
    "B": ("B", 1.0),
    "h": ("h", 1.0),
    "H": ("H", 1.0),
    "i": ("i", 1.0),
    "I": ("I", 1.0),
    "f": ("f", 1.0),
    "d": ("d", 1.0),
    "g": ("e", 1.0),
    "n": ("4s", None),
    "N": ("16s", None),
    "Z": ("64s", None),
    "c": ("h", 0.01),
    "C": ("H", 0.01),
    "e": ("i", 0.01),
    "E": ("I", 0.01),
    "L": ("i", 1e-7),
    "M": ("B", 1.0),
    "q": ("q", 1.0),
    "Q": ("Q", 1.0),
}
"""The code of `struct` and the factor of each letter; None: a text."""

Value = float | str
"""A number, or a text."""


@dataclass(frozen=True, kw_only=True)
class MessageFormat:
    """The format of a type of messages."""

    name: str
    """The name of the type."""
    columns: tuple[str, ...]
    """The names of the fields."""
    letters: str
    """The letters of the fields."""
    layout: struct.Struct
    """The layout of the fields after the three bytes of the head."""

    def decode(self, data: bytes, offset: int) -> dict[str, Value]:
        """Return the fields of a message whose fields begin at an offset."""
        values = self.layout.unpack_from(data, offset)
        fields: dict[str, Value] = {}
        for column, letter, value in zip(self.columns, self.letters, values, strict=True):
            factor = CODES[letter][1]
            if factor is None:
                fields[column] = value.split(b"\0", 1)[0].decode("ascii", "replace")
            else:
                fields[column] = float(value) * factor
        return fields


def read_messages(
    path: Path, names: Collection[str], remarks: list[str]
) -> Iterator[tuple[str, dict[str, Value]]]:
    """Yield the name and the fields of the messages of some types, in the order of the file.

    Bytes that belong to no message are skipped, which a remark states; a log that ends within a
    message, because the power failed, is valid.

    Args:
        path: the file.
        names: the names of the types to decode.
        remarks: the list to which repairs are added.

    Raises:
        LogError: the file cannot be read, is no DataFlash log, or is damaged; with the offset.
    """
    try:
        data = read_document(path, at_most=MAX_BYTES)
    except Exception as error:
        raise LogError(getattr(error, "diagnostics", ())) from None
    if not data.startswith(HEAD):
        raise _error(path, "is not a DataFlash log: its first bytes are not A3 95")
    formats: dict[int, MessageFormat] = {}
    lengths = {FORMAT_TYPE: FORMAT_LENGTH}
    offset, n_lost, end = 0, 0, len(data)
    while offset + 3 <= end:
        length = lengths.get(data[offset + 2]) if data[offset : offset + 2] == HEAD else None
        if length is None:
            step = data.find(HEAD, offset + 1)
            step = (end if step < 0 else step) - offset
            n_lost += step
            if n_lost > MAX_LOST_BYTES:
                raise _error(
                    path,
                    f"more than {MAX_LOST_BYTES} bytes belong to no message, at offset {offset}",
                )
            offset += step
            continue
        if offset + length > end:
            remarks.append("the log ends within a message.")
            break
        kind = data[offset + 2]
        if kind == FORMAT_TYPE:
            _add_format(path, data, offset, formats, lengths)
        elif formats[kind].name in names:
            yield formats[kind].name, formats[kind].decode(data, offset + 3)
        offset += length
    if n_lost:
        remarks.append(f"{n_lost} bytes of the file belong to no message; skipped.")


def _add_format(
    path: Path,
    data: bytes,
    offset: int,
    formats: dict[int, MessageFormat],
    lengths: dict[int, int],
) -> None:
    kind, length = data[offset + 3], data[offset + 4]
    texts = struct.unpack_from("<4s16s64s", data, offset + 5)
    name, letters, columns_text = (
        text.split(b"\0", 1)[0].decode("ascii", "replace") for text in texts
    )
    columns = tuple(columns_text.split(",")) if columns_text else ()
    unknown_letters = sorted(set(letters) - set(CODES))
    if unknown_letters or len(letters) != len(columns) or kind == FORMAT_TYPE:
        if kind != FORMAT_TYPE and length > 3:
            lengths.setdefault(kind, length)
            formats.setdefault(
                kind,
                MessageFormat(name="", columns=(), letters="", layout=struct.Struct("<")),
            )
        return
    layout = struct.Struct("<" + "".join(CODES[letter][0] for letter in letters))
    if layout.size + 3 != length:
        raise _error(
            path,
            f"offset {offset}: the format of {name!r} has {layout.size + 3} bytes; its length is "
            f"{length}",
        )
    formats[kind] = MessageFormat(name=name, columns=columns, letters=letters, layout=layout)
    lengths[kind] = length


def _error(path: Path, message: str) -> LogError:
    return LogError([Diagnostic(file=str(path), line=None, message=message)])
