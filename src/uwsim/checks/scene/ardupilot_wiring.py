"""Errors about the channels, lamps and rangefinders of ``<u:ardupilot>``."""

from __future__ import annotations

from collections.abc import Iterator

from ...autopilots.ardupilot.answer import N_RANGES
from ...devices.ardupilot import ArduPilotSpec
from ...devices.ardupilot.channels import ChannelSpec
from ...devices.lamp import LampSpec
from ...errors import Diagnostic, SceneError
from ...schema import line_of
from ..subjects import CheckedScene

TARGETS = ("thruster", "lamp", "joint")
"""The elements of a channel, of which it has one."""


def check_wiring(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report channels that drive nothing known, and more rangefinders than ArduPilot reads."""
    lamps = [lamp.name for v in scene.spec.vehicles for lamp in v.parts_of(LampSpec)]
    for index, vehicle in enumerate(scene.spec.vehicles):
        specs = vehicle.parts_of(ArduPilotSpec)
        if not specs:
            continue
        names = {"thruster": scene.thruster_names(index), "lamp": lamps}
        names["joint"] = _joint_names(scene, index)
        for spec in specs[1:]:
            first_line = f" (line {line_of(specs[0])})" if line_of(specs[0]) else ""
            message = f"{vehicle.name!r} has another <u:ardupilot>{first_line}; expected one"
            yield scene.error(spec, f"<u:ardupilot>: {message}")
        for spec in specs:
            yield from _check_shared_targets(scene, spec)
            for channel in spec.channels:
                yield from _check_channel(scene, channel, names, vehicle.dynamics is not None)
            if len(spec.rangefinders) > N_RANGES:
                message = f"{len(spec.rangefinders)} <rangefinder>: ArduPilot reads {N_RANGES}."
                yield scene.error(spec, message, "rangefinder")


def _check_channel(
    scene: CheckedScene,
    channel: ChannelSpec,
    names: dict[str, list[str] | None],
    is_dynamic: bool,
) -> Iterator[Diagnostic]:
    """Report the errors of a channel.

    Args:
        scene: the scene.
        channel: the channel.
        names: the valid names by kind of target; None if they could not be read.
        is_dynamic: True if the vehicle has dynamics.
    """
    targets = {kind: name for kind in TARGETS if (name := getattr(channel, kind)) is not None}
    if len(targets) != 1:
        description = " and ".join(f"<{kind}>" for kind in targets) or "none of them"
        message = (
            f"<channel> {channel.number} has {description}; expected one of <thruster>, <lamp> and "
            "<joint>"
        )
        yield scene.error(channel, message)
    for kind, name in targets.items():
        valid_names = names[kind]
        if valid_names is not None and name not in valid_names:
            near = scene.diagnostics.suggest(name, valid_names)
            yield scene.error(channel, f"No {kind} is called {name!r}.{near}", kind)
        elif kind == "joint" and not is_dynamic:
            message = f"<channel>: the joint {name!r} has no servo: the vehicle is kinematic."
            yield scene.error(channel, message, kind)
    try:
        channel.pwm_curve()
    except SceneError as error:
        yield from error.diagnostics


def _check_shared_targets(scene: CheckedScene, spec: ArduPilotSpec) -> Iterator[Diagnostic]:
    """Report thrusters and joints that two channels drive, of which the last would win."""
    drivers: dict[tuple[str, str], ChannelSpec] = {}
    for channel in spec.channels:
        for kind in ("thruster", "joint"):
            name = getattr(channel, kind)
            if name is None:
                continue
            other = drivers.setdefault((kind, name), channel)
            if other is not channel:
                line = f" (line {line_of(other)})" if line_of(other) else ""
                message = (
                    f"<channel> {channel.number}: channel {other.number}{line} drives the {kind} "
                    f"{name!r}, too; expected one channel for it"
                )
                yield scene.error(channel, message, kind)


def _joint_names(scene: CheckedScene, index: int) -> list[str] | None:
    robot = scene.robots.get(index)
    return None if robot is None else [joint.name for joint in robot.movable_joints]
