"""Inputs of a pilot are kept, and are sent again as they were; those of earlier versions, too."""

from __future__ import annotations

import json

import pytest

from tests.simulation.test_lamp import LAMP, night
from tests.support.opened import open_scene
from tests.support.short_trial import DATA
from uwsim.algorithms.pilot import AXES, Pilot
from uwsim.errors import ResultError
from uwsim.runs.trial.pilot_inputs import PilotInputs, read_inputs
from uwsim.runs.trial.pilot_topics import pilot_topics
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation


def opened(scene: str) -> Simulation:
    return open_scene(read_scene(DATA / "scenes" / f"{scene}.xml"), is_blind=True)


def inputs(axes: list[str], *values: list[float]) -> bytes:
    lines = [{"uwsim_inputs": 1, "axes": axes}]
    lines += [{"step": 10 * k, "values": each} for k, each in enumerate(values, start=1)]
    return "".join(json.dumps(line) + "\n" for line in lines).encode()


def test_inputs_of_an_earlier_version_are_sent_and_kept_as_they_were() -> None:
    first = inputs(list(AXES[:13]), [0.5] + [0.0] * 12)
    stored = read_inputs(first)
    with opened("currents-scene") as simulation:
        kept = PilotInputs(simulation, lambda: None, stored)
        simulation.advance(0.1)
        assert kept.data() == first


@pytest.mark.parametrize(
    ("axes", "values"),
    [(["sway", "surge"], [0.0, 0.0]), ([*AXES, "wing"], [0.0] * 99), (["surge"], [0.0, 1.0])],
    ids=["another order", "an axis that there is not", "too many numbers"],
)
def test_a_file_of_other_axes_is_refused(axes: list[str], values: list[float]) -> None:
    with pytest.raises(ResultError, match="no file of a pilot's inputs"):
        read_inputs(inputs(axes, values))


def piloted(simulation: Simulation, **axes: float) -> None:
    """Attach a pilot who holds axes from the first step on."""
    held = tuple(axes.get(axis, 0.0) for axis in AXES)
    PilotInputs(simulation, lambda: held)
    parameters = {**pilot_topics(simulation), "start": "", "rate": 100.0}
    simulation.attach(Pilot(), parameters=parameters)


def thrust(simulation: Simulation) -> list[float]:
    commanded: list[float] = simulation.world.engine.actuation[0].commands().tolist()
    return commanded


HEAD = json.dumps({"uwsim_inputs": 1, "axes": list(AXES)})


@pytest.mark.parametrize(
    "line",
    [
        f'{{"step": 1, "values": [{10**400}]}}',
        f'{{"step": 1, "values": [{"1" * 400}{", 0" * (len(AXES) - 1)}]}}',
        '{"step": 1e400, "values": []}',
        '{"step": [1], "values": []}',
        "[" * 100_000,
        '{"step": 1, "values": ' + "[" * 100_000,
        "7",
        "null",
    ],
)
def test_a_line_of_no_inputs_is_an_error(line: str) -> None:
    for text in (f"{HEAD}\n{line}\n", line):
        with pytest.raises(ResultError, match="is no file of a pilot's inputs"):
            read_inputs(text.encode())


@pytest.mark.slow
def test_a_pilot_drives_the_propeller_of_a_vehicle_that_takes_no_twist() -> None:
    with opened("remus-scene") as simulation:
        piloted(simulation, thruster1=0.8)
        before = simulation.pose("remus", "W").position
        simulation.advance(2.0)
        assert thrust(simulation) == pytest.approx([0.8], abs=0.1)
        moved = simulation.pose("remus", "W").position - before
        assert moved @ moved > 0.01


def test_a_pilot_drives_a_single_thruster_of_a_vehicle_that_takes_twists_too() -> None:
    with opened("grasp-scene") as simulation:
        names = simulation.world.vehicles.find("girona500").thrusters
        piloted(simulation, thruster2=-0.5)
        simulation.advance(1.0)
        wanted = [0.0] * len(names)
        wanted[1] = -0.5
        assert thrust(simulation) == pytest.approx(wanted, abs=0.1)


def test_a_pilot_dims_the_lamps_of_the_scene() -> None:
    with open_scene(night(LAMP), is_blind=True) as simulation:
        piloted(simulation, lamps=-1.0)
        (lamp,) = simulation.world.scenery.mounted_lamps
        simulation.advance(1.0)
        assert 0.45 <= lamp.intensity / LAMP.intensity <= 0.6
        simulation.advance(2.0)
        assert lamp.intensity == 0.0


def test_a_change_is_published_in_the_step_in_which_it_comes_unless_one_has_just_been() -> None:
    with opened("remus-scene") as simulation:
        held = [0.0] * len(AXES)
        kept = PilotInputs(simulation, lambda: tuple(held))
        simulation.advance(0.1)
        for n_steps in (7, 1, 1):
            held[0] += 0.1
            for _ in range(n_steps):
                simulation.advance()
        simulation.advance(0.1)
        steps = [json.loads(line)["step"] for line in kept.data().splitlines()[1:]]
    assert steps == [1, 51, 51 + 17]  # 17 steps: 30 Hz
