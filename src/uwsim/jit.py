"""The one place where numba meets strict types: a typed ``njit`` with the cache on."""

from __future__ import annotations

from collections.abc import Callable
from typing import ParamSpec, TypeVar, cast

import numba

P = ParamSpec("P")
R = TypeVar("R")


def njit(function: Callable[P, R]) -> Callable[P, R]:
    """Compile with numba: cached on disk, GIL released, no fast-math, one thread."""
    return cast("Callable[P, R]", numba.njit(cache=True, nogil=True)(function))
