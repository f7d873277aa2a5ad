r"""Absorption of sound in the deep sea at 4 degrees Celsius, after Thorp.

W. H. Thorp, *Analytic description of the low-frequency attenuation coefficient*, J. Acoust. Soc.
Am. 42(1), 1967, in the form of Stojanovic (2007). With f in kHz, the coefficient in dB/km is

.. math::

    \alpha = \frac{0.11 f^2}{1 + f^2} + \frac{44 f^2}{4100 + f^2} + 2.75 \cdot 10^{-4} f^2 + 0.003 .

The coefficient is wrong by a factor of two above 50 kHz, and does not hold in fresh water: use
`absorption` there.
"""

from __future__ import annotations


def thorp_absorption(frequency: float) -> float:
    """Return the absorption coefficient of sound of ``frequency`` [Hz], [dB/m]."""
    f2 = (frequency / 1000.0) ** 2
    return (0.11 * f2 / (1.0 + f2) + 44.0 * f2 / (4100.0 + f2) + 2.75e-4 * f2 + 0.003) / 1000.0
