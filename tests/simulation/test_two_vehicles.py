"""The bundled scene with two vehicles and an acoustic link, for five seconds."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import uwsim
from uwsim.acoustics import sound_speed
from uwsim.messages import UInt8MultiArray, seconds

SECONDS = 5.0
PUBLISHED = {
    "first/odom": ("nav_msgs/msg/Odometry", 51),
    "second/odom": ("nav_msgs/msg/Odometry", 51),
    "tf": ("tf2_msgs/msg/TFMessage", 3 * 51),
    "modem1/pose": ("geometry_msgs/msg/Pose", 51),
    "modem2/pose": ("geometry_msgs/msg/Pose", 51),
    "modem1/energy": ("std_msgs/msg/Float64", 6),
    "modem1/rx": ("std_msgs/msg/UInt8MultiArray", 0),
    "modem2/rx": ("std_msgs/msg/UInt8MultiArray", 1),
}
"""Topic -> type and number of messages."""


def collected() -> tuple[dict[str, list[tuple[float, Any]]], dict[str, str]]:
    with uwsim.load("two-vehicles-scene", seed=1) as simulation:
        heard: dict[str, list[tuple[float, Any]]] = {name: [] for name in PUBLISHED}
        for name in PUBLISHED:
            simulation.bus.subscribe(
                name, object, lambda m, name=name: heard[name].append((simulation.time, m))
            )
        data = np.arange(50, dtype=np.uint8)
        simulation.publish("/modem1/tx", UInt8MultiArray(data=data))
        simulation.advance(SECONDS)
        return heard, simulation.topics


@pytest.mark.slow
def test_every_topic_has_its_type_its_rate_and_sound_values() -> None:
    heard, types = collected()
    assert {name: (types[name], len(found)) for name, found in heard.items()} == PUBLISHED
    [(time, packet)] = heard["modem2/rx"]
    assert packet.data.tolist() == list(range(50))
    speed = sound_speed(temperature=12.0, salinity=35.0, depth=40.0)
    assert time == pytest.approx(0.05 + 50 * 8 / 1000.0 + 300.0 / speed, abs=0.003)
    depths = [message.pose.pose.position.z for _, message in heard["second/odom"]]
    assert max(abs(depth - 40.0) for depth in depths) < 0.1
    energies = [message.data for _, message in heard["modem1/energy"]]
    assert energies[0] == pytest.approx(10000.0)
    assert energies[-1] == pytest.approx(10000.0 - 18.0 * 0.45 - 0.02 * 4.55)
    stamps = [seconds(m.transforms[0].header.stamp) for _, m in heard["tf"]]
    assert stamps == sorted(stamps)
    for _, message in heard["tf"]:
        for each in message.transforms:
            q = each.transform.rotation
            assert q.x**2 + q.y**2 + q.z**2 + q.w**2 == pytest.approx(1.0)
