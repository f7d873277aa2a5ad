"""Advice on manoeuvres: which axes a log excites, and what would determine the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from .parameters import AXES
from .uncertainty import Estimate, WeakDirection
from .windows import Windows

MIN_SPEED = (0.02, 0.02, 0.02, 0.02, 0.02, 0.02)
"""The root mean square velocity from which on an axis counts as excited [m/s, rad/s]."""
NOISE_RATIO = 3.0
"""The ratio of velocity to noise from which on an axis counts as excited."""
MANOEUVRES = {
    "surge": "add runs ahead and astern with steps of the thrust from 20 to 80 %",
    "sway": "add runs to port and to starboard with steps of the thrust from 20 to 80 %",
    "heave": "add dives and ascents with steps of the thrust from 20 to 80 %",
    "roll": "push one side down by 15 to 20 degrees, release it, and repeat it",
    "pitch": "push the bow down by 15 to 20 degrees, release it, and repeat it",
    "yaw": "add a zig-zag in heading of +-30 degrees, and turns at two rates",
}
"""The manoeuvre that excites each axis."""


@dataclass(frozen=True, kw_only=True)
class AxisExcitation:
    """The excitation of an axis."""

    axis: str
    """The axis."""
    speed: float
    """The root mean square of the velocity [m/s or rad/s]."""
    max_speed: float
    """The greatest velocity, without the top percent [m/s or rad/s]."""
    is_excited: bool
    """The velocity exceeds noise and the limits of this module."""


def measure_excitation(windows: Windows, noise: Array) -> tuple[AxisExcitation, ...]:
    """Return the excitation of each axis whose velocity the logs have.

    Args:
        windows: the windows.
        noise: the noise of each channel, (12,).
    """
    rows = []
    for axis, name in enumerate(AXES):
        velocities = windows.samples[:, :, 7 + axis]
        velocities = np.abs(velocities[np.isfinite(velocities)])
        if not velocities.size:
            continue
        speed = float(np.sqrt((velocities * velocities).mean()))
        limit = max(MIN_SPEED[axis], NOISE_RATIO * float(noise[6 + axis]))
        rows.append(
            AxisExcitation(
                axis=name,
                speed=speed,
                max_speed=float(np.quantile(velocities, 0.99)),
                is_excited=speed > limit,
            )
        )
    return tuple(rows)


def give_advice(
    excitation: Sequence[AxisExcitation],
    estimates: Sequence[Estimate],
    weak_directions: Sequence[WeakDirection],
) -> tuple[str, ...]:
    """Return sentences that name the manoeuvres and measurements that would help."""
    advice = []
    free_axes = {_axis_of(estimate) for estimate in estimates}
    idle_axes = [row.axis for row in excitation if not row.is_excited and row.axis in free_axes]
    for axis in idle_axes:
        advice.append(f"{axis} was never excited: {MANOEUVRES[axis]}.")
    doubtful_axes = {
        _axis_of(estimate) for estimate in estimates if estimate.doubt not in ("", "bound")
    }
    for axis in AXES:
        if axis in doubtful_axes and axis not in idle_axes:
            advice.append(f"{axis} needs more excitation: {MANOEUVRES[axis]}.")
    groups = {name.partition("[")[0] for direction in weak_directions for name in direction.names}
    if any(len(direction.names) > 1 for direction in weak_directions):
        if "thrust" in groups:
            advice.append(
                "Forces are known up to a factor: measure the thrust (bollard pull), or weigh the "
                "vehicle and keep mass out of --free."
            )
        if groups >= {"added_mass", "mass"} or groups >= {"added_mass", "inertia"}:
            advice.append(
                "Added mass and mass or inertia act as their sum: weigh the vehicle, or keep mass "
                "and inertia out of --free."
            )
        if groups >= {"linear_damping", "quadratic_damping"}:
            advice.append(
                "The two dampings of an axis need a range of speeds: add runs at several constant "
                "commands."
            )
    return tuple(advice)


def _axis_of(estimate: Estimate) -> str:
    key = estimate.parameter.key
    return key if key in AXES else ""
