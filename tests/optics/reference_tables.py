"""Tables of light in water from Monte-Carlo computations of this project (2026), in ``tables/``.

A homogeneous medium, one wavelength, no polarisation. Phase functions: HG is Henyey and Greenstein
0.9, FF Fournier and Forand 1.10, 3.5835. The columns:

- ``full_field``: the probability h that a ray traced back hits an infinite plane; relative standard
  error 1e-4, at optical depth 8 4e-4.
- ``spread``: the share of a narrow beam within a radius on the plane, in units of the range; 1e-3.
- ``transfer``: modulation transfer at frequencies [cycles/rad]; 3e-3 of the value.
- ``edge``: a black half plane beside a white one, at places in units of the range; 3e-3.
- ``lamp``: FF, albedo 0.85; a lamp of 1 W/sr in a hard cone of 30 degrees, beside the camera; veil
  at five pixels x/f, the largest relative standard error of the five [%], signal on the axis with
  both bounces (1 %), contrast of white 0.9 and black 0.05.
- ``lamp_centre``: veil and signal of the central pixel in other media.
- ``led``: a Lambertian point source; the share P within half-angles, and the radiance of the halo
  times the squared range [1/sr], at angles [degrees]; 1e-3.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from uwsim.optics import FournierForand, HenyeyGreenstein, Medium, PhaseFunction

FloatArray = npt.NDArray[np.float64]
FOLDER = Path(__file__).parent / "tables"
PHASES: dict[str, PhaseFunction] = {"HG": HenyeyGreenstein(0.9), "FF": FournierForand()}
FREQUENCIES = (0.3, 1.0, 3.0, 10.0, 30.0, 100.0)
RADII = (0.003, 0.01, 0.03, 0.1, 0.3, 1.0)
PLACES = (-0.3, -0.1, -0.03, -0.01, -0.003, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0)
PIXELS = (-0.5, -0.25, 0.0, 0.25, 0.5)
LAMP_HALF_ANGLE = math.radians(30.0)


def read_rows(name: str) -> list[dict[str, str]]:
    with (FOLDER / f"{name}.csv").open() as file:
        return list(csv.DictReader(file))


def values_of(row: dict[str, str], columns: Sequence[float], prefix: str = "") -> FloatArray:
    return np.array([float(row[f"{prefix}{column:g}"]) for column in columns])


def water_of(phase: PhaseFunction, beam_attenuation: float, albedo: float) -> Medium:
    """Return water of one channel."""
    return Medium.from_beam_attenuation([beam_attenuation], [albedo * beam_attenuation], phase)


def water_of_row(row: dict[str, str]) -> Medium:
    """Return the water of a row for a range of 1 m."""
    return water_of(PHASES[row["phase"]], float(row["optical_depth"]), float(row["albedo"]))


def name_of_row(row: dict[str, str]) -> str:
    return "-".join(list(row.values())[:3])
