"""The measurement of the gap between a log and a simulation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path

import numpy as np

from ..base.geometry import Array
from ..devices.ardupilot import ArduPilotSpec, thrusters_of
from ..errors import BadSetting
from ..logs import VehicleLog, name_motors
from ..model.body_names import vehicle_body
from ..model.scene_model import SceneModel
from ..physics.compile_scene import compile_scene
from ..scene.spec import SceneSpec
from ..simulation import Simulation
from .attribution import Attribution, attribute_residual
from .coefficients import (
    LAG_KEY,
    Coefficient,
    describe_clock,
    list_coefficients,
    scale_coefficient,
)
from .errors import HorizonError, choose_main_horizon, summarize_horizon
from .gap import Gap
from .log_motion import LogMotion, read_motion, relative_motion
from .residuals import StepResiduals, choose_steps, measure_residuals
from .sensor_residuals import SensorComparison, SensorResidual, describe_offsets
from .settings import GapSettings
from .vehicle_commands import VehicleCommands, shift_commands
from .vehicle_run import VehicleRun, check_ground, choose_vehicle
from .windows import Windows, choose_windows

N_CURVE = 80
"""The number of points of the curves of the error over the horizon."""
N_REFINED_RUNS = 9
"""The usual number of runs of the windows for refined factors, for the progress."""
MAX_TRACKS = 40
"""The greatest number of windows whose tracks are kept."""
AUTOPILOT_FORMATS = ("bin", "tlog")
"""The formats whose frames are north-east-down always."""

Progress = Callable[[str, int], AbstractContextManager[Callable[[], None]]]
"""A function that yields a function to call after each run, for a title and a number of runs."""


def measure_gap(
    log: VehicleLog,
    model: SceneModel,
    *,
    vehicle: str | None = None,
    settings: GapSettings | None = None,
    progress: Progress | None = None,
) -> Gap:
    """Simulate the commands of a log from its states, window by window, and compare.

    Args:
        log: the log, with a motion and commands.
        model: the scene.
        vehicle: the name of the vehicle in the scene; None: the only one with dynamics.
        settings: the settings; None: the defaults.
        progress: shows the progress.

    Raises:
        UwsimError: the log lacks a motion or commands, or does not fit the vehicle.
    """
    settings = settings or GapSettings()
    return _Measurement(log, model, vehicle, settings, progress).run()


class _Measurement:
    """One measurement of the gap."""

    def __init__(
        self,
        log: VehicleLog,
        model: SceneModel,
        vehicle: str | None,
        settings: GapSettings,
        progress: Progress | None,
    ) -> None:
        self._log, self._settings, self._model = log, settings, model
        self._progress: Progress = progress or (lambda title, total: nullcontext(lambda: None))
        self._remarks = list(log.remarks)
        self._motion = read_motion(log)
        self._scene = model.source
        self._index = choose_vehicle(self._model, log, vehicle)
        self._name = self._model.scene.vehicles[self._index].name
        _check_frame(log, self._model)
        ocean = self._model.scene.ocean_state
        if ocean.waves or ocean.currents:
            self._remarks.append(
                "the scene has waves or currents; each window begins at their time 0."
            )
        devices = self._model.scene.vehicles[self._index].parts_of(ArduPilotSpec)
        self._log = name_motors(log, thrusters_of(devices), self._name)
        self._command_kinds: tuple[str, ...] = ()

    def run(self) -> Gap:
        """Measure the gap."""
        settings = self._settings
        with self._open(self._model) as run:
            commands = run.commands
            self._command_kinds = commands.kinds
            windows = choose_windows(
                self._motion, commands.start, commands.end, settings.horizons, settings.n_windows
            )
            check_ground(self._model, self._motion, windows.starts)
            self._remark_gaps(windows)
            horizons, curves, errors = self._compare(run, windows)
            tracks = self._draw_tracks(run, windows, horizons)
            residuals = self._measure_residuals(run)
        sensors = self._compare_sensors(windows)
        self._remarks += describe_offsets(sensors)
        attribution = self._attribute(windows) if settings.has_attribution else None
        curve_times, curve_values = curves
        return Gap(
            log=self._log,
            scene=Path(self._scene.path).stem,
            scene_digest=self._model.digest,
            vehicle=self._name,
            settings=settings,
            command_kinds=commands.kinds,
            windows=windows,
            radius=self._radius(),
            horizons=horizons,
            curve_times=curve_times,
            curves=curve_values,
            window_errors=errors,
            tracks=tracks,
            residuals=residuals,
            sensors=sensors,
            attribution=attribution,
            points_down=_points_down(self._model),
            is_planar=self._motion.is_planar,
            remarks=tuple(self._remarks),
        )

    def _remark_gaps(self, windows: Windows) -> None:
        """State the samples and the windows that are left out, and a planar motion."""
        if self._motion.is_planar:
            self._remarks.append(
                "the log has one depth, and no roll or pitch; the simulated vehicle keeps them, "
                "and the gap is that of surge, sway and yaw."
            )
        if self._motion.n_left_out:
            self._remarks.append(
                f"motion: {self._motion.n_left_out} of {self._motion.n_samples} samples without a "
                "whole position or twist; windows that touch them are left out."
            )
        if windows.n_left_out:
            self._remarks.append(f"windows that touch a gap, left out: {windows.n_left_out}.")

    def _compile(self, scene: SceneSpec) -> SceneModel:
        """Compile a variant of the scene."""
        model = self._model
        return compile_scene(
            scene,
            seed=model.seed,
            timestep=model.timestep,
            data_path=model.data_path,
            compatibility=model.compatibility,
        )

    def _open(self, model: SceneModel, shift: float = 0.0) -> _OpenRun:
        return _OpenRun(model, shift_commands(self._log, shift), self._index, self._motion)

    def _compare(
        self, run: VehicleRun, windows: Windows
    ) -> tuple[tuple[HorizonError, ...], tuple[Array, Array], dict[float, Array]]:
        horizons = [h for h in self._settings.horizons if len(windows.fits[h]) >= 2]
        for horizon in self._settings.horizons:
            if horizon not in horizons:
                self._remarks.append(
                    f"horizon {horizon:g} s: the log has fewer than two windows of that length."
                )
        grid: Array = np.arange(1, N_CURVE + 1, dtype=np.float64) * (horizons[-1] / N_CURVE)
        errors: dict[float, list[Array]] = {horizon: [] for horizon in horizons}
        ends: dict[float, list[tuple[Array, Array, float]]] = {h: [] for h in horizons}
        squares, counts = np.zeros((len(grid), 6)), np.zeros(len(grid))
        with self._progress("windows", len(windows.starts)) as on_window:
            for index, start in enumerate(windows.starts.tolist()):
                max_horizon = max(h for h in horizons if index in windows.fits[h])
                window_horizons = [h for h in horizons if h <= max_horizon]
                offsets = sorted({*window_horizons, *grid[grid <= max_horizon + 1e-9].tolist()})
                error, predictions, measurements = self._run_window(run, start, offsets)
                for horizon in window_horizons:
                    row = offsets.index(horizon)
                    errors[horizon].append(error[row])
                    path_length = self._motion.path_length(start, start + horizon)
                    ends[horizon].append((predictions[row], measurements[row], path_length))
                rows = [offsets.index(time) for time in grid[grid <= max_horizon + 1e-9].tolist()]
                squares[: len(rows)] += error[rows] ** 2
                counts[: len(rows)] += 1
                on_window()
        summaries = tuple(
            summarize_horizon(
                horizon,
                np.array(errors[horizon]),
                np.array([row[0] for row in ends[horizon]]),
                np.array([row[1] for row in ends[horizon]]),
                np.array([row[2] for row in ends[horizon]]),
                block=windows.block_length(horizon),
                seed=self._settings.seed,
            )
            for horizon in horizons
        )
        curves: Array = np.sqrt(squares / np.maximum(counts, 1)[:, None])
        return summaries, (grid, curves), {h: np.array(rows) for h, rows in errors.items()}

    def _run_window(
        self, run: VehicleRun, start: float, offsets: Sequence[float]
    ) -> tuple[Array, Array, Array]:
        """Return the errors and the simulated and measured displacements, each (n, 6)."""
        motion = self._motion
        predictions = run.run(start, offsets)
        times, begin = start + np.array(offsets), np.full(len(offsets), start)
        positions, quaternions = motion.positions(times), motion.quaternions(times)
        error = relative_motion(
            predictions.positions, predictions.quaternions, positions, quaternions
        )
        first = motion.positions(begin), motion.quaternions(begin)
        return (
            error,
            relative_motion(predictions.positions, predictions.quaternions, *first),
            relative_motion(positions, quaternions, *first),
        )

    def _draw_tracks(
        self, run: VehicleRun, windows: Windows, horizons: Sequence[HorizonError]
    ) -> tuple[tuple[Array, Array], ...]:
        horizon = choose_main_horizon(horizons).horizon
        offsets = np.arange(0.0, horizon + 1e-9, max(0.1, horizon / 50.0))
        tracks: list[tuple[Array, Array]] = []
        end = -np.inf
        for index in windows.fits[horizon]:
            start = float(windows.starts[index])
            if start >= end - 1e-6 and len(tracks) < MAX_TRACKS:
                end = start + horizon
                simulated_motion = run.run(start, offsets.tolist())
                tracks.append((self._motion.positions(start + offsets), simulated_motion.positions))
        return tuple(tracks)

    def _measure_residuals(self, run: VehicleRun) -> StepResiduals | None:
        commands = run.commands
        times, _ = choose_steps(self._motion, commands.start, commands.end)
        with self._progress("one-step residuals", len(times)) as on_step:
            return measure_residuals(run, commands.start, commands.end, on_step)

    def _compare_sensors(self, windows: Windows) -> tuple[SensorResidual, ...]:
        if not self._log.sensors:
            return ()
        with Simulation(self._model, is_blind=True) as simulation:
            comparison = SensorComparison(simulation, self._log.sensors, self._name)
            if comparison.is_empty:
                self._remarks.append("no sensor of the log has a counterpart in the scene.")
                return ()
            run = self._make_run(simulation)
            with self._progress("sensors", len(windows.starts)) as on_window:
                return comparison.compare_windows(
                    run, windows, self._settings.horizons[0], on_window
                )

    def _make_run(self, simulation: Simulation) -> VehicleRun:
        return make_run(simulation, self._log, self._index, self._motion)

    def _attribute(self, windows: Windows) -> Attribution:
        dynamics = self._model.dynamics[self._index]
        root = self._model.robots[self._index].root
        coefficients = [
            *self._list_measurable(list_coefficients(dynamics, root)),
            *(describe_clock(kind) for kind in self._command_kinds[:1]),
        ]
        horizon = self._settings.horizons[0]
        weights = np.array([1.0] * 3 + [self._radius()] * 3)
        ends = windows.starts + horizon
        measurements = self._motion.twists(ends) * weights

        def run_windows(changes: Sequence[tuple[Coefficient, float]]) -> Array:
            new_dynamics = dynamics
            for coefficient, factor in changes:
                new_dynamics = coefficient.change(new_dynamics, factor)
            scene = scale_coefficient(self._scene, self._index, dynamics, new_dynamics)
            model = self._model if new_dynamics is dynamics else self._compile(scene)
            shift = sum(factor - 1.0 for coefficient, factor in changes if coefficient.is_clock)
            with self._open(model, shift) as run:
                twists = [run.run(start, [horizon]).twists[0] for start in windows.starts.tolist()]
            velocities: Array = np.array(twists) * weights
            return velocities

        with self._progress("attribution", len(coefficients) + N_REFINED_RUNS) as on_run:
            return attribute_residual(
                measurements,
                coefficients,
                run_windows,
                duration=horizon,
                block=windows.block_length(horizon),
                seed=self._settings.seed,
                on_run=on_run,
            )

    def _list_measurable(self, coefficients: list[Coefficient]) -> list[Coefficient]:
        """Return the coefficients that commands of the log's interval can measure."""
        interval = next((part.interval for part in self._log.commands), 0.0)
        thrusters = self._model.dynamics[self._index].thrusters
        lag = max((thruster.time_constant for thruster in thrusters), default=0.0)
        is_sampled = any(part.sample_interval is not None for part in self._log.commands)
        if not is_sampled or interval <= lag or lag <= 0.0:
            return coefficients
        self._remarks.append(
            f"commands at {1.0 / interval:.3g} Hz, lag of the thrusters {lag:.3g} s: the log "
            "cannot measure the lag. Between samples, the commands are interpolated."
        )
        return [coefficient for coefficient in coefficients if coefficient.key != LAG_KEY]

    def _radius(self) -> float:
        """Return the root mean square of the radii of gyration about the base's axes [m]."""
        model = self._model.engine_model
        body = model.body(vehicle_body(self._index, self._model.robots[self._index].root)).id
        mass, inertia = float(model.body_mass[body]), model.body_inertia[body]
        return float(np.sqrt(float(inertia.sum()) / (3.0 * mass)))


