"""Warnings about the water of a scene: its density, what does not count, and what is slow."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from ...errors import Diagnostic
from ...schema import NAMESPACE, line_of
from ..subjects import CheckedScene

OF_SOUND = ("temperature", "salinity")
"""What the speed and the loss of sound are reckoned from, too."""
STABLE = 0.01
"""By so much the density may fall with depth, for rounded numbers [kg/m3]."""


def unstable_water(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of water that would turn over, and of densities that are said twice."""
    water = scene.spec.ocean_state
    profile = water.profile
    if profile is not None:
        for (above, heavy), (below, light) in pairwise(profile.levels):
            if light < heavy - STABLE:
                yield scene.warning(
                    profile,
                    f"<u:profile> has {heavy:.6g} kg/m3 at {above:g} m and {light:.6g} at "
                    f"{below:g} m: heavier water over lighter sinks; expected the same or more "
                    "with depth",
                )
                break
    for name in OF_SOUND if water.density is not None and profile is None else ():
        if getattr(water, name) is not None:
            yield scene.warning(
                line_of(water, f"{{{NAMESPACE}}}{name}"),
                f"<u:{name}> counts for sound alone: <u:density> says how dense the water is",
            )


def slow_currents(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of currents that are asked in Python at every step."""
    if not scene.spec.vehicles:
        return
    for current in scene.spec.ocean_state.currents:
        if current.code:
            yield scene.warning(
                current,
                f"<u:function> is {current.code!r}: Python asks it in every step for each body in "
                "the water, which slows steps down several times; the other currents are compiled, "
                "and <u:field> reads what a program has computed beforehand",
                "function",
            )
