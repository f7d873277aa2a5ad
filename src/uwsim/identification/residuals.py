r"""The residuals of windows: measured minus simulated motion, divided by the noise of each channel.

A sample has twelve channels: the position in W (3) [m], the attitude as a rotation vector in base
axes (3) [rad], the velocity over ground (3) [m/s] and the angular velocity (3) [rad/s], both in
base axes. Channels without a measurement have the residual 0. Each window has its own initial
state, which is fitted with the coefficients: twelve offsets of the first guess, in the same order.

The derivatives with respect to coefficients and offsets are differences of simulations. Those with
respect to the offsets change little with the coefficients, so that a fit may keep them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..base.numerics.jit import njit
from ..base.numerics.memory import Floats, Ints64
from ..logs.frames import multiply_quaternions, rotate_vectors
from ..physics.hydrodynamics.kernel.free_rows import simulate_actuators, simulate_rows
from ..physics.hydrodynamics.kernel.free_step import ACTUATORS
from .parameters import Numbers, Parameter, apply_values
from .vehicle_model import VehicleModel
from .windows import Windows

N_CHANNELS = 12
"""The number of channels of a sample, and of offsets of an initial state."""
CHANNELS = (
    *("north", "east", "depth"),
    *("roll", "pitch", "yaw"),
    *("surge", "sway", "heave"),
    *("roll rate", "pitch rate", "yaw rate"),
)
"""The names of the channels."""
RELATIVE_STEP = 1e-4
"""The change of a coefficient for a derivative, in plausible errors."""
OFFSET_STEPS = np.repeat([1e-4, 1e-5, 1e-5, 1e-5], 3)
"""The changes of the offsets for derivatives [m, rad, m/s, rad/s]."""
MAX_MISFIT = 1e6
"""The greatest absolute residual; a simulation that diverges stays finite."""


@njit
def compare_motion(
    path: Floats, samples: Floats, index: Ints64, fraction: Floats, weights: Floats, out: Floats
) -> None:
    """Write the weighted residuals of all windows.

    Args:
        path: the simulated motion after each step, (windows, steps + 1, 13), as `free_step`.
        samples: the measured motion, (windows, samples, 13); NaN where there is none.
        index: the step before each sample, (windows, samples).
        fraction: the fraction of a step from there to the sample, (windows, samples).
        weights: the inverse of the noise of each channel, (12,).
        out: receives the residuals, (windows, 12 samples).
    """
    motion = np.empty(13)
    for row in range(len(path)):
        for sample in range(index.shape[1]):
            k, share = index[row, sample], fraction[row, sample]
            size = 0.0
            for i in range(13):
                motion[i] = (1.0 - share) * path[row, k, i] + share * path[row, k + 1, i]
            for i in range(3, 7):
                size += motion[i] * motion[i]
            scale = 1.0 / math.sqrt(size)
            w, x, y, z = scale * motion[3], scale * motion[4], scale * motion[5], scale * motion[6]
            _to_base_axes(w, x, y, z, motion)
            target, first = samples[row, sample], N_CHANNELS * sample
            for i in range(3):
                out[row, first + i] = target[i] - motion[i]
                out[row, first + 6 + i] = target[7 + i] - motion[7 + i]
                out[row, first + 9 + i] = target[10 + i] - motion[10 + i]
            a, b, c, d = target[3], target[4], target[5], target[6]
            _write_rotation(
                w * a + x * b + y * c + z * d,
                w * b - x * a - y * d + z * c,
                w * c + x * d - y * a - z * b,
                w * d - x * c + y * b - z * a,
                out[row, first + 3 : first + 6],
            )
            for i in range(N_CHANNELS):
                value = weights[i] * out[row, first + i]
                if value != value:  # not measured
                    value = 0.0
                out[row, first + i] = min(max(value, -MAX_MISFIT), MAX_MISFIT)


@njit
def _to_base_axes(w: float, x: float, y: float, z: float, motion: Floats) -> None:
    """Rotate the velocity of a row of motion from W to base axes."""
    u, v, n = motion[7], motion[8], motion[9]
    tx, ty, tz = 2.0 * (z * v - y * n), 2.0 * (x * n - z * u), 2.0 * (y * u - x * v)
    motion[7] = u + w * tx - (y * tz - z * ty)
    motion[8] = v + w * ty - (z * tx - x * tz)
    motion[9] = n + w * tz - (x * ty - y * tx)


@njit
def _write_rotation(w: float, x: float, y: float, z: float, out: Floats) -> None:
    """Write the rotation vector of a quaternion [rad]."""
    sign = 1.0 if w >= 0.0 else -1.0
    size = math.sqrt(x * x + y * y + z * z)
    share = 2.0 * sign
    if size > 1e-9:
        share = 2.0 * sign * math.atan2(size, abs(w)) / size
    out[0], out[1], out[2] = share * x, share * y, share * z


@dataclass(frozen=True, kw_only=True, eq=False)
class Fit:
    """The state of a fit: coefficients, and offsets of the initial states."""

    values: Array
    """The coefficients, (p,)."""
    offsets: Array
    """The offsets of each window's initial state, (windows, 12)."""


