r"""Station keeping of P and PI in a current: theory, and measurement from a log.

A vehicle that follows a velocity u relative to the water, in water that moves with c, has the
position error e (with the sign of c), which satisfies

.. math:: \dot e = c + u, \qquad u = -K_p e - K_i \int e \, dt

so that the error of a harmonic of c with the angular frequency w has the transfer function

.. math:: H(j w) = \frac{j w}{(j w)^2 + K_p\, j w + K_i}, \qquad
    H(0) = \frac{1}{K_p} \text{ for } K_i = 0, \text{ else } 0

The current of a ``<currentForceUpdater>`` with F along y of L and a swing by the angle a is, by
Jacobi and Anger,

.. math::

    F \cos(a \sin w t) &= F \left( J_0(a) + 2 \textstyle\sum_k J_{2k}(a) \cos 2 k w t \right) \\
    F \sin(a \sin w t) &= 2 F \textstyle\sum_k J_{2k-1}(a) \sin (2k-1) w t

along and across. Not modelled: the time constant of the vehicle's own velocity loop, the delay of
camera and tracker, tilt, and the variation (3 mm for 5 mm/s in 4 s) and noise of the current.
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
"""The number of harmonics of the swing in a sum; the ninth is below 1e-9 for a swing of 0.7 rad."""
SETTLING_TIME = 30.0
"""The time in a level after which the error counts as settled [s]."""
SWING_PERIOD = 30.0
"""The period of the swing of the bundled current [s]."""


@dataclass(frozen=True, kw_only=True)
class Loop:
    """The gains of a P or PI controller; ``ki`` is 0 for P."""

    kp: float
    """The proportional gain K_p [1/s]."""
    ki: float = 0.0
    """The integral gain K_i [1/s2]."""

    def response(self, rate: float) -> complex:
        """Return H(jw), the error per current [s], for an angular frequency [rad/s]."""
        if rate == 0.0:
            return 0.0 if self.ki else 1.0 / self.kp + 0j
        s = 1j * rate
        return s / (s * s + self.kp * s + self.ki)


@dataclass(frozen=True, kw_only=True)
class SwingingCurrent:
    """A current whose direction swings: F along y of L, with a swing towards -x and +x."""

    speed: float
    """The speed F of the current [m/s]."""
    angle: float = 0.7
    """The amplitude a of the swing [rad]."""
    period: float = SWING_PERIOD
    """The period 2 pi / w of the swing [s]."""

    def harmonics(self) -> tuple[Array, Phasors, Phasors]:
        """Return the frequencies (n,) [rad/s] and phasors along and across (n,) [m/s] of harmonics.

        A phasor p stands for the real part of p exp(j w t).
        """
        from scipy.special import jv

        order = np.arange(TERMS)
        rates: Array = np.asarray(2.0 * math.pi / self.period * order, dtype=np.float64)
        size = self.speed * np.where(order == 0, 1.0, 2.0) * jv(order, self.angle)
        along_phasors = np.where(order % 2 == 0, size, 0.0).astype(np.complex128)
        across_phasors: Phasors = np.where(order % 2 == 1, -1j * size, 0j)  # sin = Re(-j exp)
        return rates, along_phasors, across_phasors


@dataclass(frozen=True, kw_only=True)
class StationError:
    """The error of station keeping along the mean current and across it."""

    along_mean: float
    """The mean error along [m]."""
    along_amplitude: float
    """The amplitude of the fundamental along, which has half the period of the swing [m]."""
    across_mean: float
    """The mean error across [m]."""
    across_amplitude: float
    """The amplitude of the fundamental across, which has the period of the swing [m]."""


def predict_error(loop: Loop, swing: SwingingCurrent) -> StationError:
    """Compute the settled error by the theory above.

    P: the mean F J0(a)/Kp along, the amplitude 2 F J1(a)/sqrt(Kp^2 + w^2) across. PI: no mean, and
    2 F J1(a) w/sqrt((Ki - w^2)^2 + (Kp w)^2), which is *more* than P's unless Ki > 2 w^2.
    """
    rates, along_phasors, across_phasors = swing.harmonics()
    response = np.array([loop.response(float(rate)) for rate in rates])
    return StationError(
        along_mean=float((response[0] * along_phasors[0]).real),
        along_amplitude=float(abs(response[2] * along_phasors[2])),
        across_mean=0.0,
        across_amplitude=float(abs(response[1] * across_phasors[1])),
    )


def settled_error(loop: Loop, swing: SwingingCurrent, times: Array) -> tuple[Array, Array]:
    """Return the settled error along and across (n,) [m] at times in the level (n,) [s]."""
    rates, along_phasors, across_phasors = swing.harmonics()
    response = np.array([loop.response(float(rate)) for rate in rates])
    rotation = np.exp(1j * np.outer(times, rates))  # (n, k)
    return (rotation @ (response * along_phasors)).real, (
        rotation @ (response * across_phasors)
    ).real


# ---------------------------------------------------------------------------- from the logs


@dataclass(frozen=True, kw_only=True)
class Track:
    """A level of a run: horizontal positions of the vehicle and of the tracked target.

    All are in the axes of the camera: right and up in the image.
    """

    time: Array
    """The time since the start of the measures (n,) [s]."""
    vehicle: Array
    """The vehicle's horizontal position, from any origin (n, 2) [m]."""
    target_offset: Array
    """The offset of the tracked centroid from the image centre, at the target's distance
    (n, 2) [m]; NaN without an estimate."""
    tracker_error: Array
    """The distance of estimate and truth in the image (n,) [px]; NaN without an estimate."""

    def reference(self, *, start: float = SETTLING_TIME, period: float = SWING_PERIOD) -> Array:
        """Return the vehicle's position with the tracked centroid in the image centre (2,) [m].

        A target at an offset d to the right needs a move of d to the right, so every sample gives
        ``vehicle + target_offset``. The result is the mean over whole
        periods [s] after ``start`` [s]; the attitude does not change.
        """
        is_settled = select_whole_periods(self.time, period=period, start=start)
        positions = (self.vehicle + self.target_offset)[is_settled]
        has_estimate = ~np.isnan(positions).any(axis=1)
        if not has_estimate.any():
            raise ResultError("The target was never tracked in the settled part of the level.")
        mean: Array = positions[has_estimate].mean(axis=0)
        return mean

    def error(self, reference: Array | None = None) -> Array:
        """Return the vehicle's position relative to the reference (n, 2) [m]."""
        error: Array = self.vehicle - (self.reference() if reference is None else reference)
        return error


