r"""Phase functions: the directions into which water scatters light.

A phase function :math:`p(\theta)` [1/sr] is the fraction of the scattered light per solid angle at
the scattering angle :math:`\theta` [rad], with

.. math::
    2 \pi \int_0^\pi p(\theta) \sin\theta \, d\theta = 1, \qquad
    F(\theta) = 2 \pi \int_0^\theta p(t) \sin t \, dt

The effect of scattering on an image follows from two integrals of the cumulative fraction
:math:`F`. The encircled energy of single scattering, for scatterers spread evenly between a point
and the camera, is the fraction that arrives within an angle :math:`x`:

.. math::
    EE(x) = \int_0^1 F(x / s) \, ds = \frac{x}{\pi} + x \int_x^\pi \frac{F(t)}{t^2} \, dt

Its transform, at :math:`\psi` cycles per radian, is that of the forward half of the directions on a
plane:

.. math::
    Q(\psi) = \int_0^1 \int_0^{\pi/2} J_0(2 \pi \psi s \tan\theta) \, dF(\theta) \, ds

For the small-angle form of Henyey and Greenstein, :math:`Q = (1 - e^{-x}) / x` with
:math:`x = 2 \pi \psi (1 - g) / \sqrt{g}`, the form of W. H. Wells (1969).

Not modelled: polarisation, and the dependence of a phase function on the wavelength.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ..base.numerics.elementwise import exp, log, tan

FloatArray = npt.NDArray[np.float64]

MIN_ANGLE = 1e-8
"""The smallest angle that is told from zero [rad]; a phase function may be infinite at zero."""
N_ANGLES = 4096
"""The number of angles of a table, at equal ratios from `MIN_ANGLE` to pi."""
_LOG_ANGLES = np.linspace(math.log(MIN_ANGLE), math.log(math.pi), N_ANGLES)


class PhaseFunction(ABC):
    """A phase function of water; the same for all wavelengths."""

    @abstractmethod
    def compute_density(self, angle: npt.ArrayLike) -> FloatArray:
        """Compute the phase function at scattering angles [rad]; the result is in 1/sr.

        Angles below `MIN_ANGLE` give the value there.
        """

    @abstractmethod
    def compute_cumulative(self, angle: npt.ArrayLike) -> FloatArray:
        """Compute the fraction of the light that is scattered by less than angles [rad]."""

    @cached_property
    def backscatter_ratio(self) -> float:
        """The fraction of the light that is scattered backwards, bb/b."""
        return 1.0 - float(self.compute_cumulative(math.pi / 2))

    @cached_property
    def mean_cosine(self) -> float:
        """The mean cosine of the scattering angle."""
        angles = np.linspace(0.0, math.pi, N_ANGLES)
        # By parts: the mean of cos is the integral of F sin, minus 1.
        return float(np.trapezoid(self.compute_cumulative(angles) * np.sin(angles), angles)) - 1.0

    def compute_encircled_energy(self, angle: npt.ArrayLike) -> FloatArray:
        """Compute the fraction EE of singly scattered light that arrives within angles [rad]."""
        x = np.clip(np.asarray(angle, dtype=np.float64), MIN_ANGLE, math.pi)
        integral = np.interp(log(x), _LOG_ANGLES, self._encircled_integrals)
        return x / math.pi + x * integral

    def compute_transform(self, frequency: npt.ArrayLike) -> FloatArray:
        """Compute the transform Q of single scattering at frequencies [cycles/rad]."""
        frequencies = np.asarray(frequency, dtype=np.float64)
        shares, tangents = self._forward_shares
        values = [
            float(np.sum(shares * _mean_bessel(2.0 * math.pi * value * tangents)))
            for value in frequencies.ravel()
        ]
        return np.array(values).reshape(frequencies.shape)

    @cached_property
    def _encircled_integrals(self) -> FloatArray:
        """The integrals of F(t) / t^2 from the angles of the table to pi."""
        angles = exp(_LOG_ANGLES)
        integrands = self.compute_cumulative(angles) / angles  # over ln t
        steps = 0.5 * (integrands[1:] + integrands[:-1]) * np.diff(_LOG_ANGLES)
        return np.append(np.cumsum(steps[::-1])[::-1], 0.0)

    @cached_property
    def _forward_shares(self) -> tuple[FloatArray, FloatArray]:
        """The shares of the light in rings of the forward half, and the tangents of their angles.

        A ring is represented by the geometric mean of its limits.
        """
        limits = np.append(exp(_LOG_ANGLES[exp(_LOG_ANGLES) < math.pi / 2]), math.pi / 2)
        shares = np.diff(self.compute_cumulative(limits), prepend=0.0)
        means = np.append(limits[0], np.sqrt(limits[1:] * limits[:-1]))
        return shares, tan(means)


def _mean_bessel(limit: FloatArray) -> FloatArray:
    """Compute the mean of the Bessel function J0 from zero to each limit."""
    positive = np.maximum(limit, 1e-6)
    from scipy.special import itj0y0

    return np.asarray(itj0y0(positive)[0] / positive, dtype=np.float64)
