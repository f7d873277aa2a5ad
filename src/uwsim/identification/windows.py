"""The windows of logs: measured motion in W, commands of each step, and initial states.

A window is a piece of a log that is simulated on its own, from an initial state of its own. Short
windows keep the errors of a simulation small and their dependence on the coefficients nearly
linear. Windows do not overlap. Commands are averaged over each step of the simulation.

The motion has the columns of `kernel.free_step`: the position in W [m], the attitude (wxyz), the
velocity over ground in base axes [m/s] and the angular velocity in base axes [rad/s].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, quaternion_from_rotation
from ..base.numerics.linear import rotate_rows
from ..errors import BadSetting, choices
from ..logs import CommandSeries, MotionSeries, VehicleLog, name_motors
from ..logs.frames import multiply_quaternions, rotate_vectors
from .planar import level_motion
from .vehicle_model import VehicleModel

N_MOTION = 13
"""The number of columns of the motion."""
MIN_SAMPLES = 5
"""The smallest number of samples in a window."""
MAX_WINDOWS = 400
"""The greatest number of windows; of longer logs, windows are indices evenly."""
MAX_STEPS = 20_000_000
"""The greatest number of steps of a log's time base."""


@dataclass(frozen=True, kw_only=True)
class WindowSettings:
    """The lengths of windows, steps and samples."""

    length: float = 5.0
    """The length of a window [s]."""
    step: float = 0.005
    """The step of the simulation [s]."""
    rate: float = 10.0
    """The greatest rate of samples that are compared [Hz]; of faster logs, samples are omitted."""

    @property
    def n_steps(self) -> int:
        """The number of steps of a window."""
        return max(1, round(self.length / self.step))


@dataclass(frozen=True, kw_only=True, eq=False)
class LogGrid:
    """The commands of one log on the time base of the simulation."""

    commands: Array
    """The commands of each step, (steps, actuators)."""
    starts: npt.NDArray[np.int64]
    """The first step of each window of this log, (windows,)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Windows:
    """The windows of all logs."""

    settings: WindowSettings
    """The lengths."""
    grids: tuple[LogGrid, ...]
    """The commands of each log."""
    logs: npt.NDArray[np.int64]
    """The index of the log of each window, (windows,)."""
    times: Array
    """The time of the log at which each window begins, (windows,) [s]."""
    commands: Array
    """The commands of each step, (windows, steps, actuators)."""
    samples: Array
    """The measured motion, (windows, samples, `N_MOTION`); NaN where there is none."""
    index: npt.NDArray[np.int64]
    """The step before each sample, (windows, samples)."""
    fraction: Array
    """The fraction of a step from there to the sample, (windows, samples)."""
    initial_motion: Array
    """The initial motion by the first samples, (windows, `N_MOTION`)."""
    remarks: tuple[str, ...] = ()
    """The parts of the logs that are not used, and commands that are missing."""

    def __len__(self) -> int:
        return len(self.logs)

    def select(self, rows: Sequence[int]) -> Windows:
        """Return some of the windows."""
        indices = np.array(rows, dtype=np.int64)
        grids = tuple(
            LogGrid(commands=grid.commands, starts=self._starts(i)[np.isin(self._rows(i), indices)])
            for i, grid in enumerate(self.grids)
        )
        return Windows(
            settings=self.settings, grids=grids, logs=self.logs[indices], times=self.times[indices],
            commands=self.commands[indices], samples=self.samples[indices],
            index=self.index[indices], fraction=self.fraction[indices],
            initial_motion=self.initial_motion[indices], remarks=self.remarks,
        )  # fmt: skip

    def _rows(self, log: int) -> npt.NDArray[np.int64]:
        return np.flatnonzero(self.logs == log)

    def _starts(self, log: int) -> npt.NDArray[np.int64]:
        return self.grids[log].starts


def cut_windows(
    logs: Sequence[VehicleLog], model: VehicleModel, settings: WindowSettings
) -> Windows:
    """Cut logs into windows.

    Raises:
        BadSetting: a log has no motion or no commands of thrusters or fins, a command is of no
            actuator of the vehicle, or no window has enough samples; with every error.
    """
    errors: list[str] = []
    remarks: list[str] = []
    parts: list[_Cut] = []
    for log in logs:
        problems = _find_errors(log, model, settings)
        errors += problems
        if not problems:
            parts.append(_cut_log(log, model, settings, remarks))
    if not errors and not any(len(part.starts) for part in parts):
        errors.append(
            f"No window of {settings.length:g} s has {MIN_SAMPLES} samples of the motion; "
            "expected a longer log, or a shorter --window."
        )
    if errors:
        raise BadSetting("\n".join(errors))
    return _join(parts, settings, remarks)


@dataclass(frozen=True, kw_only=True, eq=False)
class _Cut:
    """The windows of one log."""

    commands: Array
    starts: npt.NDArray[np.int64]
    samples: list[tuple[Array, Array]]
    """The times from the start of the window [s] and the motion of each window's samples."""


