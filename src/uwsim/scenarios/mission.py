"""The part of a log that a scenario repeats: its poses, from time 0 on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..devices.motion.pose_track import PoseTrack
from ..devices.motion.scripted_motion import MAX_POSES
from ..errors import BadSetting
from ..logs import VehicleLog
from ..virtual_sensors import FollowSettings, make_track
from .request import MAX_DURATION, ScenarioRequest

MIN_DURATION = 0.1
"""The shortest mission [s]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Mission:
    """The motion of a vehicle during a scenario."""

    start: float
    """The time in the log at which the scenario begins [s]."""
    duration: float
    """The duration [s]."""
    times: Array
    """The times of the poses since the begin, (n,) [s]."""
    positions: Array
    """The positions in L, (n, 3) [m]."""
    quaternions: Array
    """The orientations wxyz, (n, 4)."""

    def make_track(self, request: ScenarioRequest) -> PoseTrack:
        """Return the poses, interpolated with the settings of the request."""
        return PoseTrack(
            self.times,
            self.positions,
            self.quaternions,
            max_gap=request.max_gap,
            gaps=request.gaps,
        )


def cut_mission(log: VehicleLog, request: ScenarioRequest, start: float, end: float) -> Mission:
    """Return the poses between two times of a log, with a pose at each of them.

    Args:
        log: the log.
        request: the request, for the treatment of gaps.
        start: the time of the begin in the log [s].
        end: the time of the end in the log [s].

    Raises:
        BadSetting: there is no pose, the times are not in the log, or the mission is too long.
    """
    track = make_track(log, FollowSettings(gaps=request.gaps, max_gap=request.max_gap))
    if not MIN_DURATION <= end - start <= MAX_DURATION:
        raise BadSetting(
            f"The mission lasts {end - start:.6g} s; expected {MIN_DURATION:g} s to "
            f"{MAX_DURATION:g} s. --from and --to choose a part of the log."
        )
    if start >= track.duration or end <= float(track.times[0]):
        raise BadSetting(
            f"The log has poses from {track.times[0]:.6g} s to {track.duration:.6g} s; the mission "
            f"is from {start:.6g} s to {end:.6g} s."
        )
    motion = log.motion
    assert motion is not None
    is_inside = (motion.times > start) & (motion.times < end)
    if int(is_inside.sum()) + 2 > MAX_POSES:
        raise BadSetting(f"The mission has more than {MAX_POSES} poses.")
    start_pose, end_pose = track.pose(start), track.pose(end)
    return Mission(
        start=start,
        duration=end - start,
        times=np.concatenate([[0.0], motion.times[is_inside] - start, [end - start]]),
        positions=np.vstack([start_pose.position, motion.positions[is_inside], end_pose.position]),
        quaternions=np.vstack(
            [start_pose.quaternion, motion.quaternions[is_inside], end_pose.quaternion]
        ),
    )
