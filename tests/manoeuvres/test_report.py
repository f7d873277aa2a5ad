"""The report of manoeuvres, of results without a run."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from uwsim.benchmark.metrics.manoeuvres import (
    CrashStop,
    PullOut,
    Spiral,
    TurningCircle,
    ZigZag,
    fit_resistance,
    judge,
)
from uwsim.manoeuvres.report.document import simplify
from uwsim.manoeuvres.report.page import make_cards
from uwsim.manoeuvres.report.tables import make_tables
from uwsim.manoeuvres.run import ManoeuvreRun, make_track
from uwsim.manoeuvres.trials import TrialResults

TURN = TurningCircle(
    rudder=0.3, approach_speed=1.5, advance=6.0, transfer=4.0, tactical_diameter=8.0,
    steady_diameter=8.0, time_90=5.0, time_180=10.0, speed_loss=0.2, yaw_rate=0.3,
    drift_angle=0.1, depth_change=0.0,
)  # fmt: skip
ZIGZAG = ZigZag(
    rudder=0.17, heading=0.17, approach_speed=1.5, initial_turning_time=None,
    initial_turning_distance=None, overshoots=(), period=None, depth_change=0.0,
)  # fmt: skip
SPIRAL = Spiral(
    points=(), reverse_points=(), loop_width=None, loop_height=None, neutral_angle=None,
    resolution=0.0, reverse_width=None,
)  # fmt: skip
STOP = CrashStop(
    approach_speed=1.5, track_reach=None, head_reach=None, lateral_deviation=None, time=None,
    heading_change=None,
)  # fmt: skip


def results() -> TrialResults:
    """Return the results of a vehicle that turns to starboard, and does nothing else."""
    track = make_track(np.zeros((3, 9)), 0.0, 2.0)
    run = ManoeuvreRun(track=track, hold_intervals=(), is_complete=False)
    turns = (TURN, replace(TURN, tactical_diameter=None))
    return TrialResults(
        turns=turns, turn_runs=(run, run), zigzags=(ZIGZAG, ZIGZAG), zigzag_runs=(run, run),
        spiral=SPIRAL, pull_out=PullOut(starboard_rate=0.1, port_rate=-0.1),
        pull_out_runs=(run, run), stop=STOP, stop_run=run,
        criteria=judge(2.0, turns=turns, zigzag_10=ZIGZAG, zigzag_20=ZIGZAG, stop=STOP),
    )  # fmt: skip


def test_values_that_were_not_reached_are_named_so_and_no_criterion_is_met_by_them() -> None:
    tables = {table.title: table for table in make_tables(results(), None, 2.0)}
    rows = dict((row[0], row[1:]) for row in tables["Turning circle, rudder hard over"].rows)
    assert rows["tactical diameter [L]"] == ("4.00", "not reached")
    criteria = {row[0]: row[1:] for row in tables["Criteria of IMO MSC.137(76)"].rows}
    assert criteria["advance"] == ("3.00 L", "4.5 L", "met")
    assert criteria["tactical diameter"] == ("not reached", "5 L", "not met")
    assert criteria["track reach"] == ("not reached", "15 L", "not met")
    cards = {card["label"]: card["value"] for card in make_cards(results(), 2.0)}
    assert cards["tactical diameter"] == "4.00 L"
    assert cards["first overshoot 10/10"] == cards["loop of the spiral"] == "not reached"
    assert cards["criteria of ships"] == "1 of 7 met"


def test_json_has_no_infinity() -> None:
    resistance = fit_resistance(np.array([1.0, 2.0]), np.array([3.0, 6.0]))
    assert simplify(resistance)["linear"] == 3.0
    assert simplify((1.0, math.inf, np.array([math.nan]))) == [1.0, None, [None]]
