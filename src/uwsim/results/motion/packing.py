"""Packing of slowly changing whole numbers: differences, bytes shuffled.

A table of 32 bit integers, (n, m), is stored column by column. The first number of a column is
kept as it is, every other as its difference from the one before, modulo 2^32. Of all columns
together first the lowest byte of every number is written, then the next ones, so that bytes that
are nearly always 0 or 255 lie together, and gzip has little left.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Table = npt.NDArray[np.int32]
BYTES = 4
"""Of a number."""


def shuffled(table: Table) -> bytes:
    """Return a table (n, m) of 32 bit integers as 4 n m bytes."""
    columns = np.ascontiguousarray(table.T).view(np.uint32)
    steps = np.diff(columns, axis=1, prepend=np.uint32(0)).astype("<u4")
    return steps.reshape(-1, 1).view(np.uint8).T.tobytes()


def unshuffled(data: bytes, n_rows: int, n_columns: int) -> Table:
    """Return the table of what `shuffled` gave; raises ValueError where the length is another."""
    wanted = n_rows * n_columns * BYTES
    if n_rows < 0 or len(data) != wanted:
        raise ValueError(f"expected {wanted} bytes of numbers, found {len(data)}")
    planes = np.frombuffer(data, np.uint8).reshape(BYTES, -1)
    steps = np.ascontiguousarray(planes.T).view("<u4").reshape(n_columns, n_rows)
    columns = np.cumsum(steps, axis=1, dtype=np.uint32)
    return np.ascontiguousarray(columns.T).view(np.int32)
