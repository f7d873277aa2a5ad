"""Checks of the electric power of thrusters in hydrodynamics files."""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array
from ...schema import Numbers
from .spec import ThrusterSpec


def power_errors(thruster: ThrusterSpec) -> list[str]:
    """Return the errors for power curves that are negative at some thrust in the range."""
    errors = []
    for name, curve, forward in (
        ("power", thruster.power, True),
        ("powerBackward", thruster.power_backward, False),
    ):
        if curve is None:
            continue
        thrusts = np.linspace(0.0, max_thrust(thruster, forward=forward), 201)
        powers = polynomial(curve, thrusts)
        index = int(np.argmin(powers))
        if powers[index] < -1e-9:
            errors.append(
                f"thruster {thruster.name!r}: {name} is {powers[index]:.3g} W at "
                f"{thrusts[index]:.3g} N; expected none below 0"
            )
    return errors


def max_thrust(thruster: ThrusterSpec, *, forward: bool) -> float:
    """Compute the greatest thrust, forward or backward [N]."""
    backward = thruster.forward if thruster.backward is None else thruster.backward
    end = thruster.limits[1] if forward else -thruster.limits[0]
    commands = np.maximum(np.linspace(0.0, end, 201) - thruster.dead_zone, 0.0)
    thrust = float(polynomial(thruster.forward if forward else backward, commands).max())
    if thruster.saturation is not None:
        thrust = min(thrust, thruster.saturation[1] if forward else -thruster.saturation[0])
    return max(thrust, 0.0)


def polynomial(coefficients: Numbers, x: Array) -> Array:
    """Evaluate the polynomial ``c1 x + c2 x^2 + ...`` without a constant term."""
    return np.asarray(np.polynomial.polynomial.polyval(x, (0.0, *coefficients)), dtype=np.float64)
