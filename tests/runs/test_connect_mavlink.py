"""A vehicle that ArduPilot steers has a MAVLink connection in a run, beside its physics."""

from __future__ import annotations

from dataclasses import replace

import pytest

from uwsim.assets.bundled import bundled_files
from uwsim.devices.ardupilot import ArduPilotSpec
from uwsim.devices.mavlink import MavlinkSpec
from uwsim.runs.planning.ardupilot_scene import connect_mavlink
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec


def scene_without_mavlink(instance: int) -> SceneSpec:
    scene = read_scene(bundled_files("scenes")["bluerov2-scene"])
    (vehicle,) = scene.vehicles
    parts = tuple(
        replace(part, instance=instance) if isinstance(part, ArduPilotSpec) else part
        for part in vehicle.parts
        if not isinstance(part, MavlinkSpec)
    )
    return replace(scene, vehicles=(replace(vehicle, parts=parts),))


@pytest.mark.parametrize(("instance", "port"), [(0, 5762), (3, 5792)])
def test_a_vehicle_with_ardupilot_gets_one_at_the_second_port(instance: int, port: int) -> None:
    (vehicle,) = connect_mavlink(scene_without_mavlink(instance)).vehicles
    (link,) = vehicle.parts_of(MavlinkSpec)
    assert link.name == "bluerov2/autopilot"
    assert link.complete(vehicle.parts).address == f"tcp:127.0.0.1:{port}"
    assert [link.dvl, link.odometry, link.range] == ["", "", ""]


def test_an_address_of_the_file_is_kept() -> None:
    link = MavlinkSpec(address="udpin:127.0.0.1:14600")
    assert link.complete([ArduPilotSpec(instance=2)]) == link
    assert MavlinkSpec().complete([]).address == "tcp:127.0.0.1:5762"


def test_that_of_the_scene_remains() -> None:
    scene = read_scene(bundled_files("scenes")["bluerov2-scene"])
    assert connect_mavlink(scene) == scene


def test_without_pymavlink_none_is_added(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = scene_without_mavlink(0)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    assert connect_mavlink(scene) == scene
