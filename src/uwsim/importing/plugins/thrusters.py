r"""The thrusters of Gazebo and of UUV Simulator.

Gazebo's Thruster takes a thrust in newton, from ``min_thrust_cmd`` to ``max_thrust_cmd``, and
applies it at the origin of the propeller's link, along the axis of its joint (Thruster.hh of
gz-sim). A command x of this simulator, from -1 to 1, is a share of these limits. With
``use_angvel_cmd``, the command is a speed of the propeller, and the thrust its square,
:math:`T = C_T \rho D^4 \omega |\omega|`.

UUV Simulator's plug-in takes a speed of the rotor from ``clampMin`` to ``clampMax`` [rad/s]; with
the conversion ``Basic`` the thrust is :math:`T = c\, \omega |\omega|`, with ``LinearInterp`` a
table, of which the ends are imported as those of a square law.

ArduPilot's plug-in scales its channels to commands of thrust, (x + offset) multiplier for x from 0
to 1; these limits apply if they are narrower.

Not imported: the torque of the blades, the inertia of the rotor, gains of controllers, dead bands.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array, Pose, Triple
from ...scene.hydrodynamics.spec import MAX_TIME_CONSTANT, MIN_RADIUS, ThrusterSpec
from ..robot import NameTable
from ..sdf.flat_model import FlatJoint, FlatModel, FlatPlugin
from ..sdf.values import Source, child_of, children_of, flag_of, number_of, text_of
from .context import PluginContext, check

GAZEBO_THRUSTER = "thruster"
UUV_THRUSTERS = ("uuv_thruster_ros_plugin", "uuv_thruster_plugin")
DEFAULT_LIMIT = 1000.0
"""The limit of a thrust without ``max_thrust_cmd`` [N]."""
DEFAULT_DIAMETER = 0.02
"""The diameter of a propeller without ``propeller_diameter`` [m]."""
DIGITS = 9
"""The decimal places of a written position or direction."""


@dataclass(frozen=True, kw_only=True)
class _Curve:
    """The thrust of a thruster over its command."""

    forward: tuple[float, ...]
    """The coefficients ahead [N]."""
    backward: tuple[float, ...]
    """The coefficients astern [N]."""
    limits: tuple[float, float] = (-1.0, 1.0)
    """The limits of the command [1]."""
    note: str
    """The description."""


def propeller_joints(model: FlatModel) -> set[str]:
    """Return the paths of the joints of propellers."""
    paths = set()
    for plugin in model.plugins:
        joint = _joint_of(model, plugin)
        if joint is not None:
            paths.add(joint.path)
    return paths


def read_thrusters(context: PluginContext) -> list[ThrusterSpec]:
    """Return the thrusters of a model, in the order of the file."""
    limits = dict(_ardupilot_limits(context))
    names, thrusters = NameTable(), []
    for plugin in context.model.plugins:
        kind = plugin.plugin.kind
        if kind != GAZEBO_THRUSTER and kind not in UUV_THRUSTERS:
            continue
        joint = _joint_of(context.model, plugin)
        if joint is None or joint.child not in context.robot.links:
            name = text_of(plugin.plugin.node, "joint_name") or text_of(
                plugin.plugin.node, "jointName"
            )
            context.add("left out", plugin, f"the robot has no joint {name!r}")
            continue
        source = context.source(plugin)
        read = _read_gazebo if kind == GAZEBO_THRUSTER else _read_uuv
        curve = read(plugin, source, limits.get(joint.joint.name))
        check(source)
        if max(_top(curve.forward), _top(curve.backward)) <= 0.0:
            context.add("left out", plugin, "its greatest thrust is 0")
            continue
        name = names.add(joint.path.removesuffix("_joint"))
        thrusters.append(_make_thruster(name, joint, plugin, source, curve, context))
        context.add("imported", plugin, f"thruster {name}: {curve.note}")
    return thrusters


def _make_thruster(
    name: str,
    joint: FlatJoint,
    plugin: FlatPlugin,
    source: Source,
    curve: _Curve,
    context: PluginContext,
) -> ThrusterSpec:
    node = plugin.plugin.node
    link = context.robot.links[joint.child]
    diameter = number_of(node, 2.0 * 0.05, source, "propeller_diameter")
    has_radius = plugin.plugin.kind == GAZEBO_THRUSTER and diameter > 2.0 * MIN_RADIUS
    lag = 0.0
    if text_of(node, "dynamics", "type").lower() == "firstorder":
        lag = number_of(node, 0.0, source, "dynamics", "timeConstant")
    position = context.robot.frame_from_part(joint.child, Pose.identity()).position
    return ThrusterSpec(
        name=name,
        link=link.name,
        position=triple(position),
        direction=triple(joint.axis),
        forward=curve.forward,
        backward=None if curve.backward == curve.forward else curve.backward,
        limits=curve.limits,
        time_constant=min(max(lag, 0.0), MAX_TIME_CONSTANT),
        radius=0.5 * diameter if has_radius else 0.05,
    )


def triple(vector: Array) -> Triple:
    """Return a vector with `DIGITS` decimal places."""
    x, y, z = (round(float(value), DIGITS) + 0.0 for value in vector)
    return x, y, z


def _joint_of(model: FlatModel, plugin: FlatPlugin) -> FlatJoint | None:
    """Return the joint of the propeller of a plug-in; None for other plug-ins."""
    node = plugin.plugin.node
    if plugin.plugin.kind == GAZEBO_THRUSTER:
        return model.find_joint(text_of(node, "joint_name"), plugin.scope)
    if plugin.plugin.kind not in UUV_THRUSTERS:
        return None
    name = text_of(node, "jointName")
    for tail in (name, name.rpartition("/")[2]):
        if (joint := model.find_joint(tail, plugin.scope)) is not None:
            return joint
    link = text_of(node, "linkName").rpartition("/")[2]
    return next((j for j in model.joints.values() if link and j.joint.child == link), None)


def _read_gazebo(plugin: FlatPlugin, source: Source, limits: tuple[float, float] | None) -> _Curve:
    node = plugin.plugin.node
    low = number_of(node, -DEFAULT_LIMIT, source, "min_thrust_cmd")
    high = number_of(node, DEFAULT_LIMIT, source, "max_thrust_cmd")
    is_default = child_of(node, "max_thrust_cmd") is None
    origin = "Gazebo's default limit" if is_default else "max_thrust_cmd"
    if low > high:
        low, high, origin = -DEFAULT_LIMIT, DEFAULT_LIMIT, "Gazebo's default limit"
    if limits is not None and limits[1] < high:
        low, high, origin = max(low, limits[0]), limits[1], "limit of the ArduPilot plug-in"
    forward_thrust, backward_thrust = max(high, 0.0), max(-low, 0.0)
    is_square = flag_of(node, False, "use_angvel_cmd")
    law = "square of the command" if is_square else "proportional to the command"
    return _curve(
        forward_thrust,
        backward_thrust,
        f"{-backward_thrust:g} to {forward_thrust:g} N ({origin}), {law}",
        is_square=is_square,
    )


def _curve(forward_thrust: float, backward_thrust: float, note: str, *, is_square: bool) -> _Curve:
    def coefficients(thrust: float) -> tuple[float, ...]:
        return (0.0, thrust) if is_square else (thrust,)

    limits = (-1.0 if backward_thrust > 0.0 else 0.0, 1.0 if forward_thrust > 0.0 else 0.0)
    forward = coefficients(forward_thrust if forward_thrust > 0.0 else backward_thrust)
    backward = coefficients(backward_thrust if backward_thrust > 0.0 else forward_thrust)
    return _Curve(forward=forward, backward=backward, limits=limits, note=note)


def _read_uuv(plugin: FlatPlugin, source: Source, limits: tuple[float, float] | None) -> _Curve:
    node = plugin.plugin.node
    low = number_of(node, -math.inf, source, "clampMin")
    high = number_of(node, math.inf, source, "clampMax")
    conversion = child_of(node, "conversion")
    kind = text_of(conversion, "type").lower() or "basic"
    if kind == "linearinterp":
        outputs = [abs(value) for value in _words(text_of(conversion, "outputValues"))]
        inputs = _words(text_of(conversion, "inputValues"))
        pairs = list(zip(inputs, outputs, strict=False))
        forward_thrust = max(
            (thrust for speed, thrust in pairs if 0.0 < speed <= high), default=0.0
        )
        backward_thrust = max(
            (thrust for speed, thrust in pairs if low <= speed < 0.0), default=0.0
        )
        note = "the ends of its table, as a square law"
    else:
        forward_factor = number_of(conversion, 0.0, source, "rotorConstant")
        backward_factor = forward_factor
        note = "rotorConstant times the square of the speed"
        if kind == "bessa":
            forward_factor = number_of(conversion, 0.0, source, "rotorConstantR")
            backward_factor = number_of(conversion, 0.0, source, "rotorConstantL")
            note = "Bessa's law without its dead band"
        forward_thrust = abs(forward_factor) * high * high if math.isfinite(high) else 0.0
        backward_thrust = abs(backward_factor) * low * low if math.isfinite(low) else forward_thrust
    forward_thrust = min(forward_thrust, number_of(node, math.inf, source, "thrust_max"))
    backward_thrust = min(backward_thrust, -number_of(node, -math.inf, source, "thrust_min"))
    gain = abs(number_of(node, 1.0, source, "gain"))
    forward_thrust, backward_thrust = forward_thrust * gain, backward_thrust * gain
    return _curve(
        forward_thrust,
        backward_thrust,
        f"{-backward_thrust:g} to {forward_thrust:g} N, {note}",
        is_square=True,
    )


def _words(text: str) -> list[float]:
    values = []
    for word in text.split()[:1000]:
        try:
            values.append(float(word))
        except ValueError:
            return []
    return values


def _top(coefficients: tuple[float, ...]) -> float:
    return float(np.sum(coefficients))


def _ardupilot_limits(context: PluginContext) -> Iterator[tuple[str, tuple[float, float]]]:
    """Yield the limits of thrust that a plug-in of ArduPilot sends to a joint [N]."""
    for plugin in context.model.plugins:
        if plugin.plugin.kind != "ardupilotplugin":
            continue
        source = context.source(plugin)
        for node in children_of(plugin.plugin.node, "control"):
            multiplier = number_of(node, 1.0, source, "multiplier")
            offset = number_of(node, 0.0, source, "offset")
            ends = sorted((multiplier * offset, multiplier * (1.0 + offset)))
            if text_of(node, "cmd_topic").endswith("cmd_thrust") and ends[1] > 0.0:
                yield text_of(node, "jointName"), (ends[0], ends[1])
        check(source)
