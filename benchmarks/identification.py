"""The accuracy of ``uwsim identify``: many simulated logs, each with its own commands and noise.

For each coefficient: the root mean square error and the share of runs in which it is within 5 % or
its 95 % interval covers the truth; and the share of intervals that cover it. The first guess is
wrong by up to a factor of 2.

    python benchmarks/identification.py 50 --vehicle bluerov2_heavy
    python benchmarks/identification.py 50 --motion rest
    python benchmarks/identification.py 50 --motion one

With ``--motion``, the vehicle rests, or moves along one axis by turns. Of the coefficients that
are called determined, at least 90 % of the intervals must cover the truth.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass, replace

import numpy as np

from uwsim.base.rng import stream
from uwsim.identification import (
    IdentifySettings,
    VehicleModel,
    WindowSettings,
    identify,
    make_scene,
    open_vehicle,
)
from uwsim.identification.hydrodynamics_file import MATRIX_FIELDS
from uwsim.identification.parameters import apply_values, choose_parameters
from uwsim.identification.simulated_log import (
    Excitation,
    LogNoise,
    simulate_free_log,
    simulate_log,
)
from uwsim.physics.hydrodynamics import columns

NAMES = ("added_mass", "drag", "thrust")
MAX_FACTOR = 2.0
"""The greatest ratio of a first guess and the truth."""
CLOSE = 0.05
"""The relative error of a coefficient that counts as close."""


@dataclass(frozen=True)
class Run:
    """The errors of one run."""

    errors: np.ndarray
    """The relative errors, (p,)."""
    is_covered: np.ndarray
    """The flags of intervals that cover the truth, (p,)."""
    seconds: float
    """The time of the fit [s]."""


def spoil(model: VehicleModel, seed: int) -> VehicleModel:
    """Return a vehicle whose matrices are wrong by random factors."""
    parameters = choose_parameters(MATRIX_FIELDS, model)
    generator = stream(seed, "benchmark/first guess")
    factors = MAX_FACTOR ** generator.uniform(-1.0, 1.0, len(parameters))
    values = np.array([parameter.first_guess for parameter in parameters]) * factors
    return replace(model, numbers=apply_values(model, parameters, values).vehicle)


def run(vehicle: str, seed: int, duration: float) -> tuple[list[str], Run]:
    """Simulate a log, fit, and compare with the truth."""
    scene = make_scene(vehicle)
    truth = open_vehicle(scene)
    log = simulate_log(scene, seed=seed, excitation=Excitation(duration=duration))
    true_values = {p.name: p.first_guess for p in choose_parameters(NAMES, truth)}
    settings = IdentifySettings(free_names=NAMES, n_starts=1, n_folds=0, seed=seed)
    start = time.perf_counter()
    result = identify([log], spoil(truth, seed), settings)
    seconds = time.perf_counter() - start
    names = [e.parameter.name for e in result.uncertainty.estimates]
    values = np.array([true_values[name] for name in names])
    low = np.array([e.low for e in result.uncertainty.estimates])
    high = np.array([e.high for e in result.uncertainty.estimates])
    errors = result.values / values - 1.0
    return names, Run(errors, (low <= values) & (values <= high), seconds)


AMPLITUDES = (0.4, 0.4, 0.35, 0.05, 0.05, 0.06)
"""The commands along the axis that moves."""
IDLE_NAMES = ("added_mass", "drag")


def cover_idle(vehicle: str, seed: int, motion: str) -> dict[str, bool]:
    """Return whether the interval of each coefficient that is determined covers the truth."""
    truth = open_vehicle(make_scene(vehicle))
    truth.numbers.bodies[truth.part, columns.DISPLACED_MASS] = truth.numbers.rigid_body[0]
    moving_axis = seed % len(AMPLITUDES) if motion == "one" else None
    amplitudes = [a if i == moving_axis else 0.0 for i, a in enumerate(AMPLITUDES)]
    excitation = Excitation(duration=60.0, amplitudes=tuple(amplitudes))
    noise = LogNoise(position=0.005, attitude=0.003, velocity=0.01, angular_velocity=0.002)
    log = simulate_free_log(truth, seed=seed, excitation=excitation, noise=noise)
    names = (*IDLE_NAMES, "buoyancy") if motion == "rest" else IDLE_NAMES
    settings = IdentifySettings(
        free_names=names, windows=WindowSettings(step=0.01), n_starts=1, n_folds=0, seed=seed
    )
    true_values = {p.name: p.first_guess for p in choose_parameters(names, truth)}
    estimates = identify([log], spoil(truth, seed), settings).uncertainty.estimates
    return {
        e.parameter.name: e.low <= true_values[e.parameter.name] <= e.high
        for e in estimates
        if e.is_determined
    }


def print_idle(vehicle: str, n: int, motion: str) -> None:
    """Print the share of intervals of determined coefficients that cover the truth."""
    flags: list[bool] = []
    for seed in range(n):
        row = cover_idle(vehicle, seed, motion)
        flags += row.values()
        print(f"seed {seed}: {len(row)} determined, {sum(row.values())} covered", flush=True)
    share = f"{np.mean(flags):.1%}" if flags else "no coefficient determined"
    print(f"{motion}: {sum(flags)} of {len(flags)} intervals cover the truth: {share}")


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("n", type=int, help="number of runs")
    parser.add_argument("--vehicle", default="bluerov2_heavy")
    parser.add_argument("--duration", type=float, default=120.0)
    parser.add_argument("--motion", choices=("all", "rest", "one"), default="all")
    arguments = parser.parse_args()
    if arguments.motion != "all":
        print_idle(arguments.vehicle, arguments.n, arguments.motion)
        return
    runs: list[Run] = []
    for seed in range(arguments.n):
        names, row = run(arguments.vehicle, seed, arguments.duration)
        runs.append(row)
        print(
            f"seed {seed}: worst error {100 * np.abs(row.errors).max():.2f} %, "
            f"{row.is_covered.mean():.0%} covered, {row.seconds:.1f} s",
            flush=True,
        )
    errors = np.array([row.errors for row in runs])
    is_covered = np.array([row.is_covered for row in runs])
    print(f"{'coefficient':28} {'rms error':>9} {'worst':>7} {'covered':>8} {'met':>6}")
    for i, name in enumerate(names):
        success_rate = ((np.abs(errors[:, i]) <= CLOSE) | is_covered[:, i]).mean()
        print(
            f"{name:28} {100 * np.sqrt((errors[:, i] ** 2).mean()):8.2f}% "
            f"{100 * np.abs(errors[:, i]).max():6.2f}% {is_covered[:, i].mean():8.0%} "
            f"{success_rate:6.0%}"
        )
    print(f"covered over all: {is_covered.mean():.1%} of {is_covered.size} intervals")


if __name__ == "__main__":
    main()
