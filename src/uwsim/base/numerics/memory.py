"""Arrays over memory that is known by its address, for code compiled by numba."""

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
    """A void pointer from an address, as an integer."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.inttoptr(args[0], cgutils.voidptr_t)

    return types.voidptr(address), codegen


pointer: Any = intrinsic(_pointer)
carray: Any = numba.carray  # type: ignore[attr-defined]  # not in numba's list of exports


@njit
def view_doubles(address: int, n: int) -> Floats:
    """The ``n`` doubles that lie at ``address``."""
    view: Floats = carray(pointer(address), (n,), np.float64)
    return view


@njit
def view_int32s(address: int, n: int) -> Ints:
    """The ``n`` 32-bit integers that lie at ``address``."""
    view: Ints = carray(pointer(address), (n,), np.int32)
    return view


@njit
def view_int64s(address: int, n: int) -> Ints64:
    """The ``n`` 64-bit integers that lie at ``address``."""
    view: Ints64 = carray(pointer(address), (n,), np.int64)
    return view


@njit
def read_int64(address: int) -> int:
    """The 64-bit integer, or pointer, that lies at ``address``."""
    value: int = carray(pointer(address), (1,), np.int64)[0]
    return value


@njit
def read_int32(address: int) -> int:
    """The 32-bit integer that lies at ``address``."""
    value: int = carray(pointer(address), (1,), np.int32)[0]
    return value


@njit
def read_double(address: int) -> float:
    """The double that lies at ``address``."""
    value: float = carray(pointer(address), (1,), np.float64)[0]
    return value
