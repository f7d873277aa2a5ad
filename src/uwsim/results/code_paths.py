"""The code paths that numerical libraries have chosen for this processor.

numpy, OpenCV, OpenBLAS and numba have several implementations of a function, or compile it, and
choose one by the features of the processor or by environment variables. The numbers of `uwsim` have
the same bytes with any choice (``tests/test_same_bytes.py``); those of a user's own algorithm or
measure may differ. So the provenance of a run states the choice, and a comparison that finds
different bytes reports a different choice.
"""

from __future__ import annotations

import ctypes
import importlib
from collections.abc import Mapping, Sequence
from contextlib import suppress

import numpy as np

Code = dict[str, list[str]]
"""The names of the code paths (processor features or kernels) that each library has chosen."""
BLAS_NAMES = (
    "scipy_openblas_get_corename64_",
    "scipy_openblas_get_corename",
    "openblas_get_corename",
)
"""The function of OpenBLAS that returns the name of its kernels, as different builds call it."""
MAX_NAMES = 6
"""The greatest number of names listed."""


def chosen_code() -> Code:
    """Return the code paths that each library has chosen in this process."""
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


def code_differences(recorded_code: object) -> str:
    """Return the differences between recorded code paths and those of this process.

    The text is empty if both are the same, or if nothing is recorded.
    """
    if not isinstance(recorded_code, Mapping):
        return ""
    messages = []
    for library, current_names in chosen_code().items():
        recorded_names = recorded_code.get(library)
        if not isinstance(recorded_names, list) or recorded_names == current_names:
            continue
        recorded_text = names_text([name for name in recorded_names if name not in current_names])
        current_text = names_text([name for name in current_names if name not in recorded_names])
        messages.append(f"{library} {recorded_text} there, {current_text} here")
    return "; ".join(messages)


def names_text(names: Sequence[object]) -> str:
    """List names, up to `MAX_NAMES`."""
    rest = f" and {len(names) - MAX_NAMES} more" if len(names) > MAX_NAMES else ""
    return f"{' '.join(map(str, names[:MAX_NAMES]))}{rest}" if names else "nothing more"


def _blas_kernels() -> str:
    """Return the name of OpenBLAS's kernels; ``unknown`` with another BLAS."""
    library = ctypes.CDLL(importlib.import_module("numpy._core._multiarray_umath").__file__)
    for name in BLAS_NAMES:
        with suppress(AttributeError):
            function = getattr(library, name)
            function.restype = ctypes.c_char_p
            return str(function().decode())
    return "unknown"
