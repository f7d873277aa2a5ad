from dataclasses import replace
from importlib import resources
from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim.currents import ConstantSpec, SceneContext
from uwsim.errors import UnknownName
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

SCENE = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "visibility-scene.xml"


@pytest.fixture
def simulation() -> Simulation:
    simulation = open_scene(replace(read_scene(SCENE), objects=(), ros_interfaces=()))
    simulation.advance(0.0)
    return simulation


def place_in_l(simulation: Simulation) -> list[float]:
    world = simulation.world.bodies.find("girona500").world_from_body
    return list((simulation.world.model.scene.world_from_localized.inverse() @ world).position)


def test_a_current_carries_a_kinematic_vehicle_along(simulation: Simulation) -> None:
    current = ConstantSpec(velocity=(0.2, -0.1, 0.0)).bind(
        SceneContext(stream=simulation.world.stream)
    )
    simulation.world.water.set(current)
    for _ in range(500):
        simulation.advance()
    assert place_in_l(simulation) == pytest.approx([2.2, -0.1, 2.515])
    simulation.world.water.set(None)
    simulation.advance()
    assert place_in_l(simulation) == pytest.approx([2.2, -0.1, 2.515])


def test_a_vehicle_is_put_back_where_its_file_has_it(simulation: Simulation) -> None:
    simulation.world.water.set(
        ConstantSpec(velocity=(1.0, 0.0, 0.0)).bind(SceneContext(stream=simulation.world.stream))
    )
    for _ in range(10):
        simulation.advance()
    simulation.world.vehicles.find("girona500").reset_pose(None)
    assert place_in_l(simulation) == pytest.approx([2.0, 0.0, 2.515])
    with pytest.raises(UnknownName, match="girona500"):
        simulation.world.vehicles.find("girona50").reset_pose(None)


def test_a_timer_is_called_at_its_rate_until_it_is_stopped(simulation: Simulation) -> None:
    steps: list[int] = []
    stop = simulation.world.schedule.create_timer(100.0, lambda: steps.append(simulation.step))
    for _ in range(12):
        simulation.advance()
    stop()
    for _ in range(12):
        simulation.advance()
    assert steps == [1, 5, 10]
