"""Samples of numbers that lie in memory: compiled code copies them from their addresses."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from .numerics.calls import address_of, function_address
from .numerics.memory import carray, floats, longs, pointer, real
from .sampling import Sampler

NUMBERS = np.dtype([("addresses", np.int64), ("n", np.int64)])
"""The address of the addresses of some doubles, and how many these are."""
Addresses = npt.NDArray[np.int64]


def addresses_in(array: npt.NDArray[np.float64], places: npt.ArrayLike | None = None) -> Addresses:
    """Return the addresses of numbers of a contiguous array, which has to live on, (n,).

    Args:
        array: whose numbers these are.
        places: which, counted through the array by rows; None: all.
    """
    chosen = np.arange(array.size) if places is None else np.asarray(places, dtype=np.int64)
    return address_of(array) + array.itemsize * chosen.ravel()


def gathering(
    addresses: Addresses,
    *,
    prepare: Callable[[float], None],
    is_alone: Callable[[], bool],
    kept: tuple[object, ...] = (),
) -> Sampler:
    """Return what takes the numbers at some addresses, in their order, as a sample.

    Args:
        addresses: of doubles, (n,); they may be changed by ``prepare``.
        prepare: as in `Sampler`.
        is_alone: as in `Sampler`.
        kept: as in `Sampler`.
    """
    row = np.zeros(1, NUMBERS)
    row["addresses"], row["n"] = address_of(addresses), len(addresses)
    return Sampler(
        function=function_address(gather),
        parameters=row,
        n_values=len(addresses),
        prepare=prepare,
        is_alone=is_alone,
        kept=(addresses, *kept),
    )


def gather(parameters: int, values: int, time: float) -> None:
    """Copy numbers from their addresses; see `uwsim.base.numerics.calls`."""
    numbers = carray(pointer(parameters), (1,), NUMBERS)[0]
    addresses, found = longs(numbers.addresses, numbers.n), floats(values, numbers.n)
    for i in range(numbers.n):
        found[i] = real(addresses[i])
