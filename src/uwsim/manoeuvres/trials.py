"""All standard manoeuvres of a vehicle, one after the other, each from its own approach."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from ..algorithms.manoeuvres import (
    CrashStopNode,
    ManoeuvreNode,
    PullOutNode,
    ReverseSpiralNode,
    SpiralNode,
    TurningCircleNode,
    ZigZagNode,
)
from ..benchmark.metrics.manoeuvres import (
    CrashStop,
    Criterion,
    PullOut,
    Spiral,
    TurningCircle,
    ZigZag,
    judge,
    measure_crash_stop,
    measure_pull_out,
    measure_spiral,
    measure_turning_circle,
    measure_zigzag,
)
from .experiment import Experiment
from .run import (
    ManoeuvreRun,
    make_track_from,
    reverse_spiral_points,
    run_manoeuvre,
    spiral_points,
)
from .tank import design_speed

TIME_LIMIT_LENGTHS = 400.0
"""The longest duration of a manoeuvre, in L / U [1]."""
MIN_TIME_LIMIT = 60.0
"""The smallest limit of the duration of a manoeuvre [s]."""
HOLD_LENGTHS = 35.0
"""The time for which a spiral holds an angle, in L / U [1]."""
MIN_HOLD = 15.0
"""The least time for which a spiral holds an angle [s]."""
SPIRAL_SHARES = (1.0, 0.6, 0.4, 0.3, 0.2, 0.15, 0.1, 0.05)
"""The rudder angles of a spiral to either side, as shares of hard over [1]."""
RATE_SHARES = (0.9, 0.75, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1)
"""The yaw rates of a reverse spiral to either side, as shares of that of the turning circle [1]."""
PULL_OUT_SHARE = 0.6
"""The rudder angle of a pull-out, as a share of hard over [1]."""
N_RUNS = 9
"""The number of runs of all manoeuvres."""
COARSE_SAMPLE_TIME = 0.1
"""The time between two samples of manoeuvres of steady states [s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class TrialResults:
    """The results of all manoeuvres, with their tracks."""

    turns: tuple[TurningCircle, TurningCircle]
    """The turning circles to starboard and to port, with the rudder hard over."""
    turn_runs: tuple[ManoeuvreRun, ManoeuvreRun]
    """The runs of the turning circles."""
    zigzags: tuple[ZigZag, ZigZag]
    """The zig-zags 10/10 and 20/20."""
    zigzag_runs: tuple[ManoeuvreRun, ManoeuvreRun]
    """The runs of the zig-zags."""
    spiral: Spiral
    """The direct and the reverse spiral."""
    pull_out: PullOut
    """The pull-outs."""
    pull_out_runs: tuple[ManoeuvreRun, ManoeuvreRun]
    """The runs of the pull-outs from turns to starboard and to port."""
    stop: CrashStop
    """The crash stop."""
    stop_run: ManoeuvreRun
    """The run of the crash stop."""
    criteria: tuple[Criterion, ...]
    """The criteria of IMO's standards."""


def run_trials(experiment: Experiment, on_run: Callable[[], object] | None = None) -> TrialResults:
    """Run all manoeuvres of a vehicle.

    Args:
        experiment: the vehicle.
        on_run: a function that is called after each run.
    """
    trials = _Trials(experiment, on_run or (lambda: None))
    starboard = trials.run(TurningCircleNode())
    port = trials.run(TurningCircleNode(), side="port")
    turns = (measure_turning_circle(starboard.track), measure_turning_circle(port.track))
    small_run = trials.run(ZigZagNode(), rudder=10.0, heading=10.0)
    large_run = trials.run(ZigZagNode(), rudder=20.0, heading=20.0)
    zigzags = (
        measure_zigzag(small_run.track, math.radians(10.0)),
        measure_zigzag(large_run.track, math.radians(20.0)),
    )
    spiral = trials.run_spirals(min(abs(turn.yaw_rate) for turn in turns))
    outs = trials.run_pull_outs(math.degrees(spiral.neutral_angle or 0.0))
    crash_run = trials.run(CrashStopNode())
    stop = measure_crash_stop(crash_run.track)
    return TrialResults(
        turns=turns,
        turn_runs=(starboard, port),
        zigzags=zigzags,
        zigzag_runs=(small_run, large_run),
        spiral=spiral,
        pull_out=measure_pull_out(outs[0].track, outs[1].track),
        pull_out_runs=outs,
        stop=stop,
        stop_run=crash_run,
        criteria=judge(
            experiment.length,
            turns=turns,
            zigzag_10=zigzags[0],
            zigzag_20=zigzags[1],
            stop=stop,
        ),
    )


class _Trials:
    """The runs of one vehicle."""

    def __init__(self, experiment: Experiment, on_run: Callable[[], object]) -> None:
        self._experiment, self._on_run = experiment, on_run
        self._limit = float(experiment.parameters["limit"])
        unit = experiment.length / design_speed(experiment)  # L / U [s]
        self._hold = max(HOLD_LENGTHS * unit, MIN_HOLD)
        self._time_limit = max(TIME_LIMIT_LENGTHS * unit, MIN_TIME_LIMIT)

    def run(self, node: ManoeuvreNode, **parameters: float | str) -> ManoeuvreRun:
        run = run_manoeuvre(self._experiment, node, parameters, time_limit=self._time_limit)
        self._on_run()
        return run

    def run_steady(
        self, node: ManoeuvreNode, n_holds: int, **parameters: float | str
    ) -> ManoeuvreRun:
        run = run_manoeuvre(
            self._experiment, node, {**parameters, "hold": self._hold},
            time_limit=self._hold * (n_holds + 1), sample_time=COARSE_SAMPLE_TIME,
        )  # fmt: skip
        self._on_run()
        return run

    def run_spirals(self, yaw_rate: float) -> Spiral:
        shares = [*SPIRAL_SHARES, 0.0, *(-share for share in reversed(SPIRAL_SHARES))]
        angles = " ".join(f"{share * self._limit:.9g}" for share in shares)
        direct_run = self.run_steady(SpiralNode(), 2 * len(shares), angles=angles)
        rates = [*RATE_SHARES, 0.0, *(-share for share in reversed(RATE_SHARES))]
        gain = float(self._experiment.parameters["heading_kd"])
        reverse_run = self.run_steady(
            ReverseSpiralNode(),
            len(rates),
            rates=" ".join(f"{math.degrees(yaw_rate) * share:.9g}" for share in rates),
            gain=gain,
            integral_time=0.1 * self._hold,
        )
        return measure_spiral(spiral_points(direct_run), reverse_spiral_points(reverse_run))

    def run_pull_outs(self, neutral_angle: float) -> tuple[ManoeuvreRun, ManoeuvreRun]:
        rudder = PULL_OUT_SHARE * self._limit
        runs = []
        for side in ("starboard", "port"):
            run = self.run_steady(
                PullOutNode(), 2, rudder=rudder, side=side, neutral=f"{neutral_angle:.9g}"
            )
            runs.append(make_track_from(run, run.hold_intervals[0].end))
        return runs[0], runs[1]
