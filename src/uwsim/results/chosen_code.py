"""The code paths that numerical libraries have chosen for this processor.

numpy, OpenCV, OpenBLAS and numba hold several codes for one function, or compile it, and take what
suits the processor, or what environment variables say. What makes numbers here gives the same bytes
with any of them (``tests/test_same_bytes.py``); an algorithm or a measure of one's own may not. So
a result says what was chosen, and a comparison that finds other bytes reports a difference here.
"""

from __future__ import annotations

import ctypes
import importlib
from collections.abc import Mapping, Sequence
from contextlib import suppress

import numpy as np

Code = dict[str, list[str]]
"""Library -> names of what it has chosen."""
BLAS_NAMES = (
    "scipy_openblas_get_corename64_",
    "scipy_openblas_get_corename",
    "openblas_get_corename",
)
"""The function of OpenBLAS that names its kernels, as builds of numpy call it."""
SHOWN = 6
"""Greatest number of names listed."""


def chosen_code() -> Code:
    """Return what each library has chosen in this process."""
    import cv2
    from numba.core.registry import cpu_target

    _, processor, features = cpu_target.target_context.codegen().magic_tuple()
    return {
        "numpy": list(np.show_config(mode="dicts")["SIMD Extensions"]["found"]),
        "OpenBLAS": [_blas_kernels()],
        "OpenCV": [
            word.lstrip("*") for word in cv2.getCPUFeaturesLine().split() if not word.endswith("?")
        ],
        "numba": [processor, *(word[1:] for word in features.split(",") if word[:1] == "+")],
    }


def other_code(recorded: object) -> str:
    """Return the differences between a recorded choice and that of this process.

    Empty where both are the same, or nothing is recorded.
    """
    if not isinstance(recorded, Mapping):
        return ""
    messages = []
    for library, here in chosen_code().items():
        there = recorded.get(library)
        if not isinstance(there, list) or there == here:
            continue
        before = names_text([name for name in there if name not in here])
        now = names_text([name for name in here if name not in there])
        messages.append(f"{library} {before} there, {now} here")
    return "; ".join(messages)


def names_text(names: Sequence[object]) -> str:
    """Say some names, not all of very many."""
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return f"{' '.join(map(str, names[:SHOWN]))}{more}" if names else "nothing more"


def _blas_kernels() -> str:
    """Name OpenBLAS's kernels; ``unknown`` with another BLAS."""
    library = ctypes.CDLL(importlib.import_module("numpy._core._multiarray_umath").__file__)
    for name in BLAS_NAMES:
        with suppress(AttributeError):
            function = getattr(library, name)
            function.restype = ctypes.c_char_p
            return str(function().decode())
    return "unknown"
