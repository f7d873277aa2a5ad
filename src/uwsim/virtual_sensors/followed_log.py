"""A scene whose vehicle follows a log: at each step it is where the real vehicle was.

The topics that the scene publishes are moved below ``/virtual``, so that they never coincide with
those of the recording.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from ..devices.motion.follow_pose import FollowPoseSpec
from ..devices.motion.pose_track import GapPolicy, PoseTrack
from ..devices.motion.scripted_motion import ScriptedMotion, ScriptedMotionSpec
from ..devices.sway import SwaySpec
from ..errors import BadSetting, UnknownName
from ..logs import VehicleLog
from ..scene.spec import SceneSpec
from ..scene.vehicle import VehicleSpec
from ..simulation import Simulation
from .composed_camera import PREFIX

MOTIONS = (SwaySpec, FollowPoseSpec, ScriptedMotionSpec)
"""The elements of a vehicle that move it, which a log replaces."""


@dataclass(frozen=True, kw_only=True)
class FollowSettings:
    """The settings of a vehicle that follows a log."""

    gaps: GapPolicy = "hold"
    """The treatment of gaps in the poses."""
    max_gap: float = 1.0
    """The longest time between two poses that is no gap [s]."""


def choose_vehicle(scene: SceneSpec, log: VehicleLog, name: str | None) -> str:
    """Return the vehicle of a scene that follows a log.

    Args:
        scene: the scene.
        log: the log.
        name: the requested vehicle; None: the one with the name in the log, or the first.

    Raises:
        UnknownName: the scene has no vehicle of the requested name.
        BadSetting: the scene has no vehicle.
    """
    names = [vehicle.name for vehicle in scene.vehicles]
    if not names:
        raise BadSetting("The scene has no vehicle that could follow the log.")
    if name is not None and name not in names:
        raise UnknownName("vehicle", name, names)
    return name or (log.vehicle if log.vehicle in names else names[0])


def make_track(log: VehicleLog, settings: FollowSettings) -> PoseTrack:
    """Return the poses of a log.

    Raises:
        BadSetting: the log has no poses, or gaps that the settings refuse.
    """
    motion = log.motion
    if motion is None or not len(motion.times):
        raise BadSetting(f"{log.path}: the log has no poses.")
    try:
        return PoseTrack(
            motion.times,
            motion.positions,
            motion.quaternions,
            max_gap=settings.max_gap,
            gaps=settings.gaps,
        )
    except BadSetting as error:
        raise BadSetting(f"{log.path}: {error}") from None


def make_followed_scene(scene: SceneSpec, vehicle: str) -> SceneSpec:
    """Return a scene in which a vehicle follows poses, and whose topics are below ``/virtual``."""
    return replace(
        replace_motion(scene, vehicle, ScriptedMotionSpec(file="")),
        ros_interfaces=tuple(_move_topics(spec) for spec in scene.ros_interfaces),
    )


def replace_motion(
    scene: SceneSpec, vehicle: str, motion: ScriptedMotionSpec | FollowPoseSpec
) -> SceneSpec:
    """Return a scene in which an element moves the first vehicle of a name, and no other does."""
    index = [spec.name for spec in scene.vehicles].index(vehicle)
    vehicles = [
        _replace_parts(spec, motion) if number == index else spec
        for number, spec in enumerate(scene.vehicles)
    ]
    return replace(scene, vehicles=tuple(vehicles))


def follow_log(simulation: Simulation, vehicle: str, track: PoseTrack) -> None:
    """Let a vehicle of a scene of `make_followed_scene` follow poses from now on."""
    for device in simulation.world.devices:
        if isinstance(device, ScriptedMotion) and device.vehicle.name == vehicle:
            device.follow(track)
            device.animate(simulation.time)
            return
    raise UnknownName("vehicle with a scripted motion", vehicle, ())


def describe_track(track: PoseTrack, log: VehicleLog) -> list[str]:
    """Return the sentences about the defects of the poses, for warnings."""
    remarks = list(log.remarks)
    if track.n_left_out:
        remarks.append(f"{track.n_left_out} poses are not finite; they are left out")
    if len(track.gap_starts):
        start = int(track.gap_starts[0])
        remarks.append(
            f"{len(track.gap_starts)} gaps are in the poses, the first at "
            f"{track.times[start]:.3f} s of {track.times[start + 1] - track.times[start]:.2f} s"
        )
    return remarks


def _replace_parts(spec: VehicleSpec, motion: ScriptedMotionSpec | FollowPoseSpec) -> VehicleSpec:
    parts = [part for part in spec.parts if not isinstance(part, MOTIONS)]
    return replace(spec, parts=(*parts, motion))


def _move_topics(spec: Any) -> Any:
    if spec.subscribes:
        return spec
    names = {field: getattr(spec, field, None) for field in spec.message_types()}
    new_names = {field: f"{PREFIX}/{name.strip('/')}" for field, name in names.items() if name}
    return replace(spec, **new_names) if new_names else spec
