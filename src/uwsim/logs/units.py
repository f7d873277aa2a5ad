"""Units of the columns of logs, and their factors to SI units and radians."""

from __future__ import annotations

import math
from typing import NamedTuple

from ..base.geometry import Array
from ..errors import BadSetting, choices

GRAVITY = 9.80665
"""The standard acceleration of gravity, for accelerations in g [m/s2]."""
PWM_CENTRE = 1500.0
"""The pulse width of a stopped thruster [us]."""
PWM_RANGE = 400.0
"""The change of the pulse width from stop to full thrust, 1100 to 1900 us for a T200 [us]."""


class Conversion(NamedTuple):
    """The conversion of a unit: SI value = (value - offset) * factor."""

    quantity: str
    """The quantity that the unit measures."""
    factor: float
    """The factor to SI units."""
    offset: float = 0.0
    """The value of the unit that counts as 0 in SI units."""

    def apply(self, values: Array) -> Array:
        """Return values in SI units."""
        values_in_si: Array = (values - self.offset) * self.factor
        return values_in_si


DEGREE = math.pi / 180.0
UNITS: dict[str, Conversion] = {
    "s": Conversion("time", 1.0),
    "ms": Conversion("time", 1e-3),
    "us": Conversion("time", 1e-6),
    "ns": Conversion("time", 1e-9),
    "min": Conversion("time", 60.0),
    "m": Conversion("length", 1.0),
    "cm": Conversion("length", 0.01),
    "mm": Conversion("length", 0.001),
    "km": Conversion("length", 1000.0),
    "ft": Conversion("length", 0.3048),
    "rad": Conversion("angle", 1.0),
    "deg": Conversion("angle", DEGREE),
    "m/s": Conversion("velocity", 1.0),
    "cm/s": Conversion("velocity", 0.01),
    "mm/s": Conversion("velocity", 0.001),
    "kn": Conversion("velocity", 1852.0 / 3600.0),
    "rad/s": Conversion("angular velocity", 1.0),
    "deg/s": Conversion("angular velocity", DEGREE),
    "m/s2": Conversion("acceleration", 1.0),
    "g": Conversion("acceleration", GRAVITY),
    "mg": Conversion("acceleration", 1e-3 * GRAVITY),
    "N": Conversion("force", 1.0),
    "kgf": Conversion("force", GRAVITY),
    "N m": Conversion("torque", 1.0),
    "Pa": Conversion("pressure", 1.0),
    "hPa": Conversion("pressure", 100.0),
    "mbar": Conversion("pressure", 100.0),
    "kPa": Conversion("pressure", 1e3),
    "bar": Conversion("pressure", 1e5),
    "V": Conversion("voltage", 1.0),
    "A": Conversion("current", 1.0),
    "1": Conversion("share", 1.0),
    "%": Conversion("share", 0.01),
    "pwm": Conversion("share", 1.0 / PWM_RANGE, PWM_CENTRE),
}
"""The units of columns, by the name that mapping files use."""
SI_UNITS = {
    "time": "s",
    "length": "m",
    "angle": "rad",
    "velocity": "m/s",
    "angular velocity": "rad/s",
    "acceleration": "m/s2",
    "force": "N",
    "torque": "N m",
    "pressure": "Pa",
    "voltage": "V",
    "current": "A",
    "share": "1",
}
"""The unit of each quantity after conversion."""


def find_unit(name: str, quantity: str | None = None) -> Conversion:
    """Return the conversion of a unit.

    Args:
        name: the name of the unit.
        quantity: the quantity that it must measure; None: any.

    Raises:
        BadSetting: there is no such unit, or it measures another quantity.
    """
    names = [unit for unit, conversion in UNITS.items() if quantity in (None, conversion.quantity)]
    if name not in names:
        kind = "a unit" if quantity is None else f"a unit of {quantity}"
        raise BadSetting(f"{name!r:.40} is not {kind}.{choices(name, names)}")
    return UNITS[name]
