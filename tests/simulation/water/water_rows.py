"""What a function of water says in steps, as the engine asks it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from uwsim.base.numerics.calls import call
from uwsim.base.numerics.jit import njit
from uwsim.physics.hydrodynamics.water_function import (
    POINT,
    SURFACE,
    VELOCITY,
    WATER_ROW_LENGTH,
    WaterFunction,
)


@njit
def ask(function: int, parameters: int, rows: np.ndarray, time: float) -> np.ndarray:
    call(function, parameters, rows.ctypes.data, time)
    return rows


def rows_of(water: WaterFunction, points: np.ndarray, times: Sequence[float]) -> np.ndarray:
    """Return velocity, acceleration and rotation at points at some times, (times, n, 9)."""
    found, rows = [], np.zeros((len(points), WATER_ROW_LENGTH))
    rows[:, POINT:VELOCITY] = points
    for time in times[:1] if water.is_steady else times:
        found.append(ask(water.function, water.address, rows, time)[:, VELOCITY:SURFACE].copy())
    return np.array(found * len(times) if water.is_steady else found)
