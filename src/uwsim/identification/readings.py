r"""Other readings of logs: signs, units and frames with which the vehicle explains them better.

A wrong sign, unit or frame makes every fit fail, and the fit does not say so: it moves coefficients
until the error is smallest. Each reading of this module changes one convention of all logs, and is
simulated once. The error of a quantity q (position, attitude, velocity,
angular velocity) is

.. math:: \varepsilon_q = \frac{\mathrm{rms}(e_q)}{\max(\mathrm{rms}(d_q), \sigma_q)}

with the difference e of measured and simulated motion, the change d of the measured motion since
the start of its window, and the noise :math:`\sigma`. 1 is the error of a simulation in which
nothing changes, in any unit. The error of a reading is the geometric mean, over the quantities that
it changes, of the ratios to the errors of the logs as they were read. All are simulated with the
first guess, which does not know the mistake. The best reading is then fitted for a few iterations,
and compared with the fit to the logs. Two mistakes at once may hide each other.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from ..base.geometry import Array
from ..logs import MotionSeries, VehicleLog
from ..logs.frames import (
    convert_body_vectors,
    convert_orientations,
    convert_positions,
    multiply_quaternions,
    quaternions_from_rpy,
    rotate_vectors_back,
)
from ..logs.smoothing import estimate_twists
from .least_squares import Loss, minimise
from .residuals import Residuals
from .validation import QUANTITIES, measured_columns, simulate_errors
from .windows import Windows, cut_windows

MAX_READING_WINDOWS = 60
"""The number of windows that readings are simulated in."""
MAX_COMMAND = 1.01
"""The greatest command of thrusters in the range -1 to 1, with rounding."""
MAX_FIT_WINDOWS, FIT_ITERATIONS = 20, 8
"""The greatest number of windows and iterations of the fit to the best reading."""
MAX_ERROR_RATIO = 0.7
"""The ratio of errors from which on a reading is named."""
MIN_CHANGE = 0.01
"""The relative change of the error of a quantity that a reading changes."""
DEGREE = np.pi / 180.0
"""The number of radians in a degree."""

Change = Callable[[MotionSeries], MotionSeries]
"""A function from a motion as it was read to the motion of another reading."""


@dataclass(frozen=True, kw_only=True)
class Reading:
    """Another reading of the logs, and its error."""

    text: str
    """The reading: what the logs would have."""
    error: float
    """The error relative to that of the logs as they were read, with the first guess."""
    fitted_error: float | None = None
    """The same after a short fit to this reading and the fit to the logs; None: not fitted."""


def rank_readings(
    residuals: Residuals, logs: Sequence[VehicleLog], values: Array, noise: Array, loss: Loss
) -> tuple[Reading, ...]:
    """Return the readings, the one with the smallest error first, which is fitted, too.

    Args:
        residuals: the residuals of the windows as they were read.
        logs: the logs.
        values: the coefficients that were fitted to them.
        noise: the noise of the measurements, (12,).
        loss: the loss.
    """
    model, rows = residuals.model, _choose_rows(len(residuals.windows))
    windows = residuals.windows.select(rows)
    readings = dict(_change_commands(windows, model.thrusters))
    for text, moved_logs in _change_logs(logs):
        moved_windows = cut_windows(moved_logs, model, windows.settings)
        if len(moved_windows) == len(residuals.windows):
            readings[text] = moved_windows.select(rows)
    guess = residuals.start().values
    reference = measure_errors(residuals, windows, guess, noise)
    errors = {
        text: _compare_errors(measure_errors(residuals, reading_windows, guess, noise), reference)
        for text, reading_windows in readings.items()
    }
    finite_errors = {text: error for text, error in errors.items() if np.isfinite(error)}
    ranking = sorted(finite_errors, key=lambda text: finite_errors[text])
    fitted_error = None
    if ranking and errors[ranking[0]] < 1.0:
        reading_windows = readings[ranking[0]]
        fitted_values = _fit_shortly(residuals, reading_windows, noise, loss)
        fitted_error = _compare_errors(
            measure_errors(residuals, reading_windows, fitted_values, noise),
            measure_errors(residuals, windows, values, noise),
        )
    return tuple(
        Reading(text=text, error=errors[text], fitted_error=None if rank else fitted_error)
        for rank, text in enumerate(ranking)
    )


def _fit_shortly(residuals: Residuals, windows: Windows, noise: Array, loss: Loss) -> Array:
    """Return coefficients after few iterations in few windows of a reading, (p,)."""
    rows = np.linspace(0, len(windows) - 1, min(len(windows), MAX_FIT_WINDOWS)).round()
    part = Residuals(
        residuals.model, residuals.parameters, windows.select(rows.astype(int).tolist())
    )
    weights = 1.0 / noise
    solution = minimise(part, part.start(), weights, loss=loss, max_iterations=FIT_ITERATIONS)
    return solution.fit.values


def _choose_rows(n: int) -> list[int]:
    rows = np.linspace(0, n - 1, min(n, MAX_READING_WINDOWS)).round().astype(int)
    return [int(row) for row in rows]


def _compare_errors(errors: Array, reference: Array) -> float:
    """Return the mean ratio of errors, over the quantities that a reading changes."""
    if len(errors) != len(reference):  # a reading without one of the quantities
        return float("inf")
    ratios = errors / reference
    changed_ratios = ratios[np.abs(ratios - 1.0) > MIN_CHANGE]
    n = len(changed_ratios)
    return float(np.prod(changed_ratios) ** (1.0 / n)) if n else 1.0


def measure_errors(residuals: Residuals, windows: Windows, values: Array, noise: Array) -> Array:
    """Return the error of each quantity, relative to the change of the motion, (quantities,)."""
    part = Residuals(residuals.model, residuals.parameters, windows)
    errors = simulate_errors(part, values)
    changes = _measure_changes(windows)
    ratios = []
    for _, channels in QUANTITIES.values():
        columns = measured_columns(windows, channels)
        if columns:
            floor = float(np.sqrt((noise[columns] * noise[columns]).sum()))
            change = _spread(changes[:, :, columns])
            ratios.append(_spread(errors[:, :, columns]) / max(change, floor))
    bounded_ratios: Array = np.maximum(ratios, 1e-9)
    return bounded_ratios


def _measure_changes(windows: Windows) -> Array:
    """Return the motion relative to the first sample of a window, (windows, samples, 12)."""
    samples = windows.samples
    first_attitudes = np.repeat(samples[:, :1, 3:7], samples.shape[1], axis=1).reshape(-1, 4)
    conjugates = first_attitudes * np.array([1.0, -1.0, -1.0, -1.0])
    turns = multiply_quaternions(conjugates, samples[:, :, 3:7].reshape(-1, 4))
    size = np.sqrt((turns[:, 1:] * turns[:, 1:]).sum(axis=1, keepdims=True))
    angles = 2.0 * np.arctan2(size, np.abs(turns[:, :1]))
    vectors = (turns[:, 1:] * angles / np.maximum(size, 1e-12)).reshape(*samples.shape[:2], 3)
    columns = [samples[:, :, columns] for columns in (slice(0, 3), slice(7, 13))]
    position, twist = (part - part[:, :1] for part in columns)
    changes: Array = np.nan_to_num(np.concatenate([position, vectors, twist], axis=2))
    return changes


def _spread(values: Array) -> float:
    """Return the root mean square of lengths; errors of samples without measurement are 0."""
    squares = (values * values).sum(axis=2)
    return float(np.sqrt(squares.mean()))


def _change_commands(windows: Windows, thrusters: Sequence[str]) -> Iterator[tuple[str, Windows]]:
    """Yield readings of the commands: a thruster reversed, or two exchanged."""
    n = len(thrusters)
    for i, name in enumerate(thrusters):
        signs = np.ones(windows.commands.shape[2])
        signs[i] = -1.0
        grids = [replace(grid, commands=grid.commands * signs) for grid in windows.grids]
        yield (
            f"the thruster {name} with the opposite sign",
            replace(windows, commands=windows.commands * signs, grids=tuple(grids)),
        )
    for i, k in combinations(range(n), 2):
        order = np.arange(windows.commands.shape[2])
        order[[i, k]] = order[[k, i]]
        grids = [replace(grid, commands=grid.commands[:, order]) for grid in windows.grids]
        yield (
            f"the thrusters {thrusters[i]} and {thrusters[k]} exchanged",
            replace(windows, commands=windows.commands[:, :, order], grids=tuple(grids)),
        )


def _change_logs(logs: Sequence[VehicleLog]) -> Iterator[tuple[str, list[VehicleLog]]]:
    """Yield readings of the motion, and of commands beyond -1 to 1."""
    has_twists = all(
        log.motion is not None
        and log.motion.twists is not None
        and log.motion.twist_source == "log"
        for log in logs
    )
    for text, change in {**POSE_READINGS, **(TWIST_READINGS if has_twists else {})}.items():
        yield text, [_change_motion(log, change) for log in logs]
    if any(_has_great_commands(log) for log in logs):
        yield (
            'commands in microseconds (unit = "pwm")',
            [_scale_commands(log, 1500.0, 400.0) for log in logs],
        )
        yield "commands in percent", [_scale_commands(log, 0.0, 100.0) for log in logs]


def _has_great_commands(log: VehicleLog) -> bool:
    return any(
        part.kind == "thrusters" and bool((np.abs(part.values) > MAX_COMMAND).any())
        for part in log.commands
    )


def _scale_commands(log: VehicleLog, zero: float, unit: float) -> VehicleLog:
    commands = tuple(
        replace(part, values=(part.values - zero) / unit) if part.kind == "thrusters" else part
        for part in log.commands
    )
    return replace(log, commands=commands)


def _change_motion(log: VehicleLog, change: Change) -> VehicleLog:
    assert log.motion is not None
    motion = change(log.motion)
    if motion.twist_source == "smoothed":
        twists = estimate_twists(motion.times, motion.positions, motion.quaternions)
        motion = replace(motion, twists=twists)
    return replace(log, motion=motion)


def _turn_twists(motion: MotionSeries) -> MotionSeries:
    if motion.twists is None:
        return motion
    parts = [convert_body_vectors(motion.twists[:, i : i + 3], "flu") for i in (0, 3)]
    return replace(motion, twists=np.column_stack(parts))


def _scale_rates(factor: float) -> Change:
    def change(motion: MotionSeries) -> MotionSeries:
        assert motion.twists is not None
        twists = motion.twists.copy()
        twists[:, 3:] *= factor
        return replace(motion, twists=twists)

    return change


def _scale_angles(factor: float) -> Change:
    def change(motion: MotionSeries) -> MotionSeries:
        return replace(motion, quaternions=_scale_rpy(motion.quaternions, factor))

    return change


def _scale_rpy(quaternions: Array, factor: float) -> Array:
    w, x, y, z = quaternions.T
    roll = np.arctan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2.0 * (w * y - z * x), -1.0, 1.0))
    yaw = np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    angles = [roll, pitch, np.unwrap(yaw)]
    return quaternions_from_rpy(factor * np.column_stack(angles))


def _turn_velocities(motion: MotionSeries) -> MotionSeries:
    assert motion.twists is not None
    twists = motion.twists.copy()
    twists[:, :3] = rotate_vectors_back(motion.quaternions, twists[:, :3])
    return replace(motion, twists=twists)


def _move_positions(order: Sequence[int], signs: Sequence[float]) -> Change:
    def change(motion: MotionSeries) -> MotionSeries:
        return replace(motion, positions=motion.positions[:, list(order)] * np.array(signs))

    return change


def _turn_west(motion: MotionSeries) -> MotionSeries:
    signs = np.array([1.0, 1.0, -1.0, -1.0])
    return _turn_twists(
        replace(
            motion,
            positions=motion.positions * np.array([1.0, -1.0, -1.0]),
            quaternions=motion.quaternions * signs,
        )
    )


def _turn_east(motion: MotionSeries) -> MotionSeries:
    return _turn_twists(
        replace(
            motion,
            positions=convert_positions(motion.positions, "enu"),
            quaternions=convert_orientations(motion.quaternions, "enu", "flu"),
        )
    )


POSE_READINGS: dict[str, Change] = {
    "positions with z up": _move_positions((0, 1, 2), (1.0, 1.0, -1.0)),
    "positions in the order east, north, down": _move_positions((1, 0, 2), (1.0, 1.0, 1.0)),
    "positions in the order east, north, up": _move_positions((1, 0, 2), (1.0, 1.0, -1.0)),
    'a world east, north, up, a body forward, left, up (world = "enu", body = "flu")': _turn_east,
    "a world north, west, up, a body forward, left, up": _turn_west,
    'angles in degrees (angle_unit = "deg")': _scale_angles(DEGREE),
    'angles in radians (angle_unit = "rad")': _scale_angles(1.0 / DEGREE),
}
"""The readings of poses, and what they change."""
TWIST_READINGS: dict[str, Change] = {
    'velocities of a body forward, left, up (body = "flu")': _turn_twists,
    "angular velocities in degrees per second": _scale_rates(DEGREE),
    "angular velocities in radians per second": _scale_rates(1.0 / DEGREE),
    'velocities along the axes of the world (velocity_frame = "world")': _turn_velocities,
}
"""The readings of measured velocities, and what they change."""
