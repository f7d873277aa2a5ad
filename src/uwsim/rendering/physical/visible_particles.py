"""What a camera sees of particles and clouds: the input of their passes.

It needs no graphics, so that a scene without cameras loads none.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.geometry import Triple

LUMP = np.dtype([("place", np.float32, 4), ("depth", np.float32)])
"""A lump of a cloud: its centre in the camera's frame and its width [m], and the optical depth
along a whole ray through its centre."""


@dataclass(frozen=True, eq=False)
class VisibleClouds:
    """The clouds of sediment before a camera."""

    lumps: npt.NDArray[np.void]
    """The lumps, records of `LUMP`, (n,), one at least."""
    colour: Triple
    """The albedo of a thick cloud in daylight [1]."""


@dataclass(frozen=True, eq=False)
class VisibleParticles:
    """The particles in a camera's view."""

    records: npt.NDArray[np.void]
    """The particles, records of `uwsim.particles.PARTICLE`, (n,)."""
    aperture: float
    """The diameter of the lens's aperture [m]; 0: all particles are sharp."""
    focus_distance: float
    """The distance at which the lens is focused [m]."""
    clouds: VisibleClouds | None = None
    """The clouds of sediment; None without any."""
