"""Sentences of NMEA 0183: ``$`` + address + fields + ``*`` + checksum in two hexadecimal digits.

Source: IEC 61162-1, as described by E. S. Raymond, "NMEA Revealed", gpsd.gitlab.io/gpsd/NMEA.html.
An empty field means that a value is not known.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ...errors import BadMessage
from .checksums import xor_checksum

MAX_LENGTH = 512
"""The greatest length of a sentence that is read [bytes]; the standard allows 82."""


@dataclass(frozen=True)
class Sentence:
    """An address, such as ``GPGGA``, and its fields."""

    address: str
    """The talker and the type of the sentence."""
    fields: tuple[str, ...]
    """The texts of the fields."""

    def to_bytes(self) -> bytes:
        """Return the sentence with its checksum and its end of line."""
        body = ",".join((self.address, *self.fields)).encode("ascii")
        return b"$%s*%02X\r\n" % (body, xor_checksum(body))

    def number(self, index: int) -> float:
        """Return the number in a field; NaN if the field is empty; raise BadMessage."""
        text = self.text(index)
        return parse_number(text, self.address) if text else math.nan

    def text(self, index: int) -> str:
        """Return the text of a field; raise BadMessage if there are fewer fields."""
        if index >= len(self.fields):
            raise BadMessage(
                f"${self.address} has {len(self.fields)} fields; expected {index + 1} or more."
            )
        return self.fields[index]


def read_sentence(data: bytes, *addresses: str) -> Sentence:
    """Return the sentence of a line; the checksum is required.

    Args:
        data: the line, with or without its end.
        addresses: the expected addresses; empty: any.

    Raises:
        BadMessage: the line is no sentence, or has a wrong checksum or another address.
    """
    if len(data) > MAX_LENGTH:
        raise BadMessage(f"A line has {len(data)} bytes; expected at most {MAX_LENGTH}.")
    line = data.strip(b"\r\n")
    body, star, checksum = line[1:].rpartition(b"*")
    if line[:1] != b"$" or not star or not body.isascii() or not body.decode().isprintable():
        raise BadMessage(f"{line[:40]!r} is no sentence; expected $ADDRESS,FIELDS*CHECKSUM.")
    expected = b"%02X" % xor_checksum(body)
    if checksum.upper() != expected:
        raise BadMessage(f"{line[:40]!r} has a wrong checksum; expected *{expected.decode()}.")
    address, *fields = body.decode().split(",")
    if addresses and address not in addresses:
        raise BadMessage(f"${address[:10]} is unexpected; expected ${', $'.join(addresses)}.")
    return Sentence(address, tuple(fields))


def parse_number(text: str, name: str) -> float:
    """Return the finite number of a text; raise BadMessage, which names its message."""
    try:
        number = float(text) if len(text) <= 40 and "_" not in text else math.nan
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise BadMessage(f"{name} has the field {text[:40]!r}; expected a number.")
    return number


def format_number(value: float, digits: int, *, width: int = 0, is_signed: bool = False) -> str:
    """Return a number in decimal notation; an empty text if it is not finite.

    Args:
        value: the number.
        digits: the number of decimal digits.
        width: the width to which zeros fill the number; 0: no zeros.
        is_signed: True to write the sign of positive numbers and of 0, too.
    """
    if not math.isfinite(value):
        return ""
    number = round(value, digits) + 0.0  # -0.0 becomes 0.0
    return f"{number:{'+' if is_signed else ''}{f'0{width}' if width else ''}.{digits}f}"


def join_sentences(sentences: Sequence[Sentence]) -> bytes:
    """Return the bytes of several sentences."""
    return b"".join(sentence.to_bytes() for sentence in sentences)
