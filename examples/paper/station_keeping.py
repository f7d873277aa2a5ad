r"""Station keeping: what theory says of P and PI in a current, and what a log says of them.

A vehicle that follows a velocity u relative to the water, in water that moves with c, has the
error e (its distance from where it should be, with the sign of c), which obeys

.. math:: \dot e = c + u, \qquad u = -K_p e - K_i \int e \, dt

so that a harmonic of c with the angular frequency w is passed on by

.. math:: H(j w) = \frac{j w}{(j w)^2 + K_p\, j w + K_i}, \qquad
    H(0) = \frac{1}{K_p} \text{ for } K_i = 0, \text{ else } 0

The current of a ``<currentForceUpdater>`` with F along y of L and a swing by the angle a is, by
Jacobi and Anger,

.. math::

    F \cos(a \sin w t) &= F \left( J_0(a) + 2 \textstyle\sum_k J_{2k}(a) \cos 2 k w t \right) \\
    F \sin(a \sin w t) &= 2 F \textstyle\sum_k J_{2k-1}(a) \sin (2k-1) w t

along and across. Not modelled: the time constant of the vehicle's own velocity loop, the delay of
camera and tracker, tilt, the swelling of the current (3 mm for 5 mm/s in 4 s) and its noise.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from uwsim.base.geometry import Array
from uwsim.errors import ResultError
from uwsim.results.log import Log
from uwsim.results.result import Result

Phasors = npt.NDArray[np.complex128]

TERMS = 8
"""Harmonics of the swing that are summed; the ninth is below 1e-9 for a swing of 0.7 rad."""
SETTLED = 30.0
"""From here on in a level its error counts as settled [s]."""
PERIOD = 30.0
"""Of the swing of the bundled current [s]."""


@dataclass(frozen=True, kw_only=True)
class Loop:
    """A controller's gains; ``ki`` = 0 makes it P."""

    kp: float
    """K_p [1/s]."""
    ki: float = 0.0
    """K_i [1/s2]."""

    def response(self, rate: float) -> complex:
        """Return H(jw), the error per current [s], for an angular frequency [rad/s]."""
        if rate == 0.0:
            return 0.0 if self.ki else 1.0 / self.kp + 0j
        s = 1j * rate
        return s / (s * s + self.kp * s + self.ki)


@dataclass(frozen=True, kw_only=True)
class Swing:
    """A current that turns to and fro: F along y of L, turning towards -x and +x."""

    speed: float
    """F [m/s]."""
    angle: float = 0.7
    """a [rad]."""
    period: float = PERIOD
    """2 pi / w [s]."""

    def harmonics(self) -> tuple[Array, Phasors, Phasors]:
        """Return w of each harmonic (n,) [rad/s] and its phasors, along and across (n,) [m/s].

        A phasor p stands for the real part of p exp(j w t).
        """
        from scipy.special import jv

        order = np.arange(TERMS)
        rates: Array = np.asarray(2.0 * math.pi / self.period * order, dtype=np.float64)
        size = self.speed * np.where(order == 0, 1.0, 2.0) * jv(order, self.angle)
        along = np.where(order % 2 == 0, size, 0.0).astype(np.complex128)
        across: Phasors = np.where(order % 2 == 1, -1j * size, 0j)  # sin = Re(-j exp)
        return rates, along, across


@dataclass(frozen=True, kw_only=True)
class Station:
    """How well a station was kept, along the mean current and across it."""

    along_mean: float
    """Mean error along [m]."""
    along_amplitude: float
    """Amplitude of its fundamental, which has half the period of the swing [m]."""
    across_mean: float
    """Mean error across [m]."""
    across_amplitude: float
    """Amplitude of its fundamental, which has the period of the swing [m]."""


def predicted(loop: Loop, swing: Swing) -> Station:
    """Return what theory says.

    P: the mean F J0(a)/Kp along, the amplitude 2 F J1(a)/sqrt(Kp^2 + w^2) across. PI: no mean, and
    2 F J1(a) w/sqrt((Ki - w^2)^2 + (Kp w)^2), which is *more* than P's unless Ki > 2 w^2.
    """
    rates, along, across = swing.harmonics()
    response = np.array([loop.response(float(rate)) for rate in rates])
    return Station(
        along_mean=float((response[0] * along[0]).real),
        along_amplitude=float(abs(response[2] * along[2])),
        across_mean=0.0,
        across_amplitude=float(abs(response[1] * across[1])),
    )


def steady(loop: Loop, swing: Swing, times: Array) -> tuple[Array, Array]:
    """Return the settled error along and across (n,) [m] at times in the level (n,) [s]."""
    rates, along, across = swing.harmonics()
    response = np.array([loop.response(float(rate)) for rate in rates])
    turning = np.exp(1j * np.outer(times, rates))  # (n, k)
    return (turning @ (response * along)).real, (turning @ (response * across)).real


# ---------------------------------------------------------------------------- from the logs


