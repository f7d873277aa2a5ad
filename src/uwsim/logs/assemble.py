"""Assembly of a motion series from columns of any frame, with its checks."""

from __future__ import annotations

from typing import Literal

import numpy as np

from ..base.geometry import Array
from ..errors import AssetError
from .frames import (
    BodyFrame,
    WorldFrame,
    convert_body_vectors,
    convert_orientations,
    convert_positions,
    rotate_vectors_back,
)
from .outliers import (
    MAX_ANGULAR,
    MAX_JUMP,
    MAX_LINEAR,
    MAX_SPEED,
    NEIGHBOURS,
    Mask,
    find_fast_twists,
    find_missing_coordinates,
    find_spikes,
    list_places,
)
from .smoothing import HALF_WIDTH, estimate_twists
from .vehicle_log import MotionSeries

MAX_NORM_ERROR = 0.05
"""The greatest deviation of a quaternion's norm from 1 that is normalized without a remark."""


def make_motion(
    times: Array,
    positions: Array,
    quaternions: Array,
    twists: Array | None,
    *,
    world: WorldFrame,
    body: BodyFrame,
    remarks: list[str],
    is_world_velocity: bool = False,
    origin: tuple[float, ...] = (0.0, 0.0, 0.0),
    lines: Array | None = None,
) -> MotionSeries | None:
    """Return the motion in L and base axes; None without a valid sample.

    Samples without an orientation are removed, and those with a wrong position (`outliers`).
    Quaternions are normalized. Missing twists are estimated from the poses (`smoothing`). Remarks
    state all of it.

    Args:
        times: the times, strictly increasing, (n,) [s].
        positions: the positions in the log's world frame, (n, 3) [m]; NaN: none.
        quaternions: the orientations ``world_from_body`` of the log, (n, 4).
        twists: the twists in body axes, (n, 6); NaN: none; None: the log has no twists.
        world: the world frame of the log.
        body: the body frame of the log.
        remarks: the list to which repairs are added.
        is_world_velocity: True if the linear velocities have the axes of the log's world frame.
        origin: the position of the log's origin in L, (3,) [m].
        lines: the line of each sample in its file, (n,); None: samples have no lines.
    """
    keep = _find_positions(times, positions, lines, remarks)
    times, positions, quaternions = times[keep], positions[keep], quaternions[keep]
    twists = None if twists is None else _remove_fast_twists(twists[keep], remarks)
    norms = np.sqrt((quaternions * quaternions).sum(axis=1))
    is_valid = np.isfinite(norms) & (norms > 1e-6)
    if not is_valid.all():
        remarks.append(f"motion: {int((~is_valid).sum())} samples without an orientation; removed.")
        times, positions, quaternions = times[is_valid], positions[is_valid], quaternions[is_valid]
        norms = norms[is_valid]
        twists = None if twists is None else twists[is_valid]
    if len(times) == 0:
        return None
    n_wrong = int((np.abs(norms - 1.0) > MAX_NORM_ERROR).sum())
    if n_wrong:
        remarks.append(f"motion: {n_wrong} quaternions are not of unit length; normalized.")
    quaternions = quaternions / norms[:, None]
    if twists is not None and is_world_velocity:
        twists = np.hstack([rotate_vectors_back(quaternions, twists[:, :3]), twists[:, 3:]])
    quaternions = convert_orientations(quaternions, world, body)
    positions = convert_positions(positions, world) + np.array(origin)
    if twists is not None:
        linear, angular = (convert_body_vectors(part, body) for part in np.hsplit(twists, 2))
        twists = np.hstack([linear, angular])
    twists, source = _complete_twists(times, positions, quaternions, twists, remarks)
    return MotionSeries(
        times=times,
        positions=positions,
        quaternions=quaternions,
        twists=twists,
        twist_source=source,
    )


def _find_positions(
    times: Array, positions: Array, lines: Array | None, remarks: list[str]
) -> Mask:
    """Mark the samples whose positions remain, and state the others with their places."""
    is_missing = find_missing_coordinates(positions)
    is_spike = np.zeros(len(times), dtype=np.bool_)
    is_spike[~is_missing] = find_spikes(times[~is_missing], positions[~is_missing])
    limits = f"{MAX_JUMP:g} m and {MAX_SPEED:g} m/s from the median of {NEIGHBOURS} samples"
    for mask, text in (
        (is_missing, "without all coordinates of the position"),
        (is_spike, f"with a position beyond {limits}"),
    ):
        if mask.any():
            count = int(mask.sum())
            samples = "1 sample" if count == 1 else f"{count} samples"
            places = list_places(mask, times, None if lines is None else lines.tolist())
            remarks.append(f"motion: {samples} {text}; removed: {places}.")
    return ~(is_missing | is_spike)


def _remove_fast_twists(twists: Array, remarks: list[str]) -> Array:
    is_fast = find_fast_twists(twists)
    if is_fast.any():
        remarks.append(
            f"motion: {int(is_fast.sum())} samples with a twist beyond {MAX_LINEAR:g} m/s or "
            f"{MAX_ANGULAR:g} rad/s; removed."
        )
        twists = np.where(is_fast[:, None], np.nan, twists)
    return twists


def _complete_twists(
    times: Array, positions: Array, quaternions: Array, twists: Array | None, remarks: list[str]
) -> tuple[Array, Literal["log", "smoothed"]]:
    if twists is not None and np.isfinite(twists).all():
        return twists, "log"
    estimates = estimate_twists(times, positions, quaternions)
    if twists is None:
        twists, gap_text = estimates, "no twists"
    else:
        count = int((~np.isfinite(twists)).any(axis=1).sum())
        gap_text = f"{count} samples with an incomplete twist"
        twists = np.where(np.isfinite(twists), twists, estimates)
    remarks.append(
        f"motion: {gap_text}; estimated from poses by a cubic Savitzky-Golay filter of "
        f"{2.0 * HALF_WIDTH:g} s."
    )
    return twists, "smoothed"


def check_content(motion: MotionSeries | None, n_commands: int, name: str) -> None:
    """Raise AssetError for a log without motion and commands."""
    if motion is None and n_commands == 0:
        raise AssetError(f"{name} has neither a motion nor commands of a vehicle.")
