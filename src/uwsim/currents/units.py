"""Conversion factors of the ``units`` of NetCDF variables to metres, seconds and m/s.

The names of units follow UDUNITS, which the CF conventions (1.11, chapter 3.1) require. A unit such
as ``hours since 2000-01-01`` is a time in hours, counted from a date.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from ..schema import quote

LENGTHS: Mapping[str, float] = {
    name: factor
    for names, factor in (
        ("m metre metres meter meters", 1.0),
        ("km kilometre kilometres kilometer kilometers", 1000.0),
        ("cm centimetre centimetres centimeter centimeters", 0.01),
    )
    for name in names.split()
}
"""The length of each unit [m]."""
TIMES: Mapping[str, float] = {
    name: factor
    for names, factor in (
        ("ms msec millisecond milliseconds", 1e-3),
        ("s sec secs second seconds", 1.0),
        ("min mins minute minutes", 60.0),
        ("h hr hrs hour hours", 3600.0),
        ("d day days", 86400.0),
    )
    for name in names.split()
}
"""The duration of each unit [s]."""
EXPECTED = {
    "length": "m, km or cm",
    "time": "s, min, h or days, with or without 'since' a date",
    "speed": "m/s, cm/s or km/h",
}


def unit(name: str, text: str) -> tuple[float, bool]:
    """Return the factor from a unit to SI units, and whether it is a time since a date.

    Args:
        name: the name of the variable: ``t``, ``x``, ``y``, ``z``, ``u``, ``v`` or ``w``.
        text: the attribute ``units`` of the variable; empty for SI units.

    Raises:
        ValueError: the unit is unknown; the error message lists the expected units.
    """
    words = text.strip().lower()
    kind = "time" if name == "t" else "speed" if name in ("u", "v", "w") else "length"
    unit_name, separator, _ = words.partition(" since ")
    if not words:
        return 1.0, False
    factor: float | None = None
    if kind == "time":
        factor = TIMES.get(unit_name.strip())
    elif kind == "length":
        factor = LENGTHS.get(words)
    elif parts := re.fullmatch(r"([a-z]+)(?: ?/ ?([a-z]+)|[ .*]([a-z]+)(?:\^|\*\*)?-1)", words):
        length, time = LENGTHS.get(parts[1]), TIMES.get(parts[2] or parts[3])
        factor = None if length is None or time is None else length / time
    if factor is None:
        raise ValueError(f"{name} is in {quote(text.strip())}; expected {EXPECTED[kind]}")
    return factor, bool(separator)
