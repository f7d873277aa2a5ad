"""Interfaces: one without ``bind`` does nothing; one that names what is not there is left out."""

from __future__ import annotations

import dataclasses
from typing import ClassVar

import pytest

from uwsim.devices import DEVICES
from uwsim.scene.not_yet import limit_of
from uwsim.schema import slots
from uwsim.sensors import SENSORS
from uwsim.sensors.sensor import measured_by
from uwsim.topics import INTERFACES, InterfaceSpec, element_of
from uwsim.topics.sensor_topic import ImuToROSImuSpec, SensorTopicSpec


@pytest.mark.parametrize("name", [name for name in INTERFACES if name != "SimulatedDeviceROS"])
def test_what_has_no_bind_is_said_to_be_read_only(name: str) -> None:
    spec = INTERFACES[name]
    assert bool(limit_of("rosInterfaces", name)) is not spec.is_simulated()
    assert bool(spec.carries()) is spec.is_simulated()


@pytest.mark.parametrize("spec", INTERFACES.values())
def test_topics_are_fields_and_sources_are_elements(spec: type[InterfaceSpec]) -> None:
    assert set(spec.carries()) <= {slot.field for slot in slots(spec)}
    assert set(spec.sources) <= {*SENSORS, *DEVICES, "vehicle", "object"}


def test_sensors_on_one_interface_measure_the_same() -> None:
    for spec in INTERFACES.values():
        if issubclass(spec, SensorTopicSpec):
            parts = {**SENSORS, **DEVICES}
            types = {measured_by(parts[source]) for source in spec.sources} - {None}
            assert len(types) <= 1


def test_an_interface_of_a_sensor_that_is_simulated_is_simulated() -> None:
    @dataclasses.dataclass(frozen=True, kw_only=True)
    class CameraTopicSpec(SensorTopicSpec):
        sources: ClassVar[tuple[str, ...]] = ("virtualCamera",)

    assert CameraTopicSpec.is_simulated()
    assert not ImuToROSImuSpec.is_simulated()


def test_an_interface_knows_its_element() -> None:
    assert element_of(ImuToROSImuSpec(name="imu", topic="/imu")) == "ImuToROSImu"
