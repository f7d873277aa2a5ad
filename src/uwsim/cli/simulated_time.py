"""Simulation time on the command line: durations as text, and runs of that length."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..errors import BadSetting, did_you_mean
from .output.progress import progress

if TYPE_CHECKING:
    from ..simulation import Simulation

UNITS = {"ms": 1e-3, "s": 1.0, "min": 60.0, "h": 3600.0}
"""The units of durations, in seconds."""
DURATION = re.compile(r"\s*(\d+\.?\d*|\.\d+)\s*([a-z]*)\s*")
MAX_DURATION = 1e8
"""The longest simulation time [s]; a longer one is an error."""


def read_duration(text: str, option: str = "--for") -> float:
    """Parse a duration such as ``10s``, ``2min`` or ``0.5``; return it in seconds.

    Args:
        text: the duration.
        option: the option that has it, for errors.

    Raises:
        BadSetting: the text is not a duration, or the duration is longer than `MAX_DURATION`.
    """
    match = DURATION.fullmatch(text)
    if match is None:
        raise BadSetting(f"{option} {text!r}: expected a duration such as 10s, 500ms, 2min or 1h.")
    number, unit = float(match[1]), match[2] or "s"
    if unit not in UNITS:
        hint = did_you_mean(unit, UNITS)
        raise BadSetting(f"{option} {text!r}: expected one of the units {', '.join(UNITS)}.{hint}")
    if not number * UNITS[unit] <= MAX_DURATION:
        raise BadSetting(f"{option} {text!r}: expected at most {MAX_DURATION:g} s.")
    return number * UNITS[unit]


def run_pieces(simulation: Simulation, duration: float, title: str) -> Iterator[None]:
    """Advance in pieces of at most one second, showing progress if there is an end."""
    if duration == math.inf:
        while True:
            simulation.advance(1.0)
            yield
    total = max(1, math.ceil(duration))
    with progress(title, total, unit="s of simulation time") as on_piece:
        simulation.advance(0.0)
        yield
        for i in range(total):
            simulation.advance(duration * (i + 1) / total - simulation.time)
            on_piece()
            yield