def name_actuators(log: VehicleLog, model: VehicleModel) -> VehicleLog:
    """Return a log whose commands have the names of the vehicle's thrusters and fins.

    Raises:
        BadSetting: a motor of an autopilot has no channel with a thruster.
    """
    log = name_motors(log, model.motors, model.name)
    names = {"thrusters": model.thrusters, "fins": model.fins}
    series = (part.name_in_order(names.get(part.kind, part.names)) for part in log.commands)
    return replace(log, commands=tuple(series))


def _find_errors(log: VehicleLog, model: VehicleModel, settings: WindowSettings) -> list[str]:
    errors = []
    if log.motion is None or len(log.motion.times) < 2:
        errors.append(f"{log.path}: has no motion; expected poses or twists of the vehicle.")
    series = [part for part in log.commands if part.kind in ("thrusters", "fins")]
    if not series:
        kinds = ", ".join(part.kind for part in log.commands) or "none"
        errors.append(
            f"{log.path}: has no commands of thrusters or fins (commands: {kinds}). Coefficients "
            "follow from forces, which other commands do not give."
        )
    for part in series:
        for name in part.names:
            if name not in model.actuators:
                errors.append(
                    f"{log.path}: {part.kind}.{name} is no actuator of {model.name!r}."
                    f"{choices(name, model.actuators)}"
                )
    if log.duration / settings.step > MAX_STEPS:
        errors.append(f"{log.path}: has {log.duration:g} s; expected shorter logs.")
    return errors


def _cut_log(
    log: VehicleLog, model: VehicleModel, settings: WindowSettings, remarks: list[str]
) -> _Cut:
    assert log.motion is not None
    motion, names = log.motion, [name for part in log.commands for name in part.names]
    if missing_names := [name for name in model.actuators if name not in names]:
        remarks.append(f"{log.path}: no commands of {', '.join(missing_names)}, which count as 0.")
    n_steps = settings.n_steps
    n_all = int(np.ceil(float(motion.times[-1]) / settings.step)) + n_steps + 1
    rows = _convert_motion(motion, model)
    keep = _thin(motion.times, settings.rate)
    times, rows = motion.times[keep], rows[keep]
    starts, samples, n_short = [], [], 0
    first = int(np.floor(times[0] / settings.step))
    while first * settings.step < times[-1]:
        begin = first * settings.step
        sample_indices = np.flatnonzero(
            (times >= begin - 1e-9) & (times <= begin + settings.length + 1e-9)
        )
        usable_indices = sample_indices[np.isfinite(rows[sample_indices]).any(axis=1)]
        if (
            len(usable_indices) >= MIN_SAMPLES
            and times[usable_indices[0]] - begin <= 0.2 * settings.length
        ):
            starts.append(first)
            samples.append((np.maximum(times[usable_indices] - begin, 0.0), rows[usable_indices]))
        elif first * settings.step + settings.length <= times[-1]:
            n_short += 1
        first += n_steps
    if n_short:
        remarks.append(f"{log.path}: {n_short} windows have too few samples and are not used.")
    if len(starts) > MAX_WINDOWS:
        indices = np.linspace(0, len(starts) - 1, MAX_WINDOWS).round().astype(int).tolist()
        remarks.append(f"{log.path}: {MAX_WINDOWS} of {len(starts)} windows are used.")
        starts, samples = [starts[i] for i in indices], [samples[i] for i in indices]
    commands = _average_commands(log.commands, model.actuators, n_all, settings.step)
    return _Cut(commands=commands, starts=np.array(starts, dtype=np.int64), samples=samples)


def _thin(times: Array, rate: float) -> npt.NDArray[np.int64]:
    """Return the indices of samples at most at a rate [Hz]."""
    indices, last_time = [], -np.inf
    for i, time in enumerate(times.tolist()):
        if time - last_time >= (1.0 - 1e-6) / rate:
            indices.append(i)
            last_time = time
    return np.array(indices, dtype=np.int64)


