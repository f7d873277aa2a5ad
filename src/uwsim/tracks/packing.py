"""Packing of slowly changing whole numbers: differences, bytes shuffled, gzip.

A table of 32 bit integers, (n, m), is stored column by column. The first number of a column is
kept as it is, the second as its difference from the first, all others as differences of
differences; each is folded into a number without sign (0, -1, 1, -2, ... become 0, 1, 2, 3, ...).
Of all columns together first the lowest byte of every number is written, then the next ones, so
that bytes that are nearly always 0 lie together; gzip does the rest, without time or name, so that
equal tables give equal bytes. Arithmetic is modulo 2^32 and loses nothing.
"""

from __future__ import annotations

import gzip
import zlib

import numpy as np
import numpy.typing as npt

Table = npt.NDArray[np.int32]
BYTES = 4
"""Of a number."""


def packed(table: Table) -> bytes:
    """Pack a table (n, m) of 32 bit integers."""
    columns = np.ascontiguousarray(table.T).view(np.uint32)
    first = np.diff(columns, axis=1, prepend=np.uint32(0))
    second = first.copy()
    second[:, 2:] -= first[:, 1:-1]
    signed = second.view(np.int32)
    folded = (second << np.uint32(1)) ^ (signed >> 31).view(np.uint32)
    planes = folded.astype("<u4").reshape(-1, 1).view(np.uint8).T
    return gzip.compress(planes.tobytes(), compresslevel=9, mtime=0)


def unpacked(data: bytes, n_rows: int, n_columns: int) -> Table:
    """Unpack what `packed` gave; raises ValueError where the bytes are not such a table."""
    wanted = n_rows * n_columns * BYTES
    try:
        stream = zlib.decompressobj(wbits=31)
        raw = stream.decompress(data, wanted + 1)
    except zlib.error as error:
        raise ValueError(f"cannot be unpacked: {error}") from None
    if len(raw) != wanted or not stream.eof:
        raise ValueError(f"expected {wanted} bytes of numbers, found {len(raw)}")
    planes = np.frombuffer(raw, np.uint8).reshape(BYTES, -1)
    folded = np.ascontiguousarray(planes.T).view("<u4").reshape(n_columns, n_rows)
    folded = folded.astype(np.uint32)
    numbers = (folded >> np.uint32(1)) ^ (np.uint32(0) - (folded & np.uint32(1)))
    numbers[:, 1:] = np.cumsum(numbers[:, 1:], axis=1, dtype=np.uint32)
    columns = np.cumsum(numbers, axis=1, dtype=np.uint32)
    return np.ascontiguousarray(columns.T).view(np.int32)
