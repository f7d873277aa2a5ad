"""Errors and warnings about the water of a scene: optics, density, unused fog, slow currents."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from ...errors import Diagnostic
from ...model.water_errors import find_water_errors
from ...scene.physical_water import REPLACED_ELEMENTS
from ...schema import NAMESPACE, line_of
from ..subjects import CheckedScene

SOUND_ELEMENTS = ("temperature", "salinity")
"""The elements that also determine the speed and the absorption of sound."""
MAX_DENSITY_DECREASE = 0.01
"""The greatest decrease of density with depth, for rounded numbers [kg/m3]."""


def unstable_water(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of unstable layers of water, and of densities that are given twice."""
    water = scene.spec.ocean_state
    profile = water.profile
    if profile is not None:
        for (depth, density), (lower_depth, lower_density) in pairwise(profile.levels):
            if lower_density < density - MAX_DENSITY_DECREASE:
                yield scene.warning(
                    profile,
                    f"<u:profile> has {density:.6g} kg/m3 at {depth:g} m and {lower_density:.6g} "
                    f"at {lower_depth:g} m: heavier water over lighter sinks; expected the same "
                    "or more with depth",
                )
                break
    for name in SOUND_ELEMENTS if water.density is not None and profile is None else ():
        if getattr(water, name) is not None:
            yield scene.warning(
                line_of(water, f"{{{NAMESPACE}}}{name}"),
                f"<u:{name}> affects sound only: <u:density> sets the density of the water",
            )


def slow_currents(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of currents that call Python at every step."""
    if not scene.spec.vehicles:
        return
    for current in scene.spec.ocean_state.currents:
        if current.code:
            yield scene.warning(
                current,
                f"<u:function> is {current.code!r}: Python calls it in every step for each body in "
                "the water, which makes steps several times slower. The other currents are "
                "compiled; <u:field> reads a flow that a program has computed before",
                "function",
            )


def unused_fog(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of fog, colour and attenuation that physical water replaces, and of their variations."""
    ocean = scene.spec.ocean_state
    if ocean.water is None:
        return
    reason = 'has no effect on images: <u:water law="physical"> replaces it'
    elements = {} if ocean.source_line is None else ocean.source_line.elements
    for name in REPLACED_ELEMENTS:
        if name in elements:
            yield scene.warning(ocean, f"<{name}> {reason}", name)
    for variation in scene.spec.vary:
        parts = variation.path.split(".")
        if parts[0] == "oceanState" and parts[1:2] and parts[1] in REPLACED_ELEMENTS:
            yield scene.warning(variation, f"a variation of <{parts[1]}> {reason}")


def invalid_water(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report errors of physical water beside other errors; a valid scene is checked as a whole."""
    if not scene.is_valid:
        errors = scene.diagnostics.to_list()
        lines = {item.line for item in errors if item.severity == "error" and item.line}
        yield from find_water_errors(scene.spec, scene.data_path, lines)