def _convert_motion(motion: MotionSeries, model: VehicleModel) -> Array:
    """Return the motion in W, (n, `N_MOTION`)."""
    pose = model.world_from_localized
    rows = np.full((len(motion.times), N_MOTION), np.nan)
    rows[:, :3] = _rotate_known(pose.rotation, motion.positions) + pose.position
    rows[:, 3:7] = multiply_quaternions(
        np.tile(quaternion_from_rotation(pose.rotation), (len(rows), 1)), motion.quaternions
    )
    if motion.twists is not None:
        rows[:, 7:] = motion.twists
    return level_motion(rows) if model.is_planar else rows


def _rotate_known(rotation: Array, vectors: Array) -> Array:
    """Rotate vectors (n, 3); a component is NaN if it depends on one that is NaN."""
    is_missing = ~np.isfinite(vectors)
    components = rotate_rows(rotation, np.where(is_missing, 0.0, vectors))
    has_gap = (is_missing[:, None, :] & (np.abs(rotation) > 1e-9)).any(axis=2)
    return np.where(has_gap, np.nan, components)


def _average_commands(
    series: Sequence[CommandSeries], actuators: Sequence[str], n_steps: int, step: float
) -> Array:
    """Return the mean command of each actuator in each step; each command holds until the next."""
    commands = np.zeros((n_steps, len(actuators)))
    edges = step * np.arange(n_steps + 1)
    for part in series:
        if part.kind not in ("thrusters", "fins") or not len(part.times):
            continue
        values = np.nan_to_num(part.values)
        spans = np.diff(part.times)
        sums = np.zeros_like(values)  # the integral of each command up to its beginning
        sums[1:] = np.cumsum(values[:-1] * spans[:, None], axis=0)
        row = np.searchsorted(part.times, edges, side="right") - 1
        held_rows = np.maximum(row, 0)
        integral = sums[held_rows] + values[held_rows] * (edges - part.times[held_rows])[:, None]
        integral[row < 0] = 0.0
        means = np.diff(integral, axis=0) / step
        for k, name in enumerate(part.names):
            if name in actuators:
                commands[:, actuators.index(name)] = means[:, k]
    return commands


def _join(parts: Sequence[_Cut], settings: WindowSettings, remarks: Sequence[str]) -> Windows:
    n = sum(len(part.starts) for part in parts)
    n_samples = max(len(times) for part in parts for times, _ in part.samples)
    samples = np.full((n, n_samples, N_MOTION), np.nan)
    index, fraction = np.zeros((n, n_samples), dtype=np.int64), np.zeros((n, n_samples))
    logs, starts, commands, initial_rows = [], [], [], []
    row = 0
    for number, part in enumerate(parts):
        for start, (times, rows) in zip(part.starts.tolist(), part.samples, strict=True):
            place = times / settings.step
            previous_steps = np.minimum(place.astype(np.int64), settings.n_steps - 1)
            samples[row, : len(times)] = rows
            index[row, : len(times)], fraction[row, : len(times)] = (
                previous_steps,
                place - previous_steps,
            )
            logs.append(number)
            starts.append(start * settings.step)
            commands.append(part.commands[start : start + settings.n_steps])
            initial_rows.append(guess_initial(times, rows))
            row += 1
    grids = tuple(LogGrid(commands=part.commands, starts=part.starts) for part in parts)
    return Windows(
        settings=settings,
        grids=grids,
        logs=np.array(logs, dtype=np.int64),
        times=np.array(starts),
        commands=np.array(commands),
        samples=samples,
        index=index,
        fraction=fraction,
        initial_motion=np.array(initial_rows),
        remarks=tuple(remarks),
    )


def guess_initial(times: Array, rows: Array) -> Array:
    """Return the motion at the start of a window by its first samples, (`N_MOTION`,).

    The velocity is measured, or the difference of the first positions. Values that are not measured
    are 0, and the attitude is level.

    Args:
        times: the times of the samples from the start of the window, (n,) [s].
        rows: their motion, (n, `N_MOTION`).
    """
    motion = rows[0].copy()
    if not np.isfinite(motion[3:7]).all():
        motion[3:7] = 1.0, 0.0, 0.0, 0.0
    span = float(times[1] - times[0])
    if not np.isfinite(motion[7:10]).any() and np.isfinite(rows[:2, :3]).all():
        conjugate = motion[3:7] * np.array([1.0, -1.0, -1.0, -1.0])
        velocity = ((rows[1, :3] - rows[0, :3]) / span)[None]
        motion[7:10] = rotate_vectors(conjugate[None], velocity)[0]
    motion = np.where(np.isfinite(motion), motion, 0.0)
    velocity = rotate_vectors(motion[None, 3:7], motion[None, 7:10])[0]
    motion[:3] -= float(times[0]) * velocity
    return motion
