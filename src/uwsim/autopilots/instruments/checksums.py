"""The checksums of instruments' messages."""

from __future__ import annotations

from binascii import crc_hqx
from functools import reduce
from operator import xor


def xor_checksum(data: bytes) -> int:
    """Return the exclusive or of all bytes, the checksum of NMEA 0183."""
    return reduce(xor, data, 0)


def sum_checksum(data: bytes) -> int:
    """Return the sum of all bytes modulo 65536, the checksum of Teledyne RDI's binary formats."""
    return sum(data) & 0xFFFF


def crc8(data: bytes) -> int:
    """Return the CRC-8 of Water Linked: polynomial 0x07, start 0x00; of ``123456789`` it is 0xf4.

    Source: Water Linked, DVL protocol 2.3, serial protocol, checksum.
    """
    remainder = 0
    for byte in data:
        remainder ^= byte
        for _ in range(8):
            remainder = (remainder << 1) ^ 0x107 if remainder & 0x80 else remainder << 1
    return remainder


def crc16(data: bytes) -> int:
    """Return the CRC-16 "IBM-3740": polynomial 0x1021, start 0xffff, no reflection.

    Of ``123456789`` it is 0x29b1. Source: G. Cook, Catalogue of parametrised CRC algorithms.
    """
    return crc_hqx(data, 0xFFFF)
