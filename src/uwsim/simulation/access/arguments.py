"""Checks of the arguments that a program passes to the Python interface of a simulation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from numbers import Integral

import numpy as np

from ...base.external_values import finite_float
from ...base.geometry import Pose
from ...currents.constant import Constant
from ...currents.current import MAX_SPEED
from ...errors import BadSetting, short_repr
from ...world import Flow
from .user_flow import UserFlow

MAX_COORDINATE = 1e6
"""The greatest coordinate in W at which a body can be placed [m]."""


def check_seed(seed: int, method: str = "reset") -> int:
    """Return a seed; raise BadSetting if it is not a whole number of at least 0."""
    if isinstance(seed, bool) or not isinstance(seed, Integral) or seed < 0:
        raise BadSetting(f"{method}(seed={short_repr(seed)}): expected a whole number >= 0.")
    return int(seed)


def count_steps(seconds: float, timestep: float) -> int:
    """Return the number of steps in a time [s]; raise BadSetting if that is no time >= 0."""
    n_steps = _float_of(seconds) / timestep
    if not 0.0 <= n_steps < math.inf:
        raise BadSetting(f"advance({short_repr(seconds)}): expected a time >= 0 [s].")
    return round(n_steps)


def check_algorithm(algorithm: object) -> None:
    """Raise BadSetting if an object is not an algorithm: it has no method ``start(node)``."""
    if isinstance(algorithm, type):
        raise BadSetting(
            f"attach({algorithm.__name__}): expected an algorithm, not its class: "
            f"attach({algorithm.__name__}())."
        )
    if not callable(getattr(algorithm, "start", None)):
        raise BadSetting(f"attach({short_repr(algorithm)}): it has no method start(node).")


def check_number(method: str, number: float) -> float:
    """Return a number; raise BadSetting if it is negative or not finite."""
    value = _float_of(number)
    if not 0.0 <= value < math.inf:
        raise BadSetting(f"{method}({short_repr(number)}): expected a finite number >= 0.")
    return value


def _float_of(number: object) -> float:
    """Return a finite number as a float, and NaN for every other value."""
    if not isinstance(number, int | float | np.integer | np.floating):
        return math.nan
    value = finite_float(number)
    return math.nan if value is None else value


def check_pose(name: str, world_from_frame: Pose, frame_from_body: Pose) -> Pose:
    """Return the pose of a body in W; raise BadSetting if it is not finite or too far away."""
    if not isinstance(frame_from_body, Pose):
        raise BadSetting(
            f"set_pose({name!r}, {short_repr(frame_from_body)}): expected a Pose, as "
            "Pose([0.0, 0.0, -2.0]) of uwsim.base.geometry."
        )
    world_from_body = world_from_frame @ frame_from_body
    position = world_from_body.position
    if not np.isfinite(world_from_body.matrix).all() or np.abs(position).max() > MAX_COORDINATE:
        raise BadSetting(
            f"set_pose({name!r}): the position is {position.tolist()}; expected finite numbers, "
            f"{MAX_COORDINATE:g} m at most from the origin."
        )
    return world_from_body


def flow_of(velocity: Sequence[float] | Flow | None) -> Flow | None:
    """Return the flow for a velocity in L, (3,) [m/s], or for a `Flow` object of the user.

    Raises:
        BadSetting: the velocity is not three numbers up to `MAX_SPEED`; or the `Flow` is a class,
            or its ``is_uniform`` or ``is_still`` raises.
    """
    if velocity is None or type(velocity) is Constant:
        return velocity
    if isinstance(velocity, type):
        name = velocity.__name__
        raise BadSetting(f"set_current({name}): expected a flow, not its class: {name}().")
    if isinstance(velocity, Flow):
        return UserFlow(velocity)
    try:
        x, y, z = (float(component) for component in velocity)
    except (TypeError, ValueError, OverflowError):
        x = y = z = math.nan
    if not all(abs(component) <= MAX_SPEED for component in (x, y, z)):
        raise BadSetting(
            f"set_current({short_repr(velocity)}): expected three numbers between "
            f"{-MAX_SPEED:g} and {MAX_SPEED:g} [m/s]."
        )
    return Constant((x, y, z))