class _OpenRun:
    """A simulation that is closed after a block."""

    def __init__(self, model: SceneModel, log: VehicleLog, index: int, motion: LogMotion) -> None:
        self._simulation = Simulation(model, is_blind=True)
        self._arguments = (log, index, motion)

    def __enter__(self) -> VehicleRun:
        return make_run(self._simulation, *self._arguments)

    def __exit__(self, *arguments: object) -> None:
        self._simulation.close()


def make_run(simulation: Simulation, log: VehicleLog, index: int, motion: LogMotion) -> VehicleRun:
    """Return the vehicle of a simulation with the commands of a log."""
    model = simulation.world.model
    vehicle = simulation.world.vehicles[index]
    lags = [thruster.time_constant for thruster in model.dynamics[index].thrusters]
    commands = VehicleCommands(log, vehicle, lags)
    return VehicleRun(simulation, vehicle.name, motion, commands)


def _check_frame(log: VehicleLog, model: SceneModel) -> None:
    if log.format in AUTOPILOT_FORMATS and not _points_down(model):
        raise BadSetting(
            f"{log.path} has the frame north-east-down, but z of the scene's frame L does not "
            "point down. Set <offsetr> of <simParams> to M_PI, 0, -M_PI_2."
        )


def _points_down(model: SceneModel) -> bool:
    return float(model.scene.world_from_localized.rotation[2, 2]) < -0.99
