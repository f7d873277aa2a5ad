"""The identification of a vehicle: from logs to coefficients with intervals and validation."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType

import numpy as np

from ..base.geometry import Array
from ..base.rng import stream
from ..errors import BadSetting
from ..logs import VehicleLog
from .excitation import AxisExcitation, give_advice, measure_excitation
from .least_squares import Loss, Solution, linearise, minimise
from .model_check import ModelCheck, check_model
from .noise import (
    MAX_CHANGE,
    count_free_measurements,
    first_noise,
    measured_noise,
    residual_noise,
)
from .noise_information import measure_noise_information
from .parameters import Parameter, apply_values, choose_parameters
from .planar import has_vertical_motion, hold_vertical
from .readings import rank_readings
from .residuals import N_CHANNELS, Fit, Residuals
from .uncertainty import Uncertainty, compute_uncertainty
from .validation import HorizonError, compare_horizons, simulate_errors, split_folds
from .vehicle_model import VehicleModel
from .windows import Windows, WindowSettings, cut_windows, name_actuators

COARSE_STEP = 0.02
"""The step of the simulation far from the minimum [s]; that of the settings is used near it."""
START_FACTOR = 3.0
"""The factor by which further starts differ from the first guess."""
START_ITERATIONS, FOLD_ITERATIONS = 12, 6
"""The greatest number of iterations of a further start, and of a fold."""
MAX_START_WINDOWS = 20
"""The number of windows that the starts use."""
NOISE_ROUNDS = 3
"""The greatest number of times that the noise is estimated."""
SAME_COST = 1e-3
"""The relative difference of sums of squares up to which two starts reach the same minimum."""


@dataclass(frozen=True, kw_only=True)
class IdentifySettings:
    """The settings of an identification."""

    free_names: tuple[str, ...]
    """The names of coefficients and groups."""
    windows: WindowSettings = field(default_factory=WindowSettings)
    """The lengths of windows, steps and samples."""
    n_starts: int = 4
    """The number of starts."""
    n_folds: int = 4
    """The number of folds of the cross-validation; less than 2: none."""
    loss: Loss = "linear"
    """The loss."""
    noise: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    """The noise that is given, by group of channels."""
    seed: int = 0
    """The seed of the starts."""
    is_planar: bool | None = None
    """The planar mode for surface craft; None: for logs without depth and heave."""

    @property
    def n_pieces(self) -> int:
        """The number of pieces of work, of which the progress tells."""
        return self.n_starts + 2 + (self.n_folds if self.n_folds > 1 else 0)


@dataclass(frozen=True, kw_only=True, eq=False)
class Identification:
    """The result of an identification."""

    model: VehicleModel
    """The vehicle with its first guess."""
    settings: IdentifySettings
    """The settings."""
    logs: tuple[VehicleLog, ...]
    """The logs."""
    windows: Windows
    """The windows."""
    uncertainty: Uncertainty
    """The coefficients with their intervals and correlations."""
    noise: Array
    """The noise of each channel, (12,)."""
    chi_squared: float
    """The sum of squared residuals per measurement."""
    n_same_minimum: int
    """The number of starts that reach the same minimum."""
    n_unfinished: int
    """The number of further starts that were above it after `START_ITERATIONS`."""
    excitation: tuple[AxisExcitation, ...]
    """The excitation of each axis."""
    advice: tuple[str, ...]
    """The advice on further experiments."""
    check: ModelCheck
    """The check whether the model explains the logs."""
    horizons: tuple[HorizonError, ...]
    """The errors of windows that were held out; empty without a cross-validation."""
    first_errors: Array
    """The measured minus the simulated motion with the first guess, (windows, samples, 12)."""
    held_out_errors: Array
    """The same with coefficients that were fitted to other windows, or to all without folds."""

    @property
    def values(self) -> Array:
        """The coefficients, (p,)."""
        return np.array([estimate.value for estimate in self.uncertainty.estimates])

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The coefficients that were fitted."""
        return tuple(estimate.parameter for estimate in self.uncertainty.estimates)


class Counter:
    """The progress of an identification: done and all pieces of work."""

    def __init__(self, total: int, on_progress: Callable[[int, int], object] | None) -> None:
        self._total, self._n_done, self._on_progress = total, 0, on_progress

    def count(self) -> None:
        """Count a piece of work."""
        self._n_done += 1
        if self._on_progress is not None:
            self._on_progress(self._n_done, self._total)


