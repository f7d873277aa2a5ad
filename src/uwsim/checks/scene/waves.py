r"""Warnings about seas that are flat, and waves that would break.

Linear theory does not describe breaking waves.

A regular wave breaks above the height :math:`0.142 \lambda \tanh kh` (Miche 1944; Dean and
Dalrymple 1991, section 4.8). The steepest seas that last have a steepness
:math:`S_p = 2 \pi H_s / (g T_p^2)` of 1/15 up to :math:`T_p = 8` s, of 1/25 from 15 s on, and
linear between (DNV-RP-C205, 2010, section 3.5.5). In shallow water the limit of a regular wave
counts for the significant height, too.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ...errors import Diagnostic
from ...schema import NAMESPACE
from ...waves import (
    WAVE_SYSTEMS,
    IrregularWavesSpec,
    RegularWaveSpec,
    SeaSettings,
    UwsimOceanSpec,
    WaveSystemSpec,
    find_sea_errors,
    wave_numbers,
)
from ...world import GRAVITY
from ..subjects import CheckedScene

MICHE_CONSTANT = 0.142
"""The greatest height of a wave in deep water, over its length [1]."""
STEEPNESS_PERIODS, MAX_STEEPNESSES = (8.0, 15.0), (1.0 / 15.0, 1.0 / 25.0)
"""Peak periods [s], and the greatest steepness of seas with these periods [1]."""
MIN_HEIGHT = 1e-3
"""The least height of waves that are not flat; a height of 0 in a file is meant so [m]."""


def flat_seas(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of ``<u:waves>`` without waves, and of wind too weak for waves of UWSim's ocean."""
    ocean = scene.spec.ocean_state
    if any(find_sea_errors(ocean.waves, ocean.sea)):  # reported where the scene is read
        return
    elements = {} if ocean.source_line is None else ocean.source_line.elements
    tag = f"{{{NAMESPACE}}}waves"
    if not ocean.waves and tag in elements:
        names = ", ".join(f"<u:{name}>" for name in WAVE_SYSTEMS)
        yield scene.warning(
            ocean, f"<u:waves> is empty: the sea is flat; expected one or more of {names}", tag
        )
    for system in ocean.waves:
        height = system.expected_height(ocean.sea)
        if isinstance(system, UwsimOceanSpec) and height < MIN_HEIGHT:
            yield scene.warning(
                system,
                f"<u:uwsimOcean> is flat: its waves are {height:.2g} m high with <windSpeed> "
                f"{ocean.wind_speed:g}, <windx> {ocean.windx:g}, <windy> {ocean.windy:g} and "
                f"<waveScale> {ocean.wave_scale:g}; expected at least {MIN_HEIGHT:g} m",
            )


def breaking_waves(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of wave systems that would break."""
    ocean = scene.spec.ocean_state
    if any(find_sea_errors(ocean.waves, ocean.sea)):  # reported where the scene is read
        return
    for system in ocean.waves:
        if text := describe_breaking(system, ocean.sea):
            yield scene.warning(system, f"{text}; linear theory does not describe such waves")


def describe_breaking(system: WaveSystemSpec, sea: SeaSettings, scale: float = 1.0) -> str:
    """Describe a wave system that would break; empty if it would not, or if it is UWSim's ocean.

    Args:
        system: the wave system.
        sea: the settings of the sea.
        scale: the factor on its height [1].
    """
    if isinstance(system, RegularWaveSpec):
        height, period, name = scale * system.height, system.period, "height"
        limit = breaking_height(period, sea.depth)
    elif isinstance(system, IrregularWavesSpec):
        spectrum = system.spectrum
        height, period = scale * spectrum.significant_height, spectrum.peak_period
        name = "significant height"
        steepness = float(np.interp(period, STEEPNESS_PERIODS, MAX_STEEPNESSES))
        deep_length = GRAVITY * period**2 / (2.0 * math.pi)  # [m]
        limit = min(steepness * deep_length, breaking_height(period, sea.depth))
    else:
        return ""
    if height <= limit:
        return ""
    return (
        f"waves of {period:.3g} s break: their {name} is {height:.3g} m; expected at most "
        f"{limit:.3g} m in water {sea.depth:g} m deep"
    )


def breaking_height(period: float, depth: float) -> float:
    """Return the height of the highest regular wave [m] for a period [s] and a depth [m]."""
    number = float(wave_numbers(np.array([2.0 * math.pi / period]), depth)[0])
    return MICHE_CONSTANT * 2.0 * math.pi / number * math.tanh(number * depth)
