r"""The motion of the water under linear waves at one point, in compiled code.

For components of amplitude :math:`a`, wave number :math:`k` along the unit vector :math:`\hat k`
and phase :math:`\theta = k \hat k \cdot x - \omega t + \varphi`, with the height :math:`z` above
the still surface and the depth :math:`h`,

.. math::
    \eta = \sum a \cos\theta, \quad
    u_h = \sum a \omega \hat k \frac{\cosh k(z+h)}{\sinh kh} \cos\theta, \quad
    w = \sum a \omega \frac{\sinh k(z+h)}{\sinh kh} \sin\theta, \quad
    \frac{p}{\rho} = \sum \frac{a \omega^2}{k} \frac{\cosh k(z+h)}{\sinh kh} \cos\theta

(Airy; Dean and Dalrymple 1991, chapter 3). Linear theory ends at the still surface. Above it, in
crests, the values are those at the still surface (vertical extension). So the pressure is that of
the air at a crest, and within :math:`\rho g k \eta^2` of it in a trough. Stretching the vertical
axis instead (Wheeler 1970) adds a mean flow :math:`-\tfrac12 \omega k a^2 e^{kz}` at all depths,
against the waves, which takes the Stokes drift away.

Sine, cosine and exponential are polynomials, so that a loop over components uses the vector
instructions of the processor, with the same results on every processor. Their relative error is
below 1e-15; the phase is exact to 1e-10 rad while :math:`\omega t < 10^6`.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..base.geometry import Array
from ..base.numerics.jit import njit
from ..base.numerics.memory import carray, pointer, read_double, view_doubles

WAVES = np.dtype(
    [
        ("n", np.int64),  # components
        ("columns", np.int64),  # the address of the columns below, (N_COLUMNS, n)
        ("surface", np.float64),  # the height of the still surface in W [m]
        ("depth", np.float64),  # of the water [m]
        ("scale", np.int64),  # the address of the factor on all amplitudes [1]
    ]
)
"""The waves of a scene, for compiled code."""
AMPLITUDE, OMEGA, PHASE, K, KX, KY, UNIT_X, UNIT_Y, SPEED, FACTOR, DECAY, N_COLUMNS = range(12)
r"""The columns of components in W: amplitude [m], angular frequency [rad/s], phase [rad], wave
number and its components [rad/m], unit vector of travel [1], phase speed [m/s],
:math:`\omega / (1 - e^{-2kh})` [rad/s] and :math:`e^{-2kh}` [1]."""

ELEVATION, SLOPE, VELOCITY, ACCELERATION, GRADIENT, PRESSURE, N_VALUES = 0, 1, 3, 6, 9, 14, 15
r"""The values at a point: the elevation [m], its slopes along x and y [1]; the velocity [m/s] and
its local rate of change [m/s2]; the velocity gradient xx, xy, yy, xz, yz, which is symmetric and
without trace [1/s]; the dynamic pressure over the density [m2/s2]."""

_TWO_OVER_PI = 2.0 / math.pi
_HALF_PI = 1.57079632673412561417  # its first 33 bits, so that a product with an integer is exact
_HALF_PI_REST = 6.07710050650619224932e-11
_MIN_EXPONENT = -48.0  # below it the exponential counts as that of this number, 1e-21

Record = Any


@njit
def compute_wave_motion(waves: Record, x: float, y: float, z: float, time: float) -> Array:
    """Compute the elevation of the surface above a point, and the motion of the water there.

    Args:
        waves: a record of `WAVES`.
        x: x of the point in W [m].
        y: y of the point in W [m].
        z: z of the point in W [m].
        time: the simulation time [s].

    Returns:
        The values above, (N_VALUES,), in W.
    """
    n = waves.n
    columns = view_doubles(waves.columns, N_COLUMNS * n).reshape((N_COLUMNS, n))
    work, values = np.empty((4, n)), np.zeros(N_VALUES)
    _compute_phases(columns, x, y, time, work[0], work[1])
    height = max(min(z - waves.surface, 0.0), -waves.depth)
    _compute_decay(columns, height, work[2], work[3])
    _add_components(columns, work, values)
    scale = read_double(waves.scale)
    for k in range(N_VALUES):
        values[k] *= scale
    return values


@njit
def compute_elevation(waves: Record, x: float, y: float, time: float) -> float:
    """Compute the elevation of the surface at a point of the still surface [m].

    Args:
        waves: a record of `WAVES`.
        x: x of the point in W [m].
        y: y of the point in W [m].
        time: the simulation time [s].
    """
    n = waves.n
    columns = view_doubles(waves.columns, N_COLUMNS * n).reshape((N_COLUMNS, n))
    work = np.empty((2, n))
    _compute_phases(columns, x, y, time, work[0], work[1])
    elevation, amplitude, cosine = 0.0, columns[AMPLITUDE], work[1]
    for i in range(n):
        elevation += amplitude[i] * cosine[i]
    product: float = elevation * read_double(waves.scale)
    return product


@njit
def _compute_phases(
    columns: Array, x: float, y: float, time: float, sine: Array, cosine: Array
) -> None:
    """Write the sine and the cosine of each component's phase."""
    kx, ky, omega, phase = columns[KX], columns[KY], columns[OMEGA], columns[PHASE]
    for i in range(len(sine)):
        angle = kx[i] * x + ky[i] * y - omega[i] * time + phase[i]
        quarter = np.floor(angle * _TWO_OVER_PI + 0.5)
        r = angle - quarter * _HALF_PI - quarter * _HALF_PI_REST  # at most pi / 4
        q = r * r
        s = 1.0 - q * (1.0 / 210.0)
        s = 1.0 - q * (1.0 / 156.0) * s
        s = 1.0 - q * (1.0 / 110.0) * s
        s = 1.0 - q * (1.0 / 72.0) * s
        s = 1.0 - q * (1.0 / 42.0) * s
        s = 1.0 - q * (1.0 / 20.0) * s
        s = r * (1.0 - q * (1.0 / 6.0) * s)
        c = 1.0 - q * (1.0 / 240.0)
        c = 1.0 - q * (1.0 / 182.0) * c
        c = 1.0 - q * (1.0 / 132.0) * c
        c = 1.0 - q * (1.0 / 90.0) * c
        c = 1.0 - q * (1.0 / 56.0) * c
        c = 1.0 - q * (1.0 / 30.0) * c
        c = 1.0 - q * (1.0 / 12.0) * c
        c = 1.0 - q * (1.0 / 2.0) * c
        half = np.floor(0.5 * quarter)
        is_odd = quarter - 2.0 * half  # 1 where sine and cosine change places
        next_half = np.floor(0.5 * (quarter + 1.0))
        sign = 1.0 - 2.0 * (half - 2.0 * np.floor(0.5 * half))
        cosine_sign = 1.0 - 2.0 * (next_half - 2.0 * np.floor(0.5 * next_half))
        sine[i] = sign * (s + is_odd * (c - s))
        cosine[i] = cosine_sign * (c + is_odd * (s - c))