def identify(
    logs: Sequence[VehicleLog],
    model: VehicleModel,
    settings: IdentifySettings,
    *,
    on_progress: Callable[[int, int], object] | None = None,
) -> Identification:
    """Fit coefficients of a vehicle to logs.

    Args:
        logs: the logs.
        model: the vehicle with its first guess.
        settings: the settings.
        on_progress: a function that is called with the number of finished and of all pieces.

    Raises:
        BadSetting: a name of a coefficient, a log or a setting is invalid; with every error.
    """
    _check_logs(logs)
    logs = [name_actuators(log, model) for log in logs]
    model, remarks = _choose_mode(logs, model, settings)
    parameters = choose_parameters(settings.free_names, model)
    windows = cut_windows(logs, model, settings.windows)
    windows = replace(windows, remarks=(*remarks, *windows.remarks))
    coarse_settings = replace(settings.windows, step=max(COARSE_STEP, settings.windows.step))
    coarse_residuals = Residuals(model, parameters, cut_windows(logs, model, coarse_settings))
    rows = np.linspace(0, len(windows) - 1, min(len(windows), MAX_START_WINDOWS)).round()
    start_residuals = Residuals(
        model, parameters, coarse_residuals.windows.select(rows.astype(int).tolist())
    )
    fine_residuals = Residuals(model, parameters, windows)
    counter = Counter(settings.n_pieces, on_progress)
    starts, noise = _search(start_residuals, settings, counter)
    best_start = min(starts, key=lambda solution: solution.cost)
    n_same = sum(solution.cost <= (1.0 + SAME_COST) * best_start.cost for solution in starts)
    n_unfinished = sum(
        not solution.is_converged and solution.cost > (1.0 + SAME_COST) * best_start.cost
        for solution in starts
    )
    solution, noise = _refine(fine_residuals, best_start.fit.values, noise, settings)
    counter.count()
    clean_noise = measured_noise(windows, settings.noise)
    excitation = measure_excitation(windows, clean_noise)
    uncertainty = _measure_uncertainty(fine_residuals, solution.fit, noise, settings, excitation)
    counter.count()
    first_errors = simulate_errors(fine_residuals, fine_residuals.start().values)
    held_out = _validate(coarse_residuals, fine_residuals, solution.fit, noise, settings, counter)
    horizons = compare_horizons(windows, first_errors, held_out) if settings.n_folds > 1 else ()
    rows = fine_residuals.compute(solution.fit, 1.0 / noise)
    values = solution.fit.values
    check = check_model(
        model,
        windows,
        apply_values(model, parameters, values),
        residual_noise=residual_noise(fine_residuals, rows, noise, {}),
        measured_noise=clean_noise,
        horizons=horizons,
        readings=rank_readings(coarse_residuals, logs, values, clean_noise, settings.loss),
    )
    return Identification(
        model=model,
        settings=settings,
        logs=tuple(logs),
        windows=windows,
        uncertainty=uncertainty,
        noise=noise,
        chi_squared=float((rows * rows).sum() / max(np.count_nonzero(rows), 1)),
        n_same_minimum=n_same,
        n_unfinished=n_unfinished,
        excitation=excitation,
        advice=give_advice(excitation, uncertainty.estimates, uncertainty.weak_directions),
        check=check,
        horizons=horizons,
        first_errors=first_errors,
        held_out_errors=held_out,
    )


def _check_logs(logs: Sequence[VehicleLog]) -> None:
    """Raise BadSetting for logs with the same content, which would count twice."""
    names: dict[str, str] = {}
    errors = []
    for log in logs:
        if log.sha256 and log.sha256 in names:
            errors.append(
                f"{log.path}: has the same content as {names[log.sha256]}; give each log once."
            )
        names.setdefault(log.sha256, log.path)
    if errors:
        raise BadSetting("\n".join(errors))


def _choose_mode(
    logs: Sequence[VehicleLog], model: VehicleModel, settings: IdentifySettings
) -> tuple[VehicleModel, tuple[str, ...]]:
    """Return the vehicle of the planar mode, or as it is, and remarks."""
    is_planar = settings.is_planar
    if is_planar is None:
        is_planar = not has_vertical_motion(logs)
    if not is_planar:
        return model, ()
    reason = (
        ""
        if settings.is_planar
        else "The logs have neither depth nor heave, or constants in their place. "
    )
    remark = f"{reason}Planar mode: heave, roll and pitch are held."
    return hold_vertical(model), (remark,)


