"""The tasks of OneOcean: their places, their equations, and the program that prints the table."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import uwsim
from uwsim import Pose
from uwsim.base.rng import stream

PAPER = Path(__file__).parents[2] / "examples" / "paper"


@pytest.fixture(scope="module", autouse=True)
def _paths() -> Iterator[None]:
    sys.path.insert(0, str(PAPER))
    yield
    sys.path.remove(str(PAPER))


def load(name: str) -> Any:
    return importlib.import_module(name)


def shortened_task(**changes: float) -> Any:
    numbers = {"count": 1, "length": 0.0, "radius": 1.3, "duration": 30.0, "hold": 20.0, "kp": 0.8}
    return load("oneocean_model").Task(**{**numbers, **changes})


def test_places_are_about_a_line_of_the_length_and_within_the_square() -> None:
    draw = load("oneocean_waypoints").draw_waypoints
    middle, corner = np.array([300.0, 300.0, 10.0]), np.array([599.0, 1.0, 10.0])

    (goal,) = draw(middle, stream(1, "places"), count=1, length=240.0)
    many = draw(middle, stream(1, "places"), count=400, length=200.0)
    at_corner = draw(corner, stream(2, "places"), count=20, length=277.2)

    assert np.linalg.norm(goal - middle) == pytest.approx(240.0)
    direction = (goal - middle)[:2] / 240.0
    along = (many - middle)[:, :2] @ direction
    across = (many - middle)[:, :2] @ np.array([-direction[1], direction[0]])
    assert np.polyfit(np.linspace(-0.25, 0.75, 400), along, 1)[0] == pytest.approx(200.0, rel=0.05)
    assert np.std(across) == pytest.approx(10.0, rel=0.15)
    assert (at_corner[:, :2] >= 0.0).all()
    assert (at_corner[:, :2] <= 600.0).all()
    assert set(at_corner[:, 2]) == {10.0}


def test_places_are_reached_one_after_the_other() -> None:
    body, sent = SimpleNamespace(world_from_body=Pose.identity()), []
    world = SimpleNamespace(
        body=lambda route: body,
        world_from_localized=Pose.identity(),
        bus=SimpleNamespace(publisher=lambda topic, type: sent.append),
        stream=lambda name: stream(3, name),
    )
    module = load("oneocean_waypoints")
    places = module.draw_waypoints(np.zeros(3), stream(3, "waypoints"), count=3, length=100.0)
    spec = module.WaypointsSpec(
        name="route", target="auv", topic="/goal", count=3, length=100.0, radius=1.0
    )
    measure = spec.bind(world)
    assert measure.value is None
    measure.start()
    shares = []
    for place in (places[1], places[0], places[0], places[1], places[2] + 0.5, places[2]):
        body.world_from_body = Pose(place, np.eye(3))
        measure.update()
        shares.append(measure.value)

    assert shares == pytest.approx([0, 1 / 3, 1 / 3, 2 / 3, 1, 1])
    assert [message.pose.position.x for message in sent] == places[:, 0].tolist()


def test_the_published_equations_have_the_offset_of_a_proportional_law_in_small_steps() -> None:
    model = load("oneocean_model")
    task = shortened_task(hold=120.0, duration=120.0)

    errors = [model.simulate(task, seed=0, current=c, step=0.1).error for c in (0.1, 0.3)]

    offset = (model.GAIN + model.DRAG) / (model.GAIN * task.kp)  # of a current of 1 m/s [m]
    assert errors == pytest.approx([0.1 * offset, 0.3 * offset], rel=0.02)


def test_a_step_of_one_second_is_beyond_the_limit_of_stability() -> None:
    model = load("oneocean_model")
    task = shortened_task(hold=120.0, duration=120.0)
    velocity_limit, turn_limit = model.stable_step()
    error, fine_error = (
        np.mean([model.simulate(task, seed=s, current=0.1, step=step).error for s in range(5)])
        for step in (1.0, 0.5)
    )

    assert 0.5 < min(velocity_limit, turn_limit) < 1.0
    assert velocity_limit == pytest.approx(0.923, abs=1e-3)
    assert error > 3.0 * fine_error


def test_in_steps_of_one_second_the_vehicle_is_faster() -> None:
    model = load("oneocean_model")
    task = shortened_task(hold=0.0, length=100.0, duration=110.0, kp=0.9)

    successes = {
        step: sum(
            model.simulate(task, seed=seed, current=0.0, step=step).is_success for seed in range(8)
        )
        for step in (1.0, 0.2)
    }

    # by 0.83 m/s, 91 m: only those that begin near the border of the square have a nearer place
    assert successes[1.0] == 8
    assert successes[0.2] < 6


@pytest.mark.slow
def test_the_engine_has_the_offset_of_the_published_vehicle_and_law() -> None:
    table, model = load("oneocean_table"), load("oneocean_model")
    task = shortened_task()

    result = uwsim.bench(
        table.make_benchmark(task),
        algorithm=table.HeuristicForce,
        levels={"current": [0.3]},
        settings={"algorithm.kp": task.kp},
        data_path=[PAPER],
    )

    offset = (model.GAIN + model.DRAG) / (model.GAIN * task.kp)  # of a current of 1 m/s [m]
    assert result.numbers("route.distance") == pytest.approx([0.3 * offset], rel=2e-3)


@pytest.mark.slow
def test_the_program_prints_a_row_for_each_task_and_vehicle(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    table = load("oneocean_table")
    tasks = {
        "station keeping": shortened_task(hold=2.0, duration=2.0),
        "go to goal": shortened_task(hold=0.0, length=0.5, radius=0.6, duration=2.0),
        "route": shortened_task(hold=0.0, count=2, length=50.0, duration=2.0),
    }
    monkeypatch.setattr(table, "TASKS", tasks)
    arguments = ["--seeds", "1", "--currents", "0.1"]
    monkeypatch.setattr(sys, "argv", ["oneocean_table.py", *arguments])

    table.main()

    rows = capsys.readouterr().out.splitlines()[2:]
    assert [row.split("|")[1].strip() for row in rows] == [
        f"{task}; {vehicle}" for vehicle in ("their vehicle", "BlueROV2 Heavy") for task in tasks
    ]
    assert "1.07 m |" in rows[0]
    assert "100 % [3, 100]; 1.35" in rows[1]
    assert "0 % [0, 98]; 0.00" in rows[2]


@pytest.mark.slow
def test_the_program_of_the_helix_prints_both_errors(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    table = load("helix_table")
    monkeypatch.setattr(table, "ROWS", {"position-lqr": "position-lqr"})
    monkeypatch.setattr(sys, "argv", ["helix_table.py", "--seeds", "1"])

    table.main()

    whole, settled = capsys.readouterr().out.splitlines()[-1].split("|")[2:4]
    assert float(settled) < 0.01 < float(whole) < 0.2
