"""Force sensors that compiled code samples measure what MuJoCo's own functions say."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from tests.devices.test_force_sensor import in_water, on_a_placed_vehicle, sensor
from tests.simulation.test_grasp import Grasp
from tests.support.opened import open_scene
from uwsim.base.geometry import Array
from uwsim.devices.force_sensor import ForceSensorSpec
from uwsim.messages import WrenchStamped
from uwsim.simulation import Simulation
from uwsim.topics.sensor_topic import ForceSensorROSSpec

PLACE = {"offsetp": (0.02, -0.03, 0.05), "offsetr": (0.4, -0.7, 1.1)}
SENSORS = (
    ForceSensorSpec(name="finger1", target="part4_jaw1", **PLACE),  # type: ignore[arg-type]
    ForceSensorSpec(name="finger2", target="part4_jaw2", **PLACE),  # type: ignore[arg-type]
    ForceSensorSpec(name="wrist", target="part4_base", measures="joint", **PLACE),  # type: ignore[arg-type]
    ForceSensorSpec(name="base", target="base_link"),
)
NAMES = tuple(each.name for each in SENSORS)
TOPICS = tuple(ForceSensorROSSpec(name=name, topic=f"/{name}", rate=40) for name in NAMES)


@pytest.fixture(scope="module")
def grasp() -> Iterator[Grasp]:
    """The jaw holds a box, which hangs at the wrist."""
    grasp = Grasp(parts=SENSORS, topics=TOPICS)
    grasp.lift()
    yield grasp
    grasp.simulation.close()


def numbers(message: WrenchStamped) -> Array:
    force, torque = message.wrench.force, message.wrench.torque
    return np.array([force.x, force.y, force.z, torque.x, torque.y, torque.z])


def contact_wrench(simulation: Simulation, link: str, point: Array) -> Array:
    """Sum the contacts on a link of vehicle 0 about a point, in W."""
    engine = simulation.world.engine
    model, data = engine._model, engine._data
    body, local, total = model.body(f"vehicle/0/{link}").id, np.zeros(6), np.zeros(6)
    for i in range(data.ncon):
        contact = data.contact[i]
        first, second = (model.geom_bodyid[geom] == body for geom in contact.geom)
        if first == second:
            continue
        mujoco.mj_contactForce(model, data, i, local)
        axes = contact.frame.reshape(3, 3).T * (1.0 if second else -1.0)
        force = axes @ local[:3]
        total += [*force, *(axes @ local[3:] + np.cross(contact.pos - point, force))]
    return total


def joint_wrench(simulation: Simulation, link: str, point: Array) -> Array:
    """Compute what a link of vehicle 0 does to its joint about a point, in W."""
    engine = simulation.world.engine
    model, data = engine._model, mujoco.MjData(engine._model)
    mujoco.mj_copyData(data, model, engine._data)
    for compute in ("kinematics", "comPos", "comVel", "rnePostConstraint"):
        getattr(mujoco, f"mj_{compute}")(model, data)
    body = model.body(f"vehicle/0/{link}").id
    wrench = engine._water.wrenches(data)[body] - data.cfrc_int[body]  # torque, then force
    lever = data.subtree_com[model.body_rootid[body]] - point
    return np.array([*wrench[3:], *(wrench[:3] + np.cross(lever, wrench[3:]))])


def expected(simulation: Simulation, spec: ForceSensorSpec) -> Array:
    """Compute what a sensor of vehicle 0 measures now."""
    mount = simulation.world.vehicles[0].mount(spec, visual=True).world_from_body
    wrench = joint_wrench if spec.measures == "joint" else contact_wrench
    found = wrench(simulation, spec.target, mount.position).reshape(2, 3)
    return (found @ mount.rotation).ravel()


def sample_of(simulation: Simulation, name: str) -> Array:
    return numbers(simulation.world.sensors.sensor(name, ("ForceSensor",)).sample(0.0))


@pytest.mark.parametrize("spec", SENSORS, ids=NAMES)
def test_a_sample_is_the_wrench_by_mujocos_own_functions(
    grasp: Grasp, spec: ForceSensorSpec
) -> None:
    found = sample_of(grasp.simulation, spec.name)
    assert found == pytest.approx(expected(grasp.simulation, spec), rel=1e-9, abs=1e-9)
    if spec.name == "base":
        assert not found.any(), "nothing is at the base"
    else:
        assert np.linalg.norm(found[:3]) > 10.0, "the fingers press, and the wrist carries a box"


def test_many_steps_at_once_take_the_samples_of_single_steps(
    grasp: Grasp, monkeypatch: pytest.MonkeyPatch
) -> None:
    simulation, n_steps = grasp.simulation, []
    begun, engine = simulation.save(), simulation.world.engine
    step = engine.step

    def count(n: int, *rest: Any, **more: Any) -> bool:
        n_steps.append(n)
        return step(n, *rest, **more)

    with monkeypatch.context() as patched:
        patched.setattr(engine, "step", count)
        simulation.advance(0.51)
    assert max(n_steps) > 100, "no sample ended the steps"
    at_once = [simulation.bus.unread_message(name) for name in NAMES]
    simulation.restore(begun)
    for _ in range(round(0.51 / simulation.timestep)):
        simulation.advance()
    assert repr(at_once) == repr([simulation.bus.unread_message(name) for name in NAMES])
    simulation.restore(begun)
    received: list[WrenchStamped] = []
    stop = simulation.bus.subscribe("/wrist", WrenchStamped, received.append)
    simulation.advance(0.51)
    stop()
    assert len(received) in (20, 21)
    assert repr(received[-1]) == repr(at_once[NAMES.index("wrist")])
    simulation.restore(begun)


def test_without_a_reader_nothing_is_sampled_in_a_trial(grasp: Grasp) -> None:
    """Neither by compiled steps, nor by single ones; a reader gets all samples from then on."""
    simulation = grasp.simulation
    begun = simulation.save()
    before = [repr(simulation.bus.unread_message(name)) for name in NAMES]
    simulation.bus.keeps_unread_messages = False
    simulation.advance(0.2)
    simulation.advance()
    assert [repr(simulation.bus.unread_message(name)) for name in NAMES] == before
    received: list[WrenchStamped] = []
    stop = simulation.bus.subscribe("/wrist", WrenchStamped, received.append)
    simulation.advance(0.2)
    stop()
    simulation.bus.keeps_unread_messages = True
    assert len(received) == 8
    assert numbers(received[0])[:3].any()
    assert [repr(simulation.bus.unread_message(name)) for name in NAMES[:2]] == before[:2]
    simulation.restore(begun)


def test_a_vehicle_that_is_placed_has_no_contacts_before_the_next_step() -> None:
    with open_scene(in_water(2.0), is_blind=True) as simulation:
        simulation.advance(1.0)
        vehicle = simulation.world.vehicles[0]
        assert sample_of(simulation, "force")[2] < -5.0
        vehicle.place(vehicle.world_from_base)
        assert not sample_of(simulation, "force").any()
        begun = simulation.save()
        simulation.advance(0.1)
        at_once = simulation.bus.unread_message("/force")
        assert isinstance(at_once, WrenchStamped)
        assert numbers(at_once).any()
        simulation.restore(begun)
        assert not sample_of(simulation, "force").any()
        for _ in range(50):
            simulation.advance()
        assert repr(simulation.bus.unread_message("/force")) == repr(at_once)


def test_uwsims_own_physics_is_sampled_too(tmp_path: Path) -> None:
    spec = sensor((0.3, -0.2, 0.1), (0.4, -0.7, 1.1))
    with open_scene(on_a_placed_vehicle(tmp_path, spec), is_blind=True) as simulation:
        simulation.advance(1.0)
        found = sample_of(simulation, "force")
        assert found.any()
        assert found == pytest.approx(expected(simulation, spec), rel=1e-9, abs=1e-12)
