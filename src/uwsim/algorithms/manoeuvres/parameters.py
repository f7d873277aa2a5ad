"""The parameters of manoeuvring algorithms, and their checks."""

from __future__ import annotations

import math
from collections.abc import Mapping

from ...errors import BadSetting

MAX_NUMBERS = 64
"""The greatest number of values of a list in a parameter."""

STEERING: Mapping[str, float | str] = {
    "odometry_topic": "/odometry",
    "wrench_topic": "",
    "fins_topic": "",
    "rudder_topic": "rudderTopic",
    "ahead": 0.0,
    "astern": 0.0,
    "yaw_moment": 0.0,
    "rudders": "",
    "elevators": "",
    "limit": 35.0,
    "z_down": 1.0,
    "approach": 60.0,
    "heading_kp": 1.0,
    "heading_ki": 0.0,
    "heading_kd": 1.0,
    "heave_kp": 0.0,
    "heave_kd": 0.0,
    "roll_kp": 0.0,
    "roll_kd": 0.0,
    "trim_kp": 0.0,
    "trim_kd": 0.0,
    "pitch_kp": 1.0,
    "pitch_kd": 1.0,
    "pitch_per_depth": 0.2,
}
"""The parameters of all manoeuvring algorithms, with their defaults.

- ``odometry_topic``, ``wrench_topic``, ``fins_topic``: the topics of the vehicle; a topic that is
  empty is not used. The ordered rudder angle [rad] is published on ``rudder_topic``.
- ``ahead``, ``astern``: the thrust of the approach, and the greatest thrust astern [N].
- ``yaw_moment``: the moment of the thrusters per rudder angle [N m/rad]; 0 for a vehicle that fins
  steer.
- ``rudders``, ``elevators``: the angle of each fin per angle of the rudder to starboard, and per
  angle of the elevator bow up [1], separated by blanks.
- ``limit``: the greatest rudder angle, hard over [deg].
- ``z_down``: 1 if z of the odometry points down, 0 if it points up.
- ``approach``: the time of the approach [s], with the gains of the heading [1, 1/s, s].
- ``heave_kp``, ``heave_kd``: the gains with which thrusters hold the depth [N/m, N s/m].
- ``roll_kp``, ``roll_kd``, ``trim_kp``, ``trim_kd``: the gains with which thrusters hold roll and
  pitch at 0 [N m/rad, N m s/rad].
- ``pitch_kp``, ``pitch_kd``, ``pitch_per_depth``: the gains with which elevators hold the depth by
  pitching [1, s, rad/m]."""


def parse_numbers(name: str, value: float | str) -> tuple[float, ...]:
    """Read numbers that are separated by blanks.

    Raises:
        BadSetting: a value is not a finite number, or there are too many.
    """
    texts = str(value).split()
    try:
        numbers = tuple(float(text) for text in texts)
    except ValueError:
        numbers = (math.nan,)
    if len(numbers) > MAX_NUMBERS or not all(map(math.isfinite, numbers)):
        raise BadSetting(
            f"algorithm.{name}={str(value)[:60]!r}: expected up to {MAX_NUMBERS} finite numbers, "
            "separated by blanks."
        )
    return numbers


def check_numbers(parameters: Mapping[str, float | str]) -> None:
    """Raise BadSetting if a parameter that is a list of numbers, or a time, is invalid."""
    for name in ("rudders", "elevators", "rates", "angles", "neutral"):
        if name in parameters:
            parse_numbers(name, parameters[name])
    for name in ("rates", "angles", "neutral"):
        if name in parameters and not str(parameters[name]).split():
            raise BadSetting(f"algorithm.{name}: expected one number at least.")
    for name in ("approach", "hold"):
        value = parameters.get(name, 1.0)
        if not isinstance(value, float | int) or not 0.0 <= value <= 3600.0:
            raise BadSetting(f"algorithm.{name}={value!r}: expected a time from 0 to 3600 s.")