def _search(
    residuals: Residuals, settings: IdentifySettings, counter: Counter
) -> tuple[list[Solution], Array]:
    """Return the minima from all starts with one noise, which the first start gives."""
    if settings.n_starts < 1:
        raise BadSetting(f"--starts is {settings.n_starts}; expected 1 or more.")
    noise = first_noise(residuals, settings.noise)
    solution = minimise(residuals, residuals.start(), 1.0 / noise, loss=settings.loss)
    rows = residuals.compute(solution.fit, 1.0 / noise)
    noise = residual_noise(residuals, rows, noise, settings.noise)
    solutions = [minimise(residuals, solution.fit, 1.0 / noise, loss=settings.loss)]
    counter.count()
    for number in range(1, settings.n_starts):
        start = _draw_start(residuals, settings.seed, number)
        solutions.append(
            minimise(
                residuals,
                start,
                1.0 / noise,
                loss=settings.loss,
                max_iterations=START_ITERATIONS,
            )
        )
        counter.count()
    return solutions, noise


def _draw_start(residuals: Residuals, seed: int, number: int) -> Fit:
    """Return a start far from the first guess, within the bounds of all coefficients."""
    generator = stream(seed, f"identification/start/{number}")
    values = []
    for parameter in residuals.parameters:
        draw = float(generator.uniform(-1.0, 1.0))
        guess, error = parameter.first_guess, parameter.plausible_error
        if guess > 0.0 and error >= 0.25 * guess:
            value = guess * START_FACTOR**draw
        else:
            value = guess + draw * error
        values.append(min(max(value, parameter.minimum), parameter.maximum))
    return Fit(values=np.array(values), offsets=np.zeros((len(residuals.windows), N_CHANNELS)))


def _refine(
    residuals: Residuals, values: Array, noise: Array, settings: IdentifySettings
) -> tuple[Solution, Array]:
    """Return the minimum and the noise, which are estimated in turns."""
    fit = Fit(values=values, offsets=residuals.start().offsets)
    for _ in range(NOISE_ROUNDS):
        solution = minimise(residuals, fit, 1.0 / noise, loss=settings.loss)
        fit = solution.fit
        rows = residuals.compute(fit, 1.0 / noise)
        new_noise = residual_noise(residuals, rows, noise, settings.noise)
        change = float(np.abs(new_noise / noise - 1.0).max())
        if change <= MAX_CHANGE:
            break
        noise = new_noise
    return solution, noise


def _measure_uncertainty(
    residuals: Residuals,
    fit: Fit,
    noise: Array,
    settings: IdentifySettings,
    excitation: Sequence[AxisExcitation],
) -> Uncertainty:
    problem = linearise(residuals, fit, 1.0 / noise, settings.loss)
    return compute_uncertainty(
        problem,
        residuals.parameters,
        fit.values,
        noise_information=measure_noise_information(
            residuals, fit, problem, 1.0 / noise, settings.loss, seed=settings.seed
        ),
        n_measurements=count_free_measurements(residuals, settings.noise),
        idle_axes=[row.axis for row in excitation if not row.is_excited],
    )


def _validate(
    coarse_residuals: Residuals,
    fine_residuals: Residuals,
    fit: Fit,
    noise: Array,
    settings: IdentifySettings,
    counter: Counter,
) -> Array:
    """Return the errors of all windows with coefficients that were fitted to other windows.

    Without folds, the coefficients are those of all windows.
    """
    errors = simulate_errors(fine_residuals, fit.values)
    if settings.n_folds < 2 or len(fine_residuals.windows) < 2:
        return errors
    n = len(coarse_residuals.windows)
    for fold in split_folds(n, settings.n_folds):
        other_rows = [i for i in range(n) if i not in set(fold)]
        part = Residuals(
            fine_residuals.model,
            fine_residuals.parameters,
            coarse_residuals.windows.select(other_rows),
        )
        start = Fit(values=fit.values, offsets=fit.offsets[other_rows])
        solution = minimise(
            part, start, 1.0 / noise, loss=settings.loss, max_iterations=FOLD_ITERATIONS
        )
        held_out = Residuals(
            fine_residuals.model, fine_residuals.parameters, fine_residuals.windows.select(fold)
        )
        errors[fold] = simulate_errors(held_out, solution.fit.values)
        counter.count()
    return errors
