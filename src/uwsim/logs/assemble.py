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
) -> MotionSeries | None:
    """Return the motion in L and base axes; None without a valid sample.

    Samples without an orientation are removed. Quaternions are normalized. Missing twists are
    estimated from the poses (`smoothing`), which a remark states.

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
    """
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
