"""The run of a manoeuvre: a simulation with an algorithm that steers, and the track it leaves."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ..algorithms.manoeuvres import Hold, ManoeuvreNode
from ..base.geometry import Array
from ..benchmark.metrics.manoeuvres import ManoeuvreTrack, SpiralPoint, unwrap
from ..simulation import Simulation
from .experiment import Experiment

SAMPLE_TIME = 0.02
"""The time between two samples of a track [s]."""
STEADY_SHARE = 0.25
"""The fraction of a hold, at its end, over which the steady state is averaged [1]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ManoeuvreRun:
    """A manoeuvre that was run."""

    track: ManoeuvreTrack
    """The track; time 0 is the beginning of the manoeuvre."""
    hold_intervals: tuple[Hold, ...]
    """The times of steady states."""
    is_complete: bool
    """True if the program ended before the time limit."""


def run_manoeuvre(
    experiment: Experiment,
    node: ManoeuvreNode,
    parameters: Mapping[str, float | str],
    *,
    time_limit: float,
    sample_time: float = SAMPLE_TIME,
) -> ManoeuvreRun:
    """Run a manoeuvre and return its track.

    Args:
        experiment: the vehicle.
        node: the algorithm.
        parameters: its parameters beside those of steering.
        time_limit: the longest time from the beginning of the manoeuvre on [s].
        sample_time: the time between two samples of the track [s].
    """
    rows = []
    with experiment.open() as simulation:
        simulation.attach(node, parameters={**experiment.parameters, **parameters})
        simulation.advance(0.0)
        limit = float(experiment.parameters["approach"]) + time_limit
        while simulation.time < limit and not (node.begin_time is not None and node.is_finished):
            rows.append(sample(simulation, experiment.vehicle, node.rudder))
            simulation.advance(sample_time)
        rows.append(sample(simulation, experiment.vehicle, node.rudder))
    begin = node.begin_time if node.begin_time is not None else simulation.time
    return ManoeuvreRun(
        track=make_track(np.array(rows), begin, experiment.length),
        hold_intervals=node.hold_intervals,
        is_complete=node.is_finished,
    )


def sample(simulation: Simulation, vehicle: str, rudder: float) -> tuple[float, ...]:
    """Return time, north, east, depth, heading, surge, sway, yaw rate and rudder.

    The frame of the file has z down. Surge and sway are horizontal, along and to starboard of the
    heading.
    """
    pose, twist = simulation.pose(vehicle), simulation.velocity(vehicle)
    rotation = pose.rotation
    velocity = [sum(float(rotation[i, k] * twist[k]) for k in range(3)) for i in range(3)]
    rates = [sum(float(rotation[i, k] * twist[3 + k]) for k in range(3)) for i in range(3)]
    heading = math.atan2(rotation[1, 0], rotation[0, 0])
    c, s = math.cos(heading), math.sin(heading)
    x, y, z = pose.position.tolist()
    surge, sway = velocity[0] * c + velocity[1] * s, velocity[1] * c - velocity[0] * s
    return simulation.time, x, y, z, heading, surge, sway, rates[2], rudder


def make_track(rows: Array, begin: float, length: float) -> ManoeuvreTrack:
    """Return the track of samples (n, 9), whose manoeuvre begins at a time [s]."""
    return ManoeuvreTrack(
        length=length,
        times=rows[:, 0] - begin,
        positions=rows[:, 1:3],
        depths=rows[:, 3],
        headings=unwrap(rows[:, 4]),
        surge=rows[:, 5],
        sway=rows[:, 6],
        yaw_rates=rows[:, 7],
        rudders=rows[:, 8],
    )


def make_track_from(run: ManoeuvreRun, time: float) -> ManoeuvreRun:
    """Return a run whose manoeuvre begins at a later time [s]."""
    return replace(run, track=replace(run.track, times=run.track.times - time))


def spiral_points(run: ManoeuvreRun) -> tuple[SpiralPoint, ...]:
    """Return the steady states of a direct spiral: rudder angle and mean yaw rate of each hold."""
    return tuple(
        SpiralPoint(
            rudder=float(rudders[-1]), yaw_rate=float(np.mean(rates)), spread=float(np.ptp(rates))
        )
        for rudders, rates in _steady_parts(run)
    )


def reverse_spiral_points(run: ManoeuvreRun) -> tuple[SpiralPoint, ...]:
    """Return the steady states of a reverse spiral: mean rudder angle and yaw rate of each hold."""
    return tuple(
        SpiralPoint(
            rudder=float(np.mean(rudders)),
            yaw_rate=float(np.mean(rates)),
            spread=float(np.ptp(rudders)),
        )
        for rudders, rates in _steady_parts(run)
    )


def _steady_parts(run: ManoeuvreRun) -> list[tuple[Array, Array]]:
    """Return rudder angles and yaw rates at the end of each hold."""
    parts = []
    for hold in run.hold_intervals:
        begin = hold.end - STEADY_SHARE * (hold.end - hold.begin)
        is_inside = (run.track.times >= begin) & (run.track.times < hold.end - SAMPLE_TIME)
        parts.append((run.track.rudders[is_inside], run.track.yaw_rates[is_inside]))
    return parts