def select_whole_periods(
    time: Array, *, period: float = SWING_PERIOD, start: float = SETTLING_TIME
) -> npt.NDArray[np.bool_]:
    """Select the samples of as many whole periods after ``start`` [s] as the log holds.

    Raises:
        ResultError: the log does not hold one period.
    """
    step = float(np.median(np.diff(time))) if len(time) > 1 else 0.0
    n = math.floor((float(time[-1]) + step - start) / period + 1e-6) if len(time) else 0
    if n < 1:
        raise ResultError(f"The log does not hold a period of {period:g} s after {start:g} s.")
    is_selected = (time > start - step / 2) & (time < start + n * period - step / 2)
    return np.asarray(is_selected, dtype=np.bool_)


def amplitude(time: Array, values: Array, period: float) -> float:
    """Return the amplitude of the harmonic of a period [s], over whole periods of it."""
    rotation = np.exp(-2j * math.pi * time / period)
    return float(2.0 * abs(np.mean(values * rotation)))


def measure_error(track: Track) -> StationError:
    """Measure the station-keeping error over whole periods after 30 s.

    Along is up in the image (the current flows from stern to bow), across is right.
    """
    is_selected = select_whole_periods(track.time)
    time, error = track.time[is_selected], track.error()[is_selected]
    across_error, along_error = error[:, 0], error[:, 1]
    return StationError(
        along_mean=float(along_error.mean()),
        along_amplitude=amplitude(time, along_error, SWING_PERIOD / 2.0),
        across_mean=float(across_error.mean()),
        across_amplitude=amplitude(time, across_error, SWING_PERIOD),
    )


def read_level_track(
    result: Result, logs: dict[str, Log], *, level: float, focal: float, seed: int | None = None
) -> Track:
    """Read a level of ``currents`` from its logs.

    The tracked centroid is the truth (``objectCentered``) less the tracker's error (``centroid``);
    its metres are those at the distance d among the facts. The vehicle (``offset``) has its bow
    along y of L, so that the image's right is -x of L and its up y of L.

    Args:
        result: the run.
        logs: the logs of ``centroid``, ``objectCentered`` and ``offset``, by measure.
        level: the current [m/s].
        focal: the camera's focal length [px].
        seed: the seed of the repeat, where there are several.

    Raises:
        ResultError: a log lacks the level, or the distance is not among the facts.
    """
    distance = result.fact("d")
    if distance is None:
        raise ResultError("The result does not say how far the target is (fact d).")
    truth = _read_columns(logs["objectCentered"], ("x", "y"), level, seed)
    centroid = _read_columns(logs["centroid"], ("total", "x", "y"), level, seed)
    offset = _read_columns(logs["offset"], ("x", "y"), level, seed)
    n = min(len(truth), len(centroid), len(offset))
    truth, centroid, offset = truth[:n], centroid[:n], offset[:n]
    right = -(truth[:, 1] + centroid[:, 2])  # [px]
    up = -(truth[:, 2] - centroid[:, 3])  # [px]
    return Track(
        time=offset[:, 0] - offset[0, 0],
        vehicle=np.stack([-offset[:, 1], offset[:, 2]], axis=1),
        target_offset=np.stack([right, up], axis=1) * distance[0] / focal,
        tracker_error=centroid[:, 1],
    )


def _read_columns(log: Log, names: tuple[str, ...], level: float, seed: int | None) -> Array:
    """Return time and columns of a level, (n, 1 + m); NaN without a value."""
    column_names = [name.partition(" [")[0] for name in log.header]
    column_indices = [column_names.index("time"), *(column_names.index(name) for name in names)]
    level_index = column_names.index("current")
    rows = [
        [math.nan if (v := sample[i]) is None else float(v) for i in column_indices]
        for sample in log.samples
        if sample[level_index] is not None
        and abs(float(sample[level_index] or 0.0) - level) < 1e-9
        and (
            seed is None or "seed" not in column_names or sample[column_names.index("seed")] == seed
        )
    ]
    if not rows:
        raise ResultError(f"The log of {log.measure} has no level current={level:g}.")
    return np.array(rows)
