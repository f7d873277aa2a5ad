"""Errors and warnings about vehicles whose motion is given by a table, or from outside."""

from __future__ import annotations

from collections.abc import Iterator

from ...devices.motion.follow_pose import FollowPoseSpec
from ...devices.motion.scripted_motion import ScriptedMotionSpec
from ...devices.sway import SwaySpec
from ...errors import Diagnostic, UwsimError
from ...model.robots import find_file
from ..subjects import CheckedScene

MOTIONS = (ScriptedMotionSpec, FollowPoseSpec)
"""The elements that set the pose of a vehicle at every step."""


def given_motions(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report sources of poses that are missing or given twice, and motions without an effect."""
    for vehicle in scene.spec.vehicles:
        for follower in vehicle.parts_of(FollowPoseSpec):
            if (error := follower.describe_source_error()) is not None:
                yield scene.error(follower, error)
        motions = [part for part in vehicle.parts if isinstance(part, MOTIONS)]
        for motion in motions[:-1]:
            yield scene.warning(
                motion, f"{vehicle.name!r} has {len(motions)} given motions; the last one applies"
            )
        for sway in vehicle.parts_of(SwaySpec) if motions else ():
            yield scene.warning(
                sway, f"{vehicle.name!r} follows given poses: <u:sway> has no lasting effect"
            )


def pose_tables(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report tables of poses that are missing or invalid."""
    for vehicle in scene.spec.vehicles:
        for motion in vehicle.parts_of(ScriptedMotionSpec):
            try:
                motion.read(find_file(motion.file, scene.spec.path, scene.data_path))
            except UwsimError as error:
                yield scene.error(motion, str(error).rstrip("."), "file")
