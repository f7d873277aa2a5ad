"""The manoeuvres of the bundled REMUS 100, against the equations that Prestero published.

The same algorithms steer both, by messages alone: the vehicle of `remus-scene`, and an independent
integrator of the thesis's equations (`tests/physics/prestero.py`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from tests.physics.prestero import StateRate, foil_rate, run_program, state_rate
from uwsim.algorithms.manoeuvres import (
    CrashStopNode,
    ManoeuvreNode,
    PullOutNode,
    ReverseSpiralNode,
    SpiralNode,
    TurningCircleNode,
    ZigZagNode,
)
from uwsim.assets.bundled import bundled_files
from uwsim.benchmark.metrics.manoeuvres import (
    measure_crash_stop,
    measure_spiral,
    measure_turning_circle,
    measure_zigzag,
)
from uwsim.manoeuvres.experiment import Experiment, make_experiment
from uwsim.manoeuvres.run import (
    ManoeuvreRun,
    reverse_spiral_points,
    run_manoeuvre,
    spiral_points,
)
from uwsim.scene.reader import read_scene

TOLERANCE = 0.05
"""The greatest relative difference: the figure to reach."""
FOIL_TOLERANCE = 0.005
"""The greatest relative difference to the published equations with foils at the fins."""


@cache
def remus() -> Experiment:
    return make_experiment(read_scene(bundled_files("scenes")["remus-scene"]))


def run_both(
    make: Callable[[], ManoeuvreNode],
    limit: float = 120.0,
    rate: StateRate = state_rate,
    **parameters: float | str,
) -> tuple[ManoeuvreRun, ManoeuvreRun]:
    """Run a manoeuvre of the bundled vehicle and of the published equations."""
    experiment = remus()
    ours = run_manoeuvre(experiment, make(), parameters, time_limit=limit)
    track, node = run_program(make(), {**experiment.parameters, **parameters}, limit, rate)
    return ours, ManoeuvreRun(track=track, hold_intervals=node.hold_intervals, is_complete=True)


def compare(ours: object, published: object, names: str, tolerance: float = TOLERANCE) -> None:
    """Compare numbers of two manoeuvres; all that differ are reported together."""
    pairs = {name: (getattr(ours, name), getattr(published, name)) for name in names.split()}
    differences = {
        name: f"{one:.5g}, published {other:.5g}: {one / other - 1.0:+.1%}"
        for name, (one, other) in pairs.items()
        if one != pytest.approx(other, rel=tolerance)
    }
    assert differences == {}


def test_the_speed_on_a_straight_course_is_that_of_the_published_equations() -> None:
    ours, published = run_both(TurningCircleNode, 0.5)
    assert ours.track.approach_speed == pytest.approx(published.track.approach_speed, rel=TOLERANCE)
    # Prestero's cruise: 1.54 m/s at 1500 rpm, without the rudder that holds the course
    assert published.track.approach_speed == pytest.approx(1.54, rel=0.05)


@pytest.mark.parametrize("side", ["starboard", "port"])
@pytest.mark.parametrize(
    "rudder",
    [pytest.param(4.0, marks=pytest.mark.slow), pytest.param(8.0, marks=pytest.mark.slow), 13.5],
)
def test_turning_circles_agree_with_the_published_equations(side: str, rudder: float) -> None:
    ours, published = run_both(TurningCircleNode, rudder=rudder, side=side)
    assert ours.is_complete
    compare(
        measure_turning_circle(ours.track),
        measure_turning_circle(published.track),
        "advance transfer tactical_diameter steady_diameter time_90 time_180 yaw_rate drift_angle",
    )
    speeds = [track.steady_speed for track in (ours.track, published.track)]
    assert speeds[0] == pytest.approx(speeds[1], rel=TOLERANCE)


@pytest.mark.parametrize("angle", [10.0, 20.0])
def test_zigzags_agree_with_the_published_equations(angle: float) -> None:
    runs = run_both(ZigZagNode, rudder=angle, heading=angle)
    ours, published = (measure_zigzag(run.track, math.radians(angle)) for run in runs)
    compare(ours, published, "initial_turning_time initial_turning_distance period")
    for one, other in zip(ours.overshoots[:3], published.overshoots[:3], strict=True):
        compare(one, other, "angle time_to_check peak")


def test_the_crash_stop_agrees_with_the_published_equations() -> None:
    ours, published = (measure_crash_stop(run.track) for run in run_both(CrashStopNode))
    compare(ours, published, "track_reach head_reach time")


def test_the_crash_stop_differs_by_the_fins_alone() -> None:
    """Its lateral deviation is 8 % more than published; with foils at the fins it is the same."""
    runs = run_both(CrashStopNode, rate=foil_rate)
    ours, with_foils = (measure_crash_stop(run.track) for run in runs)
    compare(ours, with_foils, "track_reach head_reach lateral_deviation time", FOIL_TOLERANCE)


@pytest.mark.slow
def test_the_pull_outs_leave_the_yaw_rates_of_the_published_equations() -> None:
    for side in ("starboard", "port"):
        runs = run_both(PullOutNode, rudder=8.0, side=side, neutral="0.7", hold=30.0)
        ours, published = (run.track.yaw_rates[-1] for run in runs)
        assert ours == pytest.approx(published, rel=TOLERANCE)


@pytest.mark.slow
def test_the_spirals_agree_with_the_published_equations() -> None:
    angles = "13.5 8 4 2 1 0 -1 -2 -4 -8 -13.5"
    ours, published = (
        spiral_points(run) for run in run_both(SpiralNode, 1000.0, angles=angles, hold=30.0)
    )
    for one, other in zip(ours, published, strict=True):
        assert one.yaw_rate == pytest.approx(other.yaw_rate, rel=TOLERANCE)
    rates = "9 6 4 3 2 1 0 -1 -2 -3 -4 -6 -9"
    reverse = [
        reverse_spiral_points(run)
        for run in run_both(
            ReverseSpiralNode, 1000.0, rates=rates, hold=30.0, gain=1.3, integral_time=3.0
        )
    ]
    widths = [
        measure_spiral(direct, points).reverse_width
        for direct, points in zip((ours, published), reverse, strict=True)
    ]
    assert np.degrees(widths[0]) == pytest.approx(np.degrees(widths[1]), rel=TOLERANCE)
