r"""The one-step residual: the error of the simulated acceleration along the log, and its spectrum.

From states of the log at equal intervals :math:`\tau` the vehicle is simulated for one interval.
The residual acceleration is the simulated minus the measured twist at its end, over :math:`\tau`.
Its spectral density is that of Welch (1967): segments of `SEGMENT` values with a Hann window and
half overlap, with the mean of each segment removed. White noise of twists makes a spectrum that
rises to high frequencies; a wrong coefficient makes one like that of the motion.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from .log_motion import LogMotion
from .vehicle_run import VehicleRun

MIN_INTERVAL = 0.1
"""The shortest interval of a step [s]."""
MAX_STEPS = 1500
"""The greatest number of steps, from the middle of the log's longest part without a gap."""
MIN_STEPS = 32
"""The least number of steps for a spectrum."""
SEGMENT = 256
"""The greatest number of values in a segment of a spectrum."""


@dataclass(frozen=True, kw_only=True, eq=False)
class StepResiduals:
    """The residual accelerations along a log."""

    interval: float
    """The interval between states [s]."""
    times: Array
    """The times of the beginnings of the steps, (n,) [s]."""
    accelerations: Array
    """The residual accelerations in base axes, (n, 6) [m/s2, rad/s2]."""
    frequencies: Array
    """The frequencies of the spectrum, (m,) [Hz]."""
    densities: Array
    """The one-sided spectral densities, (m, 6) [(m/s2)2/Hz, (rad/s2)2/Hz]."""


def measure_residuals(
    run: VehicleRun, start: float, end: float, on_step: Callable[[], None] = lambda: None
) -> StepResiduals | None:
    """Simulate one step from each of many states of the log; None for too short a log.

    Args:
        run: the simulated vehicle.
        start: the first time with commands [s].
        end: the last time with commands [s].
        on_step: a function that is called after each step.
    """
    motion = run.motion
    times, interval = choose_steps(motion, start, end)
    if len(times) < MIN_STEPS:
        return None
    predictions = np.empty((len(times), 6))
    for index, time in enumerate(times.tolist()):
        predictions[index] = run.run(time, [interval]).twists[0]
        on_step()
    accelerations = (predictions - motion.twists(times + interval)) / interval
    frequencies, densities = estimate_spectrum(accelerations, interval)
    return StepResiduals(
        interval=interval,
        times=times,
        accelerations=accelerations,
        frequencies=frequencies,
        densities=densities,
    )


def choose_steps(motion: LogMotion, start: float, end: float) -> tuple[Array, float]:
    """Return the times of the steps, and their interval [s]."""
    period = float(np.median(np.diff(motion.times)))
    interval = max(1, math.ceil(MIN_INTERVAL / period - 1e-6)) * period
    first = max(start, float(motion.times[0]))
    end_time = min(end, float(motion.times[-1]))
    edges = [first, *(time for gap in motion.gaps for time in gap), end_time]
    parts = [
        (max(low, first), min(high, end_time))
        for low, high in zip(edges[::2], edges[1::2], strict=True)
        if min(high, end_time) > max(low, first)
    ]
    if not parts:
        return np.zeros(0), interval
    low, high = max(parts, key=lambda part: part[1] - part[0])
    n_steps = int((high - low) / interval + 1e-6)
    if n_steps > MAX_STEPS:
        low += 0.5 * (n_steps - MAX_STEPS) * interval
        n_steps = MAX_STEPS
    times: Array = low + interval * np.arange(n_steps, dtype=np.float64)
    return times, interval


def estimate_spectrum(values: Array, interval: float) -> tuple[Array, Array]:
    """Return the frequencies (m,) [Hz] and the one-sided spectral densities (m, k)."""
    n = min(SEGMENT, len(values))
    window = 0.5 - 0.5 * np.cos(2.0 * math.pi * np.arange(n) / n)
    scale = 2.0 * interval / float((window * window).sum())
    density = np.zeros((n // 2 + 1, values.shape[1]))
    starts = range(0, len(values) - n + 1, max(1, n // 2))
    for start in starts:
        segment = values[start : start + n]
        transform = np.fft.rfft((segment - segment.mean(axis=0)) * window[:, None], axis=0)
        density += scale * (transform.real**2 + transform.imag**2)
    density /= len(starts)
    frequencies = np.arange(n // 2 + 1) / (n * interval)
    return frequencies[1:], density[1:]
