"""Arrays over memory at an address, for code compiled by numba."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
import numpy.typing as npt
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from .jit import njit

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]
Ints64 = npt.NDArray[np.int64]


def _pointer(typingctx: Any, address: Any) -> Any:
    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.inttoptr(args[0], cgutils.voidptr_t)

    return types.voidptr(address), codegen


pointer: Any = intrinsic(_pointer)
"""``pointer(address)`` returns an address as a pointer, in compiled code."""
carray: Any = numba.carray  # type: ignore[attr-defined]  # not in numba's list of exports
"""``carray(pointer, shape, dtype)`` returns an array over the memory at a pointer."""


@njit
def view_doubles(address: int, n: int) -> Floats:
    """Return the ``n`` doubles at ``address``."""
    view: Floats = carray(pointer(address), (n,), np.float64)
    return view


@njit
def view_int32s(address: int, n: int) -> Ints:
    """Return the ``n`` 32-bit integers at ``address``."""
    view: Ints = carray(pointer(address), (n,), np.int32)
    return view


@njit
def view_int64s(address: int, n: int) -> Ints64:
    """Return the ``n`` 64-bit integers at ``address``."""
    view: Ints64 = carray(pointer(address), (n,), np.int64)
    return view


@njit
def read_int64(address: int) -> int:
    """Return the 64-bit integer, or pointer, at ``address``."""
    value: int = carray(pointer(address), (1,), np.int64)[0]
    return value


@njit
def read_int32(address: int) -> int:
    """Return the 32-bit integer at ``address``."""
    value: int = carray(pointer(address), (1,), np.int32)[0]
    return value


@njit
def read_double(address: int) -> float:
    """Return the double at ``address``."""
    value: float = carray(pointer(address), (1,), np.float64)[0]
    return value
