"""The packing of tables of slowly changing integers, so that they compress well.

A table of 32 bit integers, (n, m), is stored column by column. The first integer of a column is
stored itself, every other integer as the difference from its predecessor, modulo 2^32. The lowest
bytes of all integers are written first, then the second lowest bytes, and so on. Bytes that are
nearly always 0 or 255 are then adjacent, and gzip compresses them well.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Table = npt.NDArray[np.int32]
BYTES = 4
"""The size of an integer [bytes]."""


def pack_table(table: Table) -> bytes:
    """Return a table (n, m) of 32 bit integers as 4 n m bytes."""
    columns = np.ascontiguousarray(table.T).view(np.uint32)
    steps = np.diff(columns, axis=1, prepend=np.uint32(0)).astype("<u4")
    return steps.reshape(-1, 1).view(np.uint8).T.tobytes()


def unpack_table(data: bytes, n_rows: int, n_columns: int) -> Table:
    """Return the table from the bytes of `pack_table`; raise ValueError for a wrong length."""
    n_bytes = n_rows * n_columns * BYTES
    if n_rows < 0 or len(data) != n_bytes:
        raise ValueError(f"expected {n_bytes} bytes of numbers, found {len(data)}")
    planes = np.frombuffer(data, np.uint8).reshape(BYTES, -1)
    steps = np.ascontiguousarray(planes.T).view("<u4").reshape(n_columns, n_rows)
    columns = np.cumsum(steps, axis=1, dtype=np.uint32)
    return np.ascontiguousarray(columns.T).view(np.int32)