@njit
def _compute_decay(
    columns: Array, height: float, horizontal_speed: Array, vertical_speed: Array
) -> None:
    """Write the amplitudes of horizontal and vertical velocity at a height, -depth to 0 [m]."""
    k, amplitude, factor, decay = (
        columns[K],
        columns[AMPLITUDE],
        columns[FACTOR],
        columns[DECAY],
    )
    for i in range(len(horizontal_speed)):
        u = max(k[i] * height, _MIN_EXPONENT) / 64.0
        e = 1.0 + u * (1.0 / 12.0)
        e = 1.0 + u * (1.0 / 11.0) * e
        e = 1.0 + u * (1.0 / 10.0) * e
        e = 1.0 + u * (1.0 / 9.0) * e
        e = 1.0 + u * (1.0 / 8.0) * e
        e = 1.0 + u * (1.0 / 7.0) * e
        e = 1.0 + u * (1.0 / 6.0) * e
        e = 1.0 + u * (1.0 / 5.0) * e
        e = 1.0 + u * (1.0 / 4.0) * e
        e = 1.0 + u * (1.0 / 3.0) * e
        e = 1.0 + u * (1.0 / 2.0) * e
        e = 1.0 + u * e
        e *= e
        e *= e
        e *= e
        e *= e
        e *= e
        e *= e
        reflection = decay[i] / e  # of the seabed
        speed = amplitude[i] * factor[i]
        horizontal_speed[i] = speed * (e + reflection)
        vertical_speed[i] = speed * (e - reflection)


@njit
def _add_components(columns: Array, work: Array, values: Array) -> None:
    """Add up the components."""
    elevation, slope_x, slope_y, u, v, w = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    du, dv, dw, pressure = 0.0, 0.0, 0.0, 0.0
    xx, xy, yy, xz, yz = 0.0, 0.0, 0.0, 0.0, 0.0
    amplitude, omega, kx, ky = columns[AMPLITUDE], columns[OMEGA], columns[KX], columns[KY]
    unit_x, unit_y, speed = columns[UNIT_X], columns[UNIT_Y], columns[SPEED]
    for i in range(columns.shape[1]):
        sine, cosine, horizontal_speed, vertical_speed = (
            work[0, i],
            work[1, i],
            work[2, i],
            work[3, i],
        )
        horizontal_cosine, horizontal_sine = horizontal_speed * cosine, horizontal_speed * sine
        vertical_sine, vertical_cosine = vertical_speed * sine, vertical_speed * cosine
        x, y, rate = unit_x[i], unit_y[i], omega[i]
        elevation += amplitude[i] * cosine
        slope_x -= amplitude[i] * kx[i] * sine
        slope_y -= amplitude[i] * ky[i] * sine
        u += x * horizontal_cosine
        v += y * horizontal_cosine
        w += vertical_sine
        du += x * rate * horizontal_sine
        dv += y * rate * horizontal_sine
        dw -= rate * vertical_cosine
        xx -= kx[i] * x * horizontal_sine
        xy -= ky[i] * x * horizontal_sine
        yy -= ky[i] * y * horizontal_sine
        xz += kx[i] * vertical_cosine
        yz += ky[i] * vertical_cosine
        pressure += speed[i] * horizontal_cosine
    values[ELEVATION], values[SLOPE], values[SLOPE + 1] = elevation, slope_x, slope_y
    values[VELOCITY], values[VELOCITY + 1], values[VELOCITY + 2] = u, v, w
    values[ACCELERATION], values[ACCELERATION + 1], values[ACCELERATION + 2] = du, dv, dw
    values[GRADIENT], values[GRADIENT + 1], values[GRADIENT + 2] = xx, xy, yy
    values[GRADIENT + 3], values[GRADIENT + 4] = xz, yz
    values[PRESSURE] = pressure


def write_surface(parameters: int, values: int, time: float) -> None:
    """Write elevation and pressure after a point; see `uwsim.world.mounts.read_surface`."""
    waves = carray(pointer(parameters), (1,), WAVES)[0]
    row = view_doubles(values, 5)
    motion = compute_wave_motion(waves, row[0], row[1], row[2], time)
    row[3], row[4] = motion[ELEVATION], motion[PRESSURE]
