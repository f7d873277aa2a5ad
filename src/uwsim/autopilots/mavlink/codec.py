"""The bytes of MAVLink messages, by pymavlink and its dialect of ArduPilot."""

from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ...errors import MissingExtra, UwsimError
from .message import Message

DIALECT = "pymavlink.dialects.v20.ardupilotmega"
"""The module of pymavlink with all messages of ArduPilot and of the common set."""
MAGIC_1, MAGIC_2 = 0xFE, 0xFD
"""The first byte of a frame of MAVLink 1 and of MAVLink 2."""
HEADER_1, HEADER_2 = 6, 10
"""The lengths of the headers of MAVLink 1 and 2 [bytes]."""
CHECKSUM_LENGTH, SIGNATURE_LENGTH = 2, 13
"""The lengths of the checksum and of the signature after the payload [bytes]."""
MAX_FRAME = HEADER_2 + 255 + CHECKSUM_LENGTH + SIGNATURE_LENGTH
"""The greatest length of a frame [bytes]."""
SIGNED_FLAG = 0x01
"""The incompatibility flag of signed frames, the only one of MAVLink 2."""


@dataclass(frozen=True)
class Identity:
    """The sender of messages."""

    system: int
    """The number of the system, 1 to 255."""
    component: int
    """The number of the component in the system, 1 to 255."""


class Codec:
    """The encoder and decoder of messages; it keeps nothing from one message to the next.

    Raises:
        MissingExtra: pymavlink is not installed.
    """

    def __init__(self) -> None:
        if importlib.util.find_spec("pymavlink") is None:
            raise MissingExtra(
                "MAVLink needs pymavlink, which is not installed: pip install 'uwsim[mavlink]'."
            )
        self._dialect: Any = importlib.import_module(DIALECT)
        self._classes: dict[str, Any] = {
            message.msgname: message for message in self._dialect.mavlink_map.values()
        }
        self._decoder: Any = self._dialect.MAVLink(None)

    @property
    def names(self) -> frozenset[str]:
        """The names of all messages of the dialect."""
        return frozenset(self._classes)

    def encode(self, message: Message, identity: Identity, sequence: int) -> bytes:
        """Return the frame of a message, of MAVLink 2 and unsigned.

        Args:
            message: the message; fields that it lacks are 0.
            identity: the sender.
            sequence: the number of the frame, of which the lowest 8 bits are sent.

        Raises:
            UwsimError: there is no such message or field, or a value does not fit its field.
        """
        kind = self._classes.get(message.name)
        if kind is None:
            raise UwsimError(f"MAVLink has no message {message.name!r}.")
        unknown_names = sorted(set(message.fields) - set(kind.fieldnames))
        if unknown_names:
            raise UwsimError(f"{message.name} of MAVLink has no field {unknown_names[0]!r}.")
        encoder = self._dialect.MAVLink(None, identity.system, identity.component)
        encoder.seq = sequence & 0xFF
        try:
            values = [_field_value(kind, message.fields, name) for name in kind.fieldnames]
            return bytes(kind(*values).pack(encoder))
        except Exception as error:  # struct.error and others, of values that do not fit
            raise UwsimError(f"{message.name} of MAVLink: a value does not fit: {error}.") from None

    def frame_length(self, data: bytes | bytearray, start: int) -> int | None:
        """Return the length of the frame that may begin at ``start``; None if none begins there.

        0: more bytes are needed to decide.
        """
        magic, header = data[start], HEADER_1 if data[start] == MAGIC_1 else HEADER_2
        if magic not in (MAGIC_1, MAGIC_2):
            return None
        if len(data) - start < header:
            return 0
        length = header + data[start + 1] + CHECKSUM_LENGTH
        number = data[start + 5]
        if magic == MAGIC_2:
            if data[start + 2] & ~SIGNED_FLAG:
                return None
            length += SIGNATURE_LENGTH if data[start + 2] & SIGNED_FLAG else 0
            number = int.from_bytes(data[start + 7 : start + 10], "little")
        if number not in self._dialect.mavlink_map:
            return None
        return length if len(data) - start >= length else 0

    def decode(self, frame: bytes | bytearray) -> Message | None:
        """Return the message of a whole frame; None if its checksum or its payload is invalid."""
        try:
            pymavlink_message = self._decoder.decode(bytearray(frame))
            fields = pymavlink_message.to_dict()
        except Exception:  # MAVError, struct.error, UnicodeDecodeError: all of them of the bytes
            return None
        name = fields.pop("mavpackettype", "")
        if name not in self._classes:
            return None
        return Message(
            name, fields, pymavlink_message.get_srcSystem(), pymavlink_message.get_srcComponent()
        )


def _field_value(kind: Any, fields: Mapping[str, Any], name: str) -> Any:
    """Return the value of a field for pymavlink, zeros if it is missing."""
    index = kind.fieldnames.index(name)
    if kind.fieldtypes[index] == "char":
        text = fields.get(name, "")
        return text.encode() if isinstance(text, str) else text
    length = kind.array_lengths[kind.ordered_fieldnames.index(name)]
    if length == 0:
        return fields.get(name, 0)
    values = list(fields.get(name, (0,) * length))
    if len(values) != length:
        raise ValueError(f"{name} has {len(values)} values; expected {length}")
    return values
