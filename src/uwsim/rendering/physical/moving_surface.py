"""The moving surface of the water at the time of an image."""

from __future__ import annotations

from dataclasses import dataclass

from ...waves import Waves


@dataclass(frozen=True, kw_only=True)
class MovingSurface:
    """The surface that moves bodies, at one time; two are equal if they have the same shape."""

    time: float
    """The simulation time [s]."""
    waves: Waves | None = None
    """The waves, which are a function of position and time; None: the surface is level."""
    wave_scale: float = 1.0
    """The factor on all amplitudes of the waves, which `waves` reads too [1]."""
    seed: int = 0
    """The seed of what is drawn besides the waves, such as ripples."""
