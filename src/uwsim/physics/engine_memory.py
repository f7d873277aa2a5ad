"""The content of MuJoCo's data (``mjData``), read and written as bytes.

It is in three parts of memory: the struct itself; the buffer, with the arrays of fixed length; and
the arena, with the contacts and constraints of the last step. `mujoco.mj_copyData` copies all of
it, but only between two ``mjData``, each with an arena of megabytes. The bytes that are in use are
a few kilobytes, so that thousands of copies can be stored, saved and compared. Pointers into the
arena are stored as offsets from its beginning, so that the bytes fit any data of the same model.

The arrays of solver statistics (``solver``) and of timers (``timer``) are not included.
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
from .hydrodynamics.kernel.layout import MujocoChanged, data_slices

Bytes = npt.NDArray[np.uint8]

COUNTS = ("parena", "maxuse_stack", "maxuse_arena", "maxuse_con", "maxuse_efc", "solver_niter",
          "solver_nnz", "solver_fwdinv", "warning")  # fmt: skip
"""The fields of the struct that are included, besides those from `FIRST_FIELD` to `LAST_FIELD`."""
FIRST_FIELD, LAST_FIELD = "ncon", "energy"


@dataclass(frozen=True, slots=True)
class EngineSnapshot:
    """The content of MuJoCo's data as bytes."""

    counts: bytes
    """The counts and scalars of the struct."""
    offsets: bytes
    """The offsets of the arrays in the arena plus 1, or 0 for an absent array, (n,) of 64 bits."""
    arrays: bytes
    """The arrays of fixed length."""
    arena: bytes = field(compare=False)
    """The used part of the arena. It is not compared: it follows from the other fields, and has
    gaps with arbitrary bytes."""


class EngineMemory(ExternalValue):
    """The memory of one ``mjData``.

    Args:
        data: the data, which must outlive this object.
        on_set: called after the content was set; views into the arena are then invalid.

    Raises:
        MujocoChanged: the installed MuJoCo has another layout.
    """

    def __init__(self, data: mujoco.MjData, on_set: Callable[[], None] = lambda: None) -> None:
        self._on_set = on_set
        fields, size = data_slices()
        self._struct = struct = _view(data._address, size)
        self._bytes = struct.data
        self._counts = _count_slices()
        start, end = fields["contact"].start, fields["signature"].start
        self._addresses = struct[start:end].view(np.uint64)
        words = {n: struct[fields[n]].view(np.uint64) for n in ("buffer", "arena", "parena")}
        buffer, self._base = int(words["buffer"][0]), int(words["arena"][0])
        if not buffer <= data.xpos.ctypes.data < buffer + data.nbuffer:
            raise MujocoChanged(
                "MuJoCo's arrays are not in the buffer that its struct layout describes."
            )
        self._arrays = _view(buffer, data.nbuffer)
        self._arena = _view(self._base, data.narena)
        self._counts_size = sum(part.stop - part.start for part in self._counts)
        self._arena_size = words["parena"]

    def value(self) -> EngineSnapshot:
        """Return the present content."""
        addresses = self._addresses
        offsets = addresses - np.uint64(self._base - 1)
        offsets[addresses == 0] = 0
        return EngineSnapshot(
            b"".join([self._bytes[part] for part in self._counts]),
            offsets.tobytes(),
            self._arrays.tobytes(),
            self._arena[: int(self._arena_size[0])].tobytes(),
        )

    def set(self, value: object) -> None:
        """Set the content; raise UwsimError if it is the content of another model's data."""
        if not isinstance(value, EngineSnapshot):
            raise wrong_scene_error()
        offsets = np.frombuffer(value.offsets, np.uint64)
        lengths = len(value.counts), len(offsets), len(value.arrays)
        own_lengths = self._counts_size, len(self._addresses), len(self._arrays)
        if lengths != own_lengths or len(value.arena) > len(self._arena):
            raise wrong_scene_error()
        if offsets.max(initial=0) > len(value.arena) + 1:  # an empty array may begin at the end
            raise wrong_scene_error()
        start = 0
        for part in self._counts:
            end = start + part.stop - part.start
            self._bytes[part], start = value.counts[start:end], end
        base = np.uint64(self._base)
        self._addresses[:] = np.where(offsets == 0, np.uint64(0), offsets + base - np.uint64(1))
        self._arrays[:] = _bytes(value.arrays)
        self._arena[: len(value.arena)] = _bytes(value.arena)
        self._on_set()


@cache
def _count_slices() -> tuple[slice, ...]:
    """Return the included bytes of the struct as slices; adjacent fields share a slice."""
    fields, _ = data_slices()
    start, end = fields[FIRST_FIELD].start, fields[LAST_FIELD].start
    slices: list[slice] = []
    for name, part in fields.items():
        if name not in COUNTS and not start <= part.start <= end:
            continue
        begin = slices.pop().start if slices and slices[-1].stop == part.start else part.start
        slices.append(slice(begin, part.stop))
    return tuple(slices)


def _view(address: int, size: int) -> Bytes:
    memory: Any = (ctypes.c_uint8 * size).from_address(address)
    return np.frombuffer(memory, np.uint8)


def _bytes(text: bytes) -> Bytes:
    return np.frombuffer(text, np.uint8)
