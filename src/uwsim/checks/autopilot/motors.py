r"""The comparison of a vehicle's thrusters with the motor matrix of a frame.

A thruster at :math:`p` from the centre of mass that pushes along :math:`d` has the effects

.. math:: (m_x / M_x, m_y / M_y, m_z / M_z, -d_z, d_x, d_y), \qquad m = p \times d

on roll, pitch, yaw, throttle, forward and lateral, in axes forward, starboard, down; :math:`M_i` is
the greatest moment about the axis of all thrusters. It agrees with a motor if its effect along each
axis with a factor has the sign of the factor and at least `MIN_EFFECT` of the greatest, and if it
pushes along no other axis with more than `MAX_SIDE_EFFECT`. Moments about axes without a factor are
not compared: the height of thrusters causes them, and ArduSub's matrices neglect them, too. Nor are
the sizes of factors: of what they change, only the gains of ArduSub depend.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...autopilots.ardupilot.frames import AXES, Factors, Frame
from ...base.geometry import Array

MIN_EFFECT = 0.35
"""The least effect along an axis with a factor, as a fraction of that of the strongest [1]."""
MAX_SIDE_EFFECT = 0.5
"""The greatest force along an axis without a factor, as a fraction of the thrust [1]."""
N_MOMENTS = 3
"""The number of the first axes that are moments."""
EFFECTS = {
    "roll": ("rolls it to starboard", "rolls it to port"),
    "pitch": ("raises the bow", "lowers the bow"),
    "yaw": ("turns the bow to starboard", "turns the bow to port"),
    "throttle": ("pushes up", "pushes down"),
    "forward": ("pushes forward", "pushes backward"),
    "lateral": ("pushes to starboard", "pushes to port"),
}
"""The words for a positive and a negative effect along each axis."""
MIRRORS = {
    "its y position has the wrong sign": ((1, -1), (1, 1, 1)),
    "its x position has the wrong sign": ((-1, 1), (1, 1, 1)),
    "the y component of its direction has the wrong sign": ((1, 1), (1, -1, 1)),
    "the x component of its direction has the wrong sign": ((1, 1), (-1, 1, 1)),
    "it is mirrored between port and starboard": ((1, -1), (1, -1, 1)),
    "it is mirrored between bow and stern": ((-1, 1), (-1, 1, 1)),
    "x and y of its position have the wrong sign": ((-1, -1), (1, 1, 1)),
}
"""The mistakes that are tried, each as signs of the position's x and y, and of the direction."""


@dataclass(frozen=True, eq=False)
class Motor:
    """A thruster behind an output of the autopilot."""

    channel: int
    """The number of the output, from 1."""
    thruster: str
    """The name of the thruster."""
    position: Array
    """The position from the centre of mass, forward, starboard, down, (3,) [m]."""
    direction: Array
    """The direction of the push at a positive output, forward, starboard, down, (3,) [1]."""

    @property
    def moment(self) -> Array:
        """The moment per thrust about the centre of mass, (3,) [m]."""
        return np.cross(self.position, self.direction)


@dataclass(frozen=True)
class Finding:
    """A difference of the thrusters from a frame."""

    channels: tuple[int, ...]
    """The numbers of the outputs that differ."""
    text: str
    """The description, with what mends it."""


def find_differences(motors: Mapping[int, Motor], frame: Frame) -> list[Finding]:
    """Return the differences of a vehicle's motors from those of a frame.

    Args:
        motors: the thrusters, by index of the motor of the frame.
        frame: the frame.
    """
    reaches = _greatest_moments(list(motors.values()))
    indices = [
        index
        for index, motor in motors.items()
        if index < len(frame.motors) and not _agrees(motor, frame.motors[index], reaches)
    ]
    findings = list(_find_counts(motors, frame))
    reversed_indices = [
        index for index in indices if _agrees(_negate(motors[index]), frame.motors[index], reaches)
    ]
    findings += [_describe_reversal(motors[index], index, frame) for index in reversed_indices]
    other_indices = [index for index in indices if index not in reversed_indices]
    order = _find_order(other_indices, motors, frame, reaches)
    if order:
        findings.append(_describe_order(order, motors, frame))
    else:
        findings += [
            _describe_mirror(motors[index], index, frame, reaches) for index in other_indices
        ]
    return findings


def _find_counts(motors: Mapping[int, Motor], frame: Frame) -> Iterator[Finding]:
    """Report motors of the frame without a thruster, and thrusters without a motor."""
    lost = [index + 1 for index in range(len(frame.motors)) if index not in motors]
    if lost:
        numbers = ", ".join(map(str, lost))
        text = f"{frame.title} has {len(frame.motors)} motors; nothing is at motor {numbers}"
        yield Finding((), text)
    surplus_motors = [motor for index, motor in motors.items() if index >= len(frame.motors)]
    if surplus_motors:
        names = ", ".join(repr(motor.thruster) for motor in surplus_motors)
        text = f"{frame.title} has {len(frame.motors)} motors and does not drive {names}"
        yield Finding(tuple(motor.channel for motor in surplus_motors), text)


