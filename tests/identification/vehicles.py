"""A simulated log and vehicles for the tests of identification, made once in a test process."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache

import numpy as np

from uwsim.identification import VehicleModel, make_scene, open_vehicle
from uwsim.identification.parameters import apply_values, choose_parameters
from uwsim.identification.simulated_log import Excitation, simulate_log
from uwsim.logs import CommandSeries, MotionSeries, VehicleLog

ALL_AXES = (0.4, 0.4, 0.35, 0.012, 0.012, 0.06)
NO_YAW = (0.4, 0.0, 0.35, 0.0, 0.012, 0.0)


@cache
def log_of(amplitudes: tuple[float, ...] = ALL_AXES, duration: float = 40.0) -> VehicleLog:
    """Return the log of a BlueROV2 that the full engine has simulated."""
    excitation = Excitation(duration=duration, amplitudes=amplitudes)
    return simulate_log(make_scene("bluerov2_heavy"), seed=3, excitation=excitation)


@cache
def bluerov2() -> VehicleModel:
    """Return the BlueROV2 with its true coefficients."""
    return open_vehicle(make_scene("bluerov2_heavy"))


def spoil_guess(factors: Mapping[str, float]) -> VehicleModel:
    """Return the BlueROV2 with a first guess that is wrong by factors."""
    model = bluerov2()
    parameters = choose_parameters(tuple(factors), model)
    values = [p.first_guess * factors[p.name] for p in parameters]
    return replace(model, numbers=apply_values(model, parameters, np.array(values)).vehicle)


def small_log(**changes: object) -> VehicleLog:
    """Return a log at rest of 4 s, with commands of one thruster."""
    times = np.arange(0.0, 4.01, 0.1)
    n = len(times)
    motion = MotionSeries(
        times=times,
        positions=np.zeros((n, 3)),
        quaternions=np.tile([1.0, 0.0, 0.0, 0.0], (n, 1)),
        twists=np.zeros((n, 6)),
    )
    commands = CommandSeries(
        kind="thrusters",
        names=("bow_port",),
        times=np.array([0.5, 1.25]),
        values=np.array([[1.0], [-0.5]]),
    )
    log = VehicleLog(
        path="small.csv", format="csv", sha256="ab" * 32, vehicle="", motion=motion,
        commands=(commands,),
    )  # fmt: skip
    return replace(log, **changes)
