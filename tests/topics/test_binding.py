"""Interfaces: one without ``bind`` does nothing; one that names what is not there is left out."""

from __future__ import annotations

import dataclasses
from importlib import resources
from pathlib import Path
from typing import ClassVar

import pytest

from tests.support.opened import open_scene
from uwsim.base.record import NoState
from uwsim.devices import DEVICES
from uwsim.forces import FORCES
from uwsim.messages import Float64
from uwsim.scene.reader import read_scene
from uwsim.scene.unsupported import describe_limitation
from uwsim.schema import fields_of
from uwsim.schema.names import prefixed_name
from uwsim.sensors import SENSORS
from uwsim.sensors.pressure_sensor import PressureSensorSpec
from uwsim.sensors.sensor import Carrier, SensorSpec, find_message_type
from uwsim.topics import INTERFACES, InterfaceSpec, element_name
from uwsim.topics.sensor_topic import (
    ImuToROSImuSpec,
    PressureSensorToROSSpec,
    SensorTopicSpec,
    SensorToROSSpec,
)
from uwsim.world import Body, SensorWorld

SCENE = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "visibility-scene.xml"


@pytest.mark.parametrize("name", [name for name in INTERFACES if name != "SimulatedDeviceROS"])
def test_what_has_no_bind_is_reported_as_read_only(name: str) -> None:
    spec = INTERFACES[name]
    assert bool(describe_limitation("rosInterfaces", name)) is not spec.is_simulated()
    assert bool(spec.message_types()) is spec.is_simulated()


@pytest.mark.parametrize("spec", INTERFACES.values())
def test_topics_are_fields_and_sources_are_elements(spec: type[InterfaceSpec]) -> None:
    fixed = {name for name, value in vars(spec).items() if isinstance(value, str)}
    assert set(spec.message_types()) <= {field.name for field in fields_of(spec)} | fixed
    parts = {*map(prefixed_name, {**SENSORS, **DEVICES}), *(f"u:{name}" for name in FORCES)}
    assert set(spec.sources) <= {*parts, "vehicle", "object"}


def test_sensors_on_one_interface_measure_the_same() -> None:
    for spec in INTERFACES.values():
        if issubclass(spec, SensorTopicSpec) and spec is not SensorToROSSpec:
            parts = {prefixed_name(tag): part for tag, part in {**SENSORS, **DEVICES}.items()}
            types = {find_message_type(parts[source]) for source in spec.sources} - {None}
            assert len(types) <= 1


def test_an_interface_of_a_sensor_that_is_simulated_is_simulated(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    @dataclasses.dataclass(frozen=True, kw_only=True)
    class CameraTopicSpec(SensorTopicSpec):
        sources: ClassVar[tuple[str, ...]] = ("virtualCamera",)

    assert CameraTopicSpec.is_simulated()
    monkeypatch.setitem(SENSORS, "virtualCamera", SensorSpec)
    assert not CameraTopicSpec.is_simulated()


def test_an_interface_knows_its_element() -> None:
    assert element_name(ImuToROSImuSpec(name="imu", topic="/imu")) == "ImuToROSImu"


@dataclasses.dataclass(frozen=True, kw_only=True)
class DepthSpec(PressureSensorSpec):
    """What it takes to simulate a sensor whose element is read already."""

    message_type: ClassVar[type] = Float64

    def bind(self, world: SensorWorld, vehicle: Carrier) -> Depth:  # type: ignore[override]
        return Depth(vehicle.mount(self))


class Depth:
    state = NoState()

    def __init__(self, mount: Body) -> None:
        self._mount = mount

    def sample(self, time: float) -> Float64:
        return Float64(data=-float(self._mount.world_from_body.position[2]))


def test_a_sensor_is_published_as_soon_as_its_spec_has_a_bind(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scene = read_scene(SCENE)
    sensor = DepthSpec(name="depth", relative_to="base_link")
    topic = PressureSensorToROSSpec(name="depth", topic="/depth", rate=100)
    missing = PressureSensorToROSSpec(name="other", topic="/other")
    vehicle = dataclasses.replace(scene.vehicles[0], parts=(sensor,))
    monkeypatch.setitem(SENSORS, "pressureSensor", SensorSpec)
    assert not topic.is_simulated()
    monkeypatch.setitem(SENSORS, "pressureSensor", DepthSpec)
    assert topic.is_simulated()
    scene = dataclasses.replace(
        scene, vehicles=(vehicle,), objects=(), ros_interfaces=(missing, topic)
    )
    with open_scene(scene, is_blind=True) as simulation:
        simulation.latest_message("/depth")
        simulation.advance(0.01)
        expected = -simulation.world.bodies.find("girona500/base_link").world_from_body.position[2]
        assert simulation.latest_message("/depth").data == pytest.approx(expected)
        assert "other" not in simulation.topics
        saved = simulation.save()
        simulation.advance(0.01)
        simulation.restore(saved)
        assert simulation.time == pytest.approx(0.01)