class Residuals:
    """The residuals of windows as a function of coefficients and initial states.

    Args:
        model: the vehicle.
        parameters: the coefficients.
        windows: the windows.
    """

    def __init__(
        self, model: VehicleModel, parameters: Sequence[Parameter], windows: Windows
    ) -> None:
        self.model, self.parameters, self.windows = model, tuple(parameters), windows
        n, n_samples = windows.index.shape
        self._path = np.empty((n, windows.settings.n_steps + 1, ACTUATORS))
        self.shape = n, N_CHANNELS * n_samples

    def start(self) -> Fit:
        """Return the first guess of all coefficients and initial states."""
        guesses = np.array([parameter.first_guess for parameter in self.parameters])
        return Fit(values=guesses, offsets=np.zeros((len(self.windows), N_CHANNELS)))

    def compute(self, fit: Fit, weights: Array) -> Array:
        """Return the residuals, (windows, 12 samples), weighted by 1 / noise of each channel."""
        self.simulate(apply_values(self.model, self.parameters, fit.values), fit.offsets)
        return self._compare(weights)

    def simulate(self, numbers: Numbers, offsets: Array) -> Array:
        """Simulate all windows; return a view of the motion after every step.

        Args:
            numbers: the numbers of the vehicle.
            offsets: the offsets of the initial states, (windows, 12).
        """
        return self._run(numbers, self._actuator_states(numbers), offsets)

    def differentiate(self, fit: Fit, weights: Array) -> Array:
        """Return the derivatives with respect to the coefficients, (windows, 12 samples, p)."""
        base = self.compute(fit, weights)
        slopes = np.empty((*self.shape, len(self.parameters)))
        for k, parameter in enumerate(self.parameters):
            step = RELATIVE_STEP * parameter.plausible_error
            if fit.values[k] + step > parameter.maximum:
                step = -step
            values = fit.values.copy()
            values[k] += step
            moved_rows = self.compute(Fit(values=values, offsets=fit.offsets), weights)
            slopes[:, :, k] = (moved_rows - base) / step
        return slopes

    def differentiate_offsets(self, fit: Fit, weights: Array) -> Array:
        """Return the derivatives with respect to the offsets, (windows, 12 samples, 12)."""
        numbers = apply_values(self.model, self.parameters, fit.values)
        actuators = self._actuator_states(numbers)
        self._run(numbers, actuators, fit.offsets)
        base = self._compare(weights)
        slopes = np.empty((*self.shape, N_CHANNELS))
        for k, step in enumerate(OFFSET_STEPS.tolist()):
            offsets = fit.offsets.copy()
            offsets[:, k] += step
            self._run(numbers, actuators, offsets)
            slopes[:, :, k] = (self._compare(weights) - base) / step
        return slopes

    def _run(self, numbers: Numbers, actuators: Array, offsets: Array) -> Array:
        states = np.concatenate(
            [_make_states(self.windows.initial_motion, offsets), actuators], axis=1
        )
        step = self.windows.settings.step
        simulate_rows(
            numbers.vehicle, states, self.windows.commands, numbers.water, step, self._path
        )
        return self._path

    def _compare(self, weights: Array) -> Array:
        windows, out = self.windows, np.empty(self.shape)
        compare_motion(self._path, windows.samples, windows.index, windows.fraction, weights, out)
        return out

    def _actuator_states(self, numbers: Numbers) -> Array:
        """Return the states of rotors and fins at the start of each window.

        They follow from the commands since the beginning of the log, when all are 0.
        """
        n_actuators = self.windows.commands.shape[2]
        states = np.zeros((len(self.windows), n_actuators))
        for log, grid in enumerate(self.windows.grids):
            path = np.empty((len(grid.commands) + 1, n_actuators))
            state = np.zeros(ACTUATORS + n_actuators)
            step = self.windows.settings.step
            simulate_actuators(numbers.vehicle, state, grid.commands, step, path)
            states[self.windows.logs == log] = path[grid.starts]
        return states


def _make_states(initial_motion: Array, offsets: Array) -> Array:
    """Return the motion of rows of `free_step` at the start of the windows, (windows, 13)."""
    states = initial_motion.copy()
    states[:, :3] += offsets[:, :3]
    turns = np.ones((len(initial_motion), 4))
    turns[:, 1:] = 0.5 * offsets[:, 3:6]
    turns /= np.sqrt((turns * turns).sum(axis=1, keepdims=True))
    states[:, 3:7] = multiply_quaternions(initial_motion[:, 3:7], turns)
    states[:, 7:10] = rotate_vectors(states[:, 3:7], initial_motion[:, 7:10] + offsets[:, 6:9])
    states[:, 10:] += offsets[:, 9:]
    return states