@dataclass(frozen=True, kw_only=True)
class Track:
    """One level of a run, seen from above: where the vehicle was, and where it saw its target.

    All in the camera's axes: right of the image, up in the image.
    """

    time: Array
    """Since the measures began (n,) [s]."""
    vehicle: Array
    """The vehicle's horizontal position, from any origin (n, 2) [m]."""
    seen: Array
    """Where the tracked centroid was from the middle of the image, at the target's distance
    (n, 2) [m]; NaN without an estimate."""
    tracker: Array
    """Distance of estimate and truth in the image (n,) [px]; NaN without an estimate."""

    def reference(self, *, after: float = SETTLED, period: float = PERIOD) -> Array:
        """Return where the vehicle is when the tracked centroid is in the middle (2,) [m].

        A target that is seen d to the right is reached by a move of d to the right: every sample
        says ``vehicle + seen``. The mean is taken over whole periods [s] after ``after`` [s]; the
        attitude is as it was.
        """
        chosen = whole_periods(self.time, period=period, after=after)
        places = (self.vehicle + self.seen)[chosen]
        known = ~np.isnan(places).any(axis=1)
        if not known.any():
            raise ResultError("The target was never tracked in the settled part of the level.")
        mean: Array = places[known].mean(axis=0)
        return mean

    def error(self, reference: Array | None = None) -> Array:
        """Return the vehicle's position about the reference (n, 2) [m]."""
        error: Array = self.vehicle - (self.reference() if reference is None else reference)
        return error


def whole_periods(
    time: Array, *, period: float = PERIOD, after: float = SETTLED
) -> npt.NDArray[np.bool_]:
    """Choose the samples of as many whole periods after ``after`` [s] as the log holds.

    Raises:
        ResultError: there is not one.
    """
    step = float(np.median(np.diff(time))) if len(time) > 1 else 0.0
    n = math.floor((float(time[-1]) + step - after) / period + 1e-6) if len(time) else 0
    if n < 1:
        raise ResultError(f"The log does not hold a period of {period:g} s after {after:g} s.")
    chosen = (time > after - step / 2) & (time < after + n * period - step / 2)
    return np.asarray(chosen, dtype=np.bool_)


def amplitude(time: Array, values: Array, period: float) -> float:
    """Return the amplitude of the harmonic of a period [s], over whole periods of it."""
    turning = np.exp(-2j * math.pi * time / period)
    return float(2.0 * abs(np.mean(values * turning)))


def measured(track: Track) -> Station:
    """Say how well the station was kept: the vehicle's position over whole periods after 30 s.

    Along is up in the image (the current flows from stern to bow), across is right.
    """
    chosen = whole_periods(track.time)
    time, error = track.time[chosen], track.error()[chosen]
    across, along = error[:, 0], error[:, 1]
    return Station(
        along_mean=float(along.mean()),
        along_amplitude=amplitude(time, along, PERIOD / 2.0),
        across_mean=float(across.mean()),
        across_amplitude=amplitude(time, across, PERIOD),
    )


def track(
    result: Result, logs: dict[str, Log], *, level: float, focal: float, seed: int | None = None
) -> Track:
    """Take one level of ``currents`` from its logs.

    The tracked centroid is the truth (``objectCentered``) less the tracker's error (``centroid``);
    its metres are those at the distance d among the facts. The vehicle (``offset``) has its bow
    along y of L, so that the image's right is -x of L and its up y of L.

    Args:
        result: the run.
        logs: measure -> log, of ``centroid``, ``objectCentered`` and ``offset``.
        level: the current [m/s].
        focal: the camera's focal length [px].
        seed: of the repeat, where there are several.

    Raises:
        ResultError: a log lacks the level, or the distance is not among the facts.
    """
    distance = result.fact("d")
    if distance is None:
        raise ResultError("The result does not say how far the target is (fact d).")
    truth = _columns(logs["objectCentered"], ("x", "y"), level, seed)
    centroid = _columns(logs["centroid"], ("total", "x", "y"), level, seed)
    place = _columns(logs["offset"], ("x", "y"), level, seed)
    n = min(len(truth), len(centroid), len(place))
    truth, centroid, place = truth[:n], centroid[:n], place[:n]
    right = -(truth[:, 1] + centroid[:, 2])  # [px]
    up = -(truth[:, 2] - centroid[:, 3])  # [px]
    return Track(
        time=place[:, 0] - place[0, 0],
        vehicle=np.stack([-place[:, 1], place[:, 2]], axis=1),
        seen=np.stack([right, up], axis=1) * distance[0] / focal,
        tracker=centroid[:, 1],
    )


def _columns(log: Log, names: tuple[str, ...], level: float, seed: int | None) -> Array:
    """Return time and columns of a level, (n, 1 + m); NaN where there is nothing."""
    bare = [name.partition(" [")[0] for name in log.header]
    wanted = [bare.index("time"), *(bare.index(name) for name in names)]
    at = bare.index("current")
    rows = [
        [math.nan if (v := sample[i]) is None else float(v) for i in wanted]
        for sample in log.samples
        if sample[at] is not None
        and abs(float(sample[at] or 0.0) - level) < 1e-9
        and (seed is None or "seed" not in bare or sample[bare.index("seed")] == seed)
    ]
    if not rows:
        raise ResultError(f"The log of {log.measure} has no level current={level:g}.")
    return np.array(rows)
