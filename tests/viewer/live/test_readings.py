"""The state of the piloted vehicle and the topics that pages ask for: nothing changes by them."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest

import uwsim
from tests.support.opened import open_scene
from tests.viewer.live.desk import Desk
from uwsim.bus import Bus
from uwsim.devices.battery import BatterySpec
from uwsim.messages import Float64, Float64MultiArray, JointState, PoseStamped, String
from uwsim.viewer.live.readings import Readings
from uwsim.viewer.live.session import LiveSession
from uwsim.viewer.live.topic_monitor import MAX_FIELDS, TopicMonitor, fields_of


def test_joints_have_the_names_of_the_file_and_forces_and_battery_those_of_their_sensors() -> None:
    with uwsim.load("grasp-scene") as opened:
        scene = opened.world.model.scene
    battery = BatterySpec(name="pack", capacity=10.0, voltage=24.0, charge=0.25, hotel_load=500.0)
    [vehicle] = scene.vehicles
    with open_scene(
        replace(scene, vehicles=(replace(vehicle, parts=(*vehicle.parts, battery)),)), is_blind=True
    ) as simulation:
        simulation.advance(0.2)
        found = {name: (unit, value) for name, unit, value in Readings(simulation, 0).read(0.0)}
        live = simulation.world.vehicles.find("girona500")
        joints = live.joints
        wrist = simulation.world.sensors.sensor("wrist", ("ForceSensor",)).sample(0.0).wrench.force
    for name, value in zip(live.joint_names, joints, strict=True):
        assert found[f"joint/{name}"] == ("deg", pytest.approx(math.degrees(value)))
    assert found["force/wrist"] == ("N", pytest.approx(math.hypot(wrist.x, wrist.y, wrist.z)))
    assert found["force/wrist"][1] > 10.0  # the weight of the hand
    assert found["contact force"] == ("N", 0.0)
    unit, charge = found["battery/pack"]
    assert unit == "%"
    assert charge is not None
    assert 24.0 < charge < 25.0


def test_a_contact_is_felt_and_a_slide_is_in_metres() -> None:
    with uwsim.load("grasp-scene") as simulation:
        live = simulation.world.vehicles.find("girona500")
        sunk = replace(live.world_from_base, position=live.world_from_base.position - (0, 0, 1.9))
        live.place(sunk)
        simulation.advance(0.1)
        readings = {name: value for name, _, value in Readings(simulation, 0).read(0.0)}
        forces = simulation.world.contacts.forces("girona500").values()
    assert readings["contact force"] == pytest.approx(sum(np.linalg.norm(f) for f in forces))
    assert readings["contact force"] > 1.0


def test_the_real_time_factor_is_that_of_the_last_seconds_and_none_in_a_pause() -> None:
    with uwsim.load("currents-scene") as simulation:
        readings, wall, factors = Readings(simulation, 0), 0.0, []
        for speed in (2.0, 2.0, 2.0, 0.5, 0.5, 0.5, 0.5, 0.5):
            factors.append(readings.read(wall)[-1])
            simulation.advance(0.5)
            wall += 0.5 / speed
        assert factors[0] == ("real-time factor", "1", None)
        assert factors[2][2] == pytest.approx(2.0)
        assert factors[-1][2] == pytest.approx(0.5)
        assert readings.read(wall, is_paused=True)[-1][2] is None


def test_a_scene_without_a_vehicle_has_its_pace_alone() -> None:
    with uwsim.load("currents-scene") as opened:
        scene = replace(opened.world.model.scene, vehicles=(), ros_interfaces=())
    with open_scene(scene, is_blind=True) as simulation:
        assert [name for name, _, _ in Readings(simulation, 0).read(0.0)] == ["real-time factor"]


def test_numbers_and_texts_of_a_message_have_their_paths() -> None:
    pose = PoseStamped()
    pose.pose.position.x = 1.5
    pose.pose.orientation.w = math.nan
    found = dict(fields_of(pose))
    assert found["pose.position.x"] == 1.5
    assert found["pose.orientation.w"] is None
    assert not any(path.startswith("header") for path in found)
    joints = dict(fields_of(JointState(name=["a", "b"], position=np.arange(20.0))))
    assert (joints["name[1]"], joints["position[7]"]) == ("b", 7.0)
    assert "position[8]" not in joints
    assert joints["position.length"] == 20.0
    assert dict(fields_of(String(data="x" * 999)))["data"] == "x" * 200


def heard(bus: Bus, wall: list[float]) -> TopicMonitor:
    return TopicMonitor(bus, lambda: 4.0, lambda: wall[0])


def test_a_topic_is_heard_while_it_is_wanted_as_nobody_who_counts() -> None:
    bus, wall = Bus(), [1.0]
    publish = bus.publisher("depth", Float64)
    topics = heard(bus, wall)
    assert topics.new_messages({"?topic/depth", "?topic/none", "?image/camera"}) == {}
    assert not bus.has_subscribers("depth")
    for value in (2.0, 3.0):  # the second comes too soon
        publish(Float64(data=value))
        bus.deliver()
    [(channel, text)] = topics.new_messages({"?topic/depth"}).items()
    assert channel == "?topic/depth"
    about = {"type": "topic", "name": "depth", "time": 4.0, "is_cut": False}
    assert json.loads(text) == {**about, "fields": [["data", 2.0]]}
    assert topics.new_messages({"?topic/depth"}) == {}
    topics.new_messages(set())
    wall[0] = 2.0
    publish(Float64(data=5.0))
    bus.deliver()
    assert topics.new_messages({"?topic/depth"}) == {}


def test_of_a_large_message_the_first_fields_are_sent() -> None:
    bus = Bus()
    publish = bus.publisher("names", JointState)
    topics = heard(bus, [1.0])
    topics.new_messages({"?topic/names"})
    publish(
        JointState(name=["n"] * 99, position=[0.0] * 99, velocity=[0.0] * 99, effort=[0.0] * 99)
    )
    bus.deliver()
    [text] = topics.new_messages({"?topic/names"}).values()
    assert json.loads(text)["is_cut"] is (len(json.loads(text)["fields"]) == MAX_FIELDS)
    assert len(text) < 4000


def test_the_list_of_topics_is_sent_when_it_has_changed() -> None:
    bus = Bus()
    topics = heard(bus, [1.0])
    bus.publisher("a", Float64)
    assert json.loads(topics.changed_list() or "")["topics"] == [["a", "std_msgs/msg/Float64"]]
    assert topics.changed_list() is None
    bus.publisher("b", Float64MultiArray)
    assert len(json.loads(topics.changed_list() or "")["topics"]) == 2


def test_pages_get_readings_and_the_topics_they_want() -> None:
    desk = Desk(wanted=frozenset({"?topic/dataNavigator"}))
    wall = [0.0]
    session = LiveSession(desk, real_time_factor=0.0, wall=lambda: wall[0])  # type: ignore[arg-type]
    with uwsim.load("currents-scene") as simulation:
        session.open(simulation, "scene")
        for _ in range(5):
            wall[0] += 0.25
            simulation.publish("dataNavigator", simulation.bus.message_type("dataNavigator")())  # type: ignore[misc]
            simulation.advance(0.02)
        session.close()
        assert json.loads(desk.on("readings")[-1])["time"] == pytest.approx(0.1, abs=0.021)
        assert len(desk.on("topics")) == 1
        assert len(desk.on("?topic/dataNavigator")) >= 3
