r"""Samples of a motion that cannot be true: single numbers that are missing, and spikes.

A position is a spike if a coordinate differs from the median of `NEIGHBOURS` samples around it by
more than

.. math:: d_\mathrm{max} = d_0 + v_\mathrm{max} \, \max_j \lvert t_j - t_i \rvert

with :math:`d_0` of `MAX_JUMP` and :math:`v_\mathrm{max}` of `MAX_SPEED`: up to three successive
samples that no vehicle reaches between its neighbours. A step that lasts is a correction of the
navigation, which remains. Without a removal, one wrong number makes windows of a gap fail, and
moves a replayed vehicle out of the scene and back.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array

Mask = npt.NDArray[np.bool_]
"""A mark for each sample, (n,)."""
NEIGHBOURS = 7
"""The number of samples of a median."""
MAX_JUMP = 1.0
"""The distance from the median that counts as noise [m]."""
MAX_SPEED = 30.0
"""The greatest speed of a vehicle [m/s]."""
MAX_DISTANCE = 1e8
"""The greatest coordinate of a position [m]."""
MAX_LINEAR = 100.0
"""The greatest measured velocity along an axis [m/s]."""
MAX_ANGULAR = 100.0
"""The greatest measured angular velocity about an axis [rad/s]."""
MAX_LISTED = 5


def find_missing_coordinates(positions: Array) -> Mask:
    """Mark positions without a coordinate that most samples of the log have, (n,).

    A coordinate that half of the samples lack is not in the log, or has a rate of its own.
    """
    is_missing = ~np.isfinite(positions)
    is_logged = 2 * is_missing.sum(axis=0) < len(positions)
    mask: Mask = np.asarray((is_missing & is_logged).any(axis=1))
    return mask


def find_spikes(times: Array, positions: Array) -> Mask:
    """Mark positions that no vehicle reaches between its neighbours, (n,).

    Args:
        times: the times, strictly increasing, (n,) [s].
        positions: the positions, (n, 3) [m]; NaN is no spike.
    """
    mask: Mask = np.asarray((np.abs(positions) > MAX_DISTANCE).any(axis=1))
    if len(times) < NEIGHBOURS:
        return mask
    half = NEIGHBOURS // 2
    firsts = np.clip(np.arange(len(times)) - half, 0, len(times) - NEIGHBOURS)
    last_times, first_times = times[firsts + NEIGHBOURS - 1], times[firsts]
    limits = MAX_JUMP + MAX_SPEED * np.maximum(last_times - times, times - first_times)
    for column in positions.T:
        windows = np.sort(np.lib.stride_tricks.sliding_window_view(column, NEIGHBOURS), axis=1)
        medians = windows[firsts, half]
        mask |= np.abs(column - medians) > limits
    return mask


def find_fast_twists(twists: Array) -> Mask:
    """Mark twists beyond `MAX_LINEAR` or `MAX_ANGULAR`, (n,)."""
    limits = np.array([MAX_LINEAR] * 3 + [MAX_ANGULAR] * 3)
    mask: Mask = np.asarray((np.abs(twists) > limits).any(axis=1))
    return mask


def list_places(mask: Mask, times: Array, lines: Sequence[int] | None) -> str:
    """Return the lines of the file of marked samples, or their times: ``line 12``."""
    indices = np.flatnonzero(mask)
    shown_indices = indices[:MAX_LISTED].tolist()
    if lines is None:
        text = "at " + ", ".join(f"{times[index]:.2f} s" for index in shown_indices)
    else:
        text = "line " if len(indices) == 1 else "lines "
        text += ", ".join(str(int(lines[index])) for index in shown_indices)
    n_more = len(indices) - len(shown_indices)
    return f"{text} and {n_more} more" if n_more else text