def _greatest_moments(motors: Sequence[Motor]) -> Array:
    """Return the greatest moment per thrust about each axis, (3,) [m]; 1 where there is none."""
    moments = np.abs(np.array([motor.moment for motor in motors]).reshape(-1, 3)).max(
        axis=0, initial=0.0
    )
    return np.where(moments > 1e-6, moments, 1.0)


def _effects(motor: Motor, reaches: Array) -> Array:
    """Return the effects along `AXES`, (6,) [1]."""
    x, y, z = motor.direction
    return np.array([*(motor.moment / reaches), -z, x, y])


def _agrees(motor: Motor, factors: Factors, reaches: Array) -> bool:
    effects = _effects(motor, reaches)
    for k, (effect, factor) in enumerate(zip(effects, factors, strict=True)):
        if factor and effect * np.sign(factor) < MIN_EFFECT:
            return False
        if not factor and k >= N_MOMENTS and abs(effect) > MAX_SIDE_EFFECT:
            return False
    return True


def _negate(motor: Motor) -> Motor:
    return replace(motor, direction=-motor.direction)


def _find_order(
    indices: Sequence[int], motors: Mapping[int, Motor], frame: Frame, reaches: Array
) -> dict[int, int]:
    """Return the motor of the frame that each of some motors is, by index; empty if none fits.

    Every motor of ``indices`` must be another one of them, perhaps reversed.
    """
    fits = {
        source: [
            target
            for target in indices
            if any(
                _agrees(motor, frame.motors[target], reaches)
                for motor in (motors[source], _negate(motors[source]))
            )
        ]
        for source in indices
    }
    sources: dict[int, int] = {}  # by target

    def assign(source: int, targets: set[int]) -> bool:
        for target in fits[source]:
            if target in targets:
                continue
            targets.add(target)
            if target not in sources or assign(sources[target], targets):
                sources[target] = source
                return True
        return False

    if not all(assign(source, set()) for source in indices):
        return {}
    return {source: target for target, source in sources.items()}


def _describe_effects(motor: Motor, factors: Factors, reaches: Array) -> str:
    """Return the effects of a motor along the axes with a factor, in words."""
    effects = _effects(motor, reaches)
    words = [
        EFFECTS[axis][0 if effect > 0.0 else 1]
        if abs(effect) >= MIN_EFFECT
        else f"has little effect on {axis}"
        for axis, effect, factor in zip(AXES, effects, factors, strict=True)
        if factor
    ]
    return ", ".join(words[:-1]) + (" and " if words[1:] else "") + words[-1]


def _expected(factors: Factors) -> str:
    words = [EFFECTS[a][0 if f > 0 else 1] for a, f in zip(AXES, factors, strict=True) if f]
    return ", ".join(words)


def _describe_reversal(motor: Motor, index: int, frame: Frame) -> Finding:
    parameter = (
        f"SERVO{motor.channel}_REVERSED 1"
        if frame.number is None
        else f"MOT_{index + 1}_DIRECTION -1"
    )
    return Finding(
        (motor.channel,),
        f"channel {motor.channel}, thruster {motor.thruster!r}, is reversed: motor {index + 1} of "
        f"{frame.title} {_expected(frame.motors[index])} at a positive output. Set {parameter}, or "
        "change <reversed> of its <channel>",
    )


def _describe_order(order: Mapping[int, int], motors: Mapping[int, Motor], frame: Frame) -> Finding:
    channels = sorted(motors[index].channel for index in order)
    places = ", ".join(
        f"{motors[source].thruster!r} is motor {target + 1}"
        for source, target in sorted(order.items())
    )
    parameters = ", ".join(
        f"SERVO{motors[source].channel}_FUNCTION {frame.function(target)}"
        for source, target in sorted(order.items())
    )
    names = (
        " and ".join(map(str, channels)) if len(channels) == 2 else ", ".join(map(str, channels))
    )
    return Finding(
        tuple(channels),
        f"channels {names} are exchanged: of {frame.title}, {places}. Set {parameters}, or change "
        "the <thruster> of these <channel> elements",
    )


def _describe_mirror(motor: Motor, index: int, frame: Frame, reaches: Array) -> Finding:
    factors = frame.motors[index]
    causes = [
        cause
        for cause, (position_signs, direction_signs) in MIRRORS.items()
        if _fits_mirrored(motor, position_signs, direction_signs, factors, reaches)
    ]
    text = (
        f"thruster {motor.thruster!r} (channel {motor.channel}) is mirrored against motor "
        f"{index + 1} of {frame.title}: at a positive output it "
        f"{_describe_effects(motor, factors, reaches)}; expected: {_expected(factors)}"
    )
    return Finding((motor.channel,), f"{text}. Probably {causes[0]}" if causes else text)


def _fits_mirrored(
    motor: Motor,
    position_signs: tuple[int, int],
    direction_signs: tuple[int, int, int],
    factors: Factors,
    reaches: Array,
) -> bool:
    changed_motor = replace(
        motor,
        position=motor.position * np.array([*position_signs, 1]),
        direction=motor.direction * np.array(direction_signs),
    )
    return _agrees(changed_motor, factors, reaches)
