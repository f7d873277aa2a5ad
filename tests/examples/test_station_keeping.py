"""Station keeping in a current: closed forms, and the benchmark `currents` against them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from paper.station_keeping import (
    Loop,
    StationError,
    SwingingCurrent,
    Track,
    measure_error,
    predict_error,
    read_level_track,
    select_whole_periods,
    settled_error,
)
from uwsim.base.geometry import Array
from uwsim.benchmark.reader import read_benchmark
from uwsim.benchmark.updaters import levels
from uwsim.currents import SceneContext, UwsimSinusoidSpec
from uwsim.errors import ResultError
from uwsim.results.inputs import Inputs
from uwsim.results.log import Log, load_log
from uwsim.results.result import Result
from uwsim.results.run_info import RunInfo
from uwsim.runs.executors.executor import run_all
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan_request import PlanRequest
from uwsim.runs.prepare import hash_inputs
from uwsim.runs.run import Run

P, PI = Loop(kp=0.4), Loop(kp=0.4, ki=0.04)
DATA = Path(__file__).parents[2] / "src" / "uwsim" / "data" / "benchmarks"


def water(swing: SwingingCurrent, times: Array) -> Array:
    """The current that the benchmark lets flow, (n, 2) along and across [m/s]."""
    spec = UwsimSinusoidSpec(speed=swing.speed, phi_variation=swing.angle, phi_period=swing.period)
    current = spec.bind(SceneContext(stream=lambda name: np.random.default_rng(0)))
    flow = np.array([current.velocity(np.zeros((1, 3)), float(t))[0] for t in times])
    return np.stack([flow[:, 1], -flow[:, 0]], axis=1)


def test_the_numbers_at_a_fifth_of_a_metre_per_second_are_those_of_the_closed_forms() -> None:
    p, pi = (
        predict_error(P, SwingingCurrent(speed=0.2)),
        predict_error(PI, SwingingCurrent(speed=0.2)),
    )
    assert p.along_mean == pytest.approx(0.4406, abs=5e-5)
    assert p.across_amplitude == pytest.approx(0.2915, abs=5e-5)
    assert pi.along_mean == 0.0
    assert pi.across_amplitude == pytest.approx(0.3286, abs=5e-5)


def test_integral_action_helps_against_a_sinusoid_only_above_twice_its_rate_squared() -> None:
    rate = 2.0 * math.pi / 30.0
    assert abs(Loop(kp=0.4, ki=0.04).response(rate)) > abs(P.response(rate))
    assert abs(Loop(kp=0.4, ki=2.0 * rate**2).response(rate)) == pytest.approx(
        abs(P.response(rate))
    )
    assert abs(Loop(kp=0.4, ki=0.2).response(rate)) == pytest.approx(
        0.534 * abs(P.response(rate)), rel=1e-3
    )


def test_the_harmonics_add_up_to_the_current_that_flows() -> None:
    swing, times = SwingingCurrent(speed=0.2), np.linspace(0.0, 30.0, 97)
    rates, along, across = swing.harmonics()
    turning = np.exp(1j * np.outer(times, rates))
    summed = np.stack([(turning @ along).real, (turning @ across).real], axis=1)
    assert summed == pytest.approx(water(swing, times), abs=1e-6)


@pytest.mark.parametrize("loop", [P, PI])
def test_the_settled_error_is_that_of_an_integration(loop: Loop) -> None:
    swing, dt = SwingingCurrent(speed=0.2), 0.005
    times = np.arange(0.0, 150.0, dt)
    error, integral, found = np.zeros(2), np.zeros(2), []
    for flow in water(swing, times + dt / 2):
        found.append(error)
        error = error + (flow - loop.kp * error - loop.ki * integral) * dt
        integral = integral + error * dt
    late = times > 120.0
    along, across = settled_error(loop, swing, times[late])
    assert np.array(found)[late] == pytest.approx(np.stack([along, across], axis=1), abs=1e-3)


def made(loop: Loop, swing: SwingingCurrent, *, start: Array) -> Track:
    """A level without any deviation from theory, from an unknown origin."""
    time = np.arange(0.0, 118.0 + 1e-9, 0.1)
    along, across = settled_error(loop, swing, time + 2.0)
    error = np.stack([across, along], axis=1)
    return Track(
        time=time, vehicle=error + start, target_offset=-error, tracker_error=np.zeros_like(time)
    )


def test_what_is_measured_from_a_log_is_what_was_put_into_it() -> None:
    swing = SwingingCurrent(speed=0.13)
    kept = made(P, swing, start=np.array([3.0, -1.5]))
    assert kept.reference() == pytest.approx([3.0, -1.5])
    found, theory = measure_error(kept), predict_error(P, swing)
    for name in StationError.__dataclass_fields__:
        assert getattr(found, name) == pytest.approx(getattr(theory, name), abs=1e-9), name


def test_only_whole_periods_after_thirty_seconds_count() -> None:
    time = np.arange(0.0, 118.0 + 1e-9, 0.1)
    chosen = time[select_whole_periods(time)]
    assert (chosen[0], len(chosen)) == (pytest.approx(30.0), 600)
    with pytest.raises(ResultError, match="a period of 30 s"):
        select_whole_periods(time[time < 59.0])


def test_a_level_that_is_not_in_the_logs_is_reported() -> None:
    log = Log(measure="offset", header=("current [m/s]", "time [s]", "total", "x", "y"))
    result = Result(inputs=Inputs(), run=RunInfo(), columns=(), rows=(), facts={"d": (2.2, "m")})
    names = ("centroid", "objectCentered", "offset")
    with pytest.raises(ResultError, match=r"no level current=0.1"):
        read_level_track(result, dict.fromkeys(names, log), level=0.1, focal=514.7)


def test_the_figures_have_the_published_levels_and_are_else_the_benchmark_itself() -> None:
    full, two = (read_benchmark(DATA / f"currents{end}.xml") for end in ("", "-figures"))
    assert [level.values[0][1] for level in levels(two.scene_updater)] == [0.0, 0.2]
    assert len(levels(full.scene_updater)) == 20
    assert two.measures == full.measures[:-1]  # all but the outcome of the task
    assert two.scene == full.scene


def play(algorithm: str, out: Path, *settings: str) -> StationError:
    """Play a minute of the level 0.1 of `currents`, with a camera of half the size."""
    short = out.parent / "currents.xml"
    text = (DATA / "currents.xml").read_text()
    short.write_text(text.replace("<interval>120<", "<interval>60.2<"))
    camera = "vehicle[girona500].virtualCamera[bowtech1]"
    plan = make_plan(
        PlanRequest(
            benchmark=str(short),
            scene="currents-scene.xml",
            algorithm=algorithm,
            seed=1,
            repeat=1,
            levels=[("current", 0.1)],
            settings=[f"{camera}.resw=320", f"{camera}.resh=240", *settings],
        )
    )
    inputs, renderer = hash_inputs(plan)
    [result] = run_all([Run(plan=plan, out=out, inputs=inputs, renderer=renderer)])
    assert result.values("status")[0] in ("ok", "missed")  # not lost
    names = ("centroid", "objectCentered", "offset")
    logs = {name: load_log(out / f"measure-{name}.csv") for name in names}
    focal = 120.0 / math.tan(math.radians(25.0))
    return measure_error(read_level_track(result, logs, level=0.1, focal=focal))


@pytest.mark.slow
@pytest.mark.parametrize(("algorithm", "loop"), [("p", P), ("pi", PI)])
def test_a_controller_in_the_benchmark_keeps_station_as_theory_says(
    algorithm: str, loop: Loop, tmp_path: Path
) -> None:
    found = play(algorithm, tmp_path / "r")
    theory, p = (
        predict_error(loop, SwingingCurrent(speed=0.1)),
        predict_error(P, SwingingCurrent(speed=0.1)),
    )
    along, across = 0.05 * p.along_mean, 0.05 * p.across_amplitude
    assert found.along_mean == pytest.approx(theory.along_mean, abs=along)
    assert found.across_amplitude == pytest.approx(theory.across_amplitude, abs=across)
    assert found.across_mean == pytest.approx(0.0, abs=across)
    assert found.along_amplitude == pytest.approx(theory.along_amplitude, abs=along)


@pytest.mark.slow
def test_a_loop_on_the_speed_over_ground_leaves_p_no_offset(tmp_path: Path) -> None:
    found = play("p", tmp_path / "r", "vehicle[girona500].velocityLoop=ground")
    assert found.along_mean == pytest.approx(0.0, abs=0.05 * 0.1 / 0.4)
