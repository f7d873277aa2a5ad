r"""Readings of a calibration: signals of a source through the water, at a known range.

With the absorption :math:`a` and the scattering :math:`b` of the water, the signal of a reading is

.. math:: \ln S = \ln G + \ln \gamma - a L - b\, (L - \beta)

with the gain :math:`G` of the source and the camera, the geometry :math:`\gamma`, the length
:math:`L` of the light's way, and the length :math:`\beta` on which scattered light is not lost:

- A small LED at range :math:`R`, in a disc of half-angle :math:`\theta`: :math:`L = R`,
  :math:`\beta = R\, EE(\theta)`, :math:`\gamma = R^{-2}`.
- White minus black squares of a board in the light of a lamp at the distance :math:`d`, seen at the
  distance :math:`l`: :math:`L = d + l`, :math:`\beta = d\, e + l X`,
  :math:`\gamma = \cos i / d^2`. The lamp's light that is scattered forward still lights the board:
  :math:`e = EE(\text{half-angle of the lamp}) - A - k_L \sqrt{a L}` (`optics.lamp_light`). The
  camera's way keeps the share :math:`X` (`checker`). The veil of the lamp is alike on white and
  black and does not count.

Errors of the forward model against Monte-Carlo signals: LED 0.6 % + 0.6 % c R, board 0.5 % +
1.2 % c R.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from ..optics import PhaseFunction
from ..optics.lamp_light import find_lamp_coefficients
from ..optics.phase_function import FloatArray
from .checker import compute_checker_share


@dataclass(frozen=True, kw_only=True)
class Reading(ABC):
    """A signal of a source through the water, in one channel of the camera."""

    channel: str
    """The name of the channel."""
    source: str
    """The name of the LED or board; the readings of a source have one gain."""
    distance: float
    """The distance from the camera to the source [m]."""
    signal: float
    """The signal, linear in the light, of any unit."""
    reference: float | None = None
    """The signal through the reference water; None if there is none."""
    noise: float = 0.0
    """The standard deviation of ln(signal), and of its reference, by noise."""

    @property
    @abstractmethod
    def path_length(self) -> float:
        """The length L of the light's way through the water [m]."""

    @property
    @abstractmethod
    def geometry(self) -> float:
        """The geometry factor of the signal [1/m^2]."""

    @abstractmethod
    def compute_kept_length(self, phase: PhaseFunction) -> tuple[float, float]:
        """Compute the length on which scattered light is kept, as its two terms.

        Returns:
            The length for water without absorption [m], and the length that is to be subtracted
            for each unit of sqrt(a L) [m].
        """

    @abstractmethod
    def estimate_model_error(self, optical_depth: float) -> float:
        """Return the standard deviation of ln(signal) by the forward model, at a depth c R."""

    @property
    @abstractmethod
    def label(self) -> str:
        """The words for tables and plots."""


@dataclass(frozen=True, kw_only=True)
class LedReading(Reading):
    """The light of a small LED within a disc around it."""

    half_angle: float
    """The half-angle of the disc, in the water [rad]."""

    @property
    def path_length(self) -> float:
        """The length L of the light's way through the water [m]."""
        return self.distance

    @property
    def geometry(self) -> float:
        """The geometry factor of the signal [1/m^2]."""
        return 1.0 / self.distance**2

    def compute_kept_length(self, phase: PhaseFunction) -> tuple[float, float]:
        """Compute the length on which scattered light is kept, as its two terms."""
        return self.distance * float(phase.compute_encircled_energy(self.half_angle)), 0.0

    def estimate_model_error(self, optical_depth: float) -> float:
        """Return the standard deviation of ln(signal) by the forward model, at a depth c R."""
        return 0.006 + 0.006 * optical_depth

    @property
    def label(self) -> str:
        """The words for tables and plots."""
        return f"{self.source} within {math.degrees(self.half_angle):.3g}°"


@dataclass(frozen=True, kw_only=True)
class BoardReading(Reading):
    """The difference of white and black squares of a checker in the light of a lamp."""

    side: float
    """The side of a square [m]."""
    lamp_distance: float
    """The distance from the lamp to the checker [m]."""
    lamp_half_angle: float
    """The angle between the axis of the lamp and the edge of its cone [rad]."""
    incidence: float = 1.0
    """The cosine of the angle between the board's normal and the light of the lamp.

    Where squares are lit unequally, it is the number that makes `geometry` the mean of them.
    """

    @property
    def path_length(self) -> float:
        """The length L of the light's way through the water [m]."""
        return self.lamp_distance + self.distance

    @property
    def geometry(self) -> float:
        """The geometry factor of the signal [1/m^2]."""
        return self.incidence / self.lamp_distance**2

    def compute_kept_length(self, phase: PhaseFunction) -> tuple[float, float]:
        """Compute the length on which scattered light is kept, as its two terms."""
        lamp_share, factor = find_lamp_coefficients(phase, self.lamp_half_angle)
        checker_share = compute_checker_share(phase, self.side, self.distance)
        kept_length = self.lamp_distance * lamp_share + self.distance * checker_share
        return kept_length, self.lamp_distance * factor

    def estimate_model_error(self, optical_depth: float) -> float:
        """Return the standard deviation of ln(signal) by the forward model, at a depth c R."""
        return 0.005 + 0.012 * optical_depth

    @property
    def label(self) -> str:
        """The words for tables and plots."""
        return f"{self.source}, squares of {self.side * 100:.3g} cm"


def average_geometry(
    points: FloatArray, lamp_position: tuple[float, float, float]
) -> tuple[float, float, float]:
    """Average the geometry of a checker over its squares, on a board across the z axis.

    Args:
        points: the centres of the squares in the camera's frame, (n, 3) [m].
        lamp_position: the position of the lamp in the same frame [m].

    Returns:
        The mean distances from camera and lamp [m], and the incidence of a `BoardReading`.
    """
    lengths = np.linalg.norm(points, axis=1)
    from_lamp = points - np.array(lamp_position)
    lamp_lengths = np.linalg.norm(from_lamp, axis=1)
    lamp_distance = float(lamp_lengths.mean())
    geometry = float((from_lamp[:, 2] / lamp_lengths**3).mean())
    return float(lengths.mean()), lamp_distance, geometry * lamp_distance**2
