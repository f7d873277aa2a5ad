"""Records as bytes: of numbers, texts, arrays, messages and records of uwsim, and nothing else."""

from __future__ import annotations

import dataclasses
import io
import pickle
from typing import Any, TypeVar

from ...errors import UwsimError
from ...version import __version__

T = TypeVar("T")
ALLOWED = {
    ("numpy", "dtype"),
    ("numpy", "ndarray"),
    ("numpy._core.multiarray", "_reconstruct"),
    ("numpy._core.multiarray", "scalar"),
    ("numpy._core.numeric", "_frombuffer"),
    ("collections", "deque"),
}
"""Types allowed in bytes, besides numbers, texts and dataclasses of uwsim and rosbags."""


def pack(value: object) -> bytes:
    """Return a copied value as bytes, with the version of uwsim.

    Raises:
        UwsimError: something in it has no bytes.
    """
    try:
        return pickle.dumps((__version__, value), protocol=5)
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise UwsimError(f"The state cannot be saved: {error}.") from None


def unpack(data: bytes, kind: type[T]) -> T:
    """Read a value of a type from bytes.

    Raises:
        UwsimError: these are no such bytes, or another version of uwsim wrote them.
    """
    try:
        version, value = _Unpickler(io.BytesIO(data)).load()
    except Exception as error:  # whatever damaged bytes make of themselves
        raise UwsimError(f"These bytes are no saved simulation: {error}.") from None
    if version != __version__:
        raise UwsimError(f"The simulation was not saved by uwsim {__version__}.")
    if not isinstance(value, kind):
        raise UwsimError("These bytes are no saved simulation.")
    return value


class _Unpickler(pickle.Unpickler):
    """Makes numbers, arrays, messages and records, and calls nothing else."""

    def find_class(self, module: str, name: str) -> Any:
        if (module, name) in ALLOWED:
            return super().find_class(module, name)
        if module.startswith(("uwsim.", "rosbags.")):
            found = super().find_class(module, name)
            if isinstance(found, type) and dataclasses.is_dataclass(found):
                return found
        raise pickle.UnpicklingError(f"{module}.{name} has no place in them")
