"""The one place where numba meets strict types: typed decorators with the cache on."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import ParamSpec, TypeVar, cast

# Intel's functions, if they are installed, would be other code on other processors.
os.environ.setdefault("NUMBA_DISABLE_INTEL_SVML", "1")

import numba
import numpy as np
import numpy.typing as npt

P = ParamSpec("P")
R = TypeVar("R")
Elementwise = Callable[..., npt.NDArray[np.float64]]


def njit(function: Callable[P, R]) -> Callable[P, R]:
    """Compile with numba: cached on disk, GIL released, no fast-math, one thread."""
    return cast("Callable[P, R]", numba.njit(cache=True, nogil=True)(function))


def elementwise(function: Callable[..., float]) -> Elementwise:
    """Compile a function of numbers as one of arrays, element by element, as numpy's own are."""
    return cast("Elementwise", numba.vectorize(cache=True)(function))  # type: ignore[no-untyped-call]
