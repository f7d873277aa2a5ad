"""``uwsim run --follow``: the vehicle of a scene follows poses from outside."""

from __future__ import annotations

import json
import math
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from tests.support.waiting import free_port
from uwsim.cli import main
from uwsim.messages import Odometry
from uwsim.middleware.recording import BagReader


@pytest.mark.parametrize(
    ("options", "error"),
    [
        (["--follow", "ros1:/odom"], "--follow ros1:/odom: needs --ros1."),
        (["--follow", "udp:9"], "expected ros1:/TOPIC, ros2:/TOPIC, web:/TOPIC or mavlink:PORT"),
        (["--follow", "mavlink:x"], "'x' is no port"),
        (["--web", "0", "--follow", "web:/odom:posee"], "'posee' is no type of poses"),
        (["--follow-delay", "0.1"], "need --follow"),
        (["--compose", "camera"], "--compose 'camera': expected CAMERA=TOPIC."),
        (["--add-fog", "0.1"], "--add-fog needs --compose"),
    ],
)
def test_options_of_a_followed_vehicle_are_checked(
    capfd: pytest.CaptureFixture[str], options: list[str], error: str
) -> None:
    assert main(["run", "bluerov2-scene", "--for", "0.1s", *options]) == 2
    assert error in capfd.readouterr().err


def test_an_unknown_vehicle_is_an_error_that_names_the_others(
    capfd: pytest.CaptureFixture[str],
) -> None:
    command = ["run", "bluerov2-scene", "--follow", "bluerov=mavlink:14599", "--for", "0.1s"]
    assert main(command) == 2
    assert "'bluerov'" in capfd.readouterr().err


class PoseSender(threading.Thread):
    """A stub of a tank's tracking system, which sends poses to a WebSocket as rosbridge does."""

    def __init__(self, port: int) -> None:
        super().__init__(daemon=True)
        self._port, self.is_over = port, threading.Event()

    def run(self) -> None:
        for _ in range(600):
            try:
                self._send()
            except (OSError, ConnectionClosed):
                time.sleep(0.1)  # the simulation does not listen yet, or has ended
            if self.is_over.is_set():
                return

    def _send(self) -> None:
        with connect(f"ws://127.0.0.1:{self._port}", compression=None) as socket:
            kind = "nav_msgs/Odometry"
            socket.send(json.dumps({"op": "advertise", "topic": "/odom", "type": kind}))
            for i in range(3000):
                if self.is_over.is_set():
                    return
                x = math.nan if i == 5 else 0.004 * i
                pose = {"position": {"x": x, "y": 1.0, "z": 1.5}, "orientation": {"w": 1.0}}
                now = time.time()
                stamp = {"sec": int(now), "nanosec": int(1e9 * (now % 1.0))}
                message = {"header": {"stamp": stamp}, "pose": {"pose": pose}}
                text = json.dumps({"op": "publish", "topic": "/odom", "msg": message})
                socket.send(text.replace("NaN", "null") if i == 5 else text)
                time.sleep(0.01)


@pytest.mark.slow
def test_a_vehicle_follows_poses_over_the_websocket_and_they_are_reported(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    port = free_port()
    sender, out = PoseSender(port), tmp_path / "live.mcap"
    sender.start()
    try:
        command = ["run", "bluerov2-scene", "--web", str(port), "--follow", "web:/odom"]
        assert main([*command, "--for", "4s", "--images", "none", "--record", str(out)]) == 0
    finally:
        sender.is_over.set()
    printed = capfd.readouterr()
    assert "bluerov2: " in printed.out
    assert "poses received" in printed.out
    with BagReader(out) as reader:
        odometry: list[Odometry] = [
            message for _, topic, message in reader.messages() if topic == "/bluerov2/odom"
        ]
    y = np.array([message.pose.pose.position.y for message in odometry])
    assert y[-1] == pytest.approx(1.0)
    assert odometry[-1].pose.pose.position.x > 0.05
    speed = odometry[-1].twist.twist.linear.x
    assert 0.0 < speed < 0.5, "0.004 m in 0.01 s, or more on a busy computer"
    assert "delay above the smallest" in printed.out
