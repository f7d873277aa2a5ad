"""The numbers of MuJoCo's data, read and written as bytes.

They lie in three places: the struct itself; the buffer, which has the arrays of fixed length; and
the arena, which has contacts and constraints of the last step. `mujoco.mj_copyData` copies all of
it, but between two data only, each with an arena of megabytes. Bytes of what is used are a few
kilobytes: they can be kept by the thousand, saved, and compared. Places in the arena count from its
beginning, so that the bytes fit any data of the same model.

Left out are diagnostics of the solver, and its times.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import mujoco
import numpy as np
import numpy.typing as npt

from ..base.record import ExternalValue, wrong_scene_error
from .hydrodynamics.kernel.layout import MujocoChanged, data_places

Bytes = npt.NDArray[np.uint8]

COUNTS = ("parena", "maxuse_stack", "maxuse_arena", "maxuse_con", "maxuse_efc", "solver_niter",
          "solver_nnz", "solver_fwdinv", "warning")  # fmt: skip
"""Fields of the struct that are kept, besides those from `FIRST` to `LAST`."""
FIRST, LAST = "ncon", "energy"


@dataclass(frozen=True, slots=True)
class EngineNumbers:
    """The numbers of MuJoCo's data."""

    counts: bytes
    """The counts and scalars of the struct."""
    places: bytes
    """Where the arrays of the arena begin, counted from 1; 0: there is none, (n,) of 64 bits."""
    arrays: bytes
    """The arrays of fixed length."""
    arena: bytes = field(compare=False)
    """The used part of the arena. It follows from the rest; the engine leaves gaps in it."""


class EngineMemory(ExternalValue):
    """The memory of one MjData.

    Args:
        data: the data; it must outlive this.
        forget: called when numbers were set: what was looked up in the memory is elsewhere.

    Raises:
        MujocoChanged: this MuJoCo has another layout.
    """

    def __init__(self, data: mujoco.MjData, forget: Callable[[], None] = lambda: None) -> None:
        self._forget = forget
        fields, size = data_places()
        self._struct = struct = _view(data._address, size)
        self._bytes = struct.data
        self._counts = _places_of_counts()
        first, end = fields["contact"].start, fields["signature"].start
        self._places = struct[first:end].view(np.uint64)
        words = {n: struct[fields[n]].view(np.uint64) for n in ("buffer", "arena", "parena")}
        buffer, self._base = int(words["buffer"][0]), int(words["arena"][0])
        if not buffer <= data.xpos.ctypes.data < buffer + data.nbuffer:
            raise MujocoChanged("MuJoCo keeps its arrays elsewhere than its description says.")
        self._arrays = _view(buffer, data.nbuffer)
        self._arena = _view(self._base, data.narena)
        self._n_counts = sum(each.stop - each.start for each in self._counts)
        self._used = words["parena"]

    def value(self) -> EngineNumbers:
        """Return its numbers as they are now."""
        places = self._places
        counted = places - np.uint64(self._base - 1)
        counted[places == 0] = 0
        return EngineNumbers(
            b"".join([self._bytes[each] for each in self._counts]),
            counted.tobytes(),
            self._arrays.tobytes(),
            self._arena[: int(self._used[0])].tobytes(),
        )

    def set(self, value: object) -> None:
        """Set its numbers; raises UwsimError where they are of another model."""
        if not isinstance(value, EngineNumbers):
            raise wrong_scene_error()
        places = np.frombuffer(value.places, np.uint64)
        lengths = len(value.counts), len(places), len(value.arrays)
        own = self._n_counts, len(self._places), len(self._arrays)
        if lengths != own or len(value.arena) > len(self._arena):
            raise wrong_scene_error()
        if places.max(initial=0) > len(value.arena) + 1:  # what is empty may begin at its end
            raise wrong_scene_error()
        first = 0
        for each in self._counts:
            end = first + each.stop - each.start
            self._bytes[each], first = value.counts[first:end], end
        base = np.uint64(self._base)
        self._places[:] = np.where(places == 0, np.uint64(0), places + base - np.uint64(1))
        self._arrays[:] = _bytes(value.arrays)
        self._arena[: len(value.arena)] = _bytes(value.arena)
        self._forget()


@cache
def _places_of_counts() -> tuple[slice, ...]:
    """The bytes of the struct that are kept: as few slices as there are gaps between them."""
    fields, _ = data_places()
    first, last = fields[FIRST].start, fields[LAST].start
    kept: list[slice] = []
    for name, each in fields.items():
        if name not in COUNTS and not first <= each.start <= last:
            continue
        begin = kept.pop().start if kept and kept[-1].stop == each.start else each.start
        kept.append(slice(begin, each.stop))
    return tuple(kept)


def _view(address: int, size: int) -> Bytes:
    memory: Any = (ctypes.c_uint8 * size).from_address(address)
    return np.frombuffer(memory, np.uint8)


def _bytes(text: bytes) -> Bytes:
    return np.frombuffer(text, np.uint8)
