"""Messages of DataFlash logs, for tests."""

from __future__ import annotations

import struct

FORMATS = {
    "PARM": (64, "QNf", "TimeUS,Name,Value"),
    "XKF1": (65, "QBccCfffffff", "TimeUS,C,Roll,Pitch,Yaw,VN,VE,VD,dPD,PN,PE,PD"),
    "RATE": (66, "Qfff", "TimeUS,R,P,Y"),
    "RCOU": (67, "QHHHHHHHH", "TimeUS,C1,C2,C3,C4,C5,C6,C7,C8"),
    "IMU": (68, "QBffffff", "TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ"),
    "BARO": (69, "QBff", "TimeUS,I,Alt,Press"),
}
CODES = {"Q": "Q", "N": "16s", "f": "f", "B": "B", "c": "h", "C": "H", "H": "H"}


def format_message(name: str) -> bytes:
    kind, letters, columns = FORMATS[name]
    length = 3 + struct.calcsize("<" + "".join(CODES[letter] for letter in letters))
    fields = struct.pack(
        "<BB4s16s64s", kind, length, name.encode(), letters.encode(), columns.encode()
    )
    return b"\xa3\x95\x80" + fields


def message(name: str, *values: object) -> bytes:
    kind, letters, _ = FORMATS[name]
    return bytes([0xA3, 0x95, kind]) + struct.pack(
        "<" + "".join(CODES[letter] for letter in letters), *values
    )


FORMAT_OF_FORMATS = b"\xa3\x95\x80" + struct.pack(
    "<BB4s16s64s", 128, 89, b"FMT", b"BBnNZ", b"Type,Length,Name,Format,Columns"
)
"""The message that describes the type of the messages that describe types."""
