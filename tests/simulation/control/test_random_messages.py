"""No message or request that a peer can send ends a simulation."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import uwsim
from tests.support.random_messages import RandomMessages
from tests.topics.test_every_interface import SCENE
from uwsim.errors import UwsimError
from uwsim.messages import JointState, Odometry, Pose
from uwsim.messages.simulation_control import SetSimulationState, SimulationState
from uwsim.simulation import Simulation
from uwsim.simulation.control.control import SimulationControl
from uwsim.simulation.markers.lines import describe_markers, draw_markers


def send(simulation: Simulation, name: str, message: object, *, is_request: bool) -> None:
    """Send a message or a request; refusals (`UwsimError`) go to the peer."""
    try:
        if is_request:
            simulation.call(name, message)
        else:
            publish = simulation.bus.publisher(name, type(message), report=lambda *_: None)
            publish(message)
    except UwsimError:
        return


def exchange(simulation: Simulation, seed: int, n: int) -> None:
    """Send ``n`` messages, and advance and look at the markers after each."""
    bus, world = simulation.bus, simulation.world
    control = SimulationControl(simulation, lambda: None)
    control.begin()
    joints = [
        name for each in world.vehicles.names for name in world.vehicles.find(each).joint_names
    ]
    objects = [each.name for each in world.model.scene.objects]
    words = ["", "base_link", "world", "rgb8", "mono8", "spawned", "entity_0", "x", "y", "z", "rgb"]
    messages = RandomMessages(seed, [*words, *world.vehicles.names, *objects, *joints])
    topics = [topic for topic in bus.topics if bus.has_subscribers(topic)]
    for topic in list(bus.topics):
        bus.inbox(topic, object)  # everything that the scene publishes is made
    assert len(bus.services.names) >= 11
    for _ in range(n):
        is_request = not topics or messages.rng.random() < 0.3
        names = bus.services.names if is_request else topics
        name = names[messages.rng.integers(len(names))]
        cls = bus.services.request_type(name) if is_request else bus.message_type(name)
        assert cls is not None
        send(simulation, name, messages.message(cls), is_request=is_request)
        if simulation.call("get_simulation_state", _request("get_simulation_state", bus)):
            playing = SimulationState(SimulationState.PLAYING)
            simulation.call("set_simulation_state", SetSimulationState(state=playing))
        simulation.advance(0.006)
        describe_markers(
            draw_markers(world.markers.active_markers, world.model.scene.world_from_localized)
        )


def _request(name: str, bus: uwsim.simulation.simulation.Bus) -> object:
    cls = bus.services.request_type(name)
    assert cls is not None
    return cls()


@pytest.fixture(scope="module")
def every_interface(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("scene") / "scene.xml"
    path.write_text(SCENE)
    return path


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("seed", [1, 2])
def test_no_message_to_an_interface_ends_a_simulation(every_interface: Path, seed: int) -> None:
    with uwsim.load(every_interface) as simulation:
        exchange(simulation, seed, 60)
        assert np.isfinite(simulation.pose("rov").position).all()


@pytest.mark.slow
@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("scene", ["cirs", "grasp-scene", "two-vehicles-scene", "dredging-scene"])
@pytest.mark.parametrize("seed", [3, 4])
def test_no_message_to_a_bundled_scene_ends_a_simulation(scene: str, seed: int) -> None:
    with uwsim.load(scene) as simulation:
        exchange(simulation, seed, 120)
        for name in simulation.world.vehicles.names:
            assert np.isfinite(simulation.pose(name).position).all()


@pytest.mark.parametrize("distance", [1e3, 1e6, 1e12, -1e12, 1e308])
def test_a_vehicle_sent_far_away_and_back_does_not_end_the_simulation(distance: float) -> None:
    with uwsim.load("cirs") as simulation:
        near, away = Pose(), Odometry()
        away.pose.pose.position.y, away.pose.pose.orientation.w = distance, 1.0
        near.position.x, near.position.y, near.position.z = -0.73, 0.22, -0.19  # in the wall
        near.orientation.w = 1.0
        joints = JointState(name=[], position=np.full(5, 1e9), velocity=np.zeros(0))
        joints.effort = np.zeros(0)
        for _ in range(3):
            for topic, message in (
                ("dataNavigator", away),
                ("uwsim/joint_state_command", joints),
                ("g500/pose", near),
            ):
                send(simulation, topic, message, is_request=False)
                simulation.advance(0.004)
        assert np.abs(simulation.pose("girona500").position).max() < 10.0
